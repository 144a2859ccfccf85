"""The visible part of a time axis: pixels and times, zoom and pan, and snapping of moved edges."""

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf
from operator import itemgetter

from PySide6 import QtGui
from PySide6.QtCore import Qt

from skinsource_gui.plots import ranges
from skinsource_gui.plots.ranges import round_step
from skinsource_gui.qt.wheel import NOTCH, PAN_PER_NOTCH, ZOOM_PER_NOTCH

#: An edge snaps from this far away, px.
REACH_PX = 7.0
_GRID_PX = 12.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Snap:
    """Where a moved edge comes to rest.

    Attributes
    ----------
    by_s
        How far it is moved.
    guide_s
        The time to which it snapped, which is shown; None where it did not.
    """

    by_s: float
    guide_s: float | None = None


def grid_step_s(px_per_s: float) -> float:
    """Return the finest round step of time with lines far enough apart: 1, 2, 5, 10 … ms."""
    return round_step(_GRID_PX / px_per_s)


def snap_of(
    edges_s: Iterable[float],
    by_s: float,
    *,
    neighbours_s: Sequence[float],
    grid_s: float | None,
    reach_s: float,
) -> Snap:
    """Move edges by about ``by_s``, so that one of them snaps to something near.

    Parameters
    ----------
    edges_s
        Edges that may snap, before they are moved.
    by_s
        How far the pointer moved.
    neighbours_s
        Rising times to snap to: ends of other clips, playhead, markers.  They go before the grid.
    grid_s
        Step of the grid, to which the first edge snaps from any distance; None: there is none.
    reach_s
        An edge snaps to a time from this far away.
    """
    edges = tuple(edges_s)
    snaps = [
        (abs(target - edge - by_s), target - edge, target)
        for edge in edges
        if (target := _nearest(neighbours_s, edge + by_s)) is not None
    ]
    distance_s, snapped_by_s, guide_s = min(snaps, key=itemgetter(0), default=(inf, 0.0, 0.0))
    if distance_s <= reach_s:
        return Snap(by_s=snapped_by_s, guide_s=guide_s)
    if grid_s is None or not edges:
        return Snap(by_s=by_s)
    # Only the first edge follows the grid: it is the start of something.
    target = round((edges[0] + by_s) / grid_s) * grid_s
    return Snap(by_s=target - edges[0])


def _nearest(rising: Sequence[float], time_s: float) -> float | None:
    if not rising:
        return None
    right = bisect_left(rising, time_s)
    neighbours = rising[max(right - 1, 0) : right + 1]
    return min(neighbours, key=lambda time: abs(time - time_s))


Range = tuple[float, float]

#: The shortest time that the whole width can show, s.
SHORTEST_S = 0.005


@dataclass(frozen=True, kw_only=True)
class TimeScale:
    """Maps the visible part of the time to pixels.

    Attributes
    ----------
    shown_s
        First and last visible time.
    left_px, width_px
        Position of the first one, and the distance from there to the last one.
    """

    shown_s: Range
    left_px: float = 0.0
    width_px: float = 1.0

    @cached_property
    def px_per_s(self) -> float:
        """Pixels per second."""
        return self.width_px / (self.shown_s[1] - self.shown_s[0])

    def x(self, time_s: float) -> float:
        """Return the position of a time, px."""
        return self.left_px + (time_s - self.shown_s[0]) * self.px_per_s

    def time(self, x_px: float) -> float:
        """Return the time at a position."""
        return self.shown_s[0] + (x_px - self.left_px) / self.px_per_s


def zoomed(shown_s: Range, anchor_s: float, factor: float, whole_s: Range) -> Range | None:
    """Return the range ``factor`` times narrower around ``anchor_s``; None for the whole."""
    factor = min(factor, (shown_s[1] - shown_s[0]) / SHORTEST_S)
    return ranges.within(ranges.zoomed(shown_s, anchor_s, factor), whole_s)


def panned(shown_s: Range, by_s: float, whole_s: Range) -> Range | None:
    """Return the range ``by_s`` later, as far as possible; None where it is the whole."""
    return ranges.within((shown_s[0] + by_s, shown_s[1] + by_s), whole_s)


def range_by_wheel(event: QtGui.QWheelEvent, scale: TimeScale, whole_s: Range) -> Range | None:
    """Return the visible range after a turn of the wheel; None where it is the whole.

    With Shift, or sideways, the wheel pans; otherwise, and with Ctrl, it zooms at the pointer.
    """
    turns, modifiers = event.angleDelta(), event.modifiers()
    along = modifiers & Qt.KeyboardModifier.ShiftModifier or turns.x()
    if along and not modifiers & Qt.KeyboardModifier.ControlModifier:
        low, high = scale.shown_s
        notches = (turns.x() or turns.y()) / NOTCH
        return panned(scale.shown_s, -notches * PAN_PER_NOTCH * (high - low), whole_s)
    anchor_s = scale.time(event.position().x())
    factor = ZOOM_PER_NOTCH ** ((turns.y() or turns.x()) / NOTCH)
    return zoomed(scale.shown_s, anchor_s, factor, whole_s)
