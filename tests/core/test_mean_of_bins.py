"""Moving means over the bins of a spectrum."""

import numpy as np
import pytest

from skinsource.signals.spectra import mean_of_bins


@pytest.mark.parametrize("n", [1, 2, 3, 10])
@pytest.mark.parametrize("n_bins", [1, 2, 9, 10, 40])
def test_a_mean_is_that_of_the_bins_around(n, n_bins):
    magnitude = np.random.default_rng(n).random((2, 3, n_bins))
    means = mean_of_bins(magnitude, n)
    assert means.shape == magnitude.shape
    for k in range(n_bins):
        around = magnitude[..., max(k - n // 2, 0) : k + (n - 1) // 2 + 1]
        assert means[..., k] == pytest.approx(around.mean(axis=-1))
