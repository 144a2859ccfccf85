"""Fewer points that draw the same picture."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource_gui.widgets.plot.ranges import Range

#: Up to so many samples in a column of pixels, each is drawn.
MOST_IN_COLUMN = 4
# A stroke that is shorter than this part of what its neighbours cover is a gap, not a notch.
_GAP = 0.1
# Zero lies on the edge of a row of pixels, or in its middle; a little beside them rounding does
# not matter.
_SHIFT = 0.02
# From here, strokes and level lines are painted in the same row; from its middle they are not.
_INSIDE = 0.25


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Points:
    """What is drawn of curves.

    Attributes
    ----------
    x : (n,)
    y : (n_curves, n)
    strokes
        Whether points come in pairs, the ends of one upright stroke for each column of pixels.
    """

    x: Floats
    y: Floats
    strokes: bool = False


def visible_points(x: Floats, y: Floats, shown: Range, width_px: int) -> Points:
    """The visible part, and one point more at each side so that lines run to the edge.

    With more than `MOST_IN_COLUMN` samples for each column of pixels, it is the smallest and the
    largest of each column.

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
    """
    first = max(int(np.searchsorted(x, shown[0])) - 1, 0)
    last = min(int(np.searchsorted(x, shown[1], side="right")) + 1, x.size)
    x, y = x[first:last], y[:, first:last]
    if x.size <= max(MOST_IN_COLUMN * width_px, 2):
        return Points(x=x, y=y)
    low, column = shown[0], (shown[1] - shown[0]) / max(width_px, 1)
    edges = low + column * np.arange(max(width_px, 1) + 1)
    starts = np.searchsorted(x, edges)
    starts = np.concatenate(([0], np.minimum(starts, x.size - 1)))
    starts = starts[np.diff(starts, prepend=-1) > 0]
    ends = np.stack(
        [np.minimum.reduceat(y, starts, axis=1), np.maximum.reduceat(y, starts, axis=1)], axis=-1
    )
    # Up one column and down the next: the way from stroke to stroke is short, and so is painting.
    ends[:, 1::2] = ends[:, 1::2, ::-1]
    # A stroke in the middle of its column is sharp; a sample that is alone stays where it is.
    alone = np.diff(starts, append=x.size) == 1
    # (Where a sample lies on an edge, a division could round it into the column before.)
    columns = np.searchsorted(edges, x[starts], side="right") - 1
    middles = low + column * (columns + 0.5)
    places = np.repeat(np.where(alone, x[starts], middles), 2)
    return Points(x=places, y=ends.reshape(len(y), -1), strokes=True)


def in_rows(y_px: Floats, ratio: float) -> Floats:
    """Heights moved into rows of pixels, of which ``ratio`` make 1 px.

    Without smooth edges, a level line between two rows would change from one to the other.
    """
    return (np.floor(y_px * ratio + _SHIFT) + _INSIDE) / ratio


def without_notches(strokes: Floats) -> Floats:
    """Strokes, with notches of one or two columns in its edges filled.

    Where a column holds less than a period of what oscillates it misses the crest, one column
    more and another less: a comb that is not in the signal.  Crests that stand alone stay as
    narrow as they are (a closing, not a widening), and so do gaps.

    Parameters
    ----------
    strokes : (n_curves, 2 n_columns)
        Both ends of the stroke of each column, in either order.
    """
    pairs = strokes.reshape(len(strokes), -1, 2)
    low, high = pairs.min(axis=-1), pairs.max(axis=-1)
    closed_low, closed_high = -_closed(-low), _closed(high)
    notch = high - low >= _GAP * (closed_high - closed_low)
    low, high = np.where(notch, closed_low, low), np.where(notch, closed_high, high)
    rising = pairs[..., 0] <= pairs[..., 1]
    ends = np.stack([np.where(rising, low, high), np.where(rising, high, low)], axis=-1)
    return ends.reshape(strokes.shape)


def _closed(edge: Floats) -> Floats:
    """The upper edge with valleys of up to two columns filled, (n_curves, n_columns)."""
    wide = np.pad(edge, ((0, 0), (2, 2)), mode="edge")
    raised = np.maximum(np.maximum(wide[:, :-2], wide[:, 1:-1]), wide[:, 2:])
    return np.minimum(np.minimum(raised[:, :-2], raised[:, 1:-1]), raised[:, 2:])
