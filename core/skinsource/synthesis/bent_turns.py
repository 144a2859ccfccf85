"""How far a tone has turned whose frequency changes evenly from any instant on."""

from fractions import Fraction
from math import ceil

import numpy as np

from skinsource.arrays import Floats

_BLOCK = 256


def bent_turns(
    start: Fraction,
    frequency_hz: Fraction,
    slope_hz_per_s: Fraction,
    first: Fraction,
    n: int,
    sample_rate_hz: float,
) -> Floats:
    """Turns of a tone, (n,), less whole ones: start + f t + s t² / 2.

    Exact at the start of each block of samples, and from there by what is left of it, so that the
    error does not grow with time: below 1e-13 where the frequency stays below half the sample
    rate.

    Parameters
    ----------
    start
        Turns at t = 0.
    frequency_hz, slope_hz_per_s
        f at t = 0, and s.
    first
        t of the first sample, in s; may be negative.
    """
    rate = Fraction(sample_rate_hz)
    starts, steps = np.empty(ceil(n / _BLOCK)), np.empty(ceil(n / _BLOCK))
    for block in range(starts.size):
        time = first + block * _BLOCK / rate
        starts[block] = _less_whole(start + (frequency_hz + slope_hz_per_s / 2 * time) * time)
        steps[block] = _less_whole((frequency_hz + slope_hz_per_s * time) / rate)
    within = np.arange(min(n, _BLOCK))
    found = np.multiply.outer(steps, within)
    # Whole numbers times whole turns are whole turns.
    found += _less_whole(slope_hz_per_s / (2 * rate**2)) * np.square(within)
    found += starts[:, np.newaxis]
    found -= np.rint(found)
    return found.ravel()[:n]


def _less_whole(turns: Fraction) -> float:
    """What is left of turns without the nearest whole number of them."""
    return float(turns - round(turns))
