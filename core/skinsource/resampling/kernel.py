"""The filter between two rates, and its weights as a matrix."""

from collections.abc import Iterator
from functools import lru_cache
from math import ceil

import numpy as np
import scipy

from skinsource.arrays import Floats, Indices
from skinsource.limb import BAND_HZ

_STOP_BAND_DB = 140.0
_BETA = 0.1102 * (_STOP_BAND_DB - 8.7)
# Half the transition, as a share of half the lower rate.
_WIDEST, _NARROWEST = 1.0 / 13.0, 1.0 / 130.0
#: So much of half the lower rate passes, whatever the two rates are.
PASSED_SHARE = 1.0 - _WIDEST
# Of a filter that is kept for the next time: to compute it takes longer than to use it.
_LONGEST_KEPT = 2**18
# Values of a matrix of weights; larger ones cost more than they save.
_LARGEST_MATRIX = 2**19
# Results of a period, which is taken several times where the rates have a short one.
_LEAST_IN_PERIOD = 16
# Values that are computed at once.
_BLOCK = 2**18


class Kernel:
    """The filter on the grid of both rates' common multiple.

    Attributes
    ----------
    half_length
        Its last sample on either side of the middle.
    reach, n_used
        Samples on either side that a result is made of; samples that some periods of the results
        are made of together.
    periods
        How many those are.
    """

    def __init__(self, up: int, down: int, half_transition: float) -> None:
        self.up, self.down, self._half_transition = up, down, half_transition
        self._slower = max(up, down)
        # Kaiser's formula; the transition is twice the half, of half the lower rate.
        width = 2.0 * half_transition * np.pi / self._slower
        self.half_length = ceil((_STOP_BAND_DB - 7.95) / (2.285 * width) / 2.0)
        self.reach = -(-self.half_length // up)
        # Several periods share the samples that they reach.
        self.periods = min(-(-_LEAST_IN_PERIOD // up), max((2 * self.reach + 1) // down, 1))
        self.n_used = self.periods * down + 2 * self.reach + 1

    @property
    def is_small(self) -> bool:
        """Whether all weights of a period fit in a matrix that is mostly filled."""
        filled = self.periods * self.down <= 2 * (2 * self.reach + 1)
        return filled and self.periods * self.up * self.n_used <= _LARGEST_MATRIX

    def at(self, place: Indices) -> Floats:
        """The filter ``place`` samples off its middle; its sum over each phase is nearly 1."""
        within = np.clip(1.0 - (place / self.half_length) ** 2, 0.0, None)
        taper = scipy.special.i0(_BETA * np.sqrt(within)) / scipy.special.i0(_BETA)
        ideal = np.sinc(place / self._slower) * min(1.0, self.up / self.down)
        return np.where(np.abs(place) <= self.half_length, ideal * taper, 0.0)

    def whole(self) -> Floats:
        """All of it, (2 half_length + 1,); the last few that are not long are kept."""
        if self.half_length <= _LONGEST_KEPT:
            return _kept(self.up, self.down, self._half_transition)
        return self.made()

    def made(self) -> Floats:
        """Compute all of it, (2 half_length + 1,)."""
        found = np.empty(2 * self.half_length + 1)
        for start, end in blocks(found.size, _BLOCK):
            found[start:end] = self.at(np.arange(start, end) - self.half_length)
        return found

    def weights(self) -> Floats:
        """What each result of a period is made of, (n_used, periods up); the last are kept."""
        return _kept_weights(self.up, self.down, self._half_transition)


@lru_cache(maxsize=4)
def _kept(up: int, down: int, half_transition: float) -> Floats:
    found = Kernel(up, down, half_transition).made()
    found.flags.writeable = False
    return found


@lru_cache(maxsize=4)
def _kept_weights(up: int, down: int, half_transition: float) -> Floats:
    kernel = Kernel(up, down, half_transition)
    used = np.arange(kernel.n_used)[:, np.newaxis] - kernel.reach
    place = np.arange(kernel.periods * up) * down - used * up
    found = np.where(
        np.abs(place) <= kernel.half_length,
        kernel.whole()[np.clip(place + kernel.half_length, 0, 2 * kernel.half_length)],
        0.0,
    )
    found.flags.writeable = False
    return found


def half_transition(lower_hz: float) -> float:
    """Half the transition, as a share of half the lower rate.

    Part of the function, whatever the limb: of 1200 to 1300 Hz, too, 600 Hz shall pass.
    """
    if lower_hz <= 2.0 * BAND_HZ[1]:
        return _WIDEST
    return min(max(1.0 - 2.0 * BAND_HZ[1] / lower_hz, _NARROWEST), _WIDEST)


def blocks(n: int, step: int) -> Iterator[tuple[int, int]]:
    """Begin and end of each ``step`` of ``n``; the last may be shorter."""
    for start in range(0, n, step):
        yield start, min(start + step, n)
