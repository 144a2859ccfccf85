"""Which windows of a response belong to its stimulus, and what they hold."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.window_rules import _rms_within
from skinsource.signals.analysis.windows import MOST_WINDOWS, Windows, windows_over

RATE_HZ = 1300.0


def test_windows_of_a_length_begin_with_the_first_arrival_and_cover_the_stimulus():
    windows = windows_over(780, 1301, RATE_HZ, count=None, window_s=0.12)
    assert windows == Windows(first_sample=67, window_samples=156, count=5)
    assert windows.bounds_s(RATE_HZ)[0] == (0.0, 0.12)
    assert windows.bounds_s(RATE_HZ)[-1] == pytest.approx((0.48, 0.6))


@pytest.mark.parametrize(
    ("delay_s", "rate_hz", "sample"),
    [(0.086, 2500.0, 215), (0.043, 5000.0, 215), (0.052, 1300.0, 67)],
)
def test_a_delay_of_whole_samples_is_as_many_however_it_is_rounded(delay_s, rate_hz, sample):
    windows = windows_over(780, 1301, rate_hz, count=2, window_s=0.0, delay_s=delay_s)
    assert windows.first_sample == sample


def test_a_stimulus_that_ends_within_a_window_has_it_too():
    assert windows_over(781, 1302, RATE_HZ, count=None, window_s=0.12).count == 6


def test_a_count_cuts_the_stimulus_into_equal_parts():
    assert windows_over(780, 1301, RATE_HZ, count=4, window_s=0.0) == Windows(
        first_sample=67, window_samples=195, count=4
    )
    assert windows_over(783, 1304, RATE_HZ, count=4, window_s=0.0).window_samples == 195
    # A single sample cannot be cut.
    assert windows_over(1, 522, RATE_HZ, count=3, window_s=0.0).window_samples == 1


def test_only_whole_windows_count():
    assert windows_over(100, 621, RATE_HZ, count=None, window_s=0.5).count == 0
    assert windows_over(100, 67 + 650, RATE_HZ, count=None, window_s=0.5).count == 1
    assert windows_over(100, 67 + 649, RATE_HZ, count=None, window_s=0.5).count == 0


def test_there_are_never_too_many():
    windows = windows_over(1300 * 600, 1300 * 600 + 521, RATE_HZ, count=None, window_s=0.01)
    assert windows.count == MOST_WINDOWS


def test_at_another_rate_they_begin_at_the_same_time():
    assert windows_over(4000, 5000, 4000.0, count=5, window_s=0.0).first_sample == 208


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
    np.testing.assert_allclose(_rms_within(windows, pieces, 3), expected, rtol=1e-12)


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


@pytest.mark.parametrize("still", [ss.Input(location=19), ss.track(25)], ids=["empty", "nowhere"])
def test_extents_are_none_from_inputs_that_do_not_move_the_skin(still):
    def extents(design):
        given = sources(design, ss.View(method="mag"), leave_out_unplayable=True)
        return new_graph().evaluate(("extents_of_windows",), given)["extents_of_windows"]

    assert extents(replace(TRAIN, inputs=(*TRAIN.inputs, still))) == extents(TRAIN)


def test_a_silent_window_has_no_extent_and_no_sound_of_rounding():
    late = ss.Design(limb="synthetic-1", inputs=(ss.track(7, onset_s=2.0),))
    values = ss.evaluate(late, *WANTED, view=ss.View(windows_cut="length", window_s=0.5))
    # What is measured before the trigger lies in the fourth.
    assert values["extents_of_windows"][:3] == (None,) * 3
    assert not values["rms_of_windows"][:3].any()
    assert values["extents_of_windows"][4] is not None


def test_windows_lie_on_the_clock_of_the_traces_where_an_equaliser_moves_before_the_stimulus():
    coil = ss.ActuatorAt(actuator="coil", model=ss.actuators.load("example-voice-coil"))
    inverse = ss.equalising.RegularisedInverse()
    through = ss.Actuation(actuators=(coil,), equaliser=inverse, on=True)
    tone = ss.waveforms.Tone(frequency_hz=150.0, duration_s=0.4)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),), actuation=through)
    view = ss.View(outputs=(29,), windows_cut="count", window_count=4, delay_removed=True)
    wanted = "windows", "rms_of_windows", "selected_traces", "response_time_s", "sample_rate_hz"
    values = ss.evaluate(design, *wanted, view=view)
    time_s, [trace] = values["response_time_s"], values["selected_traces"]
    assert time_s[0] < -0.1
    bounds_s = values["windows"].bounds_s(values["sample_rate_hz"])
    assert bounds_s[-1][1] == pytest.approx(0.4)
    for (begin_s, end_s), rms in zip(bounds_s, values["rms_of_windows"][:, 28], strict=True):
        # The first sample is that of the delay, rounded down.
        within = trace[(time_s > begin_s - 9e-4) & (time_s < end_s - 9e-4)]
        assert np.sqrt(np.mean(within**2)) == pytest.approx(rms, rel=1e-6)
