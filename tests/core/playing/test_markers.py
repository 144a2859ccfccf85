"""Markers for Lab Streaming Layer arrive, all of them, at the time of their onset."""

import json
import runpy
import struct
from pathlib import Path
from time import monotonic
from types import SimpleNamespace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import PlaybackError
from tests.core.playing.playing_bench import wait_for

pylsl = pytest.importorskip("pylsl", reason="the extra lsl is not installed")
pyxdf = pytest.importorskip("pyxdf", reason="pyxdf is not installed")

EXAMPLE = Path(__file__).resolve().parents[3] / "examples" / "lab" / "experiment_with_markers.py"
N_MARKERS = 10_000
TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE, amplitude=0.5),))


@pytest.fixture
def inlet_of():
    inlets = []

    def find(name):
        (info,) = pylsl.resolve_byprop("name", name, timeout=20.0)
        inlets.append(pylsl.StreamInlet(info))
        inlets[-1].open_stream(timeout=20.0)
        return inlets[-1]

    yield find
    for inlet in inlets:
        inlet.close_stream()


def begun(code, *, onset_s):
    """What a marker tells of a playback."""
    return SimpleNamespace(
        code=code,
        first_sample_s=onset_s,
        latency_s=0.01,
        loopback_s=None,
        onset_at=lambda _clock: onset_s,
    )


def pulled(inlet, count):
    """So many samples of an inlet, and their times."""
    values, times = [], []

    def enough():
        chunk, at = inlet.pull_chunk(timeout=0.0, max_samples=count)
        values.extend(chunk)
        times.extend(at)
        return len(times) >= count

    wait_for(enough)
    return values, np.array(times)


def xdf_of(path, texts, times):
    """Write a file as recorders do: head, the marker stream, its samples."""

    def chunk(tag, content):
        return b"\x04" + struct.pack("<IH", len(content) + 2, tag) + content

    head = b"<?xml version='1.0'?><info><version>1.0</version></info>"
    stream = (
        b"<?xml version='1.0'?><info><name>SkinSource</name><type>Markers</type>"
        b"<channel_count>1</channel_count><nominal_srate>0</nominal_srate>"
        b"<channel_format>string</channel_format></info>"
    )
    samples = b"".join(
        b"\x08" + struct.pack("<d", at) + b"\x04" + struct.pack("<I", len(text)) + text.encode()
        for text, at in zip(texts, times, strict=True)
    )
    end = b"<?xml version='1.0'?><info></info>"
    number = struct.pack("<I", 1)
    path.write_bytes(
        b"XDF:"
        + chunk(1, head)
        + chunk(2, number + stream)
        + chunk(3, number + b"\x04" + struct.pack("<I", len(texts)) + samples)
        + chunk(6, number + end)
    )
    return path


def test_none_of_ten_thousand_markers_is_lost_and_a_recorder_reads_them(inlet_of, tmp_path):
    markers = ss.Markers("Ten thousand")
    inlet = inlet_of("Ten thousand")
    for number in range(N_MARKERS):
        markers(begun(number % 256, onset_s=5.0 + 0.01 * number))
    values, times = pulled(inlet, N_MARKERS)
    texts = [value for (value,) in values]
    assert [json.loads(text)["code"] for text in texts] == [n % 256 for n in range(N_MARKERS)]
    assert np.array_equal(times, 5.0 + 0.01 * np.arange(N_MARKERS))
    (read,), _ = pyxdf.load_xdf(xdf_of(tmp_path / "markers.xdf", texts, times))
    assert [value for (value,) in read["time_series"]] == texts
    assert np.array_equal(read["time_stamps"], times)


def test_a_marker_has_the_time_at_which_the_first_sample_is_heard(sound, inlet_of):
    markers = ss.Markers("Onsets")
    with ss.Player(DESIGN, gain_db=0.0, began=markers, loopback_s=0.125) as player:
        inlet = inlet_of("Onsets")
        playback = player.play(code=5)
        assert playback.wait(20)
        (((text,),), (at_s,)) = pulled(inlet, 1)
        ahead_s = pylsl.local_clock() - monotonic()
        assert at_s - ahead_s == pytest.approx(playback.onset_monotonic_s, abs=2e-3)
    said = json.loads(text)
    assert (said["code"], said["onset"], said["loopback_s"]) == (5, "measured", 0.125)
    assert said["first_sample_s"] == playback.first_sample_s


def test_the_drive_is_a_stream_from_the_start_whose_first_sample_is_at_the_onset(sound, inlet_of):
    markers = ss.Markers("Drives", drive_outputs=3)
    inlet = inlet_of("Drives drive")
    with ss.Player(DESIGN, gain_db=0.0, began=markers) as player:
        playback = player.play()
        assert playback.wait(20)
        values, times = pulled(inlet, playback.mix.n_times)
    drive = np.array(values, np.float32).T
    assert np.array_equal(drive[:2], playback.mix.samples)
    assert not drive[2].any()
    ahead_s = pylsl.local_clock() - monotonic()
    assert times[0] - ahead_s == pytest.approx(playback.onset_monotonic_s, abs=2e-3)


def test_a_drive_with_more_outputs_than_its_stream_is_said_and_no_marker_is_lost(sound, inlet_of):
    markers = ss.Markers("Narrow", drive_outputs=1)
    inlet = inlet_of("Narrow")
    player = ss.Player(DESIGN, began=markers)
    assert player.play(code=5).wait(20)
    with pytest.raises(PlaybackError, match="2 outputs play at 48000 Hz, and the stream has 1"):
        player.close()
    (((text,),), _) = pulled(inlet, 1)
    assert json.loads(text)["code"] == 5


def test_the_example_of_an_experiment_runs(sound, monkeypatch, capsys):
    runpy.run_path(str(EXAMPLE))
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 4
    assert all("onset estimated" in line for line in lines)


def test_a_marker_before_the_onset_is_refused():
    with pytest.raises(ss.SkinSourceError, match="has not begun"):
        ss.Markers("Early")(begun(1, onset_s=None))
