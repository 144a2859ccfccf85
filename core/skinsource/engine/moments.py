"""Second moments of the axes of each output, and what follows from them.

RMS levels of every projection follow from the moments, and the moments from spectra by Parseval:
no channel is brought back to time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from skinsource.base.arrays import Booleans, Complexes, Floats
from skinsource.signals.projection import Method, magnitude, no_main_axis, principal_axis_of

#: Below this share of its terms a sum has lost too many digits, and is computed another way.  Above
#: it the rounding of the terms, about 4e-16 of their size, keeps a level right to 1e-14.
_CANCELLED = 0.05


def pairs(n_axes: int) -> tuple[tuple[int, int], ...]:
    """Different axes whose products are wanted, by their numbers."""
    return tuple(combinations(range(n_axes), 2))


@dataclass(frozen=True, slots=True, eq=False)
class Moments:
    """Sums over the samples of a response.

    Attributes
    ----------
    second : (n_outputs, n_axes, n_axes)
        Sum of the products of axes; only the diagonal where nothing else is needed.
    first : (n_outputs, n_axes)
        Sum of the samples.
    """

    second: Floats
    first: Floats


def needs_products(axes: tuple[int, ...], method: Method) -> bool:
    """Whether a projection needs the products of different axes."""
    return len(axes) > 1 and method != "mag"


def moments_of(spectra: Complexes, n_fft: int, *, products: bool) -> Moments:
    """Moments of a vibration from its spectra, (n_outputs, n_axes, n_fft // 2 + 1).

    Products of different axes only if ``products`` are wanted.
    """
    n_axes = spectra.shape[1]
    second = np.zeros((*spectra.shape[:2], n_axes))
    for a in range(n_axes):
        second[:, a, a] = _product_sum(spectra[:, a], spectra[:, a])
    for a, b in pairs(n_axes) if products else ():
        second[:, a, b] = second[:, b, a] = _product_sum(spectra[:, a], spectra[:, b])
    return Moments(second / n_fft, spectra[:, :, 0].real.copy())


def _product_sum(left: Complexes, right: Complexes) -> Floats:
    # Twice the real part of the product, but for the ends of the spectrum, which stand alone.
    whole = np.vecdot(left.view(np.float64), right.view(np.float64))
    ends = left[:, 0].real * right[:, 0].real + left[:, -1].real * right[:, -1].real
    result: Floats = 2.0 * whole - ends
    return result


def combined(
    others: Moments, cross: Moments, edited: Moments, weight: float
) -> tuple[Moments, np.ndarray]:
    """Moments of ``others + weight * edited``, and the outputs where digits cancelled.

    Each axis counts by itself: it may be the only one that is looked at.

    Returns
    -------
    moments
        The exact three terms.
    cancelled : (n_outputs,) of bool
        Outputs with an axis whose energy is below 0.05 of the sum of the terms' magnitudes: compute
        those from the sum of the vibrations instead.
    """
    second = others.second + 2.0 * weight * cross.second + weight**2 * edited.second
    first = others.first + weight * edited.first
    size = np.einsum("oaa->oa", others.second) + weight**2 * np.einsum("oaa->oa", edited.second)
    energy = np.einsum("oaa->oa", second)
    return Moments(second, first), (energy < _CANCELLED * size).any(axis=1)


def directions_of(
    moments: Moments, axes: tuple[int, ...], method: Method, n_times: int | Floats
) -> Floats | None:
    """Vector that the chosen axes, by their numbers, are projected on, (n_outputs, n_axes).

    None for ``"mag"`` of several axes, which is no projection.
    """
    if len(axes) > 1 and method == "mag":
        return None
    if len(axes) == 1 or method == "soc":
        return np.ones((len(moments.second), len(axes)))
    if method == "rms":
        second, _ = _chosen(moments, axes)
        power = np.maximum(np.einsum("oaa->oa", second), 0.0)
        length = np.sqrt(power.sum(axis=1, keepdims=True))
        return np.sqrt(power) / np.where(length > 0, length, 1.0)
    return principal_axis_of(covariance_of(moments, axes, n_times))


def covariance_of(moments: Moments, axes: tuple[int, ...], n_times: int | Floats) -> Floats:
    """Sums of products of the chosen axes' centred samples, (n_outputs, n_axes, n_axes).

    ``n_times`` may differ between the outputs: (n_outputs, 1, 1) then.
    """
    second, first = _chosen(moments, axes)
    return second - first[:, :, None] * first[:, None, :] / n_times


def without_main_axis(
    moments: Moments, axes: tuple[int, ...], method: Method, n_times: int
) -> Booleans:
    """Outputs that are projected on a main axis they do not have, (n_outputs,).

    See `skinsource.signals.projection.no_main_axis`; False for all where no main axis is looked
    for.
    """
    if method != "pca" or len(axes) == 1:
        return np.zeros(len(moments.second), bool)
    return no_main_axis(covariance_of(moments, axes, n_times))


def energies(
    moments: Moments, directions: Floats | None, axes: tuple[int, ...]
) -> tuple[Floats, Booleans]:
    """Sum of squares of the projected signal of each output, (n_outputs,).

    Also where the axes cancelled in the projection, (n_outputs,): compute those another way.
    """
    second, _ = _chosen(moments, axes)
    if directions is None or len(axes) == 1:
        return np.einsum("oaa->o", second), np.zeros(len(second), bool)
    terms = directions[:, :, None] * second * directions[:, None, :]
    energy = np.maximum(terms.sum(axis=(1, 2)), 0.0)
    return energy, energy < _CANCELLED * np.abs(terms).sum(axis=(1, 2))


def energies_of(spectra: Complexes, n_fft: int) -> Floats:
    """Sum of squares of signals from their spectra, (n_signals,)."""
    return _product_sum(spectra, spectra) / n_fft


def _chosen(moments: Moments, axes: tuple[int, ...]) -> tuple[Floats, Floats]:
    if len(axes) == moments.first.shape[1]:
        return moments.second, moments.first
    numbers = list(axes)
    return moments.second[:, numbers][:, :, numbers], moments.first[:, numbers]


# Moments of the edited voice without its vibration.
#
# The vibration that a voice causes is its drive times a response, frequency by frequency.  Its
# moments are sums over frequency of the drive's power times what responses make of it: a matrix
# times a column.  Those between it and the other voices are a matrix times the drive, made of the
# others' vibration and the responses.  Both matrices stay while the drive changes.


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
        products = np.empty((n_outputs, len(of_pairs), n_bins))
        for k, (a, b) in enumerate(of_pairs):
            left, right = self.values[:, a], self.values[:, b]
            products[:, k] = left.real * right.real + left.imag * right.imag
        return products

    def moments(self, drive: Complexes, n_fft: int, *, products: bool) -> Moments:
        """Moments of the vibration by ``drive``, (n_bins,); of different axes only if wanted."""
        power = (np.square(drive.real) + np.square(drive.imag)) * _weights(n_fft)
        return Moments(
            _second_moments(
                _row_products(self._squares, power),
                _row_products(self._products, power) if products else None,
            ),
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
        products = np.empty((n_outputs, len(of_pairs), n_bins), np.complex128)
        for k, (a, b) in enumerate(of_pairs):
            np.multiply(self.others[:, a], self.own.conjugates[:, b], out=products[:, k])
            products[:, k] += self.others[:, b] * self.own.conjugates[:, a]
        products *= 0.5
        return products.view(np.float64)

    def moments(self, drive: Complexes, n_fft: int, *, products: bool) -> Moments:
        """Moments between the others and the vibration by ``drive``, symmetrised.

        There are none of first order between two vibrations.
        """
        # The real part of a product of complex numbers, as one of real rows and columns.
        column = (drive * _weights(n_fft)).view(np.float64)
        squares = _row_products(self._squares, column)
        second = _second_moments(
            squares, _row_products(self._products, column) if products else None
        )
        return Moments(second, np.zeros(second.shape[:2]))


# From 10 000 numbers on, products of two rows are shared out too.
_NUMBERS_AT_ONCE = 8192


def _row_products(matrix: Floats, column: Floats) -> Floats:
    """One product of a matrix and a column, (n_outputs, n_rows), row by row and by one thread.

    As a matrix product it would be shared out among the threads of the linear algebra library,
    which wait for each other without sleeping: where another program has the second processor,
    ten times the work.
    """
    sums = np.zeros(matrix.shape[:2])
    rows = matrix.reshape(*matrix.shape[:2], column.size)
    for begin in range(0, column.size, _NUMBERS_AT_ONCE):
        end = begin + _NUMBERS_AT_ONCE
        sums += np.vecdot(rows[..., begin:end], column[begin:end])
    return sums


def _weights(n_fft: int) -> Floats:
    """What stands before the terms of Parseval's sum: twice over n_fft, but once for the ends."""
    weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
    weights[[0, -1]] *= 0.5
    return weights


def _second_moments(squares: Floats, products: Floats | None) -> Floats:
    n_outputs, n_axes = squares.shape
    second = np.zeros((n_outputs, n_axes, n_axes))
    every = np.arange(n_axes)
    second[:, every, every] = squares
    if products is not None:
        for k, (a, b) in enumerate(pairs(n_axes)):
            second[:, a, b] = second[:, b, a] = products[:, k]
    return second


# From axes to one signal for each output, along vectors that are known.


@dataclass(frozen=True, slots=True, eq=False)
class Projection:
    """How the chosen axes of some outputs become one signal each.

    Attributes
    ----------
    axis_numbers
        Where the chosen axes are among those that the limb measures along.
    directions : (n_outputs, n_axes) or None
        Vector that each output is projected on; None: the length of the vector is taken.
    """

    axis_numbers: tuple[int, ...]
    directions: Floats | None

    def at(self, rows: Sequence[int] | slice | np.ndarray) -> "Projection":
        """The same for some of its outputs, counted from 0."""
        if self.directions is None:
            return self
        return Projection(self.axis_numbers, self.directions[rows])

    def signals(self, traces: Floats) -> Floats:
        """Projected signals, (n_outputs, n_times), of the chosen axes, (…, n_axes, n_times)."""
        if self.directions is None:
            return magnitude(traces)
        return np.einsum("oa,oat->ot", self.directions, traces)

    def spectra(self, spectra: Complexes) -> Complexes:
        """Spectra of the projected signals; there are none for the length of the vector."""
        if self.directions is None:
            raise ValueError("the length of a vector has no spectrum of its own")
        # As pairs of numbers: with both of one type it takes a quarter of the time.
        parts = np.ascontiguousarray(spectra).view(np.float64)
        projected: Floats = np.einsum("oa,oaf->of", self.directions, parts)
        return projected.view(np.complex128)
