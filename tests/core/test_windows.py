"""Windows, against MATLAB's documented formulas written out sample by sample."""

import math

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.signals.generators import window

LENGTHS = [*range(1, 70), 130, 131, 260, 651, 1000, 1300, 7919]


def matlab_hanning(n: int) -> list[float]:
    return [0.5 * (1 - math.cos(2 * math.pi * k / (n + 1))) for k in range(1, n + 1)]


def matlab_tukeywin(n: int, ratio: float) -> list[float]:
    """Three pieces on x from 0 to 1, as its documentation defines them."""
    samples = []
    for k in range(n):
        x = k / (n - 1) if n > 1 else 0.5
        if x < ratio / 2:
            sample = (1 + math.cos(2 * math.pi / ratio * (x - ratio / 2))) / 2
        elif x < 1 - ratio / 2:
            sample = 1.0
        else:
            sample = (1 + math.cos(2 * math.pi / ratio * (x - 1 + ratio / 2))) / 2
        samples.append(sample)
    return samples


@pytest.mark.parametrize("n", LENGTHS)
def test_windows_are_those_of_matlab(n):
    np.testing.assert_allclose(window("hanning", n), matlab_hanning(n), rtol=0, atol=1e-12)
    np.testing.assert_allclose(window("tukey", n), matlab_tukeywin(n, 0.25), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(window("none", n), [1.0] * n)


def test_an_unknown_window_is_refused_with_the_known_ones():
    with pytest.raises(InvalidInputError, match="choose from none, tukey, hanning"):
        window("hann", 21)
