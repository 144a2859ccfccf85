"""Figures that panels paint, with axes, notes, a legend of outputs, a menu and a page."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QLineF, QPoint, QPointF, QRect, QRectF, QSize, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource_gui.plots.ranges import Range, SteadyRange, Tick, log_ticks, readable_ticks
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.frames import paint_focus_frame, polygon
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import Policy, named
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, on_paper, scaled, tabular

# Letters become no smaller than this part of those around them.
_LEAST = 0.4


def shrunk(font: QtGui.QFont, texts: Sequence[str], room_px: float) -> QtGui.QFont:
    """Return ``font``, or a smaller one, in which each of ``texts`` fits without a cut."""
    widest = max((QtGui.QFontMetricsF(font).horizontalAdvance(text) for text in texts), default=0.0)
    return scaled(font, max(room_px / widest, _LEAST)) if widest > room_px else font


_MOST_LINES = 4
_BETWEEN = " · "
_FLAGS = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextWordWrap
_NO_END_PX = 100_000


class NoteLabel(QtWidgets.QLabel):
    """A dim text in as many lines as it needs, which is the tooltip, too.

    Where four lines are too few, it counts the parts, between " · ", that it leaves out.

    Attributes
    ----------
    whole
        The whole text.
    """

    def __init__(self, name: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.whole, self._held_px = "", 0
        self.setObjectName(name)
        self.setFont(tabular(self.font()))
        self.setWordWrap(True)
        self.setProperty("tone", "dim")
        policy = QtWidgets.QSizePolicy(Policy.Ignored, Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    def say(self, text: str, *, holding: bool = False) -> None:
        """Show another text; ``holding``: keep the height, so that what is above does not jump."""
        if text != self.whole:
            self.whole = text
            self.setToolTip(text)
            self.setAccessibleName(text)
        self._fit(self._held_px if holding else 0)

    def sizeHint(self) -> QSize:
        return QSize(80, self.heightForWidth(self.width()))

    def minimumSizeHint(self) -> QSize:
        return QSize(0, self._height_of(1))

    def heightForWidth(self, width: int) -> int:
        needed = min(super().heightForWidth(width), self._height_of(_MOST_LINES))
        held_px = self._held_px if width == self.width() else 0
        return max(needed, held_px, self._height_of(1))

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.oldSize().width() != event.size().width():
            self._fit(0)

    def _fit(self, held_px: int) -> None:
        """Write what has room, at least ``held_px`` high."""
        parts, text = self.whole.split(_BETWEEN), self.whole
        for count in range(len(parts) - 1, 0, -1):
            if self._lines_of(text) <= _MOST_LINES:
                break
            text = _BETWEEN.join((*parts[:count], f"+{len(parts) - count}"))
        self.setText(text)
        self._held_px = 0
        needed = self.heightForWidth(self.width())
        self._held_px = max(held_px, needed)
        self.updateGeometry()

    def _lines_of(self, text: str) -> int:
        metrics, room = self.fontMetrics(), QRect(0, 0, self.width(), _NO_END_PX)
        return round(metrics.boundingRect(room, int(_FLAGS), text).height() / metrics.lineSpacing())

    def _height_of(self, lines: int) -> int:
        metrics = self.fontMetrics()
        return metrics.height() + (lines - 1) * metrics.lineSpacing() + 2


_GAP_PX = 4.0
_TICK_X_PX, _TICK_Y_PX = 60.0, 34.0
# Height of digits, in lines of text.
_DIGITS = 0.8


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """One axis.

    Attributes
    ----------
    shown
        Values at its ends.
    title
        Title with the unit.
    factor
        Factor from values to labels.
    log
        Whether it is logarithmic; then both ends are above 0.
    """

    shown: Range
    title: str
    factor: float = 1.0
    log: bool = False

    def part(self, values: Floats) -> Floats:
        """Return how far along the axis values lie, 0 to 1; NaN where it cannot show them."""
        ends, at = np.array(self.shown, float), np.asarray(values, float)
        if self.log:
            ends = np.log(ends)
            at = np.log(at, out=np.full(at.shape, np.nan), where=at > 0.0)
        return (at - ends[0]) / (ends[1] - ends[0])

    def value(self, part: float) -> float:
        """Return the value at a part of the axis."""
        low, high = self.shown
        return float(low * (high / low) ** part) if self.log else low + part * (high - low)

    def ticks(self, length_px: float, each_px: float) -> tuple[Tick, ...]:
        """Return ticks on round numbers, about ``each_px`` apart."""
        low, high = self.shown
        airy = max(length_px / each_px, 2.0)
        if self.log:
            # Logarithmic ticks leave gaps: twice as many fit.
            ticks = log_ticks(low * self.factor, high * self.factor, 2.0 * airy)
            return tuple(replace(tick, value=tick.value / self.factor) for tick in ticks)
        return readable_ticks(low, high, airy, 2.0 * airy, self.factor)


@dataclass(frozen=True, slots=True, kw_only=True)
class Axes:
    """Two axes around a frame; y points up."""

    frame: QRectF
    x: Axis
    y: Axis

    def to_screen(self, x: Floats, y: Floats) -> Floats:
        """Return places on the screen, (n, 2)."""
        across = self.frame.left() + self.x.part(x) * self.frame.width()
        up = self.frame.bottom() - self.y.part(y) * self.frame.height()
        return np.stack(np.broadcast_arrays(across, up), axis=-1)

    def value_at(self, point: QPointF) -> tuple[float, float] | None:
        """Return x and y at a place of the screen; None outside of the frame."""
        if not self.frame.adjusted(-1, -1, 1, 1).contains(point):
            return None
        across = (point.x() - self.frame.left()) / self.frame.width()
        up = (self.frame.bottom() - point.y()) / self.frame.height()
        return self.x.value(across), self.y.value(up)

    def polygon(self, x: Floats, y: Floats) -> QtGui.QPolygonF:
        """Return a line through points."""
        return polygon(self.to_screen(x, y))

    def title_place(self, metrics: QtGui.QFontMetricsF) -> QRectF:
        """Return the area of the title of x: below the frame, and left of it if that is narrow."""
        frame, line = self.frame, metrics.height()
        room = frame.right() + 2.0 * _GAP_PX
        width = min(metrics.horizontalAdvance(self.x.title) + 1.0, room)
        left = min(frame.center().x() - width / 2, room - width)
        return QRectF(left, frame.bottom() + line + 2, width, line)

    def paint(self, painter: QtGui.QPainter, theme: Theme, *, grid: bool = True) -> None:
        """Draw frame, grid, labels and titles."""
        frame, metrics = self.frame, QtGui.QFontMetricsF(painter.font())
        line = metrics.height()
        centre = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        written = -np.inf
        for tick in self.x.ticks(frame.width(), _TICK_X_PX):
            x = float(self.to_screen(np.array([tick.value]), np.array([self.y.shown[0]]))[0, 0])
            if grid:
                painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
                painter.drawLine(QLineF(x, frame.top(), x, frame.bottom()))
            painter.setPen(QtGui.QColor(theme.dim))
            width = metrics.horizontalAdvance(tick.label)
            # Labels must not overlap.
            if tick.label and x - width / 2 > written:
                place = QRectF(x - width / 2, frame.bottom() + 2, width, line)
                painter.drawText(place, centre | Qt.TextFlag.TextDontClip, tick.label)
                written = x + width / 2 + _GAP_PX
        written = np.inf
        for tick in self.y.ticks(frame.height(), _TICK_Y_PX):
            y = float(self.to_screen(np.array([self.x.shown[0]]), np.array([tick.value]))[0, 1])
            if grid:
                painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
                painter.drawLine(QLineF(frame.left(), y, frame.right(), y))
            painter.setPen(QtGui.QColor(theme.dim))
            if tick.label and y + _DIGITS * line < written:
                place = QRectF(0.0, y - line / 2, frame.left() - _GAP_PX, line)
                painter.drawText(place, right, tick.label)
                written = y
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(frame)
        painter.setPen(QtGui.QColor(theme.dim))
        self._paint_titles(painter, line)

    def _paint_titles(self, painter: QtGui.QPainter, line: float) -> None:
        """Write titles in the middle of their axes; where these are short, beside labels too."""
        frame, metrics = self.frame, QtGui.QFontMetricsF(painter.font())
        painter.save()
        _paint_title(painter, self.title_place(metrics), self.x.title)
        painter.restore()
        painter.save()
        side = QRectF(-frame.bottom(), 1.0, frame.height(), line)
        if metrics.horizontalAdvance(self.y.title) > side.width():
            side.setLeft(-frame.bottom() - line)
            side.setRight(-_GAP_PX)
        painter.rotate(-90.0)
        _paint_title(painter, side, self.y.title)
        painter.restore()


def _paint_title(painter: QtGui.QPainter, room: QRectF, title: str) -> None:
    """Write a title, in smaller letters where it would be cut."""
    painter.setFont(shrunk(painter.font(), (title,), room.width()))
    painter.drawText(room, Qt.AlignmentFlag.AlignCenter, title)


def fitted_axes(room: QRectF, x: Axis, y: Axis, metrics: QtGui.QFontMetricsF) -> Axes:
    """Return axes in ``room``, with the space around the frame that their labels need.

    The left edge of the room is that of the widget: labels of y begin there.
    """
    line = metrics.height()
    height = max(room.height() - 2.0 * line - 3.0 * _GAP_PX, 1.0)
    labels = [tick.label for tick in y.ticks(height, _TICK_Y_PX)]
    widest = max((metrics.horizontalAdvance(label) for label in labels), default=0.0)
    left = room.left() + line + widest + 2.0 * _GAP_PX
    top = room.top() + _GAP_PX + line / 2
    width = room.right() - left - 2.0 * _GAP_PX
    for _ in range(2):  # a narrower frame may have other labels
        width = max(min(width, room.right() - left - _beyond(x, width, metrics)), 1.0)
    frame = QRectF(left, top, width, height - line / 2 - _GAP_PX)
    return Axes(frame=frame, x=x, y=y)


def _beyond(x: Axis, width: float, metrics: QtGui.QFontMetricsF) -> float:
    """Return how far the last label of x reaches beyond a frame of that width, px."""
    ticks = x.ticks(width, _TICK_X_PX)
    parts = x.part(np.array([tick.value for tick in ticks]))
    halves = (metrics.horizontalAdvance(tick.label) / 2 for tick in ticks)
    ends = (half - (1.0 - part) * width for half, part in zip(halves, parts, strict=True))
    return max(ends, default=0.0) + 1.0


def open_figure_menu(
    parent: QtWidgets.QWidget, at: QPoint, save: Callable[[], None], copy: Callable[[], None] | None
) -> QtWidgets.QMenu:
    """Open the menu of a figure; ``copy`` is None where there are no numbers to copy."""
    menu = passing_menu(parent, "figure_menu")
    if copy is not None:
        menu.addAction("Copy numbers").triggered.connect(copy)
    menu.addAction("Save picture as…").triggered.connect(save)
    menu.popup(at)
    return menu


_TEXT = 0.92
_LEAST_LINES = 6


class Figure(QtWidgets.QWidget):
    """A picture with a cursor, or a message why it is empty; subclasses draw and read it.

    Attributes
    ----------
    cursor_at
        Place of the cursor, set by the pointer or the keys; None: there is no cursor.
    axes
        The axes in which keys move the cursor; None: they do not, or nothing is drawn yet.
    steady_range
        What holds the range of its levels, where it is held.
    """

    #: What the cursor reads; "" without a cursor.
    reading = Signal(str)

    def __init__(self, name: str, accessible_name: str) -> None:
        super().__init__()
        self.cursor_at: QPointF | None = None
        self.axes: Axes | None = None
        self.message, self.steady_range = "", SteadyRange()
        named(self, name, accessible_name)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)

    def minimumSizeHint(self) -> QSize:
        # Some of the frame is left between letters of any size.
        return QSize(200, max(120, _LEAST_LINES * self.fontMetrics().height()))

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        """Draw the picture in ``room``."""
        raise NotImplementedError

    def read(self, at: QPointF) -> str:
        """Return what the cursor reads at a place; "" for nothing."""
        return ""

    def keys_area(self) -> QRectF:
        """Return the area in which keys move the cursor; empty: they do not."""
        return QRectF() if self.axes is None or self.message else self.axes.frame

    def say(self, message: str) -> None:
        """Show ``message`` instead of the picture; "" shows the picture, and reads it again."""
        self.message = message
        self.setAccessibleDescription(message)
        self.move_cursor(self.cursor_at)

    def move_cursor(self, at: QPointF | None) -> None:
        """Read another place, or none."""
        text = "" if at is None or self.message else self.read(at)
        self.cursor_at = at if text else None
        self.reading.emit(text)
        self.update()

    def paint(self, painter: QtGui.QPainter, room: QRectF) -> None:
        """Draw the picture or the message, on the screen or on a page."""
        if self.message:
            painter.setPen(QtGui.QColor(current_theme().dim))
            inner = room.adjusted(2 * UNIT_PX, UNIT_PX, -2 * UNIT_PX, -UNIT_PX)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(inner, flags, self.message)
            return
        painter.setFont(scaled(tabular(self.font()), _TEXT))
        self.draw(painter, room)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        room = QRectF(self.rect())
        painter.fillRect(room, QtGui.QColor(current_theme().base))
        self.paint(painter, room)
        if self.hasFocus():
            paint_focus_frame(painter, room, current_theme())

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._meaning_of) or super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        meaning, area = self._meaning_of(event), self.keys_area()
        if not meaning:
            super().keyPressEvent(event)
            return
        at = self.cursor_at or area.center()
        if meaning == "give_up":
            self.move_cursor(None)
        elif meaning == "jump":
            end = area.left() if event.key() == Qt.Key.Key_Home else area.right()
            self.move_cursor(QPointF(end, at.y()))
        else:
            far = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            step = 10.0 if far else 1.0
            across = at.x() + (step if event.key() == Qt.Key.Key_Right else -step)
            self.move_cursor(QPointF(min(max(across, area.left()), area.right()), at.y()))

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self.move_cursor(event.position())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.move_cursor(None)

    def _meaning_of(self, event: QtGui.QKeyEvent) -> str:
        meaning = meaning_of("plot", event)
        if meaning not in ("step", "jump", "give_up") or self.keys_area().isEmpty():
            return ""
        return meaning if meaning != "give_up" or self.cursor_at is not None else ""


def draw_figure(
    painter: QtGui.QPainter, room: QRectF, figure: Figure, above: str, below: str
) -> None:
    """Draw a figure on a page, with the texts above and below it, in ``room``."""
    painter.save()
    painter.fillRect(room, QtGui.QColor(current_theme().base))
    painter.setFont(tabular(figure.font()))
    inner = room.adjusted(UNIT_PX, 1.0, -UNIT_PX, -2.0)
    top = inner.top() + _write(painter, inner, above, Qt.AlignmentFlag.AlignTop, figure)
    bottom = inner.bottom() - _write(painter, inner, below, Qt.AlignmentFlag.AlignBottom, figure)
    painter.translate(room.left(), top)
    # Figures draw from the corner of their widget.
    cursor_at, figure.cursor_at = figure.cursor_at, None
    with on_paper():
        figure.paint(painter, QRectF(0.0, 0.0, room.width(), max(bottom - top, 1.0)))
    figure.cursor_at = cursor_at
    painter.restore()
    # The next painting on the screen places its parts there again.
    figure.update()


def _write(
    painter: QtGui.QPainter, room: QRectF, text: str, side: Qt.AlignmentFlag, figure: Figure
) -> float:
    """Write text at a side of a room; return its height."""
    if not text:
        return 0.0
    flags = int(Qt.AlignmentFlag.AlignLeft | side | Qt.TextFlag.TextWordWrap)
    endless = QRectF(0.0, 0.0, room.width(), _NO_END_PX)
    painter.setPen(QtGui.QColor(current_theme().dim))
    painter.drawText(room, flags, text)
    return painter.boundingRect(endless, flags, text).height()


# Thickness and length of the strokes of a legend, and the gap beside them.
_STROKE_PX, _WIDE_PX, _LEGEND_GAP_PX = 3.0, 12.0, 5.0


def legend_texts(outputs: tuple[int, ...], room_px: float, painter: QtGui.QPainter) -> list[str]:
    """Return the texts of a legend: head, numbers of outputs, and how many more do not fit."""
    head = "Output" if len(outputs) == 1 else "Outputs"
    numbers = [str(output) for output in outputs]
    for count in range(len(numbers), 0, -1):
        left = len(numbers) - count
        texts = [head, *numbers[:count], *([f"+{left}"] if left else [])]
        if _legend_px(texts, painter) <= room_px:
            return texts
    return numbers[:1]


def draw_legend(
    painter: QtGui.QPainter,
    room: QRectF,
    outputs: tuple[int, ...],
    theme: Theme,
    *,
    broken: bool = False,
) -> None:
    """Draw a legend: numbers of outputs in one line, each after a stroke of its colour.

    ``broken``: where colours repeat, lines of the figure are dashed, and so are these strokes.
    """
    metrics, at = painter.fontMetrics(), room.left()
    texts = legend_texts(outputs, room.width(), painter)
    ranks = dict(zip(map(str, outputs), range(len(outputs)), strict=True))
    for word in texts:
        if word in ranks:
            rank = ranks[word] if broken else ranks[word] % len(theme.outputs)
            pen = theme.output_pen(rank, _STROKE_PX)
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
            painter.setPen(pen)
            painter.drawLine(QLineF(at, room.center().y(), at + _WIDE_PX, room.center().y()))
            at += _WIDE_PX + _LEGEND_GAP_PX
        width = float(metrics.horizontalAdvance(word))
        painter.setPen(QtGui.QColor(theme.text))
        painter.drawText(
            QRectF(at, room.top(), width + 1.0, room.height()), Qt.AlignmentFlag.AlignVCenter, word
        )
        at += width + 2.0 * _LEGEND_GAP_PX


def _legend_px(texts: list[str], painter: QtGui.QPainter) -> float:
    metrics = painter.fontMetrics()
    strokes = (_WIDE_PX + _LEGEND_GAP_PX) * sum(word.isdigit() for word in texts)
    return strokes + sum(metrics.horizontalAdvance(word) + 2.0 * _LEGEND_GAP_PX for word in texts)
