"""Breakpoints while they are edited: which one is chosen, and what keys and menus do to them."""

from PySide6.QtCore import QObject, Signal

from skinsource.design.effects.breakpoints import (
    Points,
    moved,
    with_point_after,
    with_segment,
    without_chosen,
)
from skinsource.specs.fields import (
    SEGMENTS,
    Breakpoint,
    BreakpointsSpec,
    Segment,
    SlopedPoint,
    slope_of,
)
from skinsource_gui.widgets.fields.burst import Burst


class EditedPoints(QObject):
    """Points of ``spec``, one of which is chosen.

    Attributes
    ----------
    value
        The points.
    chosen
        Number of the point that the keys are about, from 0.
    burst
        Keys that follow each other quickly share its gesture.
    end_x
        Where what the curve is of ends: a key adds a point halfway from the last one to there.
        None: at the last point.
    """

    #: The new points; number of their gesture.
    edited = Signal(object, object)
    #: Other points, or another one is chosen.
    changed = Signal()

    def __init__(self, spec: BreakpointsSpec, parent: QObject) -> None:
        super().__init__(parent)
        self._spec = spec
        self.value: Points = ((0.0, 1.0, "straight"),)
        self.chosen = 0
        self.end_x: float | None = None
        self.burst = Burst(self)

    def show(self, points: Points) -> None:
        """Take other points, and tell nobody."""
        if points != self.value:
            self.value = points
            self.chosen = min(self.chosen, len(points) - 1)

    def choose(self, index: int) -> None:
        """Choose a point; beyond the ends the last one there."""
        self.chosen = min(max(index, 0), len(self.value) - 1)
        self.changed.emit()

    def put(self, points: Points, chosen: int, gesture: int | None) -> None:
        """Edit: these points from now on, of which one is chosen."""
        points = tuple(map(_rounded, points))
        self.chosen = min(max(chosen, 0), len(points) - 1)
        if points != self.value:
            self.value = points
            self.edited.emit(points, gesture)
        self.changed.emit()

    def go_on(self, segment: Segment) -> None:
        """Continue like this after the chosen point."""
        self.put(with_segment(self.value, self.chosen, segment), self.chosen, None)

    def act(self, name: str) -> None:
        """Do what the table of keys calls ``name``."""
        k, points, last = self.chosen, self.value, len(self.value) - 1
        if name in ("before", "after", "first", "last"):
            self.choose({"before": k - 1, "after": k + 1, "first": 0, "last": last}[name])
        elif name == "segment":
            self.go_on(SEGMENTS[(SEGMENTS.index(points[k][2]) + 1) % len(SEGMENTS)])
        elif name == "remove":
            self.put(*without_chosen(points, {k}), self.burst.gesture())
        elif name == "add":
            end_x = points[-1][0] if self.end_x is None else self.end_x
            self.put(*with_point_after(points, k, end_x), None)
        else:
            far = 10 if name.startswith("far_") else 1
            by_x = {"left": -1, "right": 1}.get(name.removeprefix("far_"), 0)
            by_y = {"down": -1, "up": 1}.get(name.removeprefix("far_"), 0)
            step_x, step_y = far * self._spec.x.step, far * self._spec.y.step
            after = moved(points, {k}, by_x * step_x, by_y * step_y)
            self.put(after, k, self.burst.gesture())


def _rounded(point: Breakpoint) -> Breakpoint:
    """A point without the last digits of what was computed; a slope of its own it keeps."""
    x, y, kind = point
    x, y, slope = float(f"{x:.12g}"), float(f"{y:.12g}"), slope_of(point)
    return (x, y, kind) if slope is None else SlopedPoint(x, y, kind, slope)
