"""RMS in bands of 2 Hz, in which outputs are held against inputs."""

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.limb import BAND_HZ, Band

#: Width of the bins in which outputs are held against inputs (SkinSource, 2024, Section V).
BIN_HZ = 2.0
_ROUNDING = 1e-9


def band_rms(
    transforms: Complexes, n_times: int, sample_rate_hz: float, band_hz: Band | None = BAND_HZ
) -> tuple[Floats, Floats]:
    """RMS of what signals hold in each bin of 2 Hz, over all of their time.

    Parameters
    ----------
    transforms : (..., n_times // 2 + 1)
        Of real signals of ``n_times`` samples.
    n_times, sample_rate_hz
        Their number and their rate.
    band_hz
        From where to where bins are laid, the whole ones alone; None: from 0 to half the rate.

    Returns
    -------
    frequency_hz : (n_bins,)
        Middles of the bins that hold a frequency of the transforms.
    rms : (..., n_bins)
        In the unit of the signals: squares add up to that of all that lies in the bins.
    """
    power = np.square(np.abs(transforms / n_times))
    # Each frequency stands for its mirror image too, except 0 and half the rate.
    power[..., 1 : (n_times + 1) // 2] *= 2.0
    frequency_hz = np.arange(power.shape[-1]) * (sample_rate_hz / n_times)
    low_hz, high_hz = band_hz or (0.0, sample_rate_hz / 2.0)
    # Rounding shall not bring a frequency at an edge into the bin below.
    bins = np.floor((frequency_hz - low_hz) / BIN_HZ + _ROUNDING).astype(int)
    inside = (bins >= 0) & (bins < np.floor((high_hz - low_hz) / BIN_HZ + _ROUNDING))
    numbers, first = np.unique(bins[inside], return_index=True)
    energy = np.add.reduceat(power[..., inside], first, axis=-1)
    return low_hz + (numbers + 0.5) * BIN_HZ, np.sqrt(energy)
