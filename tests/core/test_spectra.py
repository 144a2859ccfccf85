import cmath

import numpy as np
import pytest

from skinsource.signals.spectra import magnitude_spectrum

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
