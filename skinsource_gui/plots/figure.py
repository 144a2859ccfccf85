"""Words that are written smaller where there is too little room for them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QEvent, QLineF, QPoint, QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource_gui.plots.ranges import Range, Tick, log_ticks, readable_ticks
from skinsource_gui.qt.frames import paint_focus_frame
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.overlays import PALE, paint_updating
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, on_paper, scaled, tabular

# No smaller than that part of the letters around them.
_LEAST = 0.4


def shrunk(font: QFont, words: Sequence[str], room_px: float) -> QFont:
    """The font, or a smaller one, in which each of some words has room: numbers are not cut."""
    widest = max((QFontMetricsF(font).horizontalAdvance(text) for text in words), default=0.0)
    return scaled(font, max(room_px / widest, _LEAST)) if widest > room_px else font


# Words that take as many lines as they need.

_MOST_LINES = 4
_BETWEEN = " · "
_FLAGS = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextWordWrap
_NO_END_PX = 100_000


class NoteLabel(QWidget):
    """Words of less weight, in as many lines as they need; the tooltip has them too.

    Where four lines are too few, it counts what it leaves out: parts of the text stand between
    " · ".

    Attributes
    ----------
    text
        All of the words.
    """

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.text = ""
        self._held_lines = 1
        self.setObjectName(name)
        self.setFont(tabular(self.font()))
        policy = QSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    @property
    def shown(self) -> str:
        """What of the words is written."""
        return self._fitting(self.width())

    def say(self, text: str, *, holding: bool = False) -> None:
        """Show other words; ``holding``: give no room back, what is above would jump."""
        least = self._held_lines if holding else 1
        if text != self.text:
            self.text = text
            self.setToolTip(text)
            self.setAccessibleName(text)
            self.update()
        lines = max(least, self._lines_of(self.shown, self.width()))
        if lines != self._held_lines:
            self._held_lines = lines
            self.updateGeometry()

    def sizeHint(self) -> QSize:
        return QSize(80, self._height_of(self._held_lines))

    def minimumSizeHint(self) -> QSize:
        return QSize(0, self._height_of(1))

    def hasHeightForWidth(self) -> bool:
        return True

    def heightForWidth(self, width: int) -> int:
        lines = self._lines_of(self._fitting(width), width)
        held = self._held_lines if width == self.width() else 1
        return self._height_of(max(lines, held))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.oldSize().width() != event.size().width():
            self._held_lines = self._lines_of(self.shown, self.width())
            self.updateGeometry()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setPen(QColor(current_theme().dim))
        painter.drawText(self.rect(), int(_FLAGS), self.shown)
        painter.end()

    def _fitting(self, width: int) -> str:
        if self._lines_of(self.text, width) <= _MOST_LINES:
            return self.text
        parts = self.text.split(_BETWEEN)
        for count in range(len(parts) - 1, 0, -1):
            words = _BETWEEN.join((*parts[:count], f"+{len(parts) - count}"))
            if self._lines_of(words, width) <= _MOST_LINES:
                return words
        return self.text

    def _lines_of(self, words: str, width: int) -> int:
        if not words or width <= 0:
            return 1
        metrics = self.fontMetrics()
        needed = metrics.boundingRect(QRect(0, 0, width, _NO_END_PX), int(_FLAGS), words).height()
        return max(round(needed / metrics.lineSpacing()), 1)

    def _height_of(self, lines: int) -> int:
        metrics = self.fontMetrics()
        return metrics.height() + (lines - 1) * metrics.lineSpacing() + 2


# A frame with two axes, and where values lie in it.

_GAP_PX = 4.0
_TICK_X_PX, _TICK_Y_PX = 60.0, 34.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """One axis.

    Attributes
    ----------
    shown
        Values at its ends.
    title
        With its unit.
    factor
        What values are multiplied with on its labels.
    short
        A title for where there is too little room; empty: there is none.
    log
        Logarithmic; both ends are above 0.
    """

    shown: Range
    title: str
    factor: float = 1.0
    short: str = ""
    log: bool = False

    def part(self, values: Floats) -> Floats:
        """How far along it values lie, 0 to 1; NaN where it cannot show them."""
        ends, at = np.array(self.shown, float), np.asarray(values, float)
        if self.log:
            ends = np.log(ends)
            at = np.log(at, out=np.full(at.shape, np.nan), where=at > 0.0)
        return (at - ends[0]) / (ends[1] - ends[0])

    def value(self, part: float) -> float:
        """The value that lies there."""
        low, high = self.shown
        return float(low * (high / low) ** part) if self.log else low + part * (high - low)

    def title_in(self, metrics: QFontMetricsF, room_px: float) -> str:
        """Its title, or the short one where that alone has room."""
        fits = metrics.horizontalAdvance(self.title) <= room_px
        return self.title if fits or not self.short else self.short

    def ticks(self, length_px: float, each_px: float) -> tuple[Tick, ...]:
        """Round numbers along it."""
        low, high = self.shown
        airy = max(length_px / each_px, 2.0)
        if self.log:
            # Numbers that rise by factors stand apart, where as many round ones would not.
            ticks = log_ticks(low * self.factor, high * self.factor, 2.0 * airy)
            return tuple(replace(tick, value=tick.value / self.factor) for tick in ticks)
        return readable_ticks(low, high, airy, 2.0 * airy, self.factor)


@dataclass(frozen=True, slots=True, kw_only=True)
class Axes:
    """A frame inside a room, with its labels around it.

    Attributes
    ----------
    frame
        Where values are drawn.
    x, y
        The axes; y points up.
    """

    frame: QRectF
    x: Axis
    y: Axis

    def to_screen(self, x: Floats, y: Floats) -> Floats:
        """Places on the screen, (n, 2)."""
        across = self.frame.left() + self.x.part(x) * self.frame.width()
        up = self.frame.bottom() - self.y.part(y) * self.frame.height()
        return np.stack(np.broadcast_arrays(across, up), axis=-1)

    def value_at(self, point: QPointF) -> tuple[float, float] | None:
        """Values at a place of the screen; None outside of the frame."""
        if not self.frame.adjusted(-1, -1, 1, 1).contains(point):
            return None
        across = (point.x() - self.frame.left()) / self.frame.width()
        up = (self.frame.bottom() - point.y()) / self.frame.height()
        return self.x.value(across), self.y.value(up)

    def polygon(self, x: Floats, y: Floats) -> QPolygonF:
        """A line through points."""
        return QPolygonF([QPointF(*place) for place in self.to_screen(x, y)])

    def title_place(self, metrics: QFontMetricsF) -> QRectF:
        """Where the title of x stands: below the frame, and left of it where that is too narrow."""
        frame, line = self.frame, metrics.height()
        room = frame.right() + 2.0 * _GAP_PX
        title = self.x.title_in(metrics, room)
        width = min(metrics.horizontalAdvance(title) + 1.0, room)
        left = min(frame.center().x() - width / 2, room - width)
        return QRectF(left, frame.bottom() + line + 2, width, line)

    def paint(self, painter: QPainter, theme: Theme, *, grid: bool = True) -> None:
        """Draw frame, grid, labels and titles."""
        frame, metrics = self.frame, QFontMetricsF(painter.font())
        line = metrics.height()
        centre = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        written = -np.inf
        for tick in self.x.ticks(frame.width(), _TICK_X_PX):
            x = float(self.to_screen(np.array([tick.value]), np.array([self.y.shown[0]]))[0, 0])
            if grid:
                painter.setPen(QPen(QColor(theme.grid), 1))
                painter.drawLine(QLineF(x, frame.top(), x, frame.bottom()))
            painter.setPen(QColor(theme.dim))
            wide = metrics.horizontalAdvance(tick.label)
            # One that would lie on the one before is left out.
            if tick.label and x - wide / 2 > written:
                place = QRectF(x - wide / 2, frame.bottom() + 2, wide, line)
                painter.drawText(place, centre | Qt.TextFlag.TextDontClip, tick.label)
                written = x + wide / 2 + _GAP_PX
        for tick in self.y.ticks(frame.height(), _TICK_Y_PX):
            y = float(self.to_screen(np.array([self.x.shown[0]]), np.array([tick.value]))[0, 1])
            if grid:
                painter.setPen(QPen(QColor(theme.grid), 1))
                painter.drawLine(QLineF(frame.left(), y, frame.right(), y))
            painter.setPen(QColor(theme.dim))
            place = QRectF(0.0, y - line / 2, frame.left() - _GAP_PX, line)
            painter.drawText(place, right, tick.label)
        painter.setPen(QPen(QColor(theme.border), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(frame)
        painter.setPen(QColor(theme.dim))
        self._paint_titles(painter, line)

    def _paint_titles(self, painter: QPainter, line: float) -> None:
        """Write titles in the middle of their axis; where that is short, beside labels too."""
        frame, metrics = self.frame, QFontMetricsF(painter.font())
        below = self.title_place(metrics)
        title = self.x.title_in(metrics, below.width())
        painter.save()
        _paint_title(painter, below, title)
        painter.restore()
        painter.save()
        side = QRectF(-frame.bottom(), 1.0, frame.height(), line)
        title = self.y.title_in(metrics, side.width())
        if metrics.horizontalAdvance(title) > side.width():
            side.setLeft(-frame.bottom() - line)
            side.setRight(-_GAP_PX)
        painter.rotate(-90.0)
        _paint_title(painter, side, title)
        painter.restore()


def _paint_title(painter: QPainter, room: QRectF, title: str) -> None:
    """Write it smaller where even then it would be cut."""
    painter.setFont(shrunk(painter.font(), (title,), room.width()))
    painter.drawText(room, Qt.AlignmentFlag.AlignCenter, title)


def fitted_axes(room: QRectF, x: Axis, y: Axis, metrics: QFontMetricsF) -> Axes:
    """Axes in ``room``, with as much around the frame as their labels need.

    The left edge of the room is that of the widget: labels of y begin there.
    """
    line = metrics.height()
    height = max(room.height() - 2.0 * line - 3.0 * _GAP_PX, 1.0)
    labels = [tick.label for tick in y.ticks(height, _TICK_Y_PX)]
    wide = max((metrics.horizontalAdvance(label) for label in labels), default=0.0)
    left = room.left() + line + wide + 2.0 * _GAP_PX
    top = room.top() + _GAP_PX + line / 2
    width = room.right() - left - 2.0 * _GAP_PX
    for _ in range(2):  # a narrower one may have other labels
        width = max(min(width, room.right() - left - _beyond(x, width, metrics)), 1.0)
    frame = QRectF(left, top, width, height - line / 2 - _GAP_PX)
    return Axes(frame=frame, x=x, y=y)


def _beyond(x: Axis, width: float, metrics: QFontMetricsF) -> float:
    """How far the last label of x reaches beyond a frame of that width, px."""
    ticks = x.ticks(width, _TICK_X_PX)
    parts = x.part(np.array([tick.value for tick in ticks]))
    halves = (metrics.horizontalAdvance(tick.label) / 2 for tick in ticks)
    ends = (half - (1.0 - part) * width for half, part in zip(halves, parts, strict=True))
    return max(ends, default=0.0) + 1.0


# The menu of a figure.


def open_figure_menu(
    parent: QWidget, at: QPoint, save: Callable[[], None], copy: Callable[[], None] | None
) -> QMenu:
    """Open the menu at a place on the screen; ``copy`` is None where there are no numbers."""
    menu = QMenu(parent)
    menu.setObjectName("figure_menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    if copy is not None:
        menu.addAction("Copy numbers").triggered.connect(copy)
    menu.addAction("Save picture as…").triggered.connect(save)
    menu.popup(at)
    return menu


# A picture that follows the theme, says why it is empty, and reads what the pointer is over.

_TEXT = 0.92
_LEAST_LINES = 6


class Figure(QWidget):
    """What panels paint into; what is drawn, and what a place reads, its heirs say.

    Attributes
    ----------
    cursor_at
        Where the pointer, or the keys, have put the cursor; None: nowhere.
    """

    #: What the cursor reads; "" where it is nowhere.
    reading = Signal(str)

    def __init__(self, name: str, accessible_name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.cursor_at: QPointF | None = None
        self.message = ""
        self._late = False
        self.setObjectName(name)
        self.setAccessibleName(accessible_name)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)

    def minimumSizeHint(self) -> QSize:
        # Letters around a frame may be as large as they like: some of it is left.
        return QSize(200, max(120, _LEAST_LINES * self.fontMetrics().height()))

    def draw(self, painter: QPainter, room: QRectF) -> None:
        """Draw what there is, in ``room``."""
        raise NotImplementedError

    def read(self, at: QPointF) -> str:
        """What is to be said of a place; "" for nothing."""
        del at
        return ""

    def keys_area(self) -> QRectF:
        """Where the cursor can be put with the keys; empty: nowhere."""
        return QRectF()

    def show_late(self, late: bool) -> None:
        """Say whether what is drawn is older than the design."""
        self._late = late
        self.update()

    def say(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle; "" for a picture."""
        self.message = message
        self.setAccessibleDescription(message)
        if message:
            self.move_cursor(None)
        self.update()

    def move_cursor(self, at: QPointF | None) -> None:
        """Read another place, or none."""
        words = "" if at is None or self.message else self.read(at)
        self.cursor_at = at if words else None
        self.reading.emit(words)
        self.update()

    def read_again(self) -> None:
        """Tell what the cursor reads now that something else is drawn."""
        self.move_cursor(self.cursor_at)

    def paint(self, painter: QPainter, room: QRectF) -> None:
        """Draw what there is, or say why there is nothing; on the screen and on a page."""
        if self.message:
            painter.setPen(QColor(current_theme().dim))
            inner = room.adjusted(2 * UNIT_PX, UNIT_PX, -2 * UNIT_PX, -UNIT_PX)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(inner, flags, self.message)
            return
        painter.setFont(scaled(tabular(self.font()), _TEXT))
        painter.setOpacity(PALE if self._late else 1.0)
        self.draw(painter, room)
        painter.setOpacity(1.0)
        if self._late:
            theme = current_theme()
            paint_updating(painter, room, QColor(theme.base), QColor(theme.text))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        room = QRectF(self.rect())
        painter.fillRect(room, QColor(current_theme().base))
        self.paint(painter, room)
        if self.hasFocus():
            paint_focus_frame(painter, room, current_theme())
        painter.end()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._means) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        means, area = self._means(event), self.keys_area()
        if not means:
            super().keyPressEvent(event)
            return
        at = self.cursor_at or area.center()
        if means == "give_up":
            self.move_cursor(None)
        elif means == "jump":
            end = area.left() if event.key() == Qt.Key.Key_Home else area.right()
            self.move_cursor(QPointF(end, at.y()))
        else:
            held = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            step = 10.0 if held else 1.0
            across = at.x() + (step if event.key() == Qt.Key.Key_Right else -step)
            self.move_cursor(QPointF(min(max(across, area.left()), area.right()), at.y()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self.move_cursor(event.position())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.move_cursor(None)

    def _means(self, event: QKeyEvent) -> str:
        means = meaning_of("plot", event)
        if means not in ("step", "jump", "give_up") or self.keys_area().isEmpty():
            return ""
        return means if means != "give_up" or self.cursor_at is not None else ""


# A figure on a page or a slide, between its words and without what it is chosen by.

_FIGURE_PICTURE_NO_END_PX = 100_000.0


def draw_figure(painter: QPainter, room: QRectF, figure: Figure, above: str, below: str) -> None:
    """Fill ``room`` with a figure and the words above and below it."""
    painter.save()
    painter.fillRect(room, QColor(current_theme().base))
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
    # Where its parts are on the screen it knows again once it is painted there.
    figure.update()


def _write(
    painter: QPainter, room: QRectF, words: str, side: Qt.AlignmentFlag, figure: Figure
) -> float:
    """Write words at a side of a room; how high they are."""
    if not words:
        return 0.0
    flags = int(Qt.AlignmentFlag.AlignLeft | side | Qt.TextFlag.TextWordWrap)
    endless = QRectF(0.0, 0.0, room.width(), _FIGURE_PICTURE_NO_END_PX)
    painter.setPen(QColor(current_theme().dim))
    painter.drawText(room, flags, words)
    return painter.boundingRect(endless, flags, words).height()


# Which colour is which output: a line above a figure.

_STROKE_PX, _WIDE_PX, _OUTPUT_LEGEND_GAP_PX = 3.0, 12.0, 5.0


def legend_texts(outputs: tuple[int, ...], room_px: float, painter: QPainter) -> list[str]:
    """Its head, numbers of the outputs, and how many more there is no room for."""
    head = "Output" if len(outputs) == 1 else "Outputs"
    numbers = [str(output) for output in outputs]
    for count in range(len(numbers), 0, -1):
        left = len(numbers) - count
        words = [head, *numbers[:count], *([f"+{left}"] if left else [])]
        if _wide(words, painter) <= room_px:
            return words
    return numbers[:1]


def draw_legend(
    painter: QPainter,
    room: QRectF,
    outputs: tuple[int, ...],
    theme: Theme,
    *,
    broken: bool = False,
) -> None:
    """Numbers of outputs, each behind a stroke of its colour, in one line.

    ``broken``: lines of the figure are, where colours begin again, and so are these strokes.
    """
    metrics, at = painter.fontMetrics(), room.left()
    words = legend_texts(outputs, room.width(), painter)
    ranks = dict(zip(map(str, outputs), range(len(outputs)), strict=True))
    for word in words:
        if word in ranks:
            rank = ranks[word] if broken else ranks[word] % len(theme.outputs)
            pen = theme.output_pen(rank, _STROKE_PX)
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
            painter.setPen(pen)
            painter.drawLine(QLineF(at, room.center().y(), at + _WIDE_PX, room.center().y()))
            at += _WIDE_PX + _OUTPUT_LEGEND_GAP_PX
        wide = float(metrics.horizontalAdvance(word))
        painter.setPen(QColor(theme.text))
        painter.drawText(
            QRectF(at, room.top(), wide + 1.0, room.height()), Qt.AlignmentFlag.AlignVCenter, word
        )
        at += wide + 2.0 * _OUTPUT_LEGEND_GAP_PX


def _wide(words: list[str], painter: QPainter) -> float:
    metrics = painter.fontMetrics()
    strokes = (_WIDE_PX + _OUTPUT_LEGEND_GAP_PX) * sum(word.isdigit() for word in words)
    return strokes + sum(
        metrics.horizontalAdvance(word) + 2.0 * _OUTPUT_LEGEND_GAP_PX for word in words
    )
