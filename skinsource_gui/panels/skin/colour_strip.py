"""A colour scale whose ends can be dragged."""

from collections.abc import Callable
from dataclasses import replace
from functools import reduce

from PySide6.QtCore import QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.skin.colour_scale import level_y, paint_colour_scale
from skinsource_gui.panels.skin.level_range import SILENT_RANGE, Range, moved, with_high, with_low
from skinsource_gui.panels.skin.map_painter import small_font
from skinsource_gui.panels.skin.map_quantity import MapQuantity
from skinsource_gui.theme import LIGHT, Theme, tabular
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.key_tables.key_table import meant
from skinsource_gui.widgets.map.colour_maps import VIRIDIS, colour_table

_RAMP_LEFT, _RAMP_WIDTH = 10, 14
_HANDLE_WIDTH, _HANDLE_HEIGHT = 26, 12
_END_PX = 8
# The scale goes on this part of its range beyond either end, so that handles can be pulled out.
_BEYOND = 0.12
_KEY_STEPS_DB = {
    Qt.Key.Key_Up: 1.0,
    Qt.Key.Key_Right: 1.0,
    Qt.Key.Key_Down: -1.0,
    Qt.Key.Key_Left: -1.0,
    Qt.Key.Key_PageUp: 10.0,
    Qt.Key.Key_PageDown: -10.0,
}

Change = Callable[[Range, float], Range]


