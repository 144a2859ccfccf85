"""Two quiet lines that follow the pointer."""

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource_gui.theme import current_theme, tabular

_LINES = 2


class ReadoutLines(QWidget):
    """Text of up to two lines, cut short where it is too long, always of the same height."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text = ""
        self._lines = _LINES
        self.setFont(tabular(self.font()))
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def text(self) -> str:
        """The text, uncut."""
        return self._text

    def show_text(self, text: str) -> None:
        """Show other text."""
        if text != self._text:
            self._text = text
            self.setAccessibleDescription(text)
            self.setToolTip(text)
            self.update()

    def show_lines(self, count: int) -> None:
        """Have room for so many lines; in one alone a value comes first, and how to select last."""
        if count != self._lines:
            self._lines = count
            self.updateGeometry()
            self.update()

    @property
    def shown(self) -> tuple[str, ...]:
        """What stands in its lines."""
        lines = self._text.split("\n")[:_LINES]
        if self._lines > 1 or len(lines) < _LINES:
            return tuple(lines[: self._lines])
        first, second = lines
        return (f"{second} · {first}" if any(map(str.isdigit, second)) else first,)

    def sizeHint(self) -> QSize:
        return QSize(100, self._lines * self.fontMetrics().lineSpacing())

    def minimumSizeHint(self) -> QSize:
        return QSize(0, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setPen(QColor(current_theme().dim))
        height = self.fontMetrics().lineSpacing()
        for k, line in enumerate(self.shown):
            words = self.fontMetrics().elidedText(line, Qt.TextElideMode.ElideRight, self.width())
            painter.drawText(QRectF(0, k * height, self.width(), height), 0, words)
        painter.end()
