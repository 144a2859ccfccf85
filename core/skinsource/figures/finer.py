"""Signals as they are drawn: with points between their samples."""

from fractions import Fraction

import numpy as np

from skinsource.arrays import Floats
from skinsource.resampling import by_ratio

#: Points for each sample: a wave at the end of the band has more than thirty.
FINER = 8


def finer(time_s: Floats, signals: Floats) -> tuple[Floats, Floats]:
    """Instants and band-limited signals, `FINER` points for each sample.

    Straight lines between samples cut off the peaks of a wave that has four samples a period.

    Parameters
    ----------
    time_s : (n_times,)
        Equally spaced, two or more; of fewer nothing lies between.
    signals : (..., n_times)
        Silent before and after.

    Returns
    -------
    (n_points,) and (..., n_points), from the first sample to the last; samples keep their values
    within 1e-6 of the peak.
    """
    n = time_s.size
    if n < 2:
        return time_s, signals
    step_s = float(time_s[-1] - time_s[0]) / (n - 1)
    n_points = (n - 1) * FINER + 1
    dense = by_ratio(signals, Fraction(FINER), 1.0 / step_s)[..., :n_points]
    return time_s[0] + np.arange(n_points) * (step_s / FINER), dense
