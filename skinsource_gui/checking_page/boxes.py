"""Box plots of one figure, a box for each frequency."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QWidget

from skinsource.base.arrays import Floats
from skinsource.studies.checking import quartiles
from skinsource_gui.theme import Theme, current_theme
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.figure.axes import Axes, Axis, fitted_axes
from skinsource_gui.widgets.figure.figure import Figure

_WIDEST_PX = 40.0
_NOTHING = "Channels above twice the noise appear here"


class BoxFigure(Figure):
    """Whiskers, box and median of each group.

    Parameters
    ----------
    name, title
        Object name; what is measured, with its unit.
    """

    def __init__(self, name: str, title: str, parent: QWidget | None = None) -> None:
        super().__init__(name, title, parent)
        self._title = title
        self.groups: Sequence[tuple[str, Floats]] = ()
        self.axes: Axes | None = None
        self.say(_NOTHING)

    def show_groups(self, groups: Sequence[tuple[str, Floats]]) -> None:
        """Take over groups: what stands below each, and its values."""
        self.groups = [(label, values) for label, values in groups if values.size]
        self.say("" if self.groups else _NOTHING)
        self.read_again()

    def draw(self, painter: QPainter, room: QRectF) -> None:
        theme = current_theme()
        ends = [quartiles(values) for _, values in self.groups]
        low = min(0.0, *(one[0] for one in ends))
        high = max(1e-9, *(one[4] for one in ends))
        edge = 0.05 * (high - low)
        line = QFontMetricsF(painter.font()).height()
        x = Axis(shown=(0.0, float(len(ends))), title="Main frequency (Hz)")
        y = Axis(shown=(low - (edge if low < 0.0 else 0.0), high + edge), title=self._title)
        self.axes = axes = fitted_axes(room, x, y, QFontMetricsF(painter.font()))
        _paint_frame(painter, axes, theme, [label for label, _ in self.groups], line)
        for rank, one in enumerate(ends):
            self._paint_box(painter, axes, rank, one)

    def read(self, at: QPointF) -> str:
        rank = self._rank_at(at)
        if rank is None:
            return ""
        label, values = self.groups[rank]
        first, low, middle, high, last = (minus(f"{one:.3g}") for one in quartiles(values))
        return (
            f"{label} Hz: median {middle}, quartiles {low} to {high}, whiskers {first} to {last}, "
            f"{values.size} channels"
        )

    def keys_area(self) -> QRectF:
        return QRectF() if self.axes is None or self.message else self.axes.frame

    def _rank_at(self, at: QPointF) -> int | None:
        """The group under a place."""
        found = None if self.axes is None else self.axes.value_at(at)
        if found is None or not self.groups:
            return None
        return min(max(int(found[0]), 0), len(self.groups) - 1)

    def _paint_box(self, painter: QPainter, axes: Axes, rank: int, ends: tuple[float, ...]) -> None:
        theme = current_theme()
        places = axes.to_screen(np.full(5, rank + 0.5), np.array(ends))
        x = float(places[0, 0])
        first, bottom, middle, top, last = (float(one) for one in places[:, 1])
        wide = min(0.5 * axes.frame.width() / len(self.groups), _WIDEST_PX)
        painter.setPen(QPen(QColor(theme.dim), 1.5))
        painter.drawLine(QLineF(x, first, x, last))
        for end in (first, last):
            painter.drawLine(QLineF(x - wide / 4, end, x + wide / 4, end))
        fill = QColor(theme.accent)
        painter.setPen(QPen(fill, 1.5))
        painter.setBrush(QColor(theme.base))
        box = QRectF(x - wide / 2, top, wide, max(bottom - top, 0.5))
        painter.drawRect(box)
        fill.setAlphaF(0.25)
        painter.setBrush(fill)
        painter.drawRect(box)
        painter.setPen(QPen(QColor(theme.text), 2.0))
        painter.drawLine(QLineF(x - wide / 2, middle, x + wide / 2, middle))


def _paint_frame(
    painter: QPainter, axes: Axes, theme: Theme, labels: Sequence[str], line: float
) -> None:
    """Frame and numbers of y as on all figures; below the boxes their frequencies."""
    frame = axes.frame
    right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
    for tick in axes.y.ticks(frame.height(), 34.0):
        y = float(axes.to_screen(np.zeros(1), np.array([tick.value]))[0, 1])
        painter.setPen(QPen(QColor(theme.grid), 1))
        painter.drawLine(QLineF(frame.left(), y, frame.right(), y))
        painter.setPen(QColor(theme.dim))
        beside = QRectF(0.0, y - line / 2, frame.left() - 4.0, line)
        painter.drawText(beside, right, tick.label)
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(frame)
    painter.setPen(QColor(theme.dim))
    step = frame.width() / len(labels)
    for rank, label in enumerate(labels):
        below = QRectF(frame.left() + rank * step, frame.bottom() + 2.0, step, line)
        painter.drawText(below, Qt.AlignmentFlag.AlignCenter, label)
    title = QRectF(frame.left(), frame.bottom() + line + 2.0, frame.width(), line)
    painter.drawText(title, Qt.AlignmentFlag.AlignCenter, axes.x.title)
    painter.save()
    painter.translate(line / 2 + 1, frame.center().y())
    painter.rotate(-90.0)
    side = QRectF(-frame.height() / 2, -line / 2, frame.height(), line)
    painter.drawText(side, Qt.AlignmentFlag.AlignCenter, axes.y.title)
    painter.restore()
