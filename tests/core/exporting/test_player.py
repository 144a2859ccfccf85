"""The folder for PsychoPy: it runs, on a sound card that is made up here."""

import csv
import json
import runpy
import sys
import types

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import StorageError
from tests.core.playing.synthetic_sound import CallbackStop, SoundLibrary

LATENCY_S = 0.0125
DELAY = 321


class SyntheticCard(SoundLibrary):
    """What of sounddevice the player uses; output 1 is wired to input 1, ``DELAY`` samples late."""

    def OutputStream(self, **asked):  # as sounddevice calls it
        return self.open(SyntheticStream(**asked))

    def playrec(self, samples, *_, **__):
        late = np.zeros_like(samples[:, :1])
        late[DELAY:] = samples[:-DELAY, :1]
        return late


class SyntheticStream:
    """Asks for all blocks as soon as it is opened."""

    def __init__(self, *, samplerate, channels, callback, **_):
        self.shape, self.callback, self.rate_hz = channels, callback, samplerate
        self.played, self.active = [], False

    def __enter__(self):
        at, status = 100.0, types.SimpleNamespace(output_underflow=False)
        while True:
            self.played.append(np.full((256, self.shape), np.nan, np.float32))
            about = types.SimpleNamespace(currentTime=at, outputBufferDacTime=at + LATENCY_S)
            try:
                self.callback(self.played[-1], 256, about, status)
            except CallbackStop:
                return self
            at += 256 / self.rate_hz

    def __exit__(self, *_):
        return None


@pytest.fixture
def card(monkeypatch):
    card = SyntheticCard()
    monkeypatch.setitem(sys.modules, "sounddevice", card)
    return card


@pytest.fixture
def folder(design, tmp_path):
    path = tmp_path / "session"
    ss.export_stimulus(design, path, format="psychopy", rate_hz=48_000)
    return path


@pytest.fixture
def player(folder, card):
    return types.SimpleNamespace(**runpy.run_path(str(folder / "play.py")))


def test_the_folder_holds_all_that_is_needed(folder, expected, design):
    names = sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())
    assert names == ["conditions.csv", "play.py", "stimuli/session.wav", "stimulus.json"]
    read, rate_hz = soundfile.read(folder / "stimuli" / "session.wav", dtype="float32")
    np.testing.assert_array_equal(read, expected(design, 48_000).astype(np.float32))
    with (folder / "conditions.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert row["stimulus"] == "stimuli/session.wav"
    assert (row["channels"], row["rate_hz"], row["trigger_code"]) == ("2", "48000", "1")
    assert float(row["duration_s"]) == len(read) / rate_hz
    beside = folder.with_name("session.json").read_text()
    assert beside == (folder / "stimulus.json").read_text()
    assert json.loads(beside)["player"] == "play.py"


def test_it_plays_what_was_exported_with_a_trigger_that_can_be_read(
    folder, player, card, expected, design
):
    player.main(["--gain-db", "-6", "--trigger", "4", "--mask", "3"])
    (stream,) = card.streams
    played = np.concatenate(stream.played)
    expected_samples = expected(design, 48_000) * 10 ** (-6 / 20)
    assert played.shape[1] == 4
    np.testing.assert_allclose(
        played[: len(expected_samples), :2], expected_samples, rtol=0, atol=1e-6
    )
    assert not played[len(expected_samples) :].any()
    assert player.code_in(played[:, 3], 48_000) == (1, 0)
    noise = played[: len(expected_samples), 2]
    assert np.abs(noise).max() == pytest.approx(10 ** (-30 / 20), rel=1e-5)
    with (folder / "log.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert float(row["begin_dac_s"]) == 100.0 + LATENCY_S
    assert float(row["latency_s"]) == pytest.approx(LATENCY_S)
    assert row["underflows"] == "0"


@pytest.mark.parametrize("code", [0, 1, 37, 128, 255])
@pytest.mark.parametrize("rate_hz", [8000, 44_100, 48_000])
def test_every_code_reads_back_also_late_and_noisy(player, code, rate_hz):
    marks = player.trigger(code, rate_hz)
    rng = np.random.default_rng(code)
    recorded = rng.normal(0.0, 0.02, marks.size + 3000)
    recorded[1234 : 1234 + marks.size] += 0.3 * marks
    assert player.code_in(recorded, rate_hz) == (code, 1234)


def test_the_loopback_test_tells_delay_and_jitter(player, capsys):
    player.main(["--loopback", "1", "1", "--repeats", "5"])
    printed = capsys.readouterr().out
    assert "5 of 5 clicks seen" in printed
    assert f"delay {DELAY / 48:.3f} ms, jitter 0.0000 ms" in printed


def test_outputs_of_the_stimulus_are_not_taken_for_anything_else(player):
    with pytest.raises(SystemExit, match="from 3 on"):
        player.main(["--trigger", "2"])
    with pytest.raises(SystemExit, match="full scale"):
        player.main(["--gain-db", "3"])


def test_an_earlier_folder_is_replaced_and_a_foreign_one_is_not(design, tmp_path):
    path = tmp_path / "session"
    ss.export_stimulus(design, path, format="psychopy")
    (path / "stimuli" / "old.wav").write_text("")
    ss.export_stimulus(design, path, format="psychopy", rate_hz=8000)
    assert not (path / "stimuli" / "old.wav").exists()
    assert soundfile.info(path / "stimuli" / "session.wav").samplerate == 8000
    other = tmp_path / "thesis"
    other.mkdir()
    (other / "chapter.txt").write_text("years of work")
    with pytest.raises(StorageError, match="something else has this name"):
        ss.export_stimulus(design, other, format="psychopy")
    assert (other / "chapter.txt").read_text() == "years of work"
    assert sorted(entry.name for entry in tmp_path.iterdir()) == [
        "session",
        "session.json",
        "thesis",
    ]
