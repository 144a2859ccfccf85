"""Breakpoints over the waveform."""

from collections.abc import Callable
from functools import lru_cache
from itertools import product

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPixmap

from skinsource.arrays import Floats
from skinsource.effects import breakpoints as algebra
from skinsource.effects.breakpoints import Points
from skinsource.fields import SEGMENTS
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.tools.curve_drag import Drag
from skinsource_gui.panels.clip_editor.tools.curve_look import CurveLook
from skinsource_gui.panels.clip_editor.tools.tool import Button, Held
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.gesture import new_gesture
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.plot.ticks import number_text

#: How near the pointer takes hold of a point, or of the curve, px.
CATCH_PX = 9.0
_POINT_PX, _HOVERED_PX = 3.5, 5.0
# Room for a point and its line.
_DOT_PX = 10
_FINE = 0.1
_HOW = "Double click to add a point, or click the line; drag points to shape the envelope"


_ENVELOPE = CurveLook(how=_HOW)


class EnvelopeTool(QObject):
    """Click on the curve: a new point.  Drag: points, a segment up and down, a box around points.

    Ctrl: finely.  Shift: up and down or along alone.  Alt and click on a segment: its next kind.
    Right button on a point: removes it.

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

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        points = self._points()
        index = _point_at(content, points, at)
        if button == Button.RightButton:
            if index is not None:
                self._remove((index,))
            return
        if button != Button.LeftButton or self._drag is not None:
            return
        start, number = content.place(at), new_gesture()
        if index is not None:
            if held & Held.ShiftModifier:
                self.chosen = tuple(sorted(set(self.chosen) ^ {index}))
            elif index not in self.chosen:
                self.chosen = (index,)
            self._drag = Drag(points, self.chosen or (index,), start, number)
            return
        segment = _segment_at(content, points, at)
        if segment is None:
            self._drag = Drag(points, (), start, number, box=at)
        elif held & Held.AltModifier and self._look.bends:
            here = SEGMENTS.index(points[segment][2])
            following = SEGMENTS[(here + 1) % len(SEGMENTS)]
            self.changed.emit(algebra.with_segment(points, segment, following), None)
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
        if _point_at(content, self._points(), at) is not None:
            return
        highest = self._look.highest
        added, index = algebra.with_point_put(self._points(), *content.place(at), highest)
        self.chosen = (index,)
        self.changed.emit(added, None)

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
        self._remove(self.chosen)

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
        self._paint_points(painter, content, points, theme)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._drag is not None and self._drag.box is not None:
            painter.setPen(QPen(QColor(theme.accent), 1))
            painter.drawRect(QRectF(self._drag.box, self._pointer).normalized())
        self._write(painter, content, points, theme)

    def _paint_points(
        self, painter: QPainter, content: EditorContent, points: Points, theme: Theme
    ) -> None:
        near = _point_at(content, points, self._pointer)
        colour = getattr(theme, self._look.colour)
        painter.setPen(QPen(QColor(colour), 1.5))
        painter.setBrush(QColor(theme.base))
        x, y = _places(content, points)
        dot = _dot(colour, theme.base, painter.device().devicePixelRatioF())
        for place in map(QPointF, (x - _DOT_PX / 2).tolist(), (y - _DOT_PX / 2).tolist()):
            painter.drawPixmap(place, dot)
        # The others are painted again, over those beside them.
        for index in {*self.chosen, *(() if near is None else (near,))}:
            if index < len(points):
                radius = _HOVERED_PX if index == near else _POINT_PX
                chosen = index in self.chosen
                painter.setBrush(QColor(theme.accent if chosen else theme.base))
                painter.drawEllipse(QPointF(x[index], y[index]), radius, radius)

    def _write(
        self, painter: QPainter, content: EditorContent, points: Points, theme: Theme
    ) -> None:
        if len(points) == 1 and not self.chosen:
            painter.setPen(QColor(theme.text))
            flags = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignBottom
            painter.drawText(content.area.adjusted(0, 0, 0, -6), flags, self._look.how)
        if len(self.chosen) != 1 or self.chosen[0] >= len(points):
            return
        time_s, value, kind = points[self.chosen[0]]
        words = self._words(time_s, value, kind)
        at = content.at(time_s, value)
        flags = Qt.AlignmentFlag.AlignCenter
        line = QFontMetricsF(painter.font())
        width, height = line.horizontalAdvance(words) + 12, line.height() + 4
        area = content.area
        left = min(max(at.x() - width / 2, area.left() + 2), area.right() - width - 2)
        # Below the point where there is no room above it.
        top = at.y() - height - 10 if at.y() - height - 10 > area.top() else at.y() + 10
        room = QRectF(left, top, width, height)
        painter.setBrush(QColor(theme.raised))
        painter.setPen(QPen(QColor(theme.border), 1))
        painter.drawRect(room)
        painter.setPen(QColor(theme.text))
        painter.drawText(room, flags, words)

    def _words(self, time_s: float, value: float, kind: str) -> str:
        look, when = self._look, value_text(time_s, "s", digits=5)
        if look.bends:
            return f"{when} · {number_text(value, 3)} · {kind}"
        return f"{look.label} · {when} · {value:.5g} {look.unit}".rstrip()

    def _remove(self, indices: tuple[int, ...]) -> None:
        if indices:
            left, number = algebra.without_chosen(self._points(), indices)
            self.chosen = (number,)
            self.changed.emit(left, None)


@lru_cache(maxsize=8)
def _dot(line: str, ground: str, ratio: float) -> QPixmap:
    """Picture of a point, painted once."""
    dot = QPixmap(round(_DOT_PX * ratio), round(_DOT_PX * ratio))
    dot.setDevicePixelRatio(ratio)
    dot.fill(Qt.GlobalColor.transparent)
    painter = QPainter(dot)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(QColor(line), 1.5))
    painter.setBrush(QColor(ground))
    painter.drawEllipse(QPointF(_DOT_PX / 2, _DOT_PX / 2), _POINT_PX, _POINT_PX)
    painter.end()
    return dot


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
