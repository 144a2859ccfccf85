"""A line that warns, where there is something to warn of."""

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.tooltips import tooltip

_MOST_LINES, _LOST_AT_ENDS = 2, 0.3
_WRAPPED = Qt.AlignmentFlag.AlignLeft | Qt.TextFlag.TextWordWrap


class NoteLine(QWidget):
    """Some lines of text, cut short where it is longer; the whole of it is in its tooltip.

    It takes no room while there is nothing to say.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text = self._short = ""
        self._most_lines = _MOST_LINES
        self.setAccessibleName("Note on the map")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.hide()

    def text(self) -> str:
        """The text, uncut."""
        return self._text

    @property
    def shown(self) -> str:
        """What of it there is room for: the text, or the short one."""
        whole = self.fontMetrics().horizontalAdvance(self._text) <= self._room_px
        return self._text if whole else self._short or self._text

    def show_text(self, text: str, short: str = "") -> None:
        """Show other text, or the short one where it has no room; hide where it is empty."""
        if (text, short) != (self._text, self._short):
            self._text, self._short = text, short
            self.setAccessibleDescription(text)
            self.setToolTip(tooltip(text) if text else "")
            self.setVisible(bool(text))
            self.updateGeometry()
            self.update()

    def show_lines(self, count: int) -> None:
        """Have so many lines at most."""
        if count != self._most_lines:
            self._most_lines = count
            self.updateGeometry()
            self.update()

    def sizeHint(self) -> QSize:
        return QSize(100, self.fontMetrics().lineSpacing() * self._n_lines())

    def minimumSizeHint(self) -> QSize:
        return QSize(0, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setPen(QColor(current_theme().warning))
        metrics = self.fontMetrics()
        if self._n_lines() > 1:
            words = metrics.elidedText(self.shown, Qt.TextElideMode.ElideRight, self._room_px)
            painter.drawText(self.rect(), _WRAPPED, words)
        else:
            words = metrics.elidedText(self.shown, Qt.TextElideMode.ElideRight, self.width())
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignLeft, words)
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.oldSize().width() != event.size().width():
            self.updateGeometry()

    @property
    def _room_px(self) -> int:
        # Two lines hold a little less than twice one: words are not broken.
        lost = _LOST_AT_ENDS if self._most_lines > 1 else 0.0
        return round(self.width() * (self._most_lines - lost))

    def _n_lines(self) -> int:
        wide = self.fontMetrics().horizontalAdvance(self.shown) > self.width() > 0
        return self._most_lines if wide else 1
