"""Fewer points that draw the same picture."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arrays import Floats
from skinsource.signals.resampling import Extremes
from skinsource_gui.widgets.plot.ranges import Range

#: Up to so many samples in a column of pixels, each is drawn.
MOST_IN_COLUMN = 4
# Samples of an axis up to which it is compared with the one before.
_MOST_COMPARED = 2**15
# A stroke that is shorter than this part of what its neighbours cover is a gap, not a notch.
_GAP = 0.1
# Of extremes, as a part of the peak.
_ROUNDING = 1e-6
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Columns:
    """Where the samples of an axis fall among columns of pixels; the same for all curves over it.

    Attributes
    ----------
    part
        Which samples are looked at.
    places : (n,)
        Where the points are, one for each sample, or two for each column that holds any.
    starts
        The first sample of each such column, counted in the part; None where each is drawn.
    """

    part: slice
    places: Floats
    starts: NDArray[np.intp] | None = None

    def points(self, y: Floats) -> Points:
        """What is drawn of curves, (n_curves, n_points), over the axis."""
        y = y[:, self.part]
        if self.starts is None:
            return Points(x=self.places, y=y)
        low = np.minimum.reduceat(y, self.starts, axis=1)
        high = np.maximum.reduceat(y, self.starts, axis=1)
        return Points(x=self.places, y=_strokes(low, high), strokes=True)

    def reached(self, y: Floats, extremes: Extremes) -> Points:
        """What is drawn of the wave through curves, (n_curves, n_points), over the axis.

        Where each sample is drawn, it is at most half a sample beside a crest that it takes over.

        Parameters
        ----------
        extremes
            Of the part.
        """
        if self.starts is not None:
            return Points(
                x=self.places, y=_strokes(*extremes.of_columns(self.starts)), strokes=True
            )
        return Points(x=self.places, y=_with_crests(y[:, self.part], extremes))


def _with_crests(y: Floats, extremes: Extremes) -> Floats:
    """Samples, of which those beside a crest between two of them are as high as it is."""
    low, high = extremes.low[:, :-1] * extremes.sizes, extremes.high[:, :-1] * extremes.sizes
    rounding = _ROUNDING * extremes.sizes
    left, right, values = y[:, :-1], y[:, 1:], y.copy()
    dips = low < np.minimum(left, right) - rounding
    crests = high > np.maximum(left, right) + rounding
    # The one that is nearer in height takes it.
    for beyond, reached, further, of_two in (
        (dips, low, right < left, np.minimum),
        (crests, high, right > left, np.maximum),
    ):
        row, at = np.nonzero(beyond)
        of_two.at(values, (row, at + further[row, at]), reached[row, at])
    return values


def _strokes(low: Floats, high: Floats) -> Floats:
    """Strokes of columns, (n_curves, 2 n_columns): up one and down the next.

    The way from stroke to stroke is short then, and so is painting.
    """
    ends = np.empty((*low.shape, 2))
    ends[:, ::2, 0], ends[:, ::2, 1] = low[:, ::2], high[:, ::2]
    ends[:, 1::2, 0], ends[:, 1::2, 1] = high[:, 1::2], low[:, 1::2]
    return ends.reshape(len(low), -1)


def columns_of(x: Floats, shown: Range, width_px: int) -> Columns:
    """Columns of the visible part, and one sample more at each side so that lines run to the edge.

    Parameters
    ----------
    x : (n_points,)
        Rising.
    shown
        Visible part of ``x``.
    width_px
        How many columns of pixels show it.
    """
    first = max(int(np.searchsorted(x, shown[0])) - 1, 0)
    last = min(int(np.searchsorted(x, shown[1], side="right")) + 1, x.size)
    part, x = slice(first, last), x[first:last]
    if x.size <= max(MOST_IN_COLUMN * width_px, 2):
        return Columns(part=part, places=x)
    low, column = shown[0], (shown[1] - shown[0]) / max(width_px, 1)
    edges = low + column * np.arange(max(width_px, 1) + 1)
    starts = np.searchsorted(x, edges)
    starts = np.concatenate(([0], np.minimum(starts, x.size - 1)))
    starts = starts[np.diff(starts, prepend=-1) > 0]
    # A stroke in the middle of its column is sharp; a sample that is alone stays where it is.
    alone = np.diff(starts, append=x.size) == 1
    # (Where a sample lies on an edge, a division could round it into the column before.)
    columns = np.searchsorted(edges, x[starts], side="right") - 1
    middles = low + column * (columns + 0.5)
    places = np.repeat(np.where(alone, x[starts], middles), 2)
    return Columns(part=part, places=places, starts=starts)


class KeptColumns:
    """The columns that were asked for last: an edit that keeps the axis finds them as they were.

    Attributes
    ----------
    made
        How often they were found anew.
    """

    def __init__(self) -> None:
        self.made = 0
        self._axis: Floats = np.zeros(0)
        self._seen: tuple[Range, int] | None = None
        self._columns: Columns | None = None

    def of(self, x: Floats, shown: Range, width_px: int) -> Columns:
        """What `columns_of` finds."""
        same = self._seen == (shown, width_px) and self._is_axis(x)
        if self._columns is None or not same:
            self._axis, self._seen = x, (shown, width_px)
            self._columns = columns_of(x, shown, width_px)
            self.made += 1
        return self._columns

    def _is_axis(self, x: Floats) -> bool:
        # To compare many samples takes longer than to find their columns.
        return x is self._axis or (x.size <= _MOST_COMPARED and np.array_equal(x, self._axis))


def visible_points(x: Floats, y: Floats, shown: Range, width_px: int) -> Points:
    """The visible part of curves ``y``, (n_curves, n_points), over ``x``, as `columns_of` finds it.

    With more than `MOST_IN_COLUMN` samples for each column of pixels, it is the smallest and the
    largest of each column.
    """
    return columns_of(x, shown, width_px).points(y)


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
    first, second = pairs[..., 0], pairs[..., 1]
    edges = np.concatenate((-np.minimum(first, second), np.maximum(first, second)))
    closed = _closed(edges)
    # Heights of strokes, whose lower ends are upside down.
    n_curves = len(strokes)
    closed_heights = closed[n_curves:] + closed[:n_curves]
    notch = edges[n_curves:] + edges[:n_curves] >= _GAP * closed_heights
    np.copyto(edges, closed, where=np.concatenate((notch, notch)))
    low, high = -edges[:n_curves], edges[n_curves:]
    rising = first <= second
    ends = np.empty_like(pairs)
    ends[..., 0], ends[..., 1] = np.where(rising, low, high), np.where(rising, high, low)
    return ends.reshape(strokes.shape)


def _closed(edges: Floats) -> Floats:
    """Upper edges with valleys of up to two columns filled, (n_edges, n_columns)."""
    wide = np.empty((len(edges), edges.shape[-1] + 4))
    wide[:, 2:-2], wide[:, :2], wide[:, -2:] = edges, edges[:, :1], edges[:, -1:]
    raised = np.maximum(np.maximum(wide[:, :-2], wide[:, 1:-1]), wide[:, 2:])
    return np.minimum(np.minimum(raised[:, :-2], raised[:, 1:-1]), raised[:, 2:])
