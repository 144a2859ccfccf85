"""From axes to one signal for each output, along vectors that are known."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.projection import magnitude


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
