"""Moments of the selected input without its field.

The field of an input is its drive times a response, frequency by frequency.  Its moments are sums
over frequency of the drive's power times what responses make of it; those between it and the other
inputs are sums of the drive times what the others' field and responses make of it.  Both stay the
same while the drive changes, and each moment is then one product of a row and the drive.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from skinsource.rendering.moments import PAIRS, Moments
from skinsource.rendering.transforms import Complexes, Floats


@dataclass(frozen=True, eq=False)
class OwnForms:
    """What the responses to one place make of a drive's power.

    ``values`` are the spectra of the responses, (72 outputs, 3 axes, n_bins).
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
        found = np.empty(self.values.shape)
        for k, (a, b) in enumerate(PAIRS):
            left, right = self.values[:, a], self.values[:, b]
            found[:, k] = left.real * right.real + left.imag * right.imag
        return found

    def moments(self, drive: Complexes, n_fft: int, *, products: bool) -> Moments:
        """Moments of the field of ``drive``, (n_bins,); of different axes only if wanted."""
        power = (np.square(drive.real) + np.square(drive.imag)) * _weights(n_fft)
        return Moments(
            _filled(_by(self._squares, power), _by(self._products, power) if products else None),
            self.values[:, :, 0].real * drive[0].real,
        )


@dataclass(frozen=True, eq=False)
class CrossForms:
    """What the field of the other inputs and the responses to one place make of a drive.

    ``others`` is that field, (72, 3, n_bins), ``own`` holds the responses.
    """

    others: Complexes
    own: OwnForms

    @cached_property
    def _squares(self) -> Floats:
        return np.multiply(self.others, self.own.conjugates).view(np.float64)

    @cached_property
    def _products(self) -> Floats:
        found = np.empty(self.others.shape, np.complex128)
        for k, (a, b) in enumerate(PAIRS):
            np.multiply(self.others[:, a], self.own.conjugates[:, b], out=found[:, k])
            found[:, k] += self.others[:, b] * self.own.conjugates[:, a]
        found *= 0.5
        return found.view(np.float64)

    def moments(self, drive: Complexes, n_fft: int, *, products: bool) -> Moments:
        """Moments between the others and the field of ``drive``, symmetrised.

        There are none of first order between two fields.
        """
        # The real part of a product of complex numbers, as one of real rows and columns.
        column = (drive * _weights(n_fft)).view(np.float64)
        squares = _by(self._squares, column)
        second = _filled(squares, _by(self._products, column) if products else None)
        return Moments(second, np.zeros(second.shape[:2]))


def _by(form: Floats, column: Floats) -> Floats:
    """One product of a matrix and a column, (72, 3): faster than one for each output."""
    found: Floats = form.reshape(-1, column.size) @ column
    return found.reshape(form.shape[:2])


def _weights(n_fft: int) -> Floats:
    """What stands before the terms of Parseval's sum: twice over n_fft, but once for the ends."""
    weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
    weights[[0, -1]] *= 0.5
    return weights


def _filled(squares: Floats, products: Floats | None) -> Floats:
    second = np.zeros((len(squares), 3, 3))
    second[:, (0, 1, 2), (0, 1, 2)] = squares
    for k, (a, b) in enumerate(PAIRS if products is not None else ()):
        second[:, a, b] = second[:, b, a] = products[:, k] if products is not None else 0.0
    return second
