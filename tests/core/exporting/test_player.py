"""The folder for PsychoPy: it runs, on a sound card that is made up here."""

import csv
import json
import runpy
import sys
import types
from time import monotonic

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import StorageError
from skinsource.lab.playing.triggers import code_in, trigger_of
from tests.core.playing.synthetic_sound import INSIDE_S, SyntheticSoundLibrary
from tests.core.rig_measuring import bench_top


@pytest.fixture
def card(monkeypatch):
    card = SyntheticSoundLibrary(Eight=8)
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
    before_s = monotonic()
    player.main(["--gain-db", "-6", "--trigger", "4", "--mask", "3"])
    after_s = monotonic()
    (stream,) = card.streams
    drive, marks = stream.samples[:2], stream.samples[3]
    expected_samples = (expected(design, 48_000) * 10 ** (-6 / 20)).T
    assert len(stream.samples) == 4
    code, begin = code_in(marks, 48_000)
    assert code == 1
    end = begin + expected_samples.shape[1]
    np.testing.assert_allclose(drive[:, begin:end], expected_samples, rtol=0, atol=1e-6)
    assert not drive[:, end:].any()
    noise = stream.samples[2, begin:end]
    assert np.abs(noise).max() == pytest.approx(10 ** (-30 / 20), rel=1e-5)
    with (folder / "log.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert float(row["begin_dac_s"]) > 0.0
    assert before_s < float(row["onset_monotonic_s"]) < after_s + INSIDE_S
    assert (row["onset"], row["loopback_s"], row["underflows"]) == ("estimated", "", "0")


@pytest.mark.parametrize("code", [0, 1, 37, 128, 255])
@pytest.mark.parametrize("rate_hz", [8000, 44_100, 48_000])
def test_every_code_reads_back_also_late_and_noisy(code, rate_hz):
    marks = trigger_of(code, rate_hz)
    rng = np.random.default_rng(code)
    recorded = rng.normal(0.0, 0.02, marks.size + 3000)
    recorded[1234 : 1234 + marks.size] += 0.3 * marks
    assert code_in(recorded, rate_hz) == (code, 1234)


def test_the_loopback_test_tells_delay_and_jitter(player, monkeypatch, capsys):
    path = np.zeros(8192)
    path[321] = 0.6
    monkeypatch.setitem(sys.modules, "sounddevice", bench_top.Card(path, output=1))
    player.main(["--loopback", "1", "1", "--repeats", "5"])
    printed = capsys.readouterr().out
    assert "5 of 5 clicks seen" in printed
    assert f"round trip {10 + 321 / 48:.3f} ms, jitter 0.0000 ms" in printed


def test_outputs_of_the_stimulus_are_not_taken_for_anything_else(player):
    with pytest.raises(SystemExit, match="from 3 on"):
        player.main(["--mask", "2"])
    with pytest.raises(SystemExit, match="cannot be the trigger"):
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
