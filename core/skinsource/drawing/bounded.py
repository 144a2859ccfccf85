"""A drawn signal, bounded to the measured band."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arguments import finite_array, positive_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ, Band


@dataclass(frozen=True, slots=True, eq=False)
class Bounded:
    """What is left of a signal.

    Attributes
    ----------
    samples : (n_times,)
        What lies within the band.
    removed
        Share of the energy that did not, from 0 to 1.
    """

    samples: Floats
    removed: float


def bounded_to_band(samples: Floats, sample_rate_hz: float, band_hz: Band = BAND_HZ) -> Bounded:
    """Take away what lies outside a band, without moving anything in time.

    Frequencies are those of the signal as it repeats after its own length: nothing is added
    behind it, and doing it twice changes nothing more.

    Parameters
    ----------
    samples : (n_times,)
        The signal.
    sample_rate_hz
        Its rate.
    band_hz
        Lowest and highest frequency that stay.

    Raises
    ------
    InvalidInputError
        The band is empty, or a sample is not a finite number.
    """
    values = finite_array("samples", samples, "real numbers, (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    low, high = band_hz
    if not 0 <= low < high:
        raise InvalidInputError(f"band_hz is {band_hz}, expected 0 <= low < high")
    if not values.size or not values.any():
        return Bounded(values.copy(), 0.0)
    spectrum = scipy.fft.rfft(values)
    frequency_hz = np.arange(spectrum.size) * rate_hz / values.size
    spectrum[(frequency_hz < low) | (frequency_hz > high)] = 0.0
    kept = np.asarray(scipy.fft.irfft(spectrum, values.size), np.float64)
    # (Of a tiny signal the squares would vanish.)
    peak = float(np.abs(values).max())
    share = float(np.sum((kept / peak) ** 2) / np.sum((values / peak) ** 2))
    return Bounded(kept, min(max(1.0 - share, 0.0), 1.0))
