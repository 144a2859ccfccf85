"""A frame with two axes, and where values lie in it."""

from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF

from skinsource.base.arrays import Floats
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.figure.shrunk import shrunk
from skinsource_gui.widgets.plot.ranges import Range
from skinsource_gui.widgets.plot.ticks import Tick, log_ticks, readable_ticks

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
            return tuple(replace(one, value=one.value / self.factor) for one in ticks)
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
