"""Fewer points that draw the same picture."""

import numpy as np
from numpy.typing import NDArray

from skinsource_gui.widgets.ranges import Range

Floats = NDArray[np.float64]

#: Up to here every sample is drawn.
MOST_POINTS = 10_000


def visible_points(x: Floats, y: Floats, shown: Range, width_px: int) -> tuple[Floats, Floats]:
    """Points to draw: all of them, or the smallest and largest of each pixel column.

    Parameters
    ----------
    x : (n_points,)
        Rising.
    y : (n_curves, n_points)
        Curves over ``x``.
    shown
        Visible part of ``x``.
    width_px
        How many columns of pixels show it.

    Returns
    -------
    x : (n,)
    y : (n_curves, n)
        With more than `MOST_POINTS` samples, only the visible part: two points for each column,
        one more at each side so that lines run to the edge.
    """
    if x.size <= MOST_POINTS:
        return x, y
    first = max(int(np.searchsorted(x, shown[0])) - 1, 0)
    last = min(int(np.searchsorted(x, shown[1], side="right")) + 1, x.size)
    x, y = x[first:last], y[:, first:last]
    if x.size <= max(2 * width_px, 2):
        return x, y
    edges = np.linspace(shown[0], shown[1], max(width_px, 1) + 1)
    starts = np.unique(np.minimum(np.searchsorted(x, edges), x.size - 1))
    starts = starts if starts[0] == 0 else np.concatenate(([0], starts))
    lows = np.minimum.reduceat(y, starts, axis=1)
    highs = np.maximum.reduceat(y, starts, axis=1)
    points = np.stack([lows, highs], axis=-1).reshape(len(y), -1)
    return np.repeat(x[starts], 2), points
