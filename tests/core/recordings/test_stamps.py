"""Time stamps that are steady, rounded, or neither."""

from fractions import Fraction

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.readers.timestamps import at_steady_rate, sample_clock


@pytest.mark.parametrize("rate_hz", [100, 1300, 5988, 6000, 48_000])
def test_steady_stamps_say_their_rate(rate_hz):
    pace = sample_clock(17.25 + np.arange(3000) / rate_hz)
    assert pace.steady
    assert pace.rate_hz == rate_hz


@pytest.mark.parametrize("digits", [3, 4, 5, 6])
def test_stamps_that_are_only_rounded_are_steady(digits):
    rate_hz = 900 if digits == 3 else 1300
    pace = sample_clock(np.round(np.arange(5000) / rate_hz, digits))
    assert pace.steady
    assert pace.rate_hz == rate_hz


def test_a_rate_between_whole_hertz_is_kept():
    pace = sample_clock(np.arange(100_000) / 1302.5)
    assert pace.rate_hz == Fraction(2605, 2)


@pytest.mark.parametrize("deviation", [0.02, 0.4])
def test_jitter_beyond_the_digits_is_not_steady(deviation):
    rng = np.random.default_rng(0)
    timestamps = (np.arange(5000) + rng.uniform(-deviation, deviation, 5000)) / 6000.0
    pace = sample_clock(timestamps)
    assert not pace.steady
    assert "steps of" in pace.note
    assert abs(pace.rate_hz - 6000) <= 1


def test_a_signal_with_jitter_is_itself_at_a_steady_rate():
    rng = np.random.default_rng(1)
    # More than one block of samples.
    n = 70_000
    timestamps = 5.0 + (np.arange(n) + rng.uniform(-0.3, 0.3, n)) / 6000.0
    values = np.sin(2.0 * np.pi * 250.0 * timestamps)
    steady = at_steady_rate(values, timestamps, Fraction(6000))
    times = timestamps[0] + np.arange(steady.size) / 6000.0
    assert abs(steady.size - n) <= 1
    assert np.abs(steady - np.sin(2.0 * np.pi * 250.0 * times))[3:-3].max() < 2e-3
    assert np.abs(steady - np.sin(2.0 * np.pi * 250.0 * times)).max() < 2e-2


def test_gaps_are_bridged_by_straight_lines_even_to_a_single_sample():
    timestamps = np.concatenate((np.arange(200) / 1000.0, [0.4], 0.5 + np.arange(200) / 1000.0))
    values = np.sin(timestamps * 900.0)
    steady = at_steady_rate(values, timestamps, Fraction(1000))
    bridged = slice(199, 202)
    expected = np.interp(np.arange(200, 500) / 1000.0, timestamps[bridged], values[bridged])
    np.testing.assert_allclose(steady[200:500], expected, atol=1e-12)
    assert np.abs(steady).max() <= 1.0001


@pytest.mark.parametrize(
    ("timestamps", "message"),
    [
        ([0.0, 1.0, 1.0, 2.0], "sample 3"),
        ([0.0, 1.0, 0.5], "from 1 to 0.5 s"),
        ([0.0, np.nan, 2.0], "sample 2"),
        ([1.0], "one time stamp"),
        ([0.0, 1e-9, 2e-9], "check their unit"),
        ([0.0, 1e6, 2e6], "check their unit"),
    ],
)
def test_stamps_that_cannot_be_are_refused(timestamps, message):
    with pytest.raises(InvalidInputError, match=message):
        sample_clock(np.array(timestamps))
