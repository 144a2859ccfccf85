"""Words that take as many lines as they need."""

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource_gui.theme import current_theme, tabular

_MOST_LINES = 4
_BETWEEN = " · "
_FLAGS = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextWordWrap
_NO_END_PX = 100_000


class WordsLabel(QWidget):
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
