"""Windows, against MATLAB's documented formulas written out sample by sample."""

import math

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.signals.generators import WINDOWS, window

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


@pytest.mark.parametrize("n", [2, 3, 20, 21, 130, 1301])
def test_windows_are_symmetric_and_within_zero_and_one(n):
    for name in WINDOWS:
        samples = window(name, n)
        np.testing.assert_allclose(samples, samples[::-1], rtol=0, atol=1e-14)
        assert samples.min() >= 0.0
        assert samples.max() <= 1.0


@pytest.mark.parametrize("name", WINDOWS)
def test_no_samples_and_one_sample_have_windows(name):
    assert window(name, 0).shape == (0,)
    np.testing.assert_allclose(window(name, 1), [1.0], rtol=0, atol=1e-15)


@pytest.mark.parametrize("n", [-1, 2.5, math.nan, math.inf])
def test_an_impossible_length_is_refused(n):
    with pytest.raises(InvalidInputError, match="expected a whole number"):
        window("tukey", n)


def test_a_whole_length_of_any_type_will_do():
    np.testing.assert_array_equal(window("tukey", 21.0), window("tukey", np.int64(21)))


def test_an_unknown_window_is_refused_with_the_known_ones():
    with pytest.raises(InvalidInputError, match="choose from none, tukey, hanning"):
        window("hann", 21)
