"""The dorsal heat map, on which outputs are selected."""

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QHelpEvent, QKeyEvent, QKeySequence, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource_gui.panels.skin.map_canvas import FIT_ALL, MapCanvas
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_layout import MapLayout
from skinsource_gui.panels.skin.map_painter import paint_ring, ring_radius
from skinsource_gui.panels.skin.map_readout import output_readout, pixel_readout
from skinsource_gui.panels.skin.output_picking import (
    DORSAL_OUTPUTS,
    joined,
    output_at,
    output_beyond,
    outputs_inside,
    toggled,
)

_REACH_PX = 11.0
# A press that moves less than this is a click.
_CLICK_PX = 4.0
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}
_SELECT_KEYS = (Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter)
_ADDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier
_ZOOM_PER_KEY = 1.25


class HeatmapView(MapCanvas):
    """The dorsal map with mouse and keys.

    It shows `MapContent`, and tells which outputs the user wants selected.
    """

    #: The outputs to select, a tuple of numbers.
    outputs_chosen = Signal(object)
    #: What is under the pointer or the keyboard's cursor, in words; empty for nothing.
    readout_changed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.hovered: int | None = None
        self.cursor_output: int | None = None
        self._pointer: QPointF | None = None
        self._pressed: QPointF | None = None
        self._band: QRectF | None = None
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Dorsal heat map")
        self.setAccessibleDescription(
            "Arrow keys move to the next output, Space selects it, Shift and Space adds it."
        )

    def place_of(self, number: int) -> QPointF:
        """Where an output is drawn."""
        return QPointF(*self.map_layout().points[number - 1])

    def readout(self) -> str:
        """What is under the pointer, or else under the keyboard's cursor, in words."""
        number = self.hovered
        if number is None and self._pointer is None and self.hasFocus():
            number = self.cursor_output
        if number is not None:
            return output_readout(self.content, number)
        layout = self.map_layout()
        if layout is None or self._pointer is None:
            return ""
        return pixel_readout(self.content, layout, self._pointer)

    def paint_over(self, painter: QPainter, layout: MapLayout) -> None:
        marked = [(self.hovered, self._theme.text)]
        if self.hasFocus():
            marked.append((self.cursor_output, self._theme.accent))
        for number, colour in marked:
            if number is not None:
                radius = ring_radius(number, self.content, layout) + 3.5 * layout.unit
                ground = QColor(self._theme.base)
                centre = self.place_of(number)
                paint_ring(painter, centre, radius, QColor(colour), ground, 0.8 * layout.unit)
        if self._band is not None:
            fill = QColor(self._theme.accent)
            painter.setPen(QPen(fill, 1))
            fill.setAlphaF(0.15)
            painter.setBrush(fill)
            painter.drawRect(self._band)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip:
            self._show_tooltip(event)
            return True
        if event.type() == QEvent.Type.ShortcutOverride and self._is_own_key(event):
            event.accept()
            return True
        return super().event(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        super().mousePressEvent(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._pressed = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        self._pointer = event.position()
        if self._pressed is not None:
            band = QRectF(self._pressed, event.position()).normalized()
            if self._band is not None or max(band.width(), band.height()) >= _CLICK_PX:
                self._band = band
        self._look_under_pointer()
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        if event.button() != Qt.MouseButton.LeftButton or self._pressed is None:
            return
        band, self._band, self._pressed = self._band, None, None
        layout = self.map_layout()
        adds = bool(event.modifiers() & _ADDS)
        if layout is not None and band is not None:
            found = outputs_inside(layout.points, band)
            self._choose(joined(self.content.outputs, found) if adds else found)
        elif layout is not None:
            number = output_at(layout.points, event.position(), _REACH_PX)
            if number is not None:
                self._choose_one(number, adds)
        self.update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        layout = self.map_layout()
        if event.button() == Qt.MouseButton.LeftButton and layout is not None:
            if output_at(layout.points, event.position(), _REACH_PX) is None:
                self.show_all()
            else:
                self._pressed = event.position()

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._pointer = None
        self.hovered = None
        self.readout_changed.emit(self.readout())
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self.map_layout() is None or not self._act_on_key(event):
            super().keyPressEvent(event)

    def show_content(self, content: MapContent) -> None:
        super().show_content(content)
        if self._pointer is not None or self.hasFocus():
            self.readout_changed.emit(self.readout())

    def _act_on_key(self, event: QKeyEvent) -> bool:
        key, adds = event.key(), bool(event.modifiers() & _ADDS)
        middle = QRectF(self.rect()).center()
        if key in _ARROWS:
            self._move_cursor(*_ARROWS[key])
        elif key in _SELECT_KEYS:
            self._choose_one(self._cursor_start(), adds)
        elif _is_select_all(event):
            self._choose(DORSAL_OUTPUTS)
        elif key == Qt.Key.Key_Escape:
            self._step_back()
        elif key == Qt.Key.Key_0:
            self.show_all()
        elif key == Qt.Key.Key_H:
            self.show_hand()
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self.zoom(_ZOOM_PER_KEY, middle)
        elif key == Qt.Key.Key_Minus:
            self.zoom(1 / _ZOOM_PER_KEY, middle)
        else:
            return False
        return True

    def _is_own_key(self, event: QKeyEvent) -> bool:
        """Whether a shortcut of the window must not take this key."""
        if _is_select_all(event):
            return True
        plain = not event.modifiers() & Qt.KeyboardModifier.ControlModifier
        own = (*_ARROWS, *_SELECT_KEYS, Qt.Key.Key_Escape, Qt.Key.Key_0, Qt.Key.Key_H)
        return plain and event.key() in own

    def _move_cursor(self, dx: int, dy: int) -> None:
        if self.cursor_output is None:
            self.cursor_output = self._cursor_start()
        else:
            points = self.map_layout().points
            self.cursor_output = output_beyond(points, self.cursor_output, dx, dy)
        self._bring_into_sight(self.cursor_output)
        self._pointer = self.hovered = None
        self.readout_changed.emit(self.readout())
        self.update()

    def _cursor_start(self) -> int:
        if self.cursor_output is not None:
            return self.cursor_output
        if self.content.outputs:
            return self.content.outputs[0]
        return output_at(self.map_layout().points, QRectF(self.rect()).center(), float("inf"))

    def _bring_into_sight(self, number: int) -> None:
        room = QRectF(self.rect()).adjusted(20, 20, -20, -20)
        at = self.place_of(number)
        dx = min(max(at.x(), room.left()), room.right()) - at.x()
        dy = min(max(at.y(), room.top()), room.bottom()) - at.y()
        if self.fit != FIT_ALL and (dx or dy):
            self.pan(dx, dy)

    def _step_back(self) -> None:
        """Give up the rubber band, or else the selection."""
        if self._pressed is not None:
            self._pressed = self._band = None
            self.update()
        else:
            self._choose(())

    def _choose_one(self, number: int, adds: bool) -> None:
        self.cursor_output = number
        self._choose(toggled(self.content.outputs, number) if adds else (number,))

    def _choose(self, outputs: tuple[int, ...]) -> None:
        if outputs != self.content.outputs:
            self.outputs_chosen.emit(outputs)

    def _look_under_pointer(self) -> None:
        layout = self.map_layout()
        if layout is not None:
            self.hovered = output_at(layout.points, self._pointer, _REACH_PX)
            self.readout_changed.emit(self.readout())

    def _show_tooltip(self, event: QHelpEvent) -> None:
        layout = self.map_layout()
        number = None if layout is None else output_at(layout.points, event.pos(), _REACH_PX)
        if number is None:
            QToolTip.hideText()
            return
        QToolTip.showText(event.globalPos(), output_readout(self.content, number), self)


def _is_select_all(event: QKeyEvent) -> bool:
    # With Shift it is a shortcut of the window, and means the opposite.
    shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
    return event.matches(QKeySequence.StandardKey.SelectAll) and not shift
