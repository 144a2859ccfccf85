"""Rows of a plot: one for all curves, or one for each."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skinsource_gui.widgets.plot.ranges import Range

Floats = NDArray[np.float64]

#: More rows than these would be too thin to read.
MOST_ROWS = 12
_EDGE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows:
    """Equally high rows with the same range of values.

    Heights are counted in rows from the bottom; the first curve is on top.

    Attributes
    ----------
    count
        How many there are.
    values
        Range of values of each row.
    """

    count: int
    values: Range

    @property
    def span(self) -> Range:
        """Heights of the bottom and of the top."""
        return (0.0, float(self.count))

    def heights(self, values: Floats, row: int | NDArray[np.intp]) -> Floats:
        """Heights of ``values`` drawn in ``row``; what lies outside stays at the row's edge.

        ``row`` can be an array, of a shape that goes together with that of ``values``.
        """
        low, high = self.values
        edge = _EDGE if self.count > 1 else 0.0
        part = np.clip((values - low) / (high - low), 0.0, 1.0)
        return (self.count - 1 - row) + edge + (1 - 2 * edge) * part

    def height(self, value: float, row: int) -> float:
        """Height of one value."""
        return float(self.heights(np.asarray(value), row))


def row_count(n_curves: int, *, stacked: bool) -> int:
    """Rows that ``n_curves`` are drawn in."""
    return min(n_curves, MOST_ROWS) if stacked else 1
