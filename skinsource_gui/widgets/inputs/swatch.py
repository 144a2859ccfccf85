"""The colour of an input, with the number of its place."""

from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource_gui.theme import current_theme, tabular

SWATCH_PX = 24
_ROUNDING_PX = 5


def words_on(colour: QColor) -> QColor:
    """Black or white, whichever is easier to read on ``colour`` (WCAG 2 contrast)."""
    parts = (colour.redF(), colour.greenF(), colour.blueF())
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    ]
    luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    return QColor("black") if luminance > 0.179 else QColor("white")


def paint_swatch(
    painter: QPainter, place: QRectF, number: int, colour: QColor, text: QColor, *, silent: bool
) -> None:
    """Paint a rounded square with a number; that of a silent input is hollow."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setFont(_number_font(painter.font()))
    if silent:
        painter.setPen(QPen(colour, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
    else:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
    painter.drawRoundedRect(place.adjusted(1, 1, -1, -1), _ROUNDING_PX, _ROUNDING_PX)
    painter.setPen(text if silent else words_on(colour))
    painter.drawText(place, Qt.AlignmentFlag.AlignCenter, str(number))
    painter.restore()


def _number_font(font: QFont) -> QFont:
    found = tabular(font)
    found.setWeight(QFont.Weight.DemiBold)
    return found


class Swatch(QWidget):
    """A swatch as a widget of its own."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("swatch")
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._number = 0
        self._colour_number = 0
        self._silent = False

    def show_input(self, number: int, colour_number: int, *, silent: bool) -> None:
        """Number of the place, number of the colour, and whether the input is silent."""
        if (number, colour_number, silent) != (self._number, self._colour_number, self._silent):
            self._number, self._colour_number, self._silent = number, colour_number, silent
            self.setAccessibleName(f"Place {number}")
            self.updateGeometry()
            self.update()

    def sizeHint(self) -> QSize:
        # The number is whole in letters of any size.
        words = QFontMetrics(_number_font(self.font()))
        height = max(SWATCH_PX, words.height() + _ROUNDING_PX)
        return QSize(max(height, words.horizontalAdvance(str(self._number)) + _ROUNDING_PX), height)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.updateGeometry()

    def paintEvent(self, event: QPaintEvent) -> None:
        paint_swatch(
            QPainter(self),
            QRectF(self.rect()),
            self._number,
            current_theme().input_colour(self._colour_number),
            QColor(current_theme().text),
            silent=self._silent,
        )
