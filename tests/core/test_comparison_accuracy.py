"""Errors, times and promises of the benchmark, on hand-made numbers."""

import gc
from dataclasses import replace

import numpy as np
import pytest

from skinsource.method_comparison.accuracy import QUIETEST, errors_of, picked, rounding_ratio
from skinsource.method_comparison.promises import Outcome, broken_promises
from skinsource.method_comparison.references import Reference
from skinsource.method_comparison.scenes import scene_of
from skinsource.method_comparison.timing import repeated, times_of

# Two channels, three windows of which the last is silent, two samples each.
HIGH = np.array([[[4.0, 2.0], [0.5, 0.25], [0.0, 0.0]], [[-2.0, 1.0], [0.1, -0.2], [0.0, 0.0]]])
REFERENCE = Reference(
    channels=np.array([3, 5]),
    starts=np.array([0, 130, 260]),
    samples=np.array([[[0, 7], [130, 140], [260, 261]], [[1, 2], [150, 151], [270, 265]]]),
    peaks=np.abs(HIGH).max(axis=2),
    high=HIGH,
    low=np.zeros_like(HIGH),
)


def changed(channel, window, sample, by):
    values = HIGH.copy()
    values[channel, window, sample] += by
    return errors_of(REFERENCE, values)


def test_exact_values_have_no_error():
    errors = errors_of(REFERENCE, HIGH.copy())
    assert (errors.peak, errors.l2, errors.window, errors.silence) == (0.0, 0.0, 0.0, 0.0)


def test_an_error_is_relative_to_the_peak_of_its_channel_and_of_its_window():
    errors = changed(0, 1, 1, 0.001)
    assert errors.peak == pytest.approx(0.001 / 4.0)
    assert errors.window == pytest.approx(0.001 / 0.5)
    assert errors.l2 == pytest.approx(0.001 / np.linalg.norm(HIGH[0]))


def test_the_worst_channel_counts():
    values = HIGH.copy()
    values[:, 0, 0] += 0.01
    assert errors_of(REFERENCE, values).peak == pytest.approx(0.01 / 2.0)


def test_any_sound_in_a_channel_without_a_response_is_an_error_beyond_measure():
    mute = replace(REFERENCE, high=HIGH.copy(), peaks=REFERENCE.peaks.copy())
    mute.high[1], mute.peaks[1] = 0.0, 0.0
    assert errors_of(mute, mute.high).peak == errors_of(mute, mute.high).l2 == 0.0
    wrong = mute.high.copy()
    wrong[1, 0, 0] = 1e-20
    assert errors_of(mute, wrong).peak > 1e200


def test_sound_in_silence_is_told_apart():
    errors = changed(1, 2, 0, -1e-9)
    assert errors.silence == pytest.approx(1e-9 / 2.0)
    assert errors.window == 0.0


@pytest.mark.parametrize(("factor", "counts"), [(1.01, True), (0.99, False)])
def test_windows_below_the_quietest_are_promised_nothing(factor, counts):
    quiet = replace(REFERENCE, peaks=REFERENCE.peaks.copy())
    quiet.peaks[0, 1] = 4.0 * QUIETEST * factor
    values = HIGH.copy()
    values[0, 1, 0] += 1e-7
    assert (errors_of(quiet, values).window > 0.0) is counts


def test_what_float64_cannot_hold_is_part_of_the_reference():
    finer = replace(REFERENCE, low=np.full_like(HIGH, 1e-17))
    assert errors_of(finer, HIGH.copy()).peak == pytest.approx(1e-17 / 2.0)


def test_an_error_that_is_not_a_number_stays_one_and_breaks_its_promise():
    errors = changed(0, 0, 0, np.nan)
    assert np.isnan(errors.peak)
    outcome = Outcome(errors=errors, minimum_s=1.0, bytes_above_idle=None)
    broken = broken_promises(outcome, scene_of("S1"), "float64", is_ours=False)
    assert len(broken) == 2


