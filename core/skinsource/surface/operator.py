"""The heatmap: from one value per output to a picture of the back of the hand and arm."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import real_array
from skinsource.arrays import Booleans, Floats
from skinsource.decibels import FLOOR_DB
from skinsource.errors import InvalidInputError
from skinsource.surface.same_place import Pairs, refuse_two_values_for_one_place

if TYPE_CHECKING:
    from scipy.sparse import csr_array


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
        Number of outline vertices that see no output and take the two nearest by the way inside
        the outline; and of those that see only one, and take its value.
    same_place
        Outputs (counted from 0) at one place, in pairs: they need equal values; normally empty.
    warnings
        What a user should know about this map, in sentences; normally empty.
    """

    weights: "csr_array[np.float64]"
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
        interpolating amplitudes gives other pictures (up to 2.3 dB apart).  -inf, the decibels
        of nothing, counts as -200 dB, because it would blot out all its neighbours.  Other
        values are taken as they are.

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
        given = real_array("values", values, "one value per output")
        n_outputs = self.weights.shape[1]
        if given.ndim not in (1, 2) or given.shape[0] != n_outputs:
            raise InvalidInputError(
                f"the surface was given values of shape {given.shape}; expected one value per "
                f"output, ({n_outputs},) or ({n_outputs}, n_frames)."
            )
        given = np.where(np.isneginf(given), FLOOR_DB, given)
        bad = ~np.isfinite(given).reshape(n_outputs, -1).all(axis=1) & self._placed
        if bad.any():
            names = ", ".join(str(output) for output in np.flatnonzero(bad) + 1)
            raise InvalidInputError(
                f"the surface was given NaN or +inf for output {names}; every output that has a "
                "place on the map needs a finite value or -inf. Correct the values before "
                "interpolating."
            )
        refuse_two_values_for_one_place(given, self.same_place)
        # Zero times NaN must not reach the outputs that do have a place.
        usable = np.where(self._placed.reshape(-1, *[1] * (given.ndim - 1)), given, 0.0)
        surface = np.full((*self.mask.shape, *given.shape[1:]), np.nan)
        surface[self.mask] = self._inside @ usable
        return surface

    @cached_property
    def _placed(self) -> Booleans:
        """Outputs that have a place on the map, (n_outputs,)."""
        placed = np.zeros(self.weights.shape[1], bool)
        placed[self.weights.indices] = True
        return placed

    @cached_property
    def _inside(self) -> "csr_array[np.float64]":
        """Weights of the pixels inside the mask alone, (n_inside, n_outputs)."""
        return self.weights[np.flatnonzero(self.mask)]
