"""What the mouse does to points that are seen as a curve."""

from collections.abc import Callable

from PySide6.QtCore import QPointF, QRectF

from skinsource.design.effects.breakpoints import (
    HIGHEST,
    Points,
    moved,
    place_of,
    with_point,
    with_point_put,
)
from skinsource.specs.fields import BreakpointsSpec
from skinsource_gui.widgets.fields.curve_scale import CurveScale
from skinsource_gui.widgets.fields.edited_points import EditedPoints
from skinsource_gui.widgets.fields.gesture import new_gesture


class CurveMouse:
    """Adds points, and drags one.

    Parameters
    ----------
    spec, points
        What the points may be, and the points.
    area
        Where the curve is seen.

    Attributes
    ----------
    scale
        Where values lie; it stays while a point is dragged.
    """

    def __init__(
        self, spec: BreakpointsSpec, points: EditedPoints, area: Callable[[], QRectF]
    ) -> None:
        self._spec, self._points, self._area = spec, points, area
        self.scale = CurveScale.around(points.value)
        # While one is dragged: number of the gesture, the points as it began, where it began.
        self._drag: tuple[int, Points, QPointF] | None = None

    @property
    def drags(self) -> bool:
        """Whether a point is dragged."""
        return self._drag is not None

    def fit(self) -> None:
        """Make room for the points that there are now, unless one of them is dragged."""
        if self._drag is None:
            self.scale = CurveScale.around(self._points.value)

    def point_at(self, at: QPointF) -> int | None:
        """Number of the point that is meant there."""
        return self.scale.point_at(self._points.value, at, self._area())

    def press(self, at: QPointF) -> None:
        """Begin to drag the point that is there, or a new one on the curve."""
        self._points.burst.end()
        gesture, before, near = new_gesture(), self._points.value, self.point_at(at)
        if near is None:
            x = self._rounded(self.scale.value(at, self._area())[0])
            if not self.scale.is_on_curve(before, x, at, self._area()):
                return
            near = place_of(before, x)
            self._points.put(with_point(before, x), near, gesture)
        self._points.choose(near)
        self._drag = (gesture, self._points.value, at)

    def move(self, at: QPointF) -> None:
        """Have the point that is dragged follow."""
        if self._drag is None:
            return
        gesture, start, pressed = self._drag
        here, there = (self.scale.value(one, self._area()) for one in (at, pressed))
        chosen = self._points.chosen
        x, y, _ = start[min(chosen, len(start) - 1)]
        to_x, to_y = self._rounded(x + here[0] - there[0]), round(y + here[1] - there[1], 3)
        self._points.put(moved(start, {chosen}, to_x - x, to_y - y), chosen, gesture)

    def let_go(self) -> None:
        """The drag has ended."""
        self._drag = None

    def give_up(self) -> None:
        """The drag has ended, and all is as it was before."""
        if self._drag is not None:
            (gesture, start, _), self._drag = self._drag, None
            self._points.put(start, self._points.chosen, gesture)

    def put(self, at: QPointF) -> None:
        """Add a point just there."""
        x, y = self.scale.value(at, self._area())
        highest = min(self._spec.y.maximum, HIGHEST)
        added = with_point_put(self._points.value, self._rounded(x), round(y, 3), highest)
        self._points.put(*added, new_gesture())

    def _rounded(self, x: float) -> float:
        """A time in whole tenths of a step."""
        step = self._spec.x.step / 10.0
        return max(round(x / step) * step, 0.0)
