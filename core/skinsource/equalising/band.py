"""In which band an equaliser makes an actuator follow."""

import numpy as np

from skinsource.limb import BAND_HZ, Band
from skinsource.resampling import PASSED_SHARE

# Where it begins if nobody says that.
_LOWEST_HZ = BAND_HZ[0]


def followed_band(band_hz: Band | None, sample_rate_hz: float) -> Band:
    """The band in which drives are followed on a limb: the one in which it was measured.

    It ends at 12/13 of half the rate at most.  Where its lab does not say one, None, it is all up
    to there.  What begins at 0 is followed from 25 Hz on, or over its upper octave if that is less.
    """
    low, high = (0.0, np.inf) if band_hz is None else band_hz
    high = min(high, PASSED_SHARE * 0.5 * sample_rate_hz)
    return (low, high) if 0.0 < low < high else (min(_LOWEST_HZ, high / 2.0), high)
