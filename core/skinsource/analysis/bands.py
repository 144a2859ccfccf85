"""Magnitudes in bands of 2 Hz, in which outputs are held against inputs."""

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.limb import BAND_HZ, Band

#: Width of the bins in which outputs are held against inputs (SkinSource, 2024, Section V).
BIN_HZ = 2.0


def band_magnitudes(
    transforms: Complexes, n_times: int, sample_rate_hz: float, band_hz: Band | None = BAND_HZ
) -> tuple[Floats, Floats]:
    """Middles of bins of 2 Hz within a band, and the magnitude in each, (..., n_bins).

    It is the root of the mean square, over the bin, of transforms, (..., n_times // 2 + 1), divided
    by their samples.

    Parameters
    ----------
    transforms
        Of signals of ``n_times`` samples.
    n_times, sample_rate_hz
        Their number and their rate.
    band_hz
        The measured band; None: it is not known, and all frequencies count.
    """
    power = np.square(np.abs(transforms / n_times))
    frequency_hz = np.arange(power.shape[-1]) * (sample_rate_hz / n_times)
    low_hz, high_hz = band_hz or (0.0, np.inf)
    inside = (frequency_hz >= low_hz) & (frequency_hz < high_hz)
    bins = np.floor((frequency_hz[inside] - low_hz) / BIN_HZ).astype(int)
    numbers, first, counts = np.unique(bins, return_index=True, return_counts=True)
    summed = np.add.reduceat(power[..., inside], first, axis=-1)
    return low_hz + (numbers + 0.5) * BIN_HZ, np.sqrt(summed / counts)
