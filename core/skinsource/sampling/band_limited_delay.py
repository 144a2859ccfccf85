"""Delay of samples by a part of the time between two of them."""

import numpy as np

from skinsource.arguments import real_number
from skinsource.arrays import Floats

#: Samples on each side of an instant that its value is made of.
REACH = 64
#: Form of the Kaiser window over them: what it leaves of images is below -120 dB.
_BETA = 12.3


def band_limited_delay(samples: Floats, delay: float) -> Floats:
    """Samples of the same signal, ``delay`` of a sample later, (n + 1,).

    The signal is the one that the samples describe between them: a sum of sin(pi u) / (pi u),
    of which a Kaiser window keeps 64 samples on either side.  Up to 0.92 of half the sample rate
    (600 Hz at 1300 Hz) gain and delay are kept within 1e-6.  What would ring before the first
    and after the last sample is left out, so that a delayed signal begins no earlier: signals
    that begin and end in silence lose nothing by that.

    Parameters
    ----------
    samples : (n,)
        The signal; silent before and after.
    delay
        In samples, 0 up to 1.

    Returns
    -------
    (n + 1,), with a delay of 0 (n,): the samples as they are.

    Raises
    ------
    InvalidInputError
        The delay is not between 0 and 1.

    References
    ----------
    Laakso et al., Splitting the unit delay, IEEE Signal Processing Magazine 13(1), 1996.
    """
    delay = real_number("delay", delay, "a number from 0 to 1", least=0.0, most=1.0)
    if delay == 0.0 or samples.size == 0:
        return samples
    taps = np.arange(1 - REACH, REACH + 1) - delay
    kernel = np.sinc(taps) * np.i0(_BETA * np.sqrt(1.0 - (taps / REACH) ** 2)) / np.i0(_BETA)
    # The sample at its own place comes first in the result.
    return np.convolve(samples, kernel)[REACH - 1 : REACH + samples.size]
