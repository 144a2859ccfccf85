"""Where a moved edge comes to rest."""

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import floor, log10

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent

from skinsource_gui.qt.wheel import NOTCH, PAN_PER_NOTCH, ZOOM_PER_NOTCH

#: From how far away an edge snaps, px.
REACH_PX = 7.0
_GRID_PX = 12.0
_STEPS = (1.0, 2.0, 5.0, 10.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rest:
    """Where something comes to rest.

    Attributes
    ----------
    by_s
        How far it is moved.
    guide_s
        The time that it snapped to, which is shown; None where it lies free.
    """

    by_s: float
    guide_s: float | None = None


def grid_step_s(px_per_s: float) -> float:
    """Finest round step of time whose lines are still told apart: 1, 2, 5, 10 … ms."""
    least = _GRID_PX / px_per_s
    decade = 10.0 ** floor(log10(least))
    return next(step * decade for step in _STEPS if step * decade >= least * (1 - 1e-9))


def rest_of(
    edges_s: Iterable[float],
    by_s: float,
    *,
    neighbours_s: Sequence[float],
    grid_s: float | None,
    reach_s: float,
) -> Rest:
    """Move edges by about ``by_s``, so that one of them comes to rest on something near.

    Parameters
    ----------
    edges_s
        Edges that may snap, before they are moved.
    by_s
        How far the pointer moved.
    neighbours_s
        Rising times to rest on: ends of other clips, playhead, markers.  They go before the grid.
    grid_s
        Step of the grid, on which the first edge rests wherever it is; None: there is none.
    reach_s
        From how far away an edge snaps to a time.
    """
    edges = tuple(edges_s)
    nearest: tuple[float, float, float] | None = None
    for edge in edges:
        target = _nearest(neighbours_s, edge + by_s)
        if target is not None:
            nearest = _nearer(nearest, edge, target, by_s)
    if nearest is not None and nearest[0] <= reach_s:
        return Rest(by_s=nearest[1], guide_s=nearest[2])
    if grid_s is None or not edges:
        return Rest(by_s=by_s)
    # The first edge alone follows the grid: it is where something starts.
    target = round((edges[0] + by_s) / grid_s) * grid_s
    return Rest(by_s=target - edges[0])


def _nearest(rising: Sequence[float], time_s: float) -> float | None:
    if not rising:
        return None
    right = bisect_left(rising, time_s)
    around = rising[max(right - 1, 0) : right + 1]
    return min(around, key=lambda time: abs(time - time_s))


def _nearer(
    best: tuple[float, float, float] | None, edge: float, target: float, by_s: float
) -> tuple[float, float, float]:
    away = abs(target - edge - by_s)
    return best if best is not None and best[0] <= away else (away, target - edge, target)


# From times to pixels and back.

Range = tuple[float, float]

#: No closer than so much of the design across the whole width.
SHORTEST_S = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeScale:
    """Which part of the time is shown, and where.

    Attributes
    ----------
    shown_s
        First and last time that can be seen.
    left_px, width_px
        Where the first one lies, and how far away the last one.
    """

    shown_s: Range
    left_px: float = 0.0
    width_px: float = 1.0

    @property
    def px_per_s(self) -> float:
        """Pixels of a second."""
        return self.width_px / (self.shown_s[1] - self.shown_s[0])

    @property
    def right_px(self) -> float:
        """Where the last time lies."""
        return self.left_px + self.width_px

    def x(self, time_s: float) -> float:
        """Where a time lies, px."""
        return self.left_px + (time_s - self.shown_s[0]) * self.px_per_s

    def time(self, x_px: float) -> float:
        """Time at a position."""
        return self.shown_s[0] + (x_px - self.left_px) / self.px_per_s


def zoomed(shown_s: Range, anchor_s: float, factor: float, whole_s: Range) -> Range | None:
    """The range ``factor`` times narrower around ``anchor_s``; None where it is the whole."""
    low, high = shown_s
    length = max((high - low) / factor, SHORTEST_S)
    share = (anchor_s - low) / (high - low)
    return within((anchor_s - share * length, anchor_s + (1 - share) * length), whole_s)


def panned(shown_s: Range, by_s: float, whole_s: Range) -> Range | None:
    """The range ``by_s`` later, as far as there is any; None where it is the whole."""
    return within((shown_s[0] + by_s, shown_s[1] + by_s), whole_s)


def within(wanted_s: Range, whole_s: Range) -> Range | None:
    """The range of this length that lies in the whole; None where it is the whole."""
    length = wanted_s[1] - wanted_s[0]
    if length >= (whole_s[1] - whole_s[0]) * (1 - 1e-9):
        return None
    low = min(max(wanted_s[0], whole_s[0]), whole_s[1] - length)
    return (low, low + length)


# What the wheel does to the part of the time that is seen.


def range_by_wheel(event: QWheelEvent, scale: TimeScale, whole_s: Range) -> Range | None:
    """The range that a turn leads to; None where it is the whole.

    With Shift, or sideways, it goes along the time; otherwise, and with Ctrl, it zooms around the
    pointer.
    """
    turns, held = event.angleDelta(), event.modifiers()
    along = held & Qt.KeyboardModifier.ShiftModifier or turns.x()
    if along and not held & Qt.KeyboardModifier.ControlModifier:
        low, high = scale.shown_s
        notches = (turns.x() or turns.y()) / NOTCH
        return panned(scale.shown_s, -notches * PAN_PER_NOTCH * (high - low), whole_s)
    anchor_s = scale.time(event.position().x())
    factor = ZOOM_PER_NOTCH ** ((turns.y() or turns.x()) / NOTCH)
    return zoomed(scale.shown_s, anchor_s, factor, whole_s)
