"""Delayed samples, against the formula that was sampled."""

import numpy as np
import pytest

from skinsource.signals.sampling import band_limited_delay

RATE_HZ = 1300.0
DELAYS = [1e-9, 0.1, 0.25, 0.5, 0.75, 0.999]


def burst(frequency_hz: float, time_s: np.ndarray) -> np.ndarray:
    """A tone within a Gaussian of 60 ms that is below 1e-14 at its ends, 0.5 s away."""
    return np.exp(-((time_s / 0.06) ** 2) / 2) * np.cos(2 * np.pi * frequency_hz * time_s + 0.3)


@pytest.mark.parametrize("delay", DELAYS)
@pytest.mark.parametrize("frequency_hz", [0.0, 25.0, 250.0, 500.0, 590.0])
def test_a_burst_is_delayed_as_its_formula_is(frequency_hz, delay):
    time_s = np.arange(1301) / RATE_HZ - 0.5
    delayed = band_limited_delay(burst(frequency_hz, time_s), delay)
    assert delayed.shape == (1302,)
    expected = burst(frequency_hz, (np.arange(1302) - delay) / RATE_HZ - 0.5)
    np.testing.assert_allclose(delayed, expected, rtol=0, atol=1e-6)


def test_no_delay_changes_nothing_and_nothing_stays_nothing():
    samples = np.random.default_rng(3).standard_normal(40)
    assert band_limited_delay(samples, 0.0) is samples
    assert band_limited_delay(np.zeros(0), 0.5).size == 0
    assert not band_limited_delay(np.zeros(5), 0.5).any()
