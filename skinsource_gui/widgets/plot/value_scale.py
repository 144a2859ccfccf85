"""Heights of values in a row of a plot."""

from dataclasses import dataclass

import numpy as np

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.plot.ranges import Range

#: More rows than these would be too thin to read.
MOST_ROWS = 12
#: Room above and below the curve of a row that has neighbours, as a part of its height.
EDGE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueScale:
    """Where values lie in a row: 0 at its bottom, 1 at its top.

    The rows' view boxes show just that, whatever the values: from 1e-300 to 1e300 m/s² nothing
    overflows on the way to pixels, and new ranges change labels only.

    Attributes
    ----------
    values
        Range of values of the row.
    edge
        Room above and below them.
    """

    values: Range
    edge: float = 0.0

    def heights(self, values: Floats) -> Floats:
        """Heights of ``values``; what lies outside stays at the row's edge."""
        low, high = self.values
        part = np.clip((values - low) / (high - low), 0.0, 1.0)
        return self.edge + (1 - 2 * self.edge) * part

    def height(self, value: float) -> float:
        """Height of one value."""
        return float(self.heights(np.asarray(value)))


def row_count(n_curves: int, *, stacked: bool) -> int:
    """Rows that ``n_curves`` are drawn in."""
    return min(n_curves, MOST_ROWS) if stacked else 1
