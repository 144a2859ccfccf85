"""The colour bar of the skin map: a scale whose ends are dragged or typed, or follow the design."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from math import floor, log10

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFontMetrics,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolButton, QVBoxLayout, QWidget

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
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.keys import meaning_of
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, letter_scale, tabular


class AutoButton(QToolButton):
    """A button that is down while the range follows the design.

    Parameters
    ----------
    name, title, hint
        Its `objectName`, its accessible name, and its tooltip.
    """

    def __init__(self, name: str, title: str, hint: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.setText("Auto")
        self.setAccessibleName(title)
        self.setToolTip(hint)
        self.setCheckable(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)


# Distance of the numbers from the colours, in lines of text: farther than handles reach.
_TEXT_LINES = 0.8


def level_y(level_db: float, axis_db: LevelRange, ramp: QRectF) -> float:
    """Return the screen height of a level on a scale whose ``ramp`` spans ``axis_db``."""
    low, high = axis_db
    return ramp.bottom() - (level_db - low) / (high - low) * ramp.height()


def paint_colour_scale(
    painter: QPainter,
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
    painter.fillRect(ramp, QColor(int(table[0])))
    painter.fillRect(
        QRectF(ramp.left(), ramp.top(), ramp.width(), top - ramp.top()), QColor(int(table[-1]))
    )
    column = np.ascontiguousarray(table[::-1])
    image = QImage(column.data, 1, len(column), 4, QImage.Format.Format_RGB32)
    painter.drawImage(QRectF(ramp.left(), top, ramp.width(), bottom - top), image)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.drawRect(ramp)
    widest = 0
    for level in _ticks(axis_db, ramp.height(), 2.8 * line, quantity):
        y = level_y(level, axis_db, ramp)
        text = minus(f"{level:g}")
        widest = max(widest, painter.fontMetrics().horizontalAdvance(text))
        painter.setPen(QPen(QColor(theme.dim), 1))
        painter.drawLine(QPointF(ramp.right(), y), QPointF(ramp.right() + 0.3 * line, y))
        painter.setPen(QColor(theme.text))
        beside = QRectF(ramp.right() + _TEXT_LINES * line, y - line / 2, 4 * line, line)
        painter.drawText(beside, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)
    _paint_title(painter, ramp, ramp.right() + (_TEXT_LINES + 0.4) * line + widest, theme, quantity)


def fitting_title(quantity: MapQuantity, metrics: QFontMetrics, room_px: int) -> str:
    """Return the longest title that fits, else the shortest one, elided."""
    titles = quantity.titles
    fitting = (title for title in titles if metrics.horizontalAdvance(title) <= room_px)
    shortest = metrics.elidedText(titles[-1], Qt.TextElideMode.ElideRight, room_px)
    return next(fitting, shortest)


def _paint_title(
    painter: QPainter, ramp: QRectF, left: float, theme: Theme, quantity: MapQuantity
) -> None:
    line = painter.fontMetrics().height()
    painter.save()
    painter.setPen(QColor(theme.dim))
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


class PulledRange:
    """A range that is dragged; the ends of its scale stay where they are meanwhile.

    Attributes
    ----------
    range_db
        The range.
    axis_db
        Levels of the ends of the scale.
    """

    def __init__(self, range_db: LevelRange) -> None:
        self.range_db, self.axis_db = range_db, _axis_of(range_db)
        self._held: LevelRange | None = None

    def show(self, range_db: LevelRange) -> None:
        """Take over another range."""
        self.range_db = range_db
        if self._held is None:
            self.axis_db = _axis_of(range_db)

    def hold(self) -> None:
        """Begin to drag."""
        self._held = self.range_db

    def pulled(self, change: Change, part: float) -> LevelRange | None:
        """Return the dragged range, in steps of 0.1 dB; None: it is not held, or stays.

        Parameters
        ----------
        change
            Returns the dragged range.
        part
            How far up it was dragged since it is held, as a share of the scale.
        """
        if self._held is None:
            return None
        low, high = self.axis_db
        by_db = round(part * (high - low), 1)
        if not by_db and self.range_db == self._held:
            return None
        low, high = change(self._held, by_db)
        return round(low, 1), round(high, 1)

    def release(self) -> None:
        """End the drag, and fit the ends of the scale to the range."""
        self._held = None
        self.axis_db = _axis_of(self.range_db)


def _axis_of(range_db: LevelRange) -> LevelRange:
    low, high = range_db
    beyond = max(_BEYOND * (high - low), _LEAST_BEYOND_DB)
    return low - beyond, high + beyond


HANDLE_WIDTH, HANDLE_HEIGHT = 26, 12
_KEY_STEPS_DB = {
    Qt.Key.Key_Up: 1.0,
    Qt.Key.Key_Right: 1.0,
    Qt.Key.Key_Down: -1.0,
    Qt.Key.Key_Left: -1.0,
    Qt.Key.Key_PageUp: 10.0,
    Qt.Key.Key_PageDown: -10.0,
}


class RangeHandle(QWidget):
    """One end of the range: dragged, or moved with the arrow keys."""

    #: Distance upwards since the press, px.
    pulled = Signal(float)
    pressed = Signal()
    released = Signal()
    #: A step by a key, dB.
    stepped = Signal(float)

    def __init__(self, name: str, title: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._grip: QPoint | None = None
        self.setObjectName(name)
        self.setAccessibleName(title)
        self.setToolTip(f"{title}: drag, or arrow keys (Ctrl: 0.1 dB)")
        self.setFixedSize(HANDLE_WIDTH, HANDLE_HEIGHT)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.SizeVerCursor)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = current_theme().accent if self.hasFocus() else current_theme().dim
        painter.setPen(QPen(QColor(edge), 2.0 if self.hasFocus() else 1.2))
        painter.setBrush(QColor(current_theme().raised))
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


def key_step_db(event: QKeyEvent) -> float:
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


class ColourStrip(QWidget):
    """A colour scale with a handle at either end; dragging between them moves both.

    It shows a range and emits which range the user chooses.
    """

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._colours = VIRIDIS
        self._pulled = PulledRange(SILENT_RANGE)
        self._marks: tuple[tuple[float, int], ...] = ()
        self._quantity = MapQuantity()
        self._grip_y: float | None = None
        self._scale = CachedPicture()
        self.setObjectName("colour_strip")
        self.setAccessibleName("Range of the colours")
        self.setToolTip("Drag to move the range, double-click for the automatic one")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(70)
        # It paints all of its area, so that nothing behind it has to be painted.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.high = self._new_handle("range_high", "Level of the highest colour", with_high)
        self.low = self._new_handle("range_low", "Level of the lowest colour", with_low)

    def sizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        return QSize(_RAMP_LEFT + _RAMP_WIDTH + round(3.6 * line), 200)

    def minimumSizeHint(self) -> QSize:
        return QSize(self.sizeHint().width(), 70)

    def show_range(self, range_db: LevelRange) -> None:
        """Show a range; the scale stays where it is while a handle is dragged."""
        if range_db != self._pulled.range_db:
            self._pulled.show(range_db)
            self._place_handles()

    def show_marks(self, marks: tuple[tuple[float, int], ...]) -> None:
        """Show levels of selected outputs, each in its colour."""
        if marks != self._marks:
            # Only the column of marks is painted again.
            self._marks = marks
            left = self._ramp().left()
            self.update(QRectF(left - 9, 0, 9, self.height()).toAlignedRect())

    def show_quantity(self, quantity: MapQuantity, colours: str = VIRIDIS) -> None:
        """Say what the levels are, and in which colours."""
        # The strip looks the same at each instant.
        quantity = replace(quantity, time_s=0.0)
        if (quantity, colours) != (self._quantity, self._colours):
            self._quantity, self._colours = quantity, colours
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = current_theme()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(tabular(small_font(self.font())))
        ramp = self._ramp()
        pulled = self._pulled
        scale = (pulled.axis_db, pulled.range_db, theme, self._quantity, self._colours)
        ground = self.palette().window().color()
        self._scale.paint(painter, QRectF(self.rect()), scale, self._paint_scale, ground)
        painter.setPen(QPen(QColor(theme.base), 0.5))
        for level, rank in self._marks:
            painter.setBrush(theme.output_colour(rank))
            painter.drawPolygon(self._mark_at(level))
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(theme.accent), 2))
            painter.drawRect(ramp.adjusted(-1, -1, 1, 1))
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_handles()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._grip_y = event.position().y()
            self._pulled.hold()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip_y is not None:
            self._pull(moved, self._grip_y - event.position().y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._grip_y = None
        self._let_go()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.range_chosen.emit(None)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = key_step_db(event)
        if step:
            self.range_chosen.emit(moved(self._pulled.range_db, step))
        else:
            super().keyPressEvent(event)

    def _paint_scale(self, painter: QPainter) -> None:
        axis, levels, theme = self._pulled.axis_db, self._pulled.range_db, current_theme()
        table = colour_table(self._colours)
        paint_colour_scale(painter, self._ramp(), axis, levels, table, theme, self._quantity)

    def _new_handle(self, name: str, title: str, change_end: Change) -> RangeHandle:
        handle = RangeHandle(name, title, self)
        end = 1 if change_end is with_high else 0

        def pull(by_db: LevelRange, pulled_db: float) -> LevelRange:
            return change_end(by_db, by_db[end] + pulled_db)

        handle.pressed.connect(self._pulled.hold)
        handle.released.connect(self._let_go)
        handle.pulled.connect(lambda px: self._pull(pull, px))
        handle.stepped.connect(lambda db: self.range_chosen.emit(pull(self._pulled.range_db, db)))
        return handle

    def _pull(self, change: Change, up_px: float) -> None:
        dragged_to = self._pulled.pulled(change, up_px / self._ramp().height())
        if dragged_to is not None:
            self.range_chosen.emit(dragged_to)

    def _let_go(self) -> None:
        self._pulled.release()
        self._place_handles()

    def _mark_at(self, level_db: float) -> QPolygonF:
        """Return a triangle beside the ramp."""
        ramp = self._ramp()
        y = min(max(level_y(level_db, self._pulled.axis_db, ramp), ramp.top()), ramp.bottom())
        tip, back = ramp.left() - 1, ramp.left() - 8
        return QPolygonF([QPointF(tip, y), QPointF(back, y - 4), QPointF(back, y + 4)])

    def _ramp(self) -> QRectF:
        height = self.height() - 2 * _END_PX
        return QRectF(_RAMP_LEFT, _END_PX, _RAMP_WIDTH, max(height, 1))

    def _place_handles(self) -> None:
        ramp = self._ramp()
        left = round(ramp.center().x() - HANDLE_WIDTH / 2)
        for handle, level in zip((self.low, self.high), self._pulled.range_db, strict=True):
            y = level_y(level, self._pulled.axis_db, ramp)
            y = min(max(y, ramp.top()), ramp.bottom())
            handle.move(left, round(y - HANDLE_HEIGHT / 2))
        self.update()


def _level_field(name: str, label: str, limits_db: LevelRange, parent: QWidget) -> NumberField:
    lowest_db, highest_db = limits_db
    spec = NumberSpec(label=label, unit="dB", minimum=lowest_db, maximum=highest_db, step=1.0)
    field = NumberField(spec, parent, widest_unit="dB")
    field.setObjectName(name)
    return field


# Smallest height of the strip, for letters of the usual size.
_STRIP_PX = 40


class ColourBar(QWidget):
    """A colour scale with fields for its ends and a switch for the automatic range."""

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._chosen: LevelRange | None = None
        self.range_db: LevelRange = SILENT_RANGE
        self.strip = ColourStrip(self)
        high_db = LOWEST_DB + SMALLEST_SPAN_DB, HIGHEST_DB
        low_db = LOWEST_DB, HIGHEST_DB - SMALLEST_SPAN_DB
        self.high_field = _level_field(
            "range_high_field", "Level of the highest colour", high_db, self
        )
        self.low_field = _level_field("range_low_field", "Level of the lowest colour", low_db, self)
        self.auto_button = AutoButton(
            "range_auto",
            "Automatic range",
            f"The range follows the loudest output: {MAP_RANGE_DB:g} dB, "
            f"up to the next {MAP_ROUND_TO_DB:g} dB",
            self,
        )
        self.auto_button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(UNIT_PX // 2)
        layout.addWidget(self.high_field)
        layout.addWidget(self.strip, 1)
        layout.addWidget(self.low_field)
        layout.addWidget(self.auto_button)
        for field in (self.high_field, self.low_field):
            field.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
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

    def resizeEvent(self, event: QResizeEvent) -> None:
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
        self._chosen = range_db
        self.auto_button.setChecked(range_db is None)
        self._show(self.range_db if range_db is None else range_db)

    def follow(self, levels_db: NDArray[np.float64]) -> None:
        """Let the automatic range follow the levels of all outputs."""
        if self._chosen is None:
            self._show(map_range_db(levels_db))

    def show_marks(self, marks: tuple[tuple[float, int], ...]) -> None:
        """Show levels of selected outputs, each in its colour."""
        self.strip.show_marks(marks)

    def _show(self, range_db: LevelRange) -> None:
        self.range_db = range_db
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
