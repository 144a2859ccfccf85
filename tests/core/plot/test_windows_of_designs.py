"""RMS in windows as the graph computes it, against all signals held at once."""

import csv
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.transforms import Blocks
from skinsource.engine.window_rules import rms_within
from skinsource.export.tables import export_windows
from skinsource.signals.analysis.windows import Windows

TRAIN = ss.Design(
    limb="synthetic-4",
    inputs=(
        ss.track(7, ss.waveforms.WaveletTrain()),
        ss.track(13, ss.waveforms.Tap(), onset_s=0.3, amplitude=0.4),
    ),
)
WANTED = ("windows", "rms_of_windows", "levels_of_windows_db", "extents_of_windows")


def held(design, view):
    """RMS in windows of signals that are held from begin to end, (n_windows, 72)."""
    everything = replace(view, outputs=tuple(range(1, 73)))
    values = ss.evaluate(design, "selected_traces", "windows", view=everything)
    windows = values["windows"]
    rms = ss.windowed_rms(values["selected_traces"], windows.window_samples, windows.first_sample)
    return rms[: windows.count]


@pytest.mark.parametrize(
    "view",
    [
        ss.View(method="mag"),
        ss.View(method="pca", windows_cut="length", window_s=0.05),
        ss.View(axes="z", window_count=13),
        ss.View(axes="xy", method="rms", windows_cut="length", window_s=0.0077),
    ],
)
def test_windows_of_a_design_hold_the_rms_of_its_signals(view):
    values = ss.evaluate(TRAIN, *WANTED, view=view)
    expected = held(TRAIN, view)
    assert values["rms_of_windows"].shape == expected.shape
    assert len(expected) == values["windows"].count > 3
    np.testing.assert_allclose(values["rms_of_windows"], expected, rtol=1e-9, atol=1e-12)
    np.testing.assert_array_equal(
        values["levels_of_windows_db"], ss.decibels(values["rms_of_windows"])
    )


def test_a_long_design_is_cut_block_by_block_into_the_same_windows(monkeypatch):
    """Windows lie across the blocks in which a long response is computed."""
    long = ss.Design(
        limb="synthetic-1",
        inputs=(
            ss.track(7, ss.waveforms.Chirp(duration_s=20.0)),
            ss.track(3, ss.waveforms.Tap(), onset_s=19.0),
        ),
    )
    view = ss.View(method="mag", windows_cut="length", window_s=0.77)
    at_once = ss.evaluate(long, *WANTED, view=view)
    monkeypatch.setattr("skinsource.engine.voice_rules.length_at_once", lambda *_: None)
    graph = new_graph()
    values = graph.evaluate({*WANTED, "streamed_vibration"}, sources(long, view))
    assert values["streamed_vibration"] is not None
    assert isinstance(values["streamed_vibration"].cut, Blocks)
    assert values["windows"] == at_once["windows"]
    np.testing.assert_allclose(
        values["rms_of_windows"], at_once["rms_of_windows"], rtol=1e-6, atol=1e-9
    )


@pytest.mark.parametrize("step", [1, 7, 40, 41, 333])
def test_pieces_of_any_length_give_the_windows_of_the_whole(step):
    signals = np.random.default_rng(step).standard_normal((3, 333))
    windows = Windows(first_sample=11, window_samples=40, count=7)
    pieces = [
        (np.arange(3), first, signals[:, first : first + step]) for first in range(0, 333, step)
    ]
    expected = ss.windowed_rms(signals, 40, first_sample=11)[:7]
    np.testing.assert_allclose(rms_within(windows, pieces, 3), expected, rtol=1e-12)


def test_extents_are_those_from_the_inputs_that_are_heard():
    view = ss.View(method="mag")
    values = ss.evaluate(TRAIN, *WANTED, view=view)
    limb = ss.load_limb("synthetic-4")
    for rms, extent in zip(values["rms_of_windows"], values["extents_of_windows"], strict=True):
        assert extent == ss.extent(rms, limb, (7, 13))
    muted = TRAIN.with_input(1, muted=True)
    values = ss.evaluate(muted, *WANTED, view=view)
    rms, extent = values["rms_of_windows"][0], values["extents_of_windows"][0]
    assert extent == ss.extent(rms, limb, 7)


def test_a_silent_window_has_no_extent_and_no_sound_of_rounding():
    late = ss.Design(limb="synthetic-1", inputs=(ss.track(7, onset_s=2.0),))
    values = ss.evaluate(late, *WANTED, view=ss.View(windows_cut="length", window_s=0.5))
    # What is measured before the trigger lies in the fourth.
    assert values["extents_of_windows"][:3] == (None,) * 3
    assert not values["rms_of_windows"][:3].any()
    assert values["extents_of_windows"][4] is not None


def test_a_design_without_inputs_has_silent_windows():
    values = ss.evaluate(ss.Design(limb="synthetic-1"), *WANTED)
    assert not values["rms_of_windows"].any()
    assert all(extent is None for extent in values["extents_of_windows"])


def test_maps_of_windows_are_interpolations_of_their_levels():
    values = ss.evaluate(TRAIN, "surface_of_windows_db", "levels_of_windows_db", "surface")
    for shown, levels in zip(
        values["surface_of_windows_db"], values["levels_of_windows_db"], strict=True
    ):
        np.testing.assert_array_equal(shown, values["surface"].interpolate(levels))


def test_the_table_of_windows_reads_back_as_what_was_computed(tmp_path):
    view = ss.View(method="mag", windows_cut="length", window_s=0.12)
    path = tmp_path / "windows.csv"
    export_windows(path, TRAIN, view)
    lines = path.read_text("utf-8").splitlines()
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    numbers = np.array(rows[1:], float)
    values = ss.evaluate(TRAIN, *WANTED, view=view)
    np.testing.assert_allclose(numbers[:, 7:], values["rms_of_windows"], rtol=1e-12)
    assert rows[0][:4] == ["from_s", "to_s", "mean_distance_mm", "d90_mm"]
    np.testing.assert_allclose(numbers[:, 0], 0.12 * np.arange(5))
    extents = values["extents_of_windows"]
    assert [extent.mean_distance_mm for extent in extents] == pytest.approx(
        numbers[:, 2], rel=1e-12
    )
    assert [extent.d90_mm for extent in extents] == pytest.approx(numbers[:, 3], rel=1e-12)
    assert [extent.participation for extent in extents] == pytest.approx(numbers[:, 6], rel=1e-12)
    assert any("SYNTHETIC" in line for line in lines)
    assert any("156 samples each, the first from sample 67" in line for line in lines)


def test_the_extent_of_silence_is_no_number_in_the_table(tmp_path):
    path = tmp_path / "windows.csv"
    export_windows(path, ss.Design(limb="synthetic-1"), ss.View())
    rows = [line for line in path.read_text("utf-8").splitlines() if not line.startswith("#")]
    assert rows[1].split(",")[2] == "nan"
