"""Where on a field the points of a curve are seen."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt, Signal
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

from skinsource.design.effects.breakpoints import (
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
from skinsource.specs.breakpoints import (
    SEGMENTS,
    Breakpoint,
    BreakpointsSpec,
    Segment,
    SlopedPoint,
    slope_of,
)
from skinsource_gui.fields.editor import Burst, new_gesture
from skinsource_gui.qt.keys import claims_shortcut, key_text, meaning_of
from skinsource_gui.qt.theme import Theme, current_theme, tabular
from skinsource_gui.qt.tooltips import tooltip

# How far from a point or the curve it is still meant.
_NEAR_PX = 8.0


@dataclass(frozen=True, slots=True)
class CurveScale:
    """Values from 0 to ``x`` and 0 to ``y`` fill an area."""

    x: float
    y: float

    @classmethod
    def around(cls, points: Points) -> "CurveScale":
        """With room for all points, and some to move them to."""
        last, highest = points[-1][0], max(point[1] for point in points)
        return cls(1.1 * last if last > 0.0 else 0.1, 1.1 * max(highest, 1.0))

    def place(self, x: float, y: float, area: QRectF) -> QPointF:
        """Where a value is seen."""
        return QPointF(
            area.left() + area.width() * x / self.x, area.bottom() - area.height() * y / self.y
        )

    def value(self, at: QPointF, area: QRectF) -> tuple[float, float]:
        """The value that is seen at a place."""
        return (
            self.x * (at.x() - area.left()) / area.width(),
            self.y * (area.bottom() - at.y()) / area.height(),
        )

    def point_at(self, points: Points, at: QPointF, area: QRectF) -> int | None:
        """Number of the point that is seen at a place."""
        gaps = [(self.place(x, y, area) - at).manhattanLength() for x, y, _ in points]
        nearest = min(range(len(gaps)), key=gaps.__getitem__)
        return nearest if gaps[nearest] <= _NEAR_PX else None

    def is_on_curve(self, points: Points, x: float, at: QPointF, area: QRectF) -> bool:
        """Whether the curve is seen at a place whose value is ``x``."""
        y = float(curve_at(points, np.array([x]))[0])
        return abs(self.place(x, y, area).y() - at.y()) <= _NEAR_PX

    def course(self, points: Points, area: QRectF) -> list[QPointF]:
        """The curve, at each pixel and at each point; a jump is upright."""
        pixels = np.linspace(0.0, self.x, max(int(area.width()), 2))
        point_x = np.array([x for x, _, _ in points])
        # Just before each point, too, for what jumps there.
        x = np.sort(np.concatenate((pixels, point_x, np.maximum(point_x - 1e-9, 0.0))))
        return [self.place(*pair, area) for pair in zip(x, curve_at(points, x), strict=True)]


# Paints breakpoints and the curve through them.

_POINT_PX = 3.5


def paint_frame(painter: QPainter, area: QRectF, theme: Theme, *, focused: bool) -> None:
    """Paint the ground of a field, which shows whether it has the keyboard."""
    painter.setPen(QPen(QColor(theme.accent if focused else theme.border), 1))
    painter.setBrush(QColor(theme.base))
    painter.drawRoundedRect(area.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)


def paint_curve(
    painter: QPainter,
    inside: QRectF,
    scale: CurveScale,
    points: Points,
    chosen: int | None,
    theme: Theme,
) -> None:
    """Paint a line at 1, the curve and its points, of which the ``chosen`` one is filled."""
    one_y = scale.place(0.0, 1.0, inside).y()
    painter.setPen(QPen(QColor(theme.grid), 1))
    painter.drawLine(QPointF(inside.left(), one_y), QPointF(inside.right(), one_y))
    painter.setPen(QPen(QColor(theme.accent), 1.5))
    painter.drawPolyline(QPolygonF(scale.course(points, inside)))
    for k, (x, y, _) in enumerate(points):
        painter.setBrush(QColor(theme.accent if k == chosen else theme.base))
        painter.drawEllipse(scale.place(x, y, inside), _POINT_PX, _POINT_PX)


# Breakpoints while they are edited: which one is chosen, and what keys and menus do to them.


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


# What the mouse does to points that are seen as a curve.


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
        now, then = (self.scale.value(point, self._area()) for point in (at, pressed))
        chosen = self._points.chosen
        x, y, _ = start[min(chosen, len(start) - 1)]
        to_x, to_y = self._rounded(x + now[0] - then[0]), round(y + now[1] - then[1], 3)
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


# What the right button offers on a curve of breakpoints, wherever there is one.

#: How the curve goes on after a point.
SEGMENT_WORDS = {"straight": "straight on", "smooth": "smoothly on", "held": "held"}


def fill_point_menu(
    menu: QMenu,
    remove: Callable[[], object],
    *,
    bend: Callable[[Segment], object] | None = None,
    n_chosen: int = 1,
    n_points: int,
) -> None:
    """Offer to remove a point, and to let the curve go on otherwise after it.

    Parameters
    ----------
    menu
        Gets the lines.
    remove, bend
        What they do; ``bend`` is None where a curve is always straight.
    n_chosen, n_points
        How many points are removed, and of how many; the only one there is stays.
    """
    if bend is not None:
        for segment in SEGMENTS:
            menu.addAction(f"After this point: {SEGMENT_WORDS[segment]}", partial(bend, segment))
        menu.addSeparator()
    text = "Remove point" if n_chosen == 1 else f"Remove {n_chosen} points"
    menu.addAction(text, remove).setEnabled(n_points > 1)


def fill_ground_menu(menu: QMenu, add: Callable[[], object]) -> None:
    """Offer to add a point where the pointer is."""
    menu.addAction("Add point here", add)


# Breakpoints as a small curve: added, dragged, stepped, removed.

_WORDS_PX = 16


class CurveField(QWidget):
    """Edits breakpoints of ``spec``.

    A press on the curve adds a point there and drags it; a double click beside it puts one just
    there.  Delete, or the menu of the right button, takes one out.  The arrow keys move the chosen
    point, with Shift by ten steps.  Esc gives up a drag.

    Attributes
    ----------
    points
        Which one is chosen, and what keys do to them.
    """

    #: The new points; number of their gesture.
    edited = Signal(object, object)

    def __init__(self, spec: BreakpointsSpec, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.points = EditedPoints(spec, self)
        self.points.edited.connect(self.edited)
        self.points.changed.connect(self.update)
        self._mouse = CurveMouse(spec, self.points, self._inside)
        self.setAccessibleName(spec.label)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFont(tabular(self.font()))
        self.setToolTip(
            tooltip(
                f"{spec.hint}. Click on the curve, or double-click beside it: a new point. "
                "Drag, or the arrow keys: move it. "
                f"{key_text('curve', 'segment')}: straight, smooth, held. "
                f"{key_text('curve', 'remove')} or the menu of the right button: remove it"
            )
        )

    @property
    def value(self) -> Points:
        """The points."""
        return self.points.value

    def set_value(self, points: Points) -> None:
        """Show other points, and tell nobody."""
        self.points.show(points)
        self._mouse.fit()
        self.update()

    def cancel(self) -> None:
        """Let go of a drag."""
        self._mouse.let_go()

    def place_of(self, index: int) -> QPointF:
        """Where a point is seen."""
        x, y, _ = self.value[index]
        return self._mouse.scale.place(x, y, self._inside())

    def sizeHint(self) -> QSize:
        return QSize(160, 84)

    def minimumSizeHint(self) -> QSize:
        return QSize(72, 84)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._wants) or super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
        gives_up = self._mouse.drags and event.key() == Qt.Key.Key_Escape
        return gives_up or bool(meaning_of("curve", event))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
            return
        self._mouse.press(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._mouse.move(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._mouse.let_go()
        self.set_value(self.value)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        is_free = self._mouse.point_at(event.position()) is None
        if event.button() == Qt.MouseButton.LeftButton and is_free:
            self._mouse.put(event.position())

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        at = QPointF(event.pos())
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        near = self.points.chosen if by_key else self._mouse.point_at(at)
        menu = QMenu(self)
        menu.setObjectName("point_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        if near is None:
            fill_ground_menu(menu, lambda: self._mouse.put(at))
        else:
            self.points.choose(near)
            fill_point_menu(
                menu,
                lambda: self.points.act("remove"),
                bend=self.points.go_on,
                n_points=len(self.value),
            )
        menu.popup(event.globalPos())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        name = meaning_of("curve", event)
        if self._mouse.drags and event.key() == Qt.Key.Key_Escape:
            self._mouse.give_up()
        elif name:
            self.points.act(name)
        else:
            event.ignore()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, inside = QPainter(self), self._inside()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_frame(painter, QRectF(self.rect()), current_theme(), focused=self.hasFocus())
        chosen = self.points.chosen if self.hasFocus() else None
        paint_curve(painter, inside, self._mouse.scale, self.value, chosen, current_theme())
        painter.setPen(QColor(current_theme().dim))
        room = QRectF(inside.left(), 2, inside.width(), _WORDS_PX)
        text = painter.fontMetrics().elidedText(
            self.words, Qt.TextElideMode.ElideRight, round(room.width())
        )
        painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)

    @property
    def words(self) -> str:
        """The chosen point, in words."""
        chosen = self.points.chosen
        x, y, segment = self.value[chosen]
        place = f"{chosen + 1}/{len(self.value)}"
        return f"{place} · {1000.0 * x:.4g} ms · {y:.3g} · {SEGMENT_WORDS[segment]}"

    def _inside(self) -> QRectF:
        return QRectF(self.rect()).adjusted(7, _WORDS_PX + 6, -7, -7)
