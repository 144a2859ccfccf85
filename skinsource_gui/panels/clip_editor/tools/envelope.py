"""Breakpoints over the waveform."""

from collections.abc import Callable
from functools import partial
from itertools import product

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QMenu

from skinsource.base.arrays import Floats
from skinsource.design.effects import breakpoints as algebra
from skinsource.design.effects.breakpoints import Points
from skinsource.specs.fields import SEGMENTS, Segment
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.tools.curve_drag import Drag
from skinsource_gui.panels.clip_editor.tools.curve_look import CurveLook
from skinsource_gui.panels.clip_editor.tools.curve_points import paint_points, write_point
from skinsource_gui.panels.clip_editor.tools.points_box import handle_at, paint_box, scaled_by
from skinsource_gui.panels.clip_editor.tools.tool import Button, Held
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.gesture import new_gesture
from skinsource_gui.widgets.fields.point_menu import fill_ground_menu, fill_point_menu

#: How near the pointer takes hold of a point, or of the curve, px.
CATCH_PX = 9.0
_FINE = 0.1
_HOW = "Click the line, or double-click beside it: a new point. Drag points to shape it"

_ENVELOPE = CurveLook(how=_HOW)


class EnvelopeTool(QObject):
    """Click on the curve: a new point.  Drag: points, a segment up and down, a box around points.

    The handles of the box around several chosen points scale them.  Ctrl: finely.  Shift: up and
    down or along alone.  Alt and click on a segment: its next kind.
    Right button: what can be done to the point, or a new one.

    Parameters
    ----------
    points
        Returns the points that there are now.
    look
        How the curve is painted, and what its values are.
    """

    #: The points, and the number of the gesture or None.
    changed = Signal(object, object)
    #: The drag of this number is given up: all is as it was before.
    given_up = Signal(int)

    cursor = Qt.CursorShape.ArrowCursor

    def __init__(
        self, points: Callable[[], Points], parent: QObject, look: CurveLook = _ENVELOPE
    ) -> None:
        super().__init__(parent)
        self._points, self._look = points, look
        self.chosen: tuple[int, ...] = ()
        self._drag: Drag | None = None
        self._pointer = QPointF(-1, -1)

    @property
    def hint(self) -> str:
        return self._look.how if len(self._points()) == 1 and not self.chosen else ""

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        if button != Button.LeftButton or self._drag is not None:
            return
        points = self._points()
        index = _point_at(content, points, at)
        start, number = content.place(at), new_gesture()
        if index is not None:
            if held & Held.ShiftModifier:
                self.chosen = tuple(sorted(set(self.chosen) ^ {index}))
            elif index not in self.chosen:
                self.chosen = (index,)
            self._drag = Drag(points, self.chosen or (index,), start, number)
            return
        handle = handle_at(content, points, self.chosen, at)
        if handle is not None:
            self._drag = Drag(points, self.chosen, start, number, handle=handle)
            return
        segment = _segment_at(content, points, at)
        if segment is None:
            self._drag = Drag(points, (), start, number, box=at)
        elif held & Held.AltModifier and self._look.bends:
            here = SEGMENTS.index(points[segment][2])
            self._bend(segment, SEGMENTS[(here + 1) % len(SEGMENTS)])
        else:
            # A click adds a point on the curve; a drag moves the segment up and down, or, where the
            # curve is level before the first or after the last point, the new point alone.
            if 0 <= segment < len(points) - 1:
                self._drag = Drag(points, (segment, segment + 1), start, number, upright=True)
            else:
                added = algebra.with_point(points, max(start[0], 0.0))
                index = 0 if segment < 0 else len(added) - 1
                self._drag = Drag(added, (index,), start, number, added=True, before=points)

    def move(self, content: EditorContent, at: QPointF, held: Held) -> None:
        self._pointer = at
        drag = self._drag
        if drag is None:
            return
        time_s, value = content.place(at)
        by_s, by_value = time_s - drag.start[0], value - drag.start[1]
        away = content.at(*drag.start) - at
        drag.moved = drag.moved or max(abs(away.x()), abs(away.y())) >= 3
        if not drag.moved:
            return
        if drag.box is not None:
            covered = QRectF(drag.box, at).normalized()
            self.chosen = tuple(
                k for k, one in enumerate(drag.points) if covered.contains(content.at(*one[:2]))
            )
            return
        if held & Held.ControlModifier:
            by_s, by_value = by_s * _FINE, by_value * _FINE
        if drag.upright or (held & Held.ShiftModifier and abs(away.y()) > abs(away.x())):
            by_s = 0.0
        elif held & Held.ShiftModifier:
            by_value = 0.0
        if drag.handle is not None:
            scaled = scaled_by(drag.points, drag.chosen, drag.handle, by_s, by_value)
            self.changed.emit(scaled, drag.number)
            return
        self.changed.emit(algebra.moved(drag.points, drag.chosen, by_s, by_value), drag.number)

    def release(self, content: EditorContent) -> None:
        drag, self._drag = self._drag, None
        if drag is None or drag.moved:
            return
        if drag.added:
            self.chosen = drag.chosen
            self.changed.emit(drag.points, None)
        elif drag.upright:
            points = algebra.with_point(drag.points, drag.start[0])
            self.chosen = (algebra.place_of(drag.points, drag.start[0]),)
            self.changed.emit(points, None)
        elif drag.box is not None:
            self.chosen = ()

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """Put a point there, wherever the curve is."""
        if _point_at(content, self._points(), at) is None:
            self._put(content.place(at))

    def fill_menu(self, menu: QMenu, content: EditorContent, at: QPointF | None) -> None:
        points = self._points()
        if at is not None:
            index = _point_at(content, points, at)
        else:
            index = next((one for one in self.chosen if one < len(points)), None)
        if index is not None:
            if index not in self.chosen:
                self.chosen = (index,)
            bend = partial(self._bend, index) if self._look.bends else None
            n = len(self.chosen)
            fill_point_menu(menu, self.remove_chosen, bend=bend, n_chosen=n, n_points=len(points))
        elif at is not None and content.area.contains(at):
            fill_ground_menu(menu, partial(self._put, content.place(at)))

    def cancel(self) -> bool:
        drag, self._drag = self._drag, None
        if drag is not None and drag.moved and drag.box is None:
            self.given_up.emit(drag.number)
        return drag is not None

    def nudge(self, by_s: float, by_value: float, gesture: int) -> None:
        """Move the selected points."""
        if self.chosen:
            moved = algebra.moved(self._points(), self.chosen, by_s, by_value)
            self.changed.emit(moved, gesture)

    def choose_next(self, step: int) -> None:
        """Choose the point after the chosen one, or before; the first or last of all at first."""
        last = len(self._points()) - 1
        number = (0 if step > 0 else last) if not self.chosen else self.chosen[-1] + step
        self.chosen = (min(max(number, 0), last),)

    def is_near(self, content: EditorContent, at: QPointF) -> bool:
        """Whether a point, or the curve, is within reach."""
        points = self._points()
        near = _point_at(content, points, at) is not None
        return near or _segment_at(content, points, at) is not None

    def remove_chosen(self) -> None:
        """Remove the selected points."""
        if self.chosen:
            left, number = algebra.without_chosen(self._points(), self.chosen)
            self.chosen = (number,)
            self.changed.emit(left, None)

    def paint(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint curve, points and box."""
        points = self._points()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colour = QColor(getattr(theme, self._look.colour))
        shown = np.linspace(content.area.left(), content.area.right(), 400)
        times = content.scale.shown_s[0] + (shown - content.scale.left_px) / content.scale.px_per_s
        values = algebra.curve_at(points, times)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        x, y = content.curve(times, values)
        curve = arrayToQPath(x, y, finiteCheck=False)
        painter.setPen(QPen(colour, 1))
        # Four thin lines are painted in a sixth of the time of one that is two px wide.
        for aside, down in product((-0.5, 0.5), repeat=2):
            painter.drawPath(curve.translated(aside, down))
        if self._look.mirrored:
            painter.setPen(QPen(colour, 1, Qt.PenStyle.DotLine))
            painter.drawPath(arrayToQPath(x, content.curve(times, -values)[1], finiteCheck=False))
        near = _point_at(content, points, self._pointer)
        places = _places(content, points)
        paint_points(painter, places, self.chosen, near, self._look, theme)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._drag is not None and self._drag.box is not None:
            painter.setPen(QPen(QColor(theme.accent), 1))
            painter.drawRect(QRectF(self._drag.box, self._pointer).normalized())
        else:
            paint_box(painter, content, points, self.chosen, theme)
        if len(self.chosen) == 1 and self.chosen[0] < len(points):
            write_point(painter, content, points[self.chosen[0]], self._look, theme)

    def _put(self, place: tuple[float, float]) -> None:
        added, index = algebra.with_point_put(self._points(), *place, self._look.highest)
        self.chosen = (index,)
        self.changed.emit(added, None)

    def _bend(self, index: int, segment: Segment) -> None:
        self.changed.emit(algebra.with_segment(self._points(), index, segment), None)


def _places(content: EditorContent, points: Points) -> tuple[Floats, Floats]:
    """Where points lie, (n,) each, px."""
    times_s, values = np.array([one[:2] for one in points]).reshape(-1, 2).T
    return content.curve(times_s, values)


def _point_at(content: EditorContent, points: Points, at: QPointF) -> int | None:
    if not points:
        return None
    x, y = _places(content, points)
    away = np.maximum(np.abs(x - at.x()), np.abs(y - at.y()))
    nearest = int(away.argmin())
    return None if away[nearest] > CATCH_PX else nearest


def _segment_at(content: EditorContent, points: Points, at: QPointF) -> int | None:
    """The point after which the curve passes here; -1 before the first."""
    time_s, _ = content.place(at)
    value = float(algebra.curve_at(points, np.array([time_s]))[0])
    if abs(content.y(value) - at.y()) > CATCH_PX:
        return None
    return sum(one[0] <= time_s for one in points) - 1
