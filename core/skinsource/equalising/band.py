"""In which band an equaliser makes an actuator follow."""

import numpy as np

from skinsource.limb import BAND_HZ

#: Lowest and highest frequency, Hz.
Band = tuple[float, float]
# So much of half the rate can be followed; where it begins if that is not said.
_OF_HALF, _LOWEST_HZ = 12.0 / 13.0, BAND_HZ[0]


def followed_band(band_hz: Band | None, sample_rate_hz: float) -> Band:
    """The band in which drives are followed on a limb: the one in which it was measured.

    It ends at 12/13 of half the rate at most.  Where its lab does not say one, None, it is all up
    to there.  What begins at 0 is followed from 25 Hz on, or over its upper octave if that is less.
    """
    low, high = (0.0, np.inf) if band_hz is None else band_hz
    high = min(high, _OF_HALF * 0.5 * sample_rate_hz)
    return (low, high) if 0.0 < low < high else (min(_LOWEST_HZ, high / 2.0), high)
