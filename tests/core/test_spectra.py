import cmath
import math

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.signals.spectra import magnitude_spectrum, rms

SEED = 11


def direct_spectrum(x: np.ndarray, rate_hz: float) -> tuple[list[float], list[float]]:
    """One-sided amplitude spectrum as sums, one for each frequency."""
    n = len(x)
    frequency, magnitude = [], []
    for k in range(n // 2 + 1):
        turns = [cmath.exp(-2j * cmath.pi * (k * m % n) / n) for m in range(n)]
        one_sided = 1 if k == 0 or 2 * k == n else 2
        size = abs(sum(v * turn for v, turn in zip(x.tolist(), turns, strict=True)))
        magnitude.append(one_sided * size / n)
        frequency.append(k * rate_hz / n)
    return frequency, magnitude


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 6, 7, 130, 131, 521, 522, 651, 652])
def test_spectra_of_odd_and_even_lengths_are_those_of_the_sum(n):
    x = np.random.default_rng(SEED).standard_normal(n)
    frequency, magnitude = direct_spectrum(x, 1300.0)
    found_hz, amplitudes = magnitude_spectrum(x, 1300.0)
    np.testing.assert_allclose(found_hz, frequency, rtol=1e-15)
    limit = 1e-12 * max(magnitude)
    np.testing.assert_allclose(amplitudes, magnitude, rtol=0, atol=limit, err_msg=f"{SEED=}")


@pytest.mark.parametrize("n", [1300, 1301])
def test_a_sine_on_a_bin_shows_its_amplitude(n):
    time = np.arange(n) / 1300.0
    frequency_hz = 100 * 1300.0 / n
    _, magnitude = magnitude_spectrum(3.0 * np.sin(2 * np.pi * frequency_hz * time), 1300.0)
    assert magnitude[100] == pytest.approx(3.0, rel=1e-12)
    assert np.delete(magnitude, 100).max() < 1e-12


def test_the_ends_of_the_spectrum_are_not_doubled():
    _, constant = magnitude_spectrum(np.full(130, 2.0), 1300.0)
    assert constant[0] == pytest.approx(2.0)
    found_hz, alternating = magnitude_spectrum(2.0 * (-1.0) ** np.arange(130), 1300.0)
    assert found_hz[-1] == 650.0
    assert alternating[-1] == pytest.approx(2.0)
    odd_hz, _ = magnitude_spectrum(np.ones(131), 1300.0)
    assert odd_hz[-1] < 650.0


@pytest.mark.parametrize("n", [64, 65])
def test_the_energy_of_the_spectrum_is_that_of_the_signal(n):
    x = np.random.default_rng(SEED).standard_normal((2, 4, n))
    _, magnitude = magnitude_spectrum(x, 48000.0)
    assert magnitude.shape == (2, 4, n // 2 + 1)
    power = np.square(magnitude)
    power[..., 1 : (n + 1) // 2] /= 2
    np.testing.assert_allclose(np.sqrt(power.sum(axis=-1)), rms(x), rtol=1e-13)


@pytest.mark.parametrize("n", [1, 2, 522, 1821])
def test_the_rms_is_taken_over_all_samples(n):
    x = np.random.default_rng(SEED).standard_normal((3, n))
    expected = [math.sqrt(math.fsum(v * v for v in row) / n) for row in x.tolist()]
    np.testing.assert_allclose(rms(x), expected, rtol=1e-13)


def test_silence_has_no_rms_and_no_spectrum():
    assert rms(np.zeros(10)) == 0.0
    assert not magnitude_spectrum(np.zeros(10), 1300.0)[1].any()


@pytest.mark.parametrize("x", [1.0, [], np.zeros((72, 0))])
def test_no_samples_are_refused(x):
    with pytest.raises(InvalidInputError, match="at least one sample"):
        rms(x)
    with pytest.raises(InvalidInputError, match="at least one sample"):
        magnitude_spectrum(x, 1300.0)


@pytest.mark.parametrize("rate_hz", [0.0, -1300.0, math.nan, math.inf])
def test_an_impossible_sample_rate_is_refused(rate_hz):
    with pytest.raises(InvalidInputError, match="sample_rate_hz"):
        magnitude_spectrum([1.0, 2.0], rate_hz)
