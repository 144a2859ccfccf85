"""RMS in windows as the graph computes it, against all signals held at once."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine.window_rules import rms_within
from skinsource.signals.analysis.windows import Windows

TRAIN = ss.Design(
    limb="synthetic-4",
    inputs=(
        ss.track(7, ss.waveforms.WaveletTrain()),
        ss.track(13, ss.waveforms.Tap(), onset_s=0.3, amplitude=0.4),
    ),
)
WANTED = ("windows", "rms_of_windows", "levels_of_windows_db", "extents_of_windows")


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


def test_maps_of_windows_are_interpolations_of_their_levels():
    values = ss.evaluate(TRAIN, "surface_of_windows_db", "levels_of_windows_db", "surface")
    for shown, levels in zip(
        values["surface_of_windows_db"], values["levels_of_windows_db"], strict=True
    ):
        np.testing.assert_array_equal(shown, values["surface"].interpolate(levels))
