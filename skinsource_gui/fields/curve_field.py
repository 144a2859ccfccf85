"""The field of a curve of breakpoints: points are added, dragged, stepped and removed."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt

from skinsource.design.effects.breakpoints import (
    HIGHEST,
    Points,
    curve_at,
    index_for,
    moved,
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
from skinsource_gui.fields.editor import Burst, Editor, new_gesture
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import arrow_steps, claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import Policy, tooltip
from skinsource_gui.qt.theme import Theme, current_theme, tabular

# A click selects a point or the curve from this far away.
_NEAR_PX = 8.0


@dataclass(frozen=True, slots=True)
class CurveScale:
    """Maps values from 0 to ``x`` and 0 to ``y`` to an area."""

    x: float
    y: float

    @classmethod
    def around(cls, points: Points) -> "CurveScale":
        """Return a scale with room for all points, and for moving them."""
        last, highest = points[-1][0], max(point[1] for point in points)
        return cls(1.1 * last if last > 0.0 else 0.1, 1.1 * max(highest, 1.0))

    def place(self, x: float, y: float, area: QRectF) -> QPointF:
        """Return the place of a value."""
        return QPointF(
            area.left() + area.width() * x / self.x, area.bottom() - area.height() * y / self.y
        )

    def value(self, at: QPointF, area: QRectF) -> tuple[float, float]:
        """Return the value at a place."""
        return (
            self.x * (at.x() - area.left()) / area.width(),
            self.y * (area.bottom() - at.y()) / area.height(),
        )

    def point_at(self, points: Points, at: QPointF, area: QRectF) -> int | None:
        """Return the index of the point at a place."""
        gaps = [(self.place(x, y, area) - at).manhattanLength() for x, y, _ in points]
        nearest = min(range(len(gaps)), key=gaps.__getitem__)
        return nearest if gaps[nearest] <= _NEAR_PX else None

    def is_on_curve(self, points: Points, x: float, at: QPointF, area: QRectF) -> bool:
        """Return whether the curve passes the place ``at``, whose value is ``x``."""
        y = float(curve_at(points, np.array([x]))[0])
        return abs(self.place(x, y, area).y() - at.y()) <= _NEAR_PX

    def course(self, points: Points, area: QRectF) -> list[QPointF]:
        """Return the curve at each pixel and at each point; a jump is vertical."""
        pixels = np.linspace(0.0, self.x, max(int(area.width()), 2))
        point_x = np.array([x for x, _, _ in points])
        # Just before each point, too, for jumps.
        x = np.sort(np.concatenate((pixels, point_x, np.maximum(point_x - 1e-9, 0.0))))
        return [self.place(*pair, area) for pair in zip(x, curve_at(points, x), strict=True)]


_POINT_PX = 3.5


def paint_frame(painter: QtGui.QPainter, area: QRectF, theme: Theme, *, focused: bool) -> None:
    """Paint the background of a field, which shows whether it has the focus."""
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent if focused else theme.border), 1))
    painter.setBrush(QtGui.QColor(theme.base))
    painter.drawRoundedRect(area.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)


def paint_curve(
    painter: QtGui.QPainter,
    inside: QRectF,
    scale: CurveScale,
    points: Points,
    chosen: int | None,
    theme: Theme,
) -> None:
    """Paint a line at 1, the curve and its points, of which the ``chosen`` one is filled."""
    one_y = scale.place(0.0, 1.0, inside).y()
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
    painter.drawLine(QPointF(inside.left(), one_y), QPointF(inside.right(), one_y))
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1.5))
    painter.drawPolyline(QtGui.QPolygonF(scale.course(points, inside)))
    for k, (x, y, _) in enumerate(points):
        painter.setBrush(QtGui.QColor(theme.accent if k == chosen else theme.base))
        painter.drawEllipse(scale.place(x, y, inside), _POINT_PX, _POINT_PX)


def _short(point: Breakpoint) -> Breakpoint:
    """Return a point without rounding errors; it keeps a slope of its own."""
    x, y, kind = point
    x, y, slope = float(f"{x:.12g}"), float(f"{y:.12g}"), slope_of(point)
    return (x, y, kind) if slope is None else SlopedPoint(x, y, kind, slope)


#: Texts for the segment after a point.
SEGMENT_TEXTS = {"straight": "straight on", "smooth": "smoothly on", "held": "held"}


def fill_point_menu(
    menu: QtWidgets.QMenu,
    remove: Callable[[], object],
    *,
    bend: Callable[[Segment], object] | None = None,
    n_chosen: int = 1,
    n_points: int,
) -> None:
    """Fill the menu of a breakpoint: remove it, or change the segment after it.

    Parameters
    ----------
    menu
        Gets the entries.
    remove, bend
        Their functions; ``bend`` is None where a curve is always straight.
    n_chosen, n_points
        Numbers of points to remove and of all points; the last point stays.
    """
    if bend is not None:
        for segment in SEGMENTS:
            menu.addAction(f"After this point: {SEGMENT_TEXTS[segment]}", partial(bend, segment))
        menu.addSeparator()
    text = "Remove point" if n_chosen == 1 else f"Remove {n_chosen} points"
    menu.addAction(text, remove).setEnabled(n_points > 1)


def fill_ground_menu(menu: QtWidgets.QMenu, add: Callable[[], object]) -> None:
    """Fill the menu of a place without a point: add one."""
    menu.addAction("Add point here", add)


_TEXT_PX = 16


class CurveField(Editor, QtWidgets.QWidget):
    """Edits breakpoints of ``spec`` as a small curve.

    A press on the curve adds a point and drags it; a double click beside the curve adds one there.
    Delete, or the menu of the right button, removes a point.  The arrow keys move the chosen point,
    with Shift by ten steps.  Esc cancels a drag.

    Attributes
    ----------
    value, chosen
        The points, and the index of the one that keys act on.
    end_x
        End of the clip: a key adds a point halfway from the last one to there.  None: the curve
        ends at the last point.
    """

    def __init__(self, spec: BreakpointsSpec, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._spec, self._burst = spec, Burst(self)
        self.value: Points = ((0.0, 1.0, "straight"),)
        self.chosen = 0
        self.end_x: float | None = None
        # The scale does not change during a drag.
        self._scale = CurveScale.around(self.value)
        # The drag: number of the gesture, the points before, and where it began.
        self._drag: tuple[int, Points, QPointF] | None = None
        self.setAccessibleName(spec.label)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(Policy.Expanding, Policy.Fixed)
        self.setFont(tabular(self.font()))
        self.setToolTip(tooltip(f"{spec.hint}. Click to add a point, drag to move it"))

    def set_value(self, points: Points) -> None:
        """Show other points without a signal."""
        if points != self.value:
            self.value = points
            self.chosen = min(self.chosen, len(points) - 1)
        if self._drag is None:
            self._scale = CurveScale.around(points)
        self.update()

    def cancel(self) -> None:
        """End a drag."""
        self._drag = None

    def place_of(self, index: int) -> QPointF:
        """Return the place of a point."""
        x, y, _ = self.value[index]
        return self._scale.place(x, y, self._inside())

    def sizeHint(self) -> QSize:
        return QSize(160, 84)

    def minimumSizeHint(self) -> QSize:
        return QSize(72, 84)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QtGui.QKeyEvent) -> bool:
        gives_up = self._drag is not None and event.key() == Qt.Key.Key_Escape
        return gives_up or bool(meaning_of("curve", event))

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        """Begin to drag the point at a place, or a new point on the curve."""
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
            return
        self._burst.end()
        at, gesture = event.position(), new_gesture()
        near = self._point_at(at)
        if near is None:
            x = self._rounded(self._scale.value(at, self._inside())[0])
            if not self._scale.is_on_curve(self.value, x, at, self._inside()):
                return
            near = index_for(self.value, x)
            self._put(with_point(self.value, x), near, gesture)
        self._choose(near)
        self._drag = (gesture, self.value, at)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        """Move the dragged point along with the mouse."""
        if self._drag is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        gesture, start, origin = self._drag
        then, now = (
            self._scale.value(place, self._inside()) for place in (origin, event.position())
        )
        x, y, _ = start[min(self.chosen, len(start) - 1)]
        to_x, to_y = self._rounded(x + now[0] - then[0]), round(y + now[1] - then[1], 3)
        self._put(moved(start, {self.chosen}, to_x - x, to_y - y), self.chosen, gesture)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self._drag = None
        self.set_value(self.value)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        is_free = self._point_at(event.position()) is None
        if event.button() == Qt.MouseButton.LeftButton and is_free:
            self._add(event.position())

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        at = QPointF(event.pos())
        by_key = event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard
        near = self.chosen if by_key else self._point_at(at)
        menu = passing_menu(self, "point_menu")
        if near is None:
            fill_ground_menu(menu, lambda: self._add(at))
        else:
            self._choose(near)
            fill_point_menu(
                menu,
                lambda: self._act("remove"),
                bend=self._set_segment,
                n_points=len(self.value),
            )
        menu.popup(event.globalPos())

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        name = meaning_of("curve", event)
        if self._drag is not None and event.key() == Qt.Key.Key_Escape:
            (gesture, start, _), self._drag = self._drag, None
            self._put(start, self.chosen, gesture)
        elif name == "nudge":
            right, up = arrow_steps(event)
            by_x, by_y = right * self._spec.x.step, up * self._spec.y.step
            points = moved(self.value, {self.chosen}, by_x, by_y)
            self._put(points, self.chosen, self._burst.gesture())
        elif name:
            self._act(name)
        else:
            event.ignore()

    def _choose(self, index: int) -> None:
        """Choose a point; an index beyond the ends chooses the first or last point."""
        self.chosen = min(max(index, 0), len(self.value) - 1)
        self.update()

    def _put(self, points: Points, chosen: int, gesture: int | None) -> None:
        """Replace the points by an edit, and choose one of them."""
        points = tuple(map(_short, points))
        self.chosen = min(max(chosen, 0), len(points) - 1)
        if points != self.value:
            self.value = points
            self.edited.emit(points, gesture)
        self.update()

    def _add(self, at: QPointF) -> None:
        """Add a point at a place."""
        x, y = self._scale.value(at, self._inside())
        highest = min(self._spec.y.maximum, HIGHEST)
        added = with_point_put(self.value, self._rounded(x), round(y, 3), highest)
        self._put(*added, new_gesture())

    def _set_segment(self, segment: Segment) -> None:
        """Set the segment after the chosen point."""
        self._put(with_segment(self.value, self.chosen, segment), self.chosen, None)

    def _act(self, name: str) -> None:
        """Do what the key ``name`` of the table of keys means."""
        k, points, last = self.chosen, self.value, len(self.value) - 1
        if name in ("before", "after", "first", "last"):
            self._choose({"before": k - 1, "after": k + 1, "first": 0, "last": last}[name])
        elif name == "segment":
            self._set_segment(SEGMENTS[(SEGMENTS.index(points[k][2]) + 1) % len(SEGMENTS)])
        elif name == "remove":
            self._put(*without_chosen(points, {k}), self._burst.gesture())
        elif name == "add":
            end_x = points[-1][0] if self.end_x is None else self.end_x
            self._put(*with_point_after(points, k, end_x), None)

    def _point_at(self, at: QPointF) -> int | None:
        return self._scale.point_at(self.value, at, self._inside())

    def _rounded(self, x: float) -> float:
        """Return a time rounded to tenths of a step."""
        step = self._spec.x.step / 10.0
        return max(round(x / step) * step, 0.0)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, inside = QtGui.QPainter(self), self._inside()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        paint_frame(painter, QRectF(self.rect()), current_theme(), focused=self.hasFocus())
        chosen = self.chosen if self.hasFocus() else None
        paint_curve(painter, inside, self._scale, self.value, chosen, current_theme())
        painter.setPen(QtGui.QColor(current_theme().dim))
        room = QRectF(inside.left(), 2, inside.width(), _TEXT_PX)
        text = painter.fontMetrics().elidedText(
            self.text, Qt.TextElideMode.ElideRight, round(room.width())
        )
        painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)

    @property
    def text(self) -> str:
        """The text of the chosen point."""
        chosen = self.chosen
        x, y, segment = self.value[chosen]
        place = f"{chosen + 1}/{len(self.value)}"
        return f"{place} · {1000.0 * x:.4g} ms · {y:.3g} · {SEGMENT_TEXTS[segment]}"

    def _inside(self) -> QRectF:
        return QRectF(self.rect()).adjusted(7, _TEXT_PX + 6, -7, -7)
