"""Second moments of the axes of each output, and projections of axes to one signal.

RMS levels of every projection follow from the moments, and the moments from spectra by Parseval's
theorem: no channel is transformed back to time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from skinsource.base.conventions import Booleans, Complexes, Floats
from skinsource.signals.projection import Method, magnitude, no_main_axis, principal_axis_of

#: Below this share of its terms a sum has lost too many digits, and is computed in another way.
#: Above it the rounding of the terms, about 4e-16 of their size, changes a level by at most 1e-14.
_CANCELLED = 0.05


def _pairs(n_axes: int, *, products: bool) -> tuple[tuple[int, int], ...]:
    """Return each axis with itself, by number; with ``products`` then with each other one."""
    different = combinations(range(n_axes), 2) if products else ()
    return (*zip(range(n_axes), range(n_axes), strict=True), *different)


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
    """Return whether a projection needs the products of different axes."""
    return len(axes) > 1 and method != "mag"


def moments_of(spectra: Complexes, n_fft: int, *, products: bool) -> Moments:
    """Return the moments of a vibration from its spectra, (n_outputs, n_axes, n_fft // 2 + 1).

    Products of different axes are computed only with ``products``.
    """
    n_axes = spectra.shape[1]
    if products:
        second = np.empty((len(spectra), n_axes, n_axes))
        for a in range(n_axes):
            second[:, a, a:] = _product_sum(spectra[:, a : a + 1], spectra[:, a:])
            second[:, a:, a] = second[:, a, a:]
    else:
        second = _second_moments(_product_sum(spectra, spectra), n_axes, products=False)
    return Moments(second / n_fft, spectra[:, :, 0].real.copy())


def _product_sum(left: Complexes, right: Complexes) -> Floats:
    # All bins count twice, but for both ends of the spectrum.
    whole = np.vecdot(left.view(np.float64), right.view(np.float64))
    ends = left[..., 0].real * right[..., 0].real + left[..., -1].real * right[..., -1].real
    return 2.0 * whole - ends


def combined(
    others: Moments, cross: Moments, edited: Moments, weight: float
) -> tuple[Moments, np.ndarray]:
    """Return the moments of ``others + weight * edited``, and the outputs where digits cancelled.

    Returns
    -------
    moments
        Sums of three terms.
    cancelled : (n_outputs,) of bool
        Outputs with an axis whose energy is below 0.05 of the sum of the magnitudes of its terms:
        compute them from the sum of the vibrations instead.  Axes are checked one by one, as the
        view may show a single axis.
    """
    second = others.second + 2.0 * weight * cross.second + weight**2 * edited.second
    first = others.first + weight * edited.first
    size = np.einsum("oaa->oa", others.second) + weight**2 * np.einsum("oaa->oa", edited.second)
    energy = np.einsum("oaa->oa", second)
    return Moments(second, first), (energy < _CANCELLED * size).any(axis=1)


def directions_of(
    moments: Moments, axes: tuple[int, ...], method: Method, n_times: int | Floats
) -> Floats | None:
    """Return the vectors that the chosen axes are projected on, (n_outputs, n_axes).

    None for ``"mag"`` of several axes, which is not linear.
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
    """Return the sums of products of centred samples of axes, (n_outputs, n_axes, n_axes).

    ``n_times`` is a number, or (n_outputs, 1, 1) where outputs differ.
    """
    second, first = _chosen(moments, axes)
    return second - first[:, :, None] * first[:, None, :] / n_times


def without_main_axis(
    moments: Moments, axes: tuple[int, ...], method: Method, n_times: int
) -> Booleans:
    """Return whether each output is projected on a main axis that it does not have, (n_outputs,).

    See `skinsource.signals.projection.no_main_axis`; all False for methods without a main axis.
    """
    if method != "pca" or len(axes) == 1:
        return np.zeros(len(moments.second), bool)
    return no_main_axis(covariance_of(moments, axes, n_times))


def energies(
    moments: Moments, directions: Floats | None, axes: tuple[int, ...]
) -> tuple[Floats, Booleans]:
    """Return the sum of squares of the projected signal of each output, (n_outputs,).

    Also return for which outputs axes cancelled in the projection, (n_outputs,): compute their
    energies in another way.
    """
    second, _ = _chosen(moments, axes)
    if directions is None or len(axes) == 1:
        return np.einsum("oaa->o", second), np.zeros(len(second), bool)
    terms = directions[:, :, None] * second * directions[:, None, :]
    energy = np.maximum(terms.sum(axis=(1, 2)), 0.0)
    return energy, energy < _CANCELLED * np.abs(terms).sum(axis=(1, 2))


def energies_of(spectra: Complexes, n_fft: int) -> Floats:
    """Return the sum of squares of signals from their spectra, (n_signals,)."""
    return _product_sum(spectra, spectra) / n_fft


def _chosen(moments: Moments, axes: tuple[int, ...]) -> tuple[Floats, Floats]:
    if len(axes) == moments.first.shape[1]:
        return moments.second, moments.first
    numbers = list(axes)
    return moments.second[:, numbers][:, :, numbers], moments.first[:, numbers]


@dataclass(frozen=True, eq=False)
class OwnMatrix:
    """Matrix from the power spectrum of a drive to the moments of its vibration.

    A vibration is the drive times a response, frequency by frequency.  So its moments are sums over
    frequency of the power of the drive times products of responses, ``values``, (n_outputs, n_axes,
    n_bins), which stay while the drive changes.  ``products``: see `moments_of`.
    """

    values: Complexes
    products: bool

    @cached_property
    def _rows(self) -> Floats:
        n_outputs, n_axes, n_bins = self.values.shape
        of_pairs = _pairs(n_axes, products=self.products)
        rows = np.empty((n_outputs, len(of_pairs), n_bins))
        squares = rows[:, :n_axes]
        np.square(self.values.real, out=squares)
        squares += np.square(self.values.imag)
        for k, (a, b) in enumerate(of_pairs[n_axes:], n_axes):
            left, right = self.values[:, a], self.values[:, b]
            rows[:, k] = left.real * right.real + left.imag * right.imag
        return rows

    def moments(self, drive: Complexes, n_fft: int) -> Moments:
        """Return the moments of the vibration by ``drive``, (n_bins,)."""
        power = (np.square(drive.real) + np.square(drive.imag)) * _weights(n_fft)
        sums = _row_products(self._rows, power)
        first = self.values[:, :, 0].real * drive[0].real
        return Moments(_second_moments(sums, first.shape[1], products=self.products), first)


@dataclass(frozen=True, eq=False)
class CrossMatrix:
    """Matrix from the spectrum of a drive to moments between its vibration and that of others.

    It is made of the vibration by the other voices, (n_outputs, n_axes, n_bins), and the responses
    to the location of the drive; both stay while the drive changes.
    """

    others: Complexes
    own: OwnMatrix

    @cached_property
    def _rows(self) -> Floats:
        n_outputs, n_axes, n_bins = self.others.shape
        of_pairs = _pairs(n_axes, products=self.own.products)
        rows = np.empty((n_outputs, len(of_pairs), n_bins), np.complex128)
        # Each in its place, until it is replaced by its product: a copy would take as much again.
        conjugates = np.conjugate(self.own.values, out=rows[:, :n_axes])
        for k, (a, b) in enumerate(of_pairs[n_axes:], n_axes):
            row = np.multiply(self.others[:, a], conjugates[:, b], out=rows[:, k])
            row += self.others[:, b] * conjugates[:, a]
            row *= 0.5
        np.multiply(self.others, conjugates, out=conjugates)
        return rows.view(np.float64)

    def moments(self, drive: Complexes, n_fft: int) -> Moments:
        """Return the symmetrised moments between the others and the vibration by ``drive``.

        First moments between two vibrations are 0.
        """
        # Real rows times a real column give the real part of the complex product.
        column = (drive * _weights(n_fft)).view(np.float64)
        sums = _row_products(self._rows, column)
        second = _second_moments(sums, self.others.shape[1], products=self.own.products)
        return Moments(second, np.zeros(second.shape[:2]))


# From 10 000 numbers on, the library of linear algebra uses threads for products of rows too.
_NUMBERS_AT_ONCE = 8192


def _row_products(matrix: Floats, column: Floats) -> Floats:
    """Return the product of a matrix and a column, (n_outputs, n_rows), computed row by row.

    A matrix product would use threads that wait for each other without sleeping, which takes ten
    times as long where another program has the second processor.
    """
    sums = np.zeros(matrix.shape[:2])
    rows = matrix.reshape(*matrix.shape[:2], column.size)
    for begin in range(0, column.size, _NUMBERS_AT_ONCE):
        end = begin + _NUMBERS_AT_ONCE
        sums += np.vecdot(rows[..., begin:end], column[begin:end])
    return sums


def _weights(n_fft: int) -> Floats:
    """Return the factors in Parseval's sum: 2 / n_fft, and half of it at both ends."""
    weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
    weights[[0, -1]] *= 0.5
    return weights


def _second_moments(sums: Floats, n_axes: int, *, products: bool) -> Floats:
    """Return sums of products, (n_outputs, n_pairs), as symmetric (n_outputs, n_axes, n_axes)."""
    left, right = np.array(_pairs(n_axes, products=products)).T
    second = np.zeros((len(sums), n_axes, n_axes))
    second[:, left, right] = second[:, right, left] = sums
    return second


@dataclass(frozen=True, slots=True, eq=False)
class Projection:
    """How the chosen axes of each output become one signal.

    Attributes
    ----------
    axis_numbers
        Numbers of the chosen axes among those of the limb.
    directions : (n_outputs, n_axes) or None
        Vector that each output is projected on; None for the length of the acceleration vector.
    """

    axis_numbers: tuple[int, ...]
    directions: Floats | None

    def at(self, rows: Sequence[int] | slice | np.ndarray) -> "Projection":
        """Return the projection of some of its outputs, counted from 0."""
        if self.directions is None:
            return self
        return Projection(self.axis_numbers, self.directions[rows])

    def signals(self, traces: Floats) -> Floats:
        """Return projected signals, (n_outputs, n_times), of the axes, (…, n_axes, n_times)."""
        if self.directions is None:
            return magnitude(traces)
        return np.einsum("oa,oat->ot", self.directions, traces)

    def waves(self, traces: Floats, signals: Floats) -> Floats:
        """Return what is interpolated between samples: the signals, or axes with their length."""
        return traces if self.directions is None else signals

    def spectra(self, spectra: Complexes) -> Complexes:
        """Return the spectra of projected signals; only where the projection is linear."""
        if self.directions is None:
            raise ValueError("the length of a vector has no spectrum of its own")
        # As pairs of real numbers it takes a quarter of the time.
        parts = np.ascontiguousarray(spectra).view(np.float64)
        return np.einsum("oa,oaf->of", self.directions, parts).view(np.complex128)
