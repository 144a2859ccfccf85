"""How far a tone has turned whose frequency changes evenly from any instant on."""

from decimal import Decimal, localcontext
from math import ceil

import numpy as np

from skinsource.arrays import Floats

#: Digits of the phase at the start of each block; an hour has some ten of whole turns.
DIGITS = 60
_BLOCK = 512


def bent_turns(
    start: Decimal,
    frequency_hz: Decimal,
    slope_hz_per_s: Decimal,
    first: Decimal,
    n: int,
    sample_rate_hz: float,
) -> Floats:
    """Turns of a tone, (n,), less whole ones: start + f t + s t² / 2.

    Computed with 60 digits at the start of each block of samples, and from there by what is left
    of it, so that the error does not grow with time: below 1e-13 where the frequency stays below
    half the sample rate.

    Parameters
    ----------
    start
        Turns at t = 0.
    frequency_hz, slope_hz_per_s
        f at t = 0, and s.
    first
        t of the first sample, in s; may be negative.
    """
    starts, steps = np.empty(ceil(n / _BLOCK)), np.empty(ceil(n / _BLOCK))
    with localcontext(prec=DIGITS):
        rate = Decimal(sample_rate_hz)
        bend = _less_whole(slope_hz_per_s / (2 * rate**2))
        for block in range(starts.size):
            time = first + block * _BLOCK / rate
            starts[block] = _less_whole(start + (frequency_hz + slope_hz_per_s / 2 * time) * time)
            steps[block] = _less_whole((frequency_hz + slope_hz_per_s * time) / rate)
    within = np.arange(min(n, _BLOCK))
    found = np.multiply.outer(steps, within)
    # Whole numbers times whole turns are whole turns.
    found += bend * np.square(within)
    found += starts[:, np.newaxis]
    found -= np.rint(found)
    return found.ravel()[:n]


def _less_whole(turns: Decimal) -> float:
    """What is left of turns without the nearest whole number of them."""
    return float(turns - turns.to_integral_value())
