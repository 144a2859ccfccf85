"""How much quicker the clock that records is than the one that plays, told from repeats."""

import numpy as np
import scipy

from skinsource.arrays import Floats

#: Clocks that differ by more are not told; quartz differs by a tenth of that at most.
MOST_DIFFERENCE = 2e-3
_ROUNDS = 3


def clock_ratio(recorded: Floats, start: int, period: int, repeats: int) -> float:
    """Samples that are recorded while one is played.

    The same sweep, heard again, comes later by the time between both, as the recording clock
    counts it.  First and second sweep say it roughly, so that the last one can be found; first and
    last say it well.

    Parameters
    ----------
    recorded : (n_times,)
        What came back, without a constant.
    start
        Sample at which the first sweep begins, or a little before.
    period
        Samples from one sweep to the next, by the clock that plays.
    repeats
        Sweeps that there are, at least 2.
    """
    most = max(round(MOST_DIFFERENCE * period), 1)
    ratio = 1.0
    for apart in dict.fromkeys((1, repeats - 1)):
        later = start + round(apart * period * ratio)
        parts = recorded[start : start + period], recorded[later : later + period]
        lag = later - start + _lag(*parts, most)
        ratio = lag / (apart * period)
    return ratio


def _lag(first: Floats, later: Floats, most: int) -> float:
    """Samples by which ``later`` is behind, of either sign, at most about ``most``."""
    length = scipy.fft.next_fast_len(first.size + later.size, real=True)
    cross = scipy.fft.rfft(first, length).conj() * scipy.fft.rfft(later, length)
    common = scipy.fft.irfft(cross, length)
    lags = np.arange(-most, most + 1)
    lag = float(lags[np.argmax(common[lags])])
    turn = 2.0 * np.pi * np.arange(cross.size) / length
    weight = np.abs(cross)
    scale = float(weight @ turn**2)
    for _ in range(_ROUNDS if scale > 0.0 else 0):
        # Beside the right lag the phase is a straight line through 0, and short of a turn.
        left = np.angle(cross * np.exp(1j * turn * lag))
        lag -= float((weight * left) @ turn) / scale
    return lag


def part_from(samples: Floats, begin: float, n: int) -> Floats:
    """``n`` samples from a place on that may lie between two of them; silence behind the last."""
    whole = round(begin)
    part = np.zeros(n)
    found = samples[whole : whole + n]
    part[: found.size] = found
    if begin == whole:
        return part
    length = scipy.fft.next_fast_len(n, real=True)
    turn = 2j * np.pi * np.arange(length // 2 + 1) / length
    moved = scipy.fft.rfft(part, length) * np.exp(turn * (begin - whole))
    between: Floats = scipy.fft.irfft(moved, length)[:n]
    return between
