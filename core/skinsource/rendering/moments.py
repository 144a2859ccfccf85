"""Second moments of the axes of each output, and what follows from them.

RMS levels of every projection follow from the moments, and the moments from spectra by Parseval:
no channel is brought back to time.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from skinsource.arrays import Booleans, Complexes, Floats
from skinsource.projection import Method, no_main_axis, principal_axis_of

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

    See `skinsource.projection.no_main_axis`; False for all where no main axis is looked for.
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
