"""The surface operator, from one value per output to a picture, and outputs that share a place."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.base.arguments import real_array
from skinsource.base.conventions import Booleans, Floats, Indices
from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import InvalidInputError

if TYPE_CHECKING:
    from scipy.sparse import csr_array


#: Sites no farther apart than this part of the size of all are one site.
NEAR_DUPLICATE = 1e-9

Pairs = tuple[tuple[int, int], ...]


def first_at_same_place(sites: Floats, size: float) -> Indices:
    """Return the index of the first site at each site's place, (n_sites,).

    Parameters
    ----------
    sites : (n_sites, 2)
        Finite coordinates.
    size
        Extent of what they are part of; `NEAR_DUPLICATE` of it counts as no distance.
    """
    every = np.arange(len(sites))
    near = scipy.spatial.KDTree(sites).query_pairs(NEAR_DUPLICATE * size, output_type="ndarray")
    if not len(near):
        return every
    joined = scipy.sparse.coo_array((np.ones(len(near)), tuple(near.T)), shape=2 * every.shape)
    _, group = scipy.sparse.csgraph.connected_components(joined, directed=False)
    _, first = np.unique(group, return_index=True)
    return np.asarray(first[group], dtype=np.intp)


def pairs_at_same_place(sites: Floats, size: float) -> Pairs:
    """Return each site that shares its place, paired with the first one there; NaN has no place."""
    placed = np.flatnonzero(np.isfinite(sites).all(axis=1))
    first = placed[first_at_same_place(sites[placed], size)]
    second = first != placed
    return tuple(zip(first[second].tolist(), placed[second].tolist(), strict=True))


def check_values_of_shared_places(values: Floats, pairs: Pairs) -> None:
    """Raise where two outputs at one place were given different values.

    Parameters
    ----------
    values : (n_outputs, ...)
        Given values.
    pairs
        From `pairs_at_same_place`.

    Raises
    ------
    InvalidInputError
        Names both outputs and their values.
    """
    for first, other in pairs:
        differ = np.argwhere(np.atleast_1d(values[first] != values[other]))
        if len(differ):
            at = tuple(differ[0])
            pair = (np.atleast_1d(values[k])[at] for k in (first, other))
            raise InvalidInputError(
                f"outputs {first + 1} and {other + 1} lie at the same place of the map, but were "
                "given {:g} and {:g}; expected one value for one place. Move one of the two, or "
                "give both the same value.".format(*pair)
            )


@dataclass(frozen=True, kw_only=True, eq=False)
class SurfaceOperator:
    """Spreads one value per output over the outline of the limb.

    Attributes
    ----------
    weights : (rows * columns, n_outputs) sparse
        Row of a pixel is row * columns + column; empty outside the mask.
    mask : (rows, columns) of bool
        Pixels inside the closed outline.  Rows increase with y, columns with x.
    x_mm, y_mm : (columns,) and (rows,)
        Places of the pixels: coordinates of the limb's map, scaled to millimetres.
    fallback_count
        Pixels interpolated linearly because natural neighbours failed there; normally 0.
    blind_vertices, single_vertices
        Number of outline vertices that see no output, and lie between others that do; and of those
        that see only one, and take its value.
    same_place
        Outputs (counted from 0) at one place, in pairs: they need equal values; normally empty.
    warnings
        What a user should know about this map, in sentences; normally empty.
    """

    weights: csr_array[np.float64]
    mask: Booleans
    x_mm: Floats
    y_mm: Floats
    fallback_count: int
    blind_vertices: int
    single_vertices: int
    same_place: Pairs
    warnings: tuple[str, ...]

    def interpolate(self, values: ArrayLike) -> Floats:
        """Interpolate values at the outputs over the surface.

        Values are decibels by convention: the published toolbox interpolates decibels, and
        interpolating amplitudes gives other pictures (up to 2.3 dB apart).  -inf, which is silence,
        counts as -200 dB, because it would erase its neighbours.  Other values are taken as they
        are.

        Parameters
        ----------
        values : (n_outputs,) or (n_outputs, n_frames)
            Outputs without a place on the map are ignored, also where NaN.

        Returns
        -------
        (rows, columns) or (rows, columns, n_frames)
            In the unit of ``values``; NaN outside the mask.

        Raises
        ------
        InvalidInputError
            The shape is wrong, the value of an output with a place is NaN or +inf, or outputs at
            one place have different values.
        """
        data = real_array("values", values, "one value per output")
        n_outputs = self.weights.shape[1]
        if data.ndim not in (1, 2) or data.shape[0] != n_outputs:
            raise InvalidInputError(
                f"the surface was given values of shape {data.shape}; expected one value per "
                f"output, ({n_outputs},) or ({n_outputs}, n_frames)."
            )
        data = np.where(np.isneginf(data), FLOOR_DB, data)
        bad = ~np.isfinite(data).reshape(n_outputs, -1).all(axis=1) & self._placed
        if bad.any():
            names = ", ".join(str(output) for output in np.flatnonzero(bad) + 1)
            raise InvalidInputError(
                f"the surface was given NaN or +inf for output {names}; every output that has a "
                "place on the map needs a finite value or -inf. Correct the values before "
                "interpolating."
            )
        check_values_of_shared_places(data, self.same_place)
        # Zero times NaN must not reach the outputs that do have a place.
        usable = np.where(self._placed.reshape(-1, *[1] * (data.ndim - 1)), data, 0.0)
        surface = np.full((*self.mask.shape, *data.shape[1:]), np.nan)
        surface[self.mask] = self._inside @ usable
        return surface

    @cached_property
    def _placed(self) -> Booleans:
        """Outputs that have a place on the map, (n_outputs,)."""
        placed = np.zeros(self.weights.shape[1], bool)
        placed[self.weights.indices] = True
        return placed

    @cached_property
    def _inside(self) -> csr_array[np.float64]:
        """Weights of the pixels inside the mask alone, (n_inside, n_outputs)."""
        return self.weights[np.flatnonzero(self.mask)]
