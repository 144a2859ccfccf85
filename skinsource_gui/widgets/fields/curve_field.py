"""Breakpoints as a small curve: added, dragged, stepped, removed."""

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from skinsource.design.effects.breakpoints import Points
from skinsource.specs.fields import BreakpointsSpec
from skinsource_gui.theme import current_theme, tabular
from skinsource_gui.widgets.fields.curve_mouse import CurveMouse
from skinsource_gui.widgets.fields.curve_painter import paint_curve, paint_frame
from skinsource_gui.widgets.fields.edited_points import EditedPoints
from skinsource_gui.widgets.fields.point_menu import (
    SEGMENT_WORDS,
    fill_ground_menu,
    fill_point_menu,
)
from skinsource_gui.widgets.keys import claims_shortcut, key_text, meaning_of
from skinsource_gui.widgets.tooltips import tooltip

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
        beside = self._mouse.point_at(event.position()) is None
        if event.button() == Qt.MouseButton.LeftButton and beside:
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
        words = painter.fontMetrics().elidedText(
            self.words, Qt.TextElideMode.ElideRight, round(room.width())
        )
        painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, words)

    @property
    def words(self) -> str:
        """The chosen point, in words."""
        chosen = self.points.chosen
        x, y, segment = self.value[chosen]
        place = f"{chosen + 1}/{len(self.value)}"
        return f"{place} · {1000.0 * x:.4g} ms · {y:.3g} · {SEGMENT_WORDS[segment]}"

    def _inside(self) -> QRectF:
        return QRectF(self.rect()).adjusted(7, _WORDS_PX + 6, -7, -7)
