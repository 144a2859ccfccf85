"""Breakpoints as a small curve: added, dragged, stepped, removed."""

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from skinsource.effects.breakpoints import (
    HIGHEST,
    Points,
    curve_at,
    moved,
    place_of,
    with_point,
    with_point_after,
    with_point_put,
    with_segment,
    without_chosen,
)
from skinsource.fields import SEGMENTS, BreakpointsSpec, Segment
from skinsource_gui.theme import LIGHT, Theme, tabular
from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.fields.curve_scale import CurveScale
from skinsource_gui.widgets.fields.gesture import new_gesture
from skinsource_gui.widgets.key_tables.kept_from_shortcuts import kept_from_shortcuts
from skinsource_gui.widgets.key_tables.key_table import key_text, meant
from skinsource_gui.widgets.tooltips import tooltip

_NEAR_PX, _POINT_PX = 8.0, 3.5
_WORDS_PX = 16
_SEGMENT_WORDS = {"straight": "straight on", "smooth": "smoothly on", "held": "held"}


class CurveField(QWidget):
    """Edits breakpoints of ``spec``.

    A press on the curve adds a point there and drags it; a double click beside it puts one just
    there.  Delete, or the menu of the right button, takes one out.  The arrow keys move the chosen
    point, with Shift by ten steps.  Esc gives up a drag.

    Attributes
    ----------
    end_x
        Where what the curve is of ends: a key adds a point halfway from the last one to there.
        None: at the last point.
    """

    #: The new points; number of their gesture.
    edited = Signal(object, object)

    def __init__(self, spec: BreakpointsSpec, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._spec, self._theme = spec, LIGHT
        self._points: Points = ((0.0, 1.0, "straight"),)
        self._chosen = 0
        self.end_x: float | None = None
        self._burst = Burst(self)
        # While one is dragged: number of the gesture, the points as it began, where it began.
        self._drag: tuple[int, Points, QPointF] | None = None
        self._scale = CurveScale.around(self._points)
        self.setAccessibleName(spec.label)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFont(tabular(self.font()))
        self.setToolTip(
            tooltip(
                f"{spec.hint}. Click on the curve, or double-click beside it: a new point. "
                "Drag, or the arrow keys: move it. "
                f"{key_text('curve', 'segment')}: straight, smooth, held. "
                f"{key_text('curve', 'remove')} or the right button: remove it"
            )
        )

    @property
    def value(self) -> Points:
        """The points."""
        return self._points

    @property
    def chosen(self) -> int:
        """Number of the point that the keys are about, from 0."""
        return self._chosen

    def set_value(self, points: Points) -> None:
        """Show other points, and tell nobody."""
        if points != self._points:
            self._points = points
            self._chosen = min(self._chosen, len(points) - 1)
        if self._drag is None:
            self._scale = CurveScale.around(points)
        self.update()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def cancel(self) -> None:
        """Let go of a drag."""
        self._drag = None

    def place_of(self, index: int) -> QPointF:
        """Where a point is seen."""
        x, y, _ = self._points[index]
        return self._scale.place(x, y, self._inside())

    def sizeHint(self) -> QSize:
        return QSize(160, 84)

    def minimumSizeHint(self) -> QSize:
        return QSize(72, 84)

    def event(self, event: QEvent) -> bool:
        return kept_from_shortcuts(event, self._wants) or super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
        gives_up = self._drag is not None and event.key() == Qt.Key.Key_Escape
        return gives_up or bool(meant("curve", event))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
            return
        self._burst.end()
        gesture, before = new_gesture(), self._points
        near = self._near(event.position())
        if near is None:
            x, _ = self._scale.value(event.position(), self._inside())
            x = self._rounded(x)
            if not self._is_on_curve(event.position(), x):
                return
            after, near = with_point(before, x), place_of(before, x)
            self._tell(after, near, gesture)
        self._chosen = near
        self._drag = (gesture, self._points, event.position())
        self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._drag is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        gesture, start, pressed = self._drag
        inside = self._inside()
        here, there = (self._scale.value(at, inside) for at in (event.position(), pressed))
        x, y, _ = start[min(self._chosen, len(start) - 1)]
        to_x, to_y = self._rounded(x + here[0] - there[0]), round(y + here[1] - there[1], 3)
        self._tell(moved(start, {self._chosen}, to_x - x, to_y - y), self._chosen, gesture)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._drag = None
        self.set_value(self._points)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self._near(event.position()) is None:
            x, y = self._scale.value(event.position(), self._inside())
            highest = min(self._spec.y.maximum, HIGHEST)
            put = with_point_put(self._points, self._rounded(x), round(y, 3), highest)
            self._tell(*put, new_gesture())

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        near = self._near(QPointF(event.pos()))
        if near is not None:
            self._chosen = near
            self.update()
        menu = QMenu(self)
        for segment in SEGMENTS:
            action = menu.addAction(f"After this point: {_SEGMENT_WORDS[segment]}")
            action.triggered.connect(lambda _=False, segment=segment: self._continue(segment))
        menu.addSeparator()
        menu.addAction("Remove this point", lambda: self._act("remove"))
        menu.popup(event.globalPos())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        name = meant("curve", event)
        if self._drag is not None and event.key() == Qt.Key.Key_Escape:
            gesture, start, _ = self._drag
            self._drag = None
            self._tell(start, min(self._chosen, len(start) - 1), gesture)
        elif name:
            self._act(name)
        else:
            event.ignore()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        whole, inside = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), self._inside()
        edge = self._theme.accent if self.hasFocus() else self._theme.border
        painter.setPen(QPen(QColor(edge), 1))
        painter.setBrush(QColor(self._theme.base))
        painter.drawRoundedRect(whole, 4, 4)
        one = self._scale.place(0.0, 1.0, inside).y()
        painter.setPen(QPen(QColor(self._theme.grid), 1))
        painter.drawLine(QPointF(inside.left(), one), QPointF(inside.right(), one))
        painter.setPen(QPen(QColor(self._theme.accent), 1.5))
        painter.drawPolyline(QPolygonF(self._scale.course(self._points, inside)))
        for k in range(len(self._points)):
            chosen = k == self._chosen and self.hasFocus()
            painter.setBrush(QColor(self._theme.accent if chosen else self._theme.base))
            painter.drawEllipse(self.place_of(k), _POINT_PX, _POINT_PX)
        painter.setPen(QColor(self._theme.dim))
        room = QRectF(inside.left(), 2, inside.width(), _WORDS_PX)
        words = painter.fontMetrics().elidedText(
            self.words, Qt.TextElideMode.ElideRight, round(room.width())
        )
        painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, words)

    @property
    def words(self) -> str:
        """The chosen point, in words."""
        x, y, segment = self._points[self._chosen]
        place = f"{self._chosen + 1}/{len(self._points)}"
        return f"{place} · {1000.0 * x:.4g} ms · {y:.3g} · {_SEGMENT_WORDS[segment]}"

    def _act(self, name: str) -> None:
        k, points, last = self._chosen, self._points, len(self._points) - 1
        if name in ("before", "after", "first", "last"):
            to = {"before": k - 1, "after": k + 1, "first": 0, "last": last}[name]
            self._chosen = min(max(to, 0), last)
            self.update()
        elif name == "segment":
            self._continue(SEGMENTS[(SEGMENTS.index(points[k][2]) + 1) % len(SEGMENTS)])
        elif name == "remove":
            self._tell(*without_chosen(points, {k}), self._burst.gesture())
        elif name == "add":
            end_x = points[-1][0] if self.end_x is None else self.end_x
            self._tell(*with_point_after(points, k, end_x), None)
        else:
            far = 10 if name.startswith("far_") else 1
            by_x = {"left": -1, "right": 1}.get(name.removeprefix("far_"), 0)
            by_y = {"down": -1, "up": 1}.get(name.removeprefix("far_"), 0)
            step_x, step_y = far * self._spec.x.step, far * self._spec.y.step
            after = moved(points, {k}, by_x * step_x, by_y * step_y)
            self._tell(after, k, self._burst.gesture())

    def _continue(self, segment: Segment) -> None:
        self._tell(with_segment(self._points, self._chosen, segment), self._chosen, None)

    def _tell(self, points: Points, chosen: int, gesture: int | None) -> None:
        points = tuple((float(f"{x:.12g}"), float(f"{y:.12g}"), kind) for x, y, kind in points)
        self._chosen = min(max(chosen, 0), len(points) - 1)
        if points != self._points:
            self._points = points
            self.edited.emit(points, gesture)
        self.update()

    def _near(self, at: QPointF) -> int | None:
        """The point under the pointer."""
        gaps = [(self.place_of(k) - at).manhattanLength() for k in range(len(self._points))]
        nearest = min(range(len(gaps)), key=gaps.__getitem__)
        return nearest if gaps[nearest] <= _NEAR_PX else None

    def _is_on_curve(self, at: QPointF, x: float) -> bool:
        y = float(curve_at(self._points, np.array([x]))[0])
        return abs(self._scale.place(x, y, self._inside()).y() - at.y()) <= _NEAR_PX

    def _rounded(self, x: float) -> float:
        """A time in whole tenths of a step."""
        step = self._spec.x.step / 10.0
        return max(round(x / step) * step, 0.0)

    def _inside(self) -> QRectF:
        return QRectF(self.rect()).adjusted(7, _WORDS_PX + 6, -7, -7)
