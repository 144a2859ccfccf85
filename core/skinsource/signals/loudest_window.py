"""What a level averages over: the whole record, or its loudest window.

Sums over windows are made of sums over 1, 2, 4, 8, … neighbours: only numbers of zero or more are
added, nothing is subtracted, so that quiet after a burst is as right as the burst.
"""

from typing import Literal, get_args

import numpy as np

from skinsource.base.arguments import positive_number
from skinsource.base.arrays import Floats
from skinsource.signals.generators import sample_count

Span = Literal["record", "loudest"]
SPANS: tuple[Span, ...] = get_args(Span)

#: Length of the window that moves over the record to its loudest place.
LOUDEST_WINDOW_S = 0.1
#: Length of the window of `skinsource.signals.spectra.peak_hold_spectrum`: longer, as frequencies
#: that differ by less than one over it are one.
HOLD_WINDOW_S = 0.25

# They are gone through again and again, and stay in the cache meanwhile.
_NUMBERS_AT_ONCE = 2**13


def window_samples(sample_rate_hz: float) -> int:
    """Samples of the window of ``"loudest"``, at least one: 130 at 1300 Hz."""
    return max(sample_count(LOUDEST_WINDOW_S, positive_number("sample_rate_hz", sample_rate_hz)), 1)


def loudest_energy(signals: Floats, n_window: int) -> Floats:
    """Largest sum of squares of any ``n_window`` neighbours in time, (...,), of (..., n_times).

    Beyond both ends lies silence: a signal shorter than the window counts as a whole.
    """
    loudest = LoudestEnergy(signals.shape[:-1], n_window)
    loudest.add(0, signals)
    return loudest.energy


class LoudestEnergy:
    """Largest energy of any window of some signals that come piece by piece.

    Parameters
    ----------
    shape
        Of the signals, without time.
    n_window
        Samples of the window.

    Attributes
    ----------
    energy : shape
        Largest sum of squares within a window, of what was added so far.
    """

    def __init__(self, shape: tuple[int, ...], n_window: int) -> None:
        self.energy = np.zeros(shape)
        self._n_window = n_window
        # Squares of the samples before the next ones, as many as a window can still hold.
        self._before = np.zeros((*shape, n_window - 1))
        self._end = 0

    def add(self, first: int, signals: Floats) -> None:
        """Take the samples from ``first`` on, (..., n); between pieces lies silence."""
        if signals.shape[-1] == 0:
            return
        if first != self._end:
            gap = min(first - self._end, self._n_window - 1)
            silence = np.zeros((*self.energy.shape, gap))
            self._before = np.concatenate((self._before[..., gap:], silence), axis=-1)
        squares = np.concatenate((self._before, np.square(signals)), axis=-1)
        np.maximum(self.energy, _largest_sums(squares, self._n_window), out=self.energy)
        self._before = squares[..., squares.shape[-1] - self._n_window + 1 :].copy()
        self._end = first + signals.shape[-1]


def _largest_sums(squares: Floats, n: int) -> Floats:
    """Largest sum of any ``n`` neighbours, (...,), of (..., n_samples)."""
    rows = squares.reshape(-1, squares.shape[-1])
    largest = np.empty(len(rows))
    at_once = max(_NUMBERS_AT_ONCE // rows.shape[-1], 1)
    for low in range(0, len(rows), at_once):
        some = slice(low, low + at_once)
        largest[some] = _window_sums(rows[some], n).max(axis=-1)
    return largest.reshape(squares.shape[:-1])


def _window_sums(squares: Floats, n: int) -> Floats:
    """Sum of each ``n`` neighbours, (n_signals, n_samples - n + 1)."""
    n_sums = squares.shape[-1] - n + 1
    sums: Floats = np.zeros((len(squares), n_sums))
    of_width, width, summed = squares, 1, 0
    while True:
        if n & width:
            sums += of_width[:, summed : summed + n_sums]
            summed += width
        if summed == n:
            return sums
        of_width = of_width[:, :-width] + of_width[:, width:]
        width *= 2
