"""pyqtgraph's axis with our ticks, words and grid."""

from collections.abc import Callable, Sequence
from typing import Any, Literal

import pyqtgraph
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.plot.plot_layout import fitting
from skinsource_gui.widgets.plot.ranges import Range
from skinsource_gui.widgets.plot.ticks import Tick

_GAP_PX = 4.0
_CENTRED = Qt.AlignmentFlag.AlignCenter
_AT_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter

#: Ticks between two positions of a view that are so many pixels apart.
TickRule = Callable[[float, float, float], Sequence[Tick]]


class Axis(pyqtgraph.AxisItem):
    """An axis on the left of one view, or below one or several of equal width.

    It draws the grid of these views, behind them, and their frames if it is on the left.  All of
    it is kept as a picture until range, ticks, words or size change.

    Attributes
    ----------
    titles
        What is written below the labels, longest first; the first that fits.
    band
        Positions whose outside is shaded, or ``None``.
    """

    def __init__(self, orientation: Literal["left", "bottom"], rule: TickRule) -> None:
        super().__init__(orientation)
        self.enableAutoSIPrefix(False)
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.titles: tuple[str, ...] = ()
        self.band: Range | None = None
        self._rule = rule
        self._font = QFont()
        self._views: tuple[pyqtgraph.ViewBox, ...] = ()
        # Behind curves; the shaded part of the axis below lies under the other axis's grid.
        self.setZValue(-1000 if orientation == "left" else -1001)

    def set_views(self, *views: pyqtgraph.ViewBox) -> None:
        """Follow the range of the first view, and draw the grid of all."""
        if self._views[:1] != views[:1]:
            if self._views:
                self.unlinkFromView()
            self.linkToView(views[0])
        self._views = views
        self.refresh()

    def show_font(self, font: QFont) -> None:
        """Take over a font, and the colours in use."""
        self._font = font
        self.refresh()

    def say(self, titles: tuple[str, ...], band: Range | None = None) -> None:
        """Write the longest of ``titles`` that fits, and shade all but ``band``."""
        if (titles, band) != (self.titles, self.band):
            self.titles, self.band = titles, band
            self.refresh()

    def refresh(self) -> None:
        """Draw anew."""
        self.prepareGeometryChange()
        self.update()

    def ticks(self) -> list[tuple[float, str]]:
        """Places of the ticks in coordinates of this item, px, and their labels."""
        if not self._views:
            return []
        across = self.orientation == "bottom"
        rect = self._view_rect(self._views[0])
        start, length = (rect.left(), rect.width()) if across else (rect.bottom(), -rect.height())
        low, high = self.range
        if length == 0 or not low < high:
            return []
        return [
            (start + length * (tick.value - low) / (high - low), tick.label)
            for tick in self._rule(low, high, abs(length))
        ]

    def shaded(self) -> list[QRectF]:
        """What lies outside the band, in coordinates of this item, px."""
        low, high = self.range
        if self.band is None or not low < high:
            return []
        parts = []
        for rect in map(self._view_rect, self._views):
            start, end = (
                rect.left() + rect.width() * min(max((value - low) / (high - low), 0.0), 1.0)
                for value in self.band
            )
            for left, right in ((rect.left(), start), (end, rect.right())):
                parts.append(QRectF(left, rect.top(), right - left, rect.height()))
        return [part for part in parts if part.width() > 0]

    def boundingRect(self) -> QRectF:
        bounds = self.rect()
        for view in self._views:
            bounds = bounds.united(self._view_rect(view))
        # Frames lie half a pixel outside, and half of a label at an end.
        above = QFontMetricsF(self._font).height() / 2 if self.orientation == "left" else 1
        return bounds.adjusted(-1, -above, 1, above)

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        # No QPicture in between, which would forget that digits are to have one width.
        painter.setFont(self._font)
        specs = self.generateDrawSpecs(painter)
        if specs is not None:
            self.drawPicture(painter, *specs)

    def generateDrawSpecs(self, painter: QPainter) -> Any:
        metrics = QFontMetricsF(self._font)
        ticks = self.ticks()
        below = self.orientation == "bottom"
        pen = QPen(QColor(current_theme().grid), 1)
        lines, labels = [], []
        for rect in map(self._view_rect, self._views):
            for at, _ in ticks:
                if below:
                    ends = QPointF(at, rect.top()), QPointF(at, rect.bottom())
                else:
                    ends = QPointF(rect.left(), at), QPointF(rect.right(), at)
                lines.append((pen, *ends))
        place = self._below if below else self._beside
        free_from = 0.0
        for at, text in ticks:
            room = place(at, metrics.horizontalAdvance(text) + 2, metrics.height())
            if text and not (below and room.left() < free_from):
                labels.append((room, _CENTRED if below else _AT_RIGHT, text))
                free_from = room.right() + _GAP_PX
        return None, lines, labels

    def drawPicture(self, painter: QPainter, axis: Any, lines: Any, labels: Any) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        for outside in self.shaded():
            painter.fillRect(outside, QColor(current_theme().window))
        for pen, start, end in lines:
            painter.setPen(pen)
            painter.drawLine(start, end)
        if self.orientation == "left":
            painter.setPen(QPen(QColor(current_theme().border), 1))
            for rect in map(self._view_rect, self._views):
                painter.drawRect(rect)
        painter.setPen(QColor(current_theme().dim))
        for room, flags, text in labels:
            painter.drawText(room, flags, text)
        self._write_title(painter)

    def _view_rect(self, view: pyqtgraph.ViewBox) -> QRectF:
        return self.mapRectFromItem(view, view.rect())

    def _below(self, at: float, width: float, line: float) -> QRectF:
        left = at - width / 2
        start = self._view_rect(self._views[0]).left()
        if left < start <= at:
            # Beside the lowest number of the axis on the left, not below it.
            left = start
        return QRectF(min(max(left, 0.0), self.rect().width() - width), 2, width, line)

    def _beside(self, at: float, width: float, line: float) -> QRectF:
        return QRectF(0, at - line / 2, self.rect().width() - _GAP_PX, line)

    def _write_title(self, painter: QPainter) -> None:
        if not self.titles or not self._views:
            return
        metrics, room = QFontMetricsF(self._font), self.rect()
        title = fitting(self.titles, metrics, room.width() - UNIT_PX)
        width = metrics.horizontalAdvance(title) + 2
        middle = self._view_rect(self._views[0]).center().x()
        left = min(max(middle - width / 2, _GAP_PX), room.width() - width - _GAP_PX)
        painter.setPen(QColor(current_theme().text))
        line = metrics.height()
        painter.drawText(QRectF(left, 2 + line, width, line), _CENTRED, title)
