"""When the samples of a recipe lie."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.sampling import shift_of, turns
from skinsource.signals import sample_count

__all__ = ["count_of", "instants", "shift_of", "turns"]


def count_of(duration_s: float, sample_rate_hz: float, shift_s: float) -> int:
    """Samples that a recipe takes: one more where it does not start on one."""
    return sample_count(duration_s, sample_rate_hz) + (shift_of(shift_s, sample_rate_hz) > 0.0)


def instants(duration_s: float, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
    """A recipe's own time at its samples, (n_times,), in s; the first is negative if shifted."""
    n = count_of(duration_s, sample_rate_hz, shift_s)
    return np.arange(n) / sample_rate_hz - shift_s