class RangeHandle(QWidget):
    """One end of the scale: dragged, or moved with the arrow keys."""

    #: How far it was pulled since the press, px, upwards.
    pulled = Signal(float)
    pressed = Signal()
    released = Signal()
    #: A step by a key, dB.
    stepped = Signal(float)

    def __init__(self, name: str, words: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._theme = LIGHT
        self._grip: QPoint | None = None
        self.setObjectName(name)
        self.setAccessibleName(words)
        self.setToolTip(f"{words}: drag, or arrow keys (Ctrl: 0.1 dB)")
        self.setFixedSize(_HANDLE_WIDTH, _HANDLE_HEIGHT)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.SizeVerCursor)

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = self._theme.accent if self.hasFocus() else self._theme.dim
        painter.setPen(QPen(QColor(edge), 2.0 if self.hasFocus() else 1.2))
        painter.setBrush(QColor(self._theme.raised))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1.5, 2, -1.5, -2), 3, 3)
        painter.drawLine(QPointF(9, self.height() / 2), QPointF(17, self.height() / 2))
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._grip = event.globalPosition().toPoint()
            self.pressed.emit()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            self.pulled.emit(float(self._grip.y() - event.globalPosition().toPoint().y()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            self._grip = None
            self.released.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = key_step_db(event)
        if step:
            self.stepped.emit(step)
        else:
            super().keyPressEvent(event)


class ColourStrip(QWidget):
    """A colour scale with a handle at either end; dragging between them moves both.

    It shows what it is told, and tells which range the user wants.
    """

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = LIGHT
        self._colours = VIRIDIS
        self._range: Range = SILENT_RANGE
        self._axis = _axis_of(self._range)
        self._marks: tuple[tuple[float, QColor], ...] = ()
        self._quantity = MapQuantity()
        self._at_press: Range | None = None
        self._grip_y: float | None = None
        self._scale = KeptPicture()
        self.setObjectName("colour_strip")
        self.setAccessibleName("Range of the colours")
        self.setToolTip("Drag to move the range, double-click for the automatic one")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(70)
        # All of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.high = self._new_handle("range_high", "Level of the highest colour", with_high)
        self.low = self._new_handle("range_low", "Level of the lowest colour", with_low)

    def sizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        return QSize(_RAMP_LEFT + _RAMP_WIDTH + round(3.6 * line), 200)

    def minimumSizeHint(self) -> QSize:
        return QSize(self.sizeHint().width(), 70)

    def show_range(self, range_db: Range) -> None:
        """Show a range; the scale stays where it is while a handle is dragged."""
        if range_db != self._range:
            self._range = range_db
            if self._at_press is None:
                self._axis = _axis_of(range_db)
            self._place_handles()

    def show_marks(self, marks: tuple[tuple[float, QColor], ...]) -> None:
        """Show levels of selected outputs, each in its colour."""
        if marks != self._marks:
            # From where they were to where they come: the rest of the strip stays.
            places = [self._mark_at(level).boundingRect() for level, _ in (*self._marks, *marks)]
            reached = reduce(QRectF.united, places)
            self._marks = marks
            self.update(reached.adjusted(-1, -1, 1, 1).toAlignedRect())

    def show_quantity(self, quantity: MapQuantity, colours: str = VIRIDIS) -> None:
        """Say what the levels are, and in which colours."""
        # The strip is the same at each instant.
        quantity = replace(quantity, time_s=0.0)
        if (quantity, colours) != (self._quantity, self._colours):
            self._quantity, self._colours = quantity, colours
            self.update()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.high.show_theme(theme)
        self.low.show_theme(theme)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(tabular(small_font(self.font())))
        ramp = self._ramp()
        scale = (self._axis, self._range, self._theme, self._quantity, self._colours)
        ground = self.palette().window().color()
        self._scale.paint(painter, QRectF(self.rect()), scale, self._paint_scale, ground)
        painter.setPen(QPen(QColor(self._theme.base), 0.5))
        for level, colour in self._marks:
            painter.setBrush(colour)
            painter.drawPolygon(self._mark_at(level))
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(self._theme.accent), 2))
            painter.drawRect(ramp.adjusted(-1, -1, 1, 1))
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_handles()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._grip_y = event.position().y()
            self._start_drag()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip_y is not None:
            self._drag(moved, self._grip_y - event.position().y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._grip_y = None
        self._end_drag()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.range_chosen.emit(None)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = key_step_db(event)
        if step:
            self.range_chosen.emit(moved(self._range, step))
        else:
            super().keyPressEvent(event)

    def _paint_scale(self, painter: QPainter) -> None:
        axis, levels, theme = self._axis, self._range, self._theme
        table = colour_table(self._colours)
        paint_colour_scale(painter, self._ramp(), axis, levels, table, theme, self._quantity)

    def _new_handle(self, name: str, words: str, change_end: Change) -> RangeHandle:
        handle = RangeHandle(name, words, self)
        end = 1 if change_end is with_high else 0

        def pull(by_db: Range, pulled_db: float) -> Range:
            return change_end(by_db, by_db[end] + pulled_db)

        handle.pressed.connect(self._start_drag)
        handle.released.connect(self._end_drag)
        handle.pulled.connect(lambda px: self._drag(pull, px))
        handle.stepped.connect(lambda db: self.range_chosen.emit(pull(self._range, db)))
        return handle

    def _start_drag(self) -> None:
        self._at_press = self._range

    def _drag(self, change: Change, up_px: float) -> None:
        if self._at_press is None:
            return
        low, high = self._axis
        by_db = round(up_px * (high - low) / self._ramp().height(), 1)
        if by_db or self._range != self._at_press:
            low, high = change(self._at_press, by_db)
            self.range_chosen.emit((round(low, 1), round(high, 1)))

    def _end_drag(self) -> None:
        self._at_press = None
        self._axis = _axis_of(self._range)
        self._place_handles()

    def _mark_at(self, level_db: float) -> QPolygonF:
        """A triangle beside the ramp."""
        ramp = self._ramp()
        y = min(max(level_y(level_db, self._axis, ramp), ramp.top()), ramp.bottom())
        tip, back = ramp.left() - 1, ramp.left() - 8
        return QPolygonF([QPointF(tip, y), QPointF(back, y - 4), QPointF(back, y + 4)])

    def _ramp(self) -> QRectF:
        height = self.height() - 2 * _END_PX
        return QRectF(_RAMP_LEFT, _END_PX, _RAMP_WIDTH, max(height, 1))

    def _place_handles(self) -> None:
        ramp = self._ramp()
        left = round(ramp.center().x() - _HANDLE_WIDTH / 2)
        for handle, level in ((self.low, self._range[0]), (self.high, self._range[1])):
            y = level_y(level, self._axis, ramp)
            y = min(max(y, ramp.top()), ramp.bottom())
            handle.move(left, round(y - _HANDLE_HEIGHT / 2))
        self.update()


def _axis_of(range_db: Range) -> Range:
    """Levels of the ends of the scale."""
    low, high = range_db
    beyond = max(_BEYOND * (high - low), 2.0)
    return low - beyond, high + beyond


def key_step_db(event: QKeyEvent) -> float:
    """Step that a key asks for, dB; 0 for none."""
    if not meant("colour_bar", event):
        return 0.0
    step = _KEY_STEPS_DB[Qt.Key(event.key())]
    if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
        return step / 10
    if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
        return step * 5
    return step
