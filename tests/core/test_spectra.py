import math

import numpy as np
import pytest

from skinsource.design.waveforms import Noise, Tone
from skinsource.signals.spectra import magnitude_spectrum, share_outside_band

SEED = 11


def direct_spectrum(x: np.ndarray) -> np.ndarray:
    """One-sided amplitudes as sums, one for each frequency."""
    n, k = x.size, np.arange(x.size // 2 + 1)
    turns = np.exp(-2j * np.pi * (np.outer(k, np.arange(n)) % n) / n)
    return np.abs(turns @ x) / n * np.where((k == 0) | (2 * k == n), 1, 2)


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 6, 7, 130, 131, 521, 522, 651, 652])
def test_spectra_of_odd_and_even_lengths_are_those_of_the_sum(n):
    x = np.random.default_rng(SEED).standard_normal(n)
    magnitude = direct_spectrum(x)
    found_hz, amplitudes = magnitude_spectrum(x, 1300.0)
    np.testing.assert_allclose(found_hz, np.arange(magnitude.size) * 1300.0 / n, rtol=1e-15)
    limit = 1e-12 * magnitude.max()
    np.testing.assert_allclose(amplitudes, magnitude, rtol=0, atol=limit, err_msg=f"{SEED=}")


RATE_HZ = 1300.0


@pytest.mark.parametrize(("low_hz", "high_hz"), [(0.0, 100.0), (25.0, 600.0), (600.0, 650.0)])
@pytest.mark.parametrize("second", [1.0, -1.0, 0.3])
def test_two_samples_have_a_cosine_for_a_spectrum(second, low_hz, high_hz):
    """|1 + a exp(-i w)|² = 1 + a² + 2 a cos w, integrated from w1 to w2."""
    low, high = (2 * math.pi * edge / RATE_HZ for edge in (low_hz, high_hz))
    energy = (1 + second**2) * (high - low) + 2 * second * (math.sin(high) - math.sin(low))
    expected = 1 - energy / (math.pi * (1 + second**2))
    share = share_outside_band(np.array([1.0, second]), RATE_HZ, (low_hz, high_hz))
    assert share == pytest.approx(expected, abs=1e-14)


def test_any_signal_agrees_with_the_integral_of_its_spectrum():
    samples = Noise(5, 0.2).samples(RATE_HZ) + 0.1
    n = 2**20
    frequency_hz = np.fft.rfftfreq(n, 1 / RATE_HZ)
    power = np.abs(np.fft.rfft(samples, n)) ** 2
    inside = (frequency_hz >= 25.0) & (frequency_hz <= 600.0)
    expected = 1 - np.trapezoid(power[inside]) / np.trapezoid(power)
    assert share_outside_band(samples, RATE_HZ) == pytest.approx(expected, abs=1e-5)


def test_silence_around_a_signal_and_its_strength_change_nothing():
    samples = Tone(40.0, duration_s=0.05).samples(RATE_HZ)
    share = share_outside_band(samples, RATE_HZ)
    assert 0.01 < share < 0.9
    padded = np.concatenate((np.zeros(333), samples, np.zeros(1001)))
    assert share_outside_band(padded, RATE_HZ) == pytest.approx(share, abs=1e-13)
    for factor in (-1.0, 1e-200, 1e200):
        assert share_outside_band(factor * samples, RATE_HZ) == pytest.approx(share, abs=1e-13)


def test_nothing_of_silence_lies_outside():
    assert share_outside_band(np.zeros(100), RATE_HZ) == 0.0
    assert share_outside_band(np.zeros(0), RATE_HZ) == 0.0