def test_samples_are_picked_from_blocks_of_any_length():
    signals = np.arange(216 * 300, dtype=float).reshape(216, 300)
    expected = signals[REFERENCE.channels[:, None, None], REFERENCE.samples]
    rows = np.arange(216)
    whole = picked(REFERENCE, rows, [(0, signals)])
    parts = [(first, signals[:, first : first + 37]) for first in range(0, 300, 37)]
    np.testing.assert_array_equal(whole, expected)
    np.testing.assert_array_equal(picked(REFERENCE, rows, parts), expected)
    few = np.array([5, 3])
    np.testing.assert_array_equal(picked(REFERENCE, few, [(0, signals[few])]), expected)


def test_what_no_block_holds_is_silent():
    values = picked(REFERENCE, np.arange(216), [(130, np.ones((216, 130)))])
    np.testing.assert_array_equal(values[:, [0, 2]], 0.0)
    np.testing.assert_array_equal(values[:, 1], 1.0)


def test_an_engine_that_leaves_out_checked_channels_is_refused():
    with pytest.raises(ValueError, match="leaves out channels"):
        picked(REFERENCE, np.array([3, 4]), [])


def test_the_ratio_is_the_error_in_units_of_its_bound():
    eps = np.finfo(np.float64).eps
    ratio = rounding_ratio(np.array([eps, 3 * eps]), np.array([1.0, 6.0]), 256, np.float64)
    assert ratio == pytest.approx(1.0 / 8.0)


def test_statistics_of_times():
    times = times_of([4.0, 1.0, 2.0, 3.0, 100.0])
    assert (times.minimum_s, times.median_s, times.deviation_s) == (1.0, 3.0, 1.0)
    assert times.runs == 5
    assert not times.is_stable
    assert times_of([1.0, 1.1, 1.2]).is_stable


def test_runs_are_numbered_on_so_that_none_is_the_same_edit():
    seen = []

    def run(number):
        seen.append(number)
        yield 0, np.zeros((1, 1))

    seconds = repeated(run, first_s=0.1, warm_ups=2, longest_s=60.0, most_runs=4)
    assert seen == [1, 2, 3, 4, 5, 6]
    assert len(seconds) == 4


def test_a_slow_method_runs_once_and_a_very_slow_one_not_again():
    seen = []

    def run(number):
        seen.append(number)
        yield 0, np.zeros((1, 1))

    slow = {"warm_ups": 2, "longest_s": 0.0, "most_runs": 9}
    assert len(repeated(run, first_s=1.9, **slow)) == 1
    assert seen == [1]
    assert repeated(run, first_s=2.0, **slow) == [2.0]
    assert seen == [1]


def test_the_garbage_collector_is_left_as_it_was():
    def run(number):
        assert not gc.isenabled()
        yield 0, np.zeros((1, 1))

    repeated(run, first_s=0.1, warm_ups=0, longest_s=0.0, most_runs=1)
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0


def outcome(**errors):
    given = {"peak": 0.0, "l2": 0.0, "window": 0.0, "silence": 0.0, **errors}
    return Outcome(
        errors=type(errors_of(REFERENCE, HIGH))(**given), minimum_s=9.0, bytes_above_idle=4e8
    )


@pytest.mark.parametrize(
    ("errors", "precision", "is_ours", "broken"),
    [
        ({"peak": 9e-15, "window": 9e-10, "silence": 1.0}, "float64", False, 0),
        ({"peak": 9e-15, "window": 9e-10, "silence": 1e-300}, "float64", True, 1),
        ({"peak": 2e-14}, "float64", False, 1),
        ({"window": 2e-9}, "float64", False, 1),
        ({"peak": 1e-6, "window": 1.0}, "float32", False, 0),
        ({"peak": 3e-6}, "float32", False, 1),
    ],
)
def test_promises_depend_on_precision_and_on_whose_engine_it_is(errors, precision, is_ours, broken):
    found = broken_promises(outcome(**errors), scene_of("S5"), precision, is_ours=is_ours)
    assert len(found) == broken


def test_long_scenes_promise_time_and_memory():
    late = replace(outcome(), minimum_s=10.5, bytes_above_idle=6e8)
    assert broken_promises(late, scene_of("S5"), "float64", is_ours=True) == (
        "time in s 10.5, promised 10",
        "memory in MB 600, promised 500",
    )
    assert broken_promises(late, scene_of("S4"), "float64", is_ours=True) == ()
