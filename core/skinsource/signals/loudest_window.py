"""The loudest window of a signal, over which a level can average instead of the whole record.

Sums over windows are made of sums over 1, 2, 4, 8, … neighbours: nothing is subtracted, so that
quiet parts after a burst are as accurate as the burst.
"""

from typing import Literal, get_args

import numpy as np

from skinsource.base.arguments import positive_number
from skinsource.base.conventions import Floats
from skinsource.signals.generators import sample_count

Span = Literal["record", "loudest"]
SPANS: tuple[Span, ...] = get_args(Span)

#: Length of the loudest window.
LOUDEST_WINDOW_S = 0.1
#: Length of the window of `skinsource.signals.spectra.peak_hold_spectrum`: longer, because it
#: resolves frequencies that differ by more than one over it.
HOLD_WINDOW_S = 0.25

# Numbers of a block, which stays in the processor's cache.
_NUMBERS_AT_ONCE = 2**13


def window_samples(sample_rate_hz: float) -> int:
    """Return the samples of the loudest window, at least one: 130 at 1300 Hz."""
    return max(sample_count(LOUDEST_WINDOW_S, positive_number("sample_rate_hz", sample_rate_hz)), 1)


def loudest_energy(signals: Floats, n_window: int) -> Floats:
    """Return the largest sum of squares of any ``n_window`` neighbours, (...), of (..., n_times).

    Beyond both ends there is silence: a signal shorter than the window counts as a whole.
    """
    squares = np.zeros((*signals.shape[:-1], signals.shape[-1] + n_window - 1))
    np.square(signals, out=squares[..., n_window - 1 :])
    return _largest_sums(squares, n_window)


class LoudestEnergy:
    """Largest energy of any window of signals that are added piece by piece.

    Parameters
    ----------
    shape
        Shape of the signals without time.
    n_window
        Samples of the window.

    Attributes
    ----------
    energy : shape
        Largest sum of squares within a window so far.
    """

    def __init__(self, shape: tuple[int, ...], n_window: int) -> None:
        self.energy = np.zeros(shape)
        self._n_window = n_window
        # Squares of the last samples, as many as a window with the next one can hold.
        self._before = np.zeros((*shape, n_window - 1))
        self._end = 0

    def add(self, first: int, signals: Floats) -> None:
        """Add the samples from ``first`` on, (..., n); between pieces there is silence."""
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
    """Return the largest sum of any ``n`` neighbours, (...), of (..., n_samples)."""
    rows = squares.reshape(-1, squares.shape[-1])
    largest = np.empty(len(rows))
    at_once = max(_NUMBERS_AT_ONCE // rows.shape[-1], 1)
    for low in range(0, len(rows), at_once):
        part = slice(low, low + at_once)
        largest[part] = _window_sums(rows[part], n).max(axis=-1)
    return largest.reshape(squares.shape[:-1])


def _window_sums(squares: Floats, n: int) -> Floats:
    """Return the sums of each ``n`` neighbours, (n_signals, n_samples - n + 1)."""
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
