"""Signals as they are drawn: with points between their samples."""

from fractions import Fraction

import numpy as np

from skinsource.arrays import Floats
from skinsource.resampling.conversion import by_ratio
from skinsource.resampling.kernel import Kernel, half_transition

#: Points for each sample: a wave at the end of the band has more than thirty.
FINER = 8


def finer(
    time_s: Floats, signals: Floats, first: int = 0, end: int | None = None
) -> tuple[Floats, Floats]:
    """Instants and band-limited signals, `FINER` points for each sample.

    Straight lines between samples cut off the peaks of a wave that has four samples a period.

    Parameters
    ----------
    time_s : (n_times,)
        Equally spaced.
    signals : (..., n_times)
        Silent before and after.
    first, end
        Samples from ``first`` to before ``end`` alone, all of them unless given; of fewer than
        two nothing lies between.  What lies around them has its part in the points.

    Returns
    -------
    (n_points,) and (..., n_points), from the first sample to the last; samples keep their values
    within 1e-6 of the peak.
    """
    end = time_s.size if end is None else end
    n = end - first
    if n < 2:
        return time_s[first:end], signals[..., first:end]
    step_s = float(time_s[-1] - time_s[0]) / (time_s.size - 1)
    reach = Kernel(FINER, 1, half_transition(1.0 / step_s)).reach
    before = min(first, reach)
    dense = by_ratio(signals[..., first - before : end + reach], Fraction(FINER), 1.0 / step_s)
    n_points = (n - 1) * FINER + 1
    skipped = before * FINER
    instants = time_s[first] + np.arange(n_points) * (step_s / FINER)
    return instants, dense[..., skipped : skipped + n_points]
