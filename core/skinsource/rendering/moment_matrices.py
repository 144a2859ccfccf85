"""Moments of the edited voice without its vibration.

The vibration that a voice causes is its drive times a response, frequency by frequency.  Its
moments are sums over frequency of the drive's power times what responses make of it: a matrix times
a column.  Those between it and the other voices are a matrix times the drive, made of the others'
vibration and the responses.  Both matrices stay while the drive changes.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.rendering.moments import Moments, pairs


@dataclass(frozen=True, eq=False)
class OwnMatrix:
    """What the responses to one place make of a drive's power.

    ``values`` are the spectra of the responses, (n_outputs, n_axes, n_bins).
    """

    values: Complexes

    @cached_property
    def conjugates(self) -> Complexes:
        """Conjugate spectra of the responses."""
        return self.values.conj()

    @cached_property
    def _squares(self) -> Floats:
        return np.square(self.values.real) + np.square(self.values.imag)

    @cached_property
    def _products(self) -> Floats:
        n_outputs, n_axes, n_bins = self.values.shape
        of_pairs = pairs(n_axes)
        found = np.empty((n_outputs, len(of_pairs), n_bins))
        for k, (a, b) in enumerate(of_pairs):
            left, right = self.values[:, a], self.values[:, b]
            found[:, k] = left.real * right.real + left.imag * right.imag
        return found

    def moments(self, drive: Complexes, n_fft: int, *, products: bool) -> Moments:
        """Moments of the vibration by ``drive``, (n_bins,); of different axes only if wanted."""
        power = (np.square(drive.real) + np.square(drive.imag)) * _weights(n_fft)
        return Moments(
            _filled(_by(self._squares, power), _by(self._products, power) if products else None),
            self.values[:, :, 0].real * drive[0].real,
        )


@dataclass(frozen=True, eq=False)
class CrossMatrix:
    """What the vibration by other voices and the responses to one place make of a drive.

    ``others`` is that vibration, (n_outputs, n_axes, n_bins), ``own`` holds the responses.
    """

    others: Complexes
    own: OwnMatrix

    @cached_property
    def _squares(self) -> Floats:
        return np.multiply(self.others, self.own.conjugates).view(np.float64)

    @cached_property
    def _products(self) -> Floats:
        n_outputs, n_axes, n_bins = self.others.shape
        of_pairs = pairs(n_axes)
        found = np.empty((n_outputs, len(of_pairs), n_bins), np.complex128)
        for k, (a, b) in enumerate(of_pairs):
            np.multiply(self.others[:, a], self.own.conjugates[:, b], out=found[:, k])
            found[:, k] += self.others[:, b] * self.own.conjugates[:, a]
        found *= 0.5
        return found.view(np.float64)

    def moments(self, drive: Complexes, n_fft: int, *, products: bool) -> Moments:
        """Moments between the others and the vibration by ``drive``, symmetrised.

        There are none of first order between two vibrations.
        """
        # The real part of a product of complex numbers, as one of real rows and columns.
        column = (drive * _weights(n_fft)).view(np.float64)
        squares = _by(self._squares, column)
        second = _filled(squares, _by(self._products, column) if products else None)
        return Moments(second, np.zeros(second.shape[:2]))


# From 10 000 numbers on, products of two rows are shared out too.
_NUMBERS_AT_ONCE = 8192


def _by(matrix: Floats, column: Floats) -> Floats:
    """One product of a matrix and a column, (n_outputs, n_rows), row by row and by one thread.

    As a matrix product it would be shared out among the threads of the linear algebra library,
    which wait for each other without sleeping: where another program has the second processor,
    ten times the work.
    """
    found = np.zeros(matrix.shape[:2])
    rows = matrix.reshape(*matrix.shape[:2], column.size)
    for begin in range(0, column.size, _NUMBERS_AT_ONCE):
        end = begin + _NUMBERS_AT_ONCE
        found += np.vecdot(rows[..., begin:end], column[begin:end])
    return found


def _weights(n_fft: int) -> Floats:
    """What stands before the terms of Parseval's sum: twice over n_fft, but once for the ends."""
    weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
    weights[[0, -1]] *= 0.5
    return weights


def _filled(squares: Floats, products: Floats | None) -> Floats:
    n_outputs, n_axes = squares.shape
    second = np.zeros((n_outputs, n_axes, n_axes))
    every = np.arange(n_axes)
    second[:, every, every] = squares
    if products is not None:
        for k, (a, b) in enumerate(pairs(n_axes)):
            second[:, a, b] = second[:, b, a] = products[:, k]
    return second
