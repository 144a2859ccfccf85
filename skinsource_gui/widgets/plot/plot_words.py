"""Words in a plot: the line above it, the number of a row, a message in the middle."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.plot.plot_layout import Header

_CENTRED = Qt.AlignmentFlag.AlignCenter
_AT_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_AT_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_SMALLEST_FONT_PX = 7


class HeaderLine(pyqtgraph.GraphicsWidget):
    """Unit and notes on the left, marks on the right.

    Attributes
    ----------
    header
        What it says.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.header = Header()
        self._font = QFont()

    def show_font(self, font: QFont) -> None:
        """Take over a font."""
        self._font = font
        self.update()

    def say(self, header: Header) -> None:
        """Show ``header``."""
        if header != self.header:
            self.header = header
            self.update()

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        header, theme, line = self.header, current_theme(), self.rect()
        painter.setFont(self._font)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        metrics = QFontMetricsF(self._font)
        right = line.right()
        if header.badge:
            badge_px = metrics.horizontalAdvance(header.badge) + UNIT_PX
            badge = QRectF(right - badge_px, line.top() + 1.5, badge_px - 1, line.height() - 3)
            painter.setPen(QPen(QColor(theme.warning), 1))
            painter.drawRoundedRect(badge, 3, 3)
            painter.drawText(badge, _CENTRED, header.badge)
            right = badge.left() - UNIT_PX
        painter.setPen(QColor(theme.dim))
        if header.mark:
            painter.drawText(QRectF(0, 0, right, line.height()), _AT_RIGHT, header.mark)
            right -= metrics.horizontalAdvance(header.mark) + UNIT_PX
        painter.setPen(QColor(theme.text))
        unit, note = header.said(metrics, right)
        painter.drawText(QRectF(0, 0, right, line.height()), _AT_LEFT, unit)
        start = metrics.horizontalAdvance(unit) + 2 * UNIT_PX
        painter.setPen(QColor(theme.warning))
        painter.drawText(QRectF(start, 0, max(right - start, 1), line.height()), _AT_LEFT, note)


class RowNumber(pyqtgraph.GraphicsWidget):
    """The number of an output beside its row, in the colour of its curve.

    Attributes
    ----------
    text
        The number.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.text = ""
        self._colour = QColor()
        self._font = QFont()

    def say(self, text: str, colour: QColor, font: QFont) -> None:
        """Show ``text``."""
        if (text, colour, font) != (self.text, self._colour, self._font):
            self.text, self._colour, self._font = text, colour, font
            self.update()

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        font, height = QFont(self._font), self.rect().height()
        if height < QFontMetricsF(font).height():
            font.setPixelSize(max(_SMALLEST_FONT_PX, int(height * 0.85)))
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(self._colour)
        painter.drawText(self.rect(), _CENTRED, self.text)


class Message(pyqtgraph.GraphicsWidget):
    """Words in the middle of an empty picture.

    Attributes
    ----------
    text
        The words.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        self.setZValue(10)
        self.text = ""
        self._colour = QColor()
        self._font = QFont()

    def say(self, text: str, colour: QColor, font: QFont) -> None:
        """Show ``text``."""
        self.text, self._colour, self._font = text, colour, font
        self.setVisible(bool(text))
        self.update()

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        painter.setFont(self._font)
        painter.setPen(self._colour)
        painter.drawText(self.rect(), _CENTRED | Qt.TextFlag.TextWordWrap, self.text)
