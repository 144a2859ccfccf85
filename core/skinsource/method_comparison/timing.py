"""Times of repeated runs, and their statistics."""

import gc
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from skinsource.method_comparison.accuracy import Block

#: What runs longer is run once: what a first run costs more is lost in that.
ONCE_FROM_S = 2.0
# Where the slowest of twenty runs takes so many times the fastest, times mean little.
_UNSTABLE = 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Times:
    """Statistics of run times, in seconds.

    Attributes
    ----------
    minimum_s, median_s
        The minimum is the least disturbed.
    deviation_s
        Median absolute deviation from the median.
    p95_s
        95 % of the runs took at most this.
    runs
        How many there were.
    """

    minimum_s: float
    median_s: float
    deviation_s: float
    p95_s: float
    runs: int

    @property
    def is_stable(self) -> bool:
        """Whether the slow runs are of the same order as the fast ones."""
        return self.p95_s <= _UNSTABLE * self.minimum_s


def times_of(seconds: Sequence[float]) -> Times:
    """Statistics of some run times, of one or several processes."""
    values = np.asarray(seconds, np.float64)
    median = float(np.median(values))
    return Times(
        minimum_s=float(values.min()),
        median_s=median,
        deviation_s=float(np.median(np.abs(values - median))),
        p95_s=float(np.percentile(values, 95)),
        runs=values.size,
    )


def repeated(
    run: Callable[[int], Iterable[Block]],
    *,
    first_s: float,
    warm_ups: int,
    longest_s: float,
    most_runs: int,
) -> list[float]:
    """Seconds of each run; at least one, until ``longest_s`` or ``most_runs`` is reached.

    Garbage is collected before each run, not within.

    Parameters
    ----------
    run
        Gets the number of the run, from 1 on: another edit each time.
    first_s
        What run 0 took, with all that a first run costs more.  From `ONCE_FROM_S` on that is all;
        what takes ``longest_s`` needs no warming up.
    """
    if first_s >= ONCE_FROM_S:
        return [first_s]
    number = 1
    collecting = gc.isenabled()
    gc.disable()
    # What stands now is not looked through again before each run.
    gc.freeze()
    try:
        for _ in range(warm_ups if first_s < longest_s else 0):
            _timed(run, number)
            number += 1
        seconds: list[float] = []
        while not seconds or (sum(seconds) < longest_s and len(seconds) < most_runs):
            seconds.append(_timed(run, number))
            number += 1
    finally:
        gc.unfreeze()
        if collecting:
            gc.enable()
    return seconds


def _timed(run: Callable[[int], Iterable[Block]], number: int) -> float:
    gc.collect()
    start = perf_counter()
    for _ in run(number):
        pass
    return perf_counter() - start
