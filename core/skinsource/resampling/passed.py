"""What of a signal reaches another rate."""

from functools import lru_cache
from math import ceil

import numpy as np
import scipy

from skinsource.arrays import Floats
from skinsource.resampling.kernel import Kernel, half_transition

# Samples of the filter in each sample at the lower rate, and points of its response.
_FINER, _POINTS = 8, 2**17
# How long it rings: periods of the lower rate, over half its transition; samples at most.
_RINGS, _LONGEST_RING = 5.0, 2**21


def passed(samples: Floats, from_hz: float, to_hz: float) -> Floats:
    """Return what the filter between two rates leaves of a signal, at its own rate.

    Nothing folds, so that its energy depends on no phase.

    Parameters
    ----------
    samples : (n_times,)
        Silent before and after.
    from_hz, to_hz
        As of `resample`.

    Returns
    -------
    (ring + n_times + ring,)
        With what rings before and after.
    """
    lower_hz = min(from_hz, to_hz)
    transition = half_transition(lower_hz)
    ring = min(ceil(_RINGS / transition * from_hz / lower_hz), _LONGEST_RING)
    padded = np.pad(samples, ring)
    length = scipy.fft.next_fast_len(padded.size, real=True)
    share = scipy.fft.rfftfreq(length, 1.0 / from_hz) / (0.5 * lower_hz)
    gain = np.interp(share, *_response(transition))
    found: Floats = scipy.fft.irfft(gain * scipy.fft.rfft(padded, length), length)[: padded.size]
    return found


@lru_cache(maxsize=4)
def _response(transition: float) -> tuple[Floats, Floats]:
    """Frequencies, in parts of half the lower rate, and the gain of the filter there."""
    taps = Kernel(1, _FINER, transition).made()
    share: Floats = np.linspace(0.0, _FINER, _POINTS // 2 + 1)
    gain: Floats = np.abs(scipy.fft.rfft(taps, _POINTS))
    return share, gain
