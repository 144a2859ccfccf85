"""Matrices from the spectra of drives to moments of what they cause together.

The vibration by some drives is their sum, each times a response; its second moments are sums over
pairs of drives of a product of their spectra, times a product of responses.  The products of
responses are matrices that stay while drives change, and many stimuli are the columns that they
are multiplied with: the responses are read once for all of them.
"""

from collections.abc import Hashable, Iterable

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.rendering.moments import pairs

# Larger products are shared out among the threads of the linear algebra library, which wait for
# each other without sleeping; and the order of a sum would be a matter of their number.
_NUMBERS_AT_ONCE = 2**18
# Few whole rows at a time are quicker than parts of many: what they are multiplied with stays in
# the cache.  The library takes rows by so many.
_ROWS = 8


class Products:
    """Products of responses, which are made when they are asked for and stay for the next ones.

    Attributes
    ----------
    pairs
        Axes of each product: of each axis with itself, then of different ones.

    Parameters
    ----------
    n_fft
        Length of the transforms.
    n_axes
        Of each output.
    products
        Whether products of different axes are wanted.
    """

    def __init__(self, n_fft: int, n_axes: int, *, products: bool) -> None:
        self.n_axes = n_axes
        squares = tuple((axis, axis) for axis in range(n_axes))
        self.pairs = (*squares, *(pairs(n_axes) if products else ()))
        self._weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
        self._weights[[0, -1]] *= 0.5
        self._known: dict[Hashable, Floats] = {}

    def n_bytes(self, n_own: int, n_pairs: int, values: Complexes) -> int:
        """What so many matrices take, for responses such as ``values``."""
        return (n_own + 2 * n_pairs) * len(self.pairs) * len(values) * values.shape[-1] * 8

    def own(self, key: Hashable, values: Complexes) -> Floats:
        """Of responses with themselves, (n_products, n_outputs, n_bins), for powers of a drive.

        Parameters
        ----------
        key
            What tells ``values`` from others.
        values : (n_outputs, n_axes, n_bins)
            Spectra of responses.
        """
        known = self._known.get(key)
        if known is None:
            known = np.empty((len(self.pairs), len(values), values.shape[-1]))
            for k, (a, b) in enumerate(self.pairs):
                left, right = values[:, a], values[:, b]
                known[k] = (left.real * right.real + left.imag * right.imag) * self._weights
            self._known[key] = known
        return known

    def between(self, keys: tuple[Hashable, Hashable], left: Complexes, right: Complexes) -> Floats:
        """Of two responses, (n_products, n_outputs, 2 n_bins).

        For products of the left drive and the conjugate of the right one, real and imaginary parts
        in turn: what the two cause together beside what each causes alone.
        """
        known = self._known.get(keys)
        if known is None:
            made = np.empty((len(self.pairs), len(left), left.shape[-1]), np.complex128)
            conjugate = left.conj()
            for k, (a, b) in enumerate(self.pairs):
                np.multiply(conjugate[:, a], right[:, b], out=made[k])
                made[k] += right[:, a] * conjugate[:, b]
                made[k] *= self._weights
            known = self._known[keys] = made.view(np.float64)
        return known

    def forget_all_but(self, keys: Iterable[Hashable]) -> None:
        """Keep only these matrices."""
        wanted = set(keys)
        self._known = {key: one for key, one in self._known.items() if key in wanted}


def multiplied(matrix: Floats, columns: Floats) -> Floats:
    """Sums over the last axis, (n_columns, n_products, n_outputs), by one thread.

    Parameters
    ----------
    matrix : (n_products, n_outputs, n)
    columns : (n_columns, n)
        Each sum is the same whatever stands in the other columns.
    """
    n_columns, n = columns.shape
    rows = matrix.reshape(-1, n)
    found = np.zeros((n_columns, len(rows)))
    step = min(max(_NUMBERS_AT_ONCE // (n_columns * _ROWS), 1), n)
    at_once = _ROWS * max(_NUMBERS_AT_ONCE // (n_columns * _ROWS * step), 1)
    for low in range(0, n, step):
        part = columns[:, low : low + step]
        for row in range(0, len(rows), at_once):
            found[:, row : row + at_once] += part @ rows[row : row + at_once, low : low + step].T
    return found.reshape(n_columns, *matrix.shape[:2])
