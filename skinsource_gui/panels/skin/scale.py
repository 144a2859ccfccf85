"""The colour bar of the skin map: a scale whose ends are dragged or typed, or follow the design."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from math import floor, log10

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal

from skinsource.signals.map_range import MAP_RANGE_DB, MAP_ROUND_TO_DB, map_range_db
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.skin.painting import small_font
from skinsource_gui.panels.skin.settings import (
    HIGHEST_DB,
    LOWEST_DB,
    SILENT_RANGE,
    SMALLEST_SPAN_DB,
    LevelRange,
    MapQuantity,
    moved,
    pushed_high,
    pushed_low,
    tick_levels,
    with_high,
    with_low,
)
from skinsource_gui.plots.colour_maps import VIRIDIS, colour_table
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.keys import meaning_of
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, letter_scale, tabular


def auto_button(
    parent: QtWidgets.QWidget, name: str, title: str, hint: str
) -> QtWidgets.QToolButton:
    """Return a button that is down while the range follows the design."""
    button = tool_button(parent, name, "Auto", hint, checkable=True)
    button.setAccessibleName(title)
    button.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
    return button


# Distance of the numbers from the colours, in lines of text: farther than handles reach.
_TEXT_LINES = 0.8


def level_y(level_db: float, axis_db: LevelRange, ramp: QRectF) -> float:
    """Return the screen height of a level on a scale whose ``ramp`` spans ``axis_db``."""
    low, high = axis_db
    return ramp.bottom() - (level_db - low) / (high - low) * ramp.height()


def paint_colour_scale(
    painter: QtGui.QPainter,
    ramp: QRectF,
    axis_db: LevelRange,
    range_db: LevelRange,
    table: NDArray[np.uint32],
    theme: Theme,
    quantity: MapQuantity,
) -> None:
    """Draw the colours in ``ramp``, ticks and title to its right, in the painter's font.

    Parameters
    ----------
    painter
        Its font is that of the ticks.
    ramp
        Area of the colours.
    axis_db
        Levels of its lower and upper edge; values, where ``quantity`` is no level.
    range_db
        Levels of the lowest and the highest colour.
    table, theme
        Colours.
    quantity
        What the values are.
    """
    line = painter.fontMetrics().height()
    top, bottom = (level_y(level, axis_db, ramp) for level in reversed(range_db))
    painter.fillRect(ramp, QtGui.QColor(int(table[0])))
    painter.fillRect(
        QRectF(ramp.left(), ramp.top(), ramp.width(), top - ramp.top()),
        QtGui.QColor(int(table[-1])),
    )
    column = np.ascontiguousarray(table[::-1])
    image = QtGui.QImage(column.data, 1, len(column), 4, QtGui.QImage.Format.Format_RGB32)
    painter.drawImage(QRectF(ramp.left(), top, ramp.width(), bottom - top), image)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.drawRect(ramp)
    widest = 0
    for level in _ticks(axis_db, ramp.height(), 2.8 * line, quantity):
        y = level_y(level, axis_db, ramp)
        text = minus(f"{level:g}")
        widest = max(widest, painter.fontMetrics().horizontalAdvance(text))
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.dim), 1))
        painter.drawLine(QPointF(ramp.right(), y), QPointF(ramp.right() + 0.3 * line, y))
        painter.setPen(QtGui.QColor(theme.text))
        beside = QRectF(ramp.right() + _TEXT_LINES * line, y - line / 2, 4 * line, line)
        painter.drawText(beside, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)
    _paint_title(painter, ramp, ramp.right() + (_TEXT_LINES + 0.4) * line + widest, theme, quantity)


def fitting_title(quantity: MapQuantity, metrics: QtGui.QFontMetrics, room_px: int) -> str:
    """Return the longest title that fits, else the shortest one, elided."""
    titles = quantity.titles
    fitting = (title for title in titles if metrics.horizontalAdvance(title) <= room_px)
    shortest = metrics.elidedText(titles[-1], Qt.TextElideMode.ElideRight, room_px)
    return next(fitting, shortest)


def _paint_title(
    painter: QtGui.QPainter, ramp: QRectF, left: float, theme: Theme, quantity: MapQuantity
) -> None:
    line = painter.fontMetrics().height()
    painter.save()
    painter.setPen(QtGui.QColor(theme.dim))
    painter.translate(left + line / 2, ramp.center().y())
    painter.rotate(-90)
    title = fitting_title(quantity, painter.fontMetrics(), int(ramp.height()))
    along = QRectF(-ramp.height() / 2, -line / 2, ramp.height(), line)
    painter.drawText(along, Qt.AlignmentFlag.AlignCenter, title)
    painter.restore()


def _ticks(
    axis: LevelRange, room_px: float, spacing_px: float, quantity: MapQuantity
) -> list[float]:
    if not quantity.signed:
        return tick_levels(*axis, room_px, spacing_px)
    # Steps of levels are whole decibels; here any power of ten is possible.
    scale = 10.0 ** (floor(log10(axis[1] - axis[0])) - 1)
    ticks = tick_levels(axis[0] / scale, axis[1] / scale, room_px, spacing_px)
    return [tick * scale for tick in ticks]


#: Returns a range that was dragged by some dB.
Change = Callable[[LevelRange, float], LevelRange]

# The scale extends this share of its range beyond either end, so that handles can be dragged out.
_BEYOND, _LEAST_BEYOND_DB = 0.12, 2.0


def _axis_of(range_db: LevelRange) -> LevelRange:
    """Return the ends of the scale on which a range is shown."""
    low, high = range_db
    beyond = max(_BEYOND * (high - low), _LEAST_BEYOND_DB)
    return low - beyond, high + beyond


def _low_moved(range_db: LevelRange, by_db: float) -> LevelRange:
    return with_low(range_db, range_db[0] + by_db)


def _high_moved(range_db: LevelRange, by_db: float) -> LevelRange:
    return with_high(range_db, range_db[1] + by_db)


HANDLE_WIDTH, HANDLE_HEIGHT = 26, 12
_KEY_STEPS_DB = {
    Qt.Key.Key_Up: 1.0,
    Qt.Key.Key_Right: 1.0,
    Qt.Key.Key_Down: -1.0,
    Qt.Key.Key_Left: -1.0,
    Qt.Key.Key_PageUp: 10.0,
    Qt.Key.Key_PageDown: -10.0,
}


class RangeHandle(QtWidgets.QWidget):
    """One end of the range of a strip: dragged, or moved with the arrow keys.

    Parameters
    ----------
    change
        Moves this end.
    """

    def __init__(self, name: str, title: str, change: Change, strip: "ColourStrip") -> None:
        super().__init__(strip)
        self._change, self._strip = change, strip
        self.setObjectName(name)
        self.setAccessibleName(title)
        self.setToolTip(f"{title}: drag, or arrow keys (Ctrl: 0.1 dB)")
        self.setFixedSize(HANDLE_WIDTH, HANDLE_HEIGHT)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.SizeVerCursor)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        edge = current_theme().accent if self.hasFocus() else current_theme().dim
        painter.setPen(QtGui.QPen(QtGui.QColor(edge), 2.0 if self.hasFocus() else 1.2))
        painter.setBrush(QtGui.QColor(current_theme().raised))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1.5, 2, -1.5, -2), 3, 3)
        painter.drawLine(QPointF(9, self.height() / 2), QPointF(17, self.height() / 2))
        painter.end()

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._strip.hold(event)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self._strip.pull(event, self._change)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self._strip.release()

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if not self._strip.step(event, self._change):
            super().keyPressEvent(event)


def key_step_db(event: QtGui.QKeyEvent) -> float:
    """Return the step of a key, dB; 0 for none."""
    if not meaning_of("colour_bar", event):
        return 0.0
    step = _KEY_STEPS_DB[Qt.Key(event.key())]
    if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
        return step / 10
    if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
        return step * 5
    return step


_RAMP_LEFT, _RAMP_WIDTH = 10, 14
_END_PX = 8


class ColourStrip(QtWidgets.QWidget):
    """A colour scale with a handle at either end; dragging between them moves both.

    It shows a range and emits which range the user chooses.
    """

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._colours = VIRIDIS
        self.range_db, self._axis_db = SILENT_RANGE, _axis_of(SILENT_RANGE)
        # The range at the press, and where that was on the screen, while it is dragged.
        self._held: tuple[LevelRange, float] | None = None
        self._marks: tuple[tuple[float, int], ...] = ()
        self._quantity = MapQuantity()
        self._scale = CachedPicture()
        self.setObjectName("colour_strip")
        self.setAccessibleName("Range of the colours")
        self.setToolTip("Drag to move the range, double-click for the automatic one")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(70)
        # It paints all of its area, so that nothing behind it has to be painted.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.high = RangeHandle("range_high", "Level of the highest colour", _high_moved, self)
        self.low = RangeHandle("range_low", "Level of the lowest colour", _low_moved, self)

    def sizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        return QSize(_RAMP_LEFT + _RAMP_WIDTH + round(3.6 * line), 200)

    def minimumSizeHint(self) -> QSize:
        return QSize(self.sizeHint().width(), 70)

    def show_range(self, range_db: LevelRange) -> None:
        """Show a range; the scale stays where it is while a handle is dragged."""
        if range_db != self.range_db:
            self.range_db = range_db
            if self._held is None:
                self._axis_db = _axis_of(range_db)
            self._place_handles()

    def show_marks(self, marks: tuple[tuple[float, int], ...]) -> None:
        """Show levels of selected outputs, each in its colour."""
        if marks != self._marks:
            # Only the marks are painted again, where they were and where they are.
            levels = [level for level, _ in (*self._marks, *marks)]
            self._marks = marks
            lowest, highest = (self._mark_at(of(levels)).boundingRect() for of in (min, max))
            self.update(lowest.united(highest).adjusted(-1, -1, 1, 1).toAlignedRect())

    def show_quantity(self, quantity: MapQuantity, colours: str = VIRIDIS) -> None:
        """Say what the levels are, and in which colours."""
        # The strip looks the same at each instant.
        quantity = replace(quantity, time_s=0.0)
        if (quantity, colours) != (self._quantity, self._colours):
            self._quantity, self._colours = quantity, colours
            self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme = current_theme()
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setFont(tabular(small_font(self.font())))
        ramp = self._ramp()
        scale = (self._axis_db, self.range_db, theme, self._quantity, self._colours)
        ground = self.palette().window().color()
        self._scale.paint(painter, QRectF(self.rect()), scale, self._paint_scale, ground)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.base), 0.5))
        for level, rank in self._marks:
            painter.setBrush(theme.output_colour(rank))
            painter.drawPolygon(self._mark_at(level))
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 2))
            painter.drawRect(ramp.adjusted(-1, -1, 1, 1))
        painter.end()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_handles()

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.hold(event)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self.pull(event, moved)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self.release()

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        self.range_chosen.emit(None)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if not self.step(event, moved):
            super().keyPressEvent(event)

    def hold(self, event: QtGui.QMouseEvent) -> None:
        """Begin to drag."""
        self._held = self.range_db, event.globalPosition().y()

    def pull(self, event: QtGui.QMouseEvent, change: Change) -> None:
        """Drag the range that is held, in steps of 0.1 dB."""
        if self._held is None:
            return
        held, pressed_y = self._held
        low, high = self._axis_db
        part = (pressed_y - event.globalPosition().y()) / self._ramp().height()
        by_db = round(part * (high - low), 1)
        if by_db or self.range_db != held:
            low, high = change(held, by_db)
            self.range_chosen.emit((round(low, 1), round(high, 1)))

    def release(self) -> None:
        """End the drag, and fit the ends of the scale to the range."""
        self._held, self._axis_db = None, _axis_of(self.range_db)
        self._place_handles()

    def step(self, event: QtGui.QKeyEvent, change: Change) -> bool:
        """Change the range by the step of a key; return whether the key has one."""
        step_db = key_step_db(event)
        if step_db:
            self.range_chosen.emit(change(self.range_db, step_db))
        return bool(step_db)

    def _paint_scale(self, painter: QtGui.QPainter) -> None:
        axis, table = self._axis_db, colour_table(self._colours)
        paint_colour_scale(
            painter, self._ramp(), axis, self.range_db, table, current_theme(), self._quantity
        )

    def _mark_at(self, level_db: float) -> QtGui.QPolygonF:
        """Return a triangle beside the ramp."""
        ramp = self._ramp()
        y = min(max(level_y(level_db, self._axis_db, ramp), ramp.top()), ramp.bottom())
        tip, back = ramp.left() - 1, ramp.left() - 8
        return QtGui.QPolygonF([QPointF(tip, y), QPointF(back, y - 4), QPointF(back, y + 4)])

    def _ramp(self) -> QRectF:
        height = self.height() - 2 * _END_PX
        return QRectF(_RAMP_LEFT, _END_PX, _RAMP_WIDTH, max(height, 1))

    def _place_handles(self) -> None:
        ramp = self._ramp()
        left = round(ramp.center().x() - HANDLE_WIDTH / 2)
        for handle, level in zip((self.low, self.high), self.range_db, strict=True):
            y = level_y(level, self._axis_db, ramp)
            y = min(max(y, ramp.top()), ramp.bottom())
            handle.move(left, round(y - HANDLE_HEIGHT / 2))
        self.update()


def _level_field(
    name: str, label: str, limits_db: LevelRange, parent: QtWidgets.QWidget
) -> NumberField:
    lowest_db, highest_db = limits_db
    spec = NumberSpec(label=label, unit="dB", minimum=lowest_db, maximum=highest_db, step=1.0)
    field = NumberField(spec, parent, widest_unit="dB")
    field.setObjectName(name)
    return field


# Smallest height of the strip, for letters of the usual size.
_STRIP_PX = 40


class ColourBar(QtWidgets.QWidget):
    """A colour scale with fields for its ends and a switch for the automatic range."""

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.strip = ColourStrip(self)
        high_db = LOWEST_DB + SMALLEST_SPAN_DB, HIGHEST_DB
        low_db = LOWEST_DB, HIGHEST_DB - SMALLEST_SPAN_DB
        self.high_field = _level_field(
            "range_high_field", "Level of the highest colour", high_db, self
        )
        self.low_field = _level_field("range_low_field", "Level of the lowest colour", low_db, self)
        self.auto_button = auto_button(
            self,
            "range_auto",
            "Automatic range",
            f"The range follows the loudest output: {MAP_RANGE_DB:g} dB, "
            f"up to the next {MAP_ROUND_TO_DB:g} dB",
        )
        layout = QtWidgets.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(UNIT_PX // 2)
        layout.addWidget(self.high_field)
        layout.addWidget(self.strip, 1)
        layout.addWidget(self.low_field)
        layout.addWidget(self.auto_button)
        for field in (self.high_field, self.low_field):
            field.setSizePolicy(
                QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed
            )
        order = (
            self.high_field,
            self.strip,
            self.strip.high,
            self.strip.low,
            self.low_field,
            self.auto_button,
        )
        for before, after in pairwise(order):
            self.setTabOrder(before, after)
        self.setFixedWidth(self._width())
        self.strip.range_chosen.connect(self.range_chosen)
        self.high_field.edited.connect(self._choose_high)
        self.low_field.edited.connect(self._choose_low)
        self.auto_button.clicked.connect(self._switch)
        self.choose(None)

    @property
    def range_db(self) -> LevelRange:
        """Levels of the lowest and the highest colour."""
        return self.strip.range_db

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        # Where there is little room, the numbers matter more than the switch.
        fields = (self.high_field, self.low_field, self.auto_button)
        strip_px = round(_STRIP_PX * letter_scale(self.font()))
        needed = sum(part.sizeHint().height() for part in fields) + strip_px
        self.auto_button.setVisible(self.height() >= needed)

    def minimumSizeHint(self) -> QSize:
        # Without the switch, which is hidden where there is no room for it.
        parts = (self.high_field, self.strip, self.low_field)
        least = sum(part.minimumSizeHint().height() for part in parts)
        return QSize(self.width(), least + UNIT_PX)

    def event(self, event: QEvent) -> bool:
        done = super().event(event)
        # The font of the strip may change after that of the bar.
        may_widen = event.type() in (QEvent.Type.FontChange, QEvent.Type.LayoutRequest)
        if may_widen and self.width() != self._width():
            self.setFixedWidth(self._width())
        return done

    def choose(self, range_db: LevelRange | None) -> None:
        """Show a range, or the automatic one."""
        self.auto_button.setChecked(range_db is None)
        self._show(self.range_db if range_db is None else range_db)

    def follow(self, levels_db: NDArray[np.float64]) -> None:
        """Let the automatic range follow the levels of all outputs."""
        if self.auto_button.isChecked():
            self._show(map_range_db(levels_db))

    def _show(self, range_db: LevelRange) -> None:
        self.strip.show_range(range_db)
        self.low_field.set_value(round(range_db[0], 1))
        self.high_field.set_value(round(range_db[1], 1))

    def _choose_high(self, level_db: float) -> None:
        self.range_chosen.emit(pushed_high(self.range_db, level_db))

    def _choose_low(self, level_db: float) -> None:
        self.range_chosen.emit(pushed_low(self.range_db, level_db))

    def _switch(self, automatic: bool) -> None:
        self.range_chosen.emit(None if automatic else self.range_db)

    def _width(self) -> int:
        text = self.fontMetrics().horizontalAdvance("−199.9 dB")
        return max(self.strip.sizeHint().width(), text + 2 * UNIT_PX)
