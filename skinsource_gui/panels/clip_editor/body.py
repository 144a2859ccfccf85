"""The curve of a clip and its spectrum, below each other or side by side."""

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QWidget

_CANVAS_PART, _SPECTRUM_PART = 3, 1
# A panel that is lower than this, and this many times as wide, has more room beside the curve.
_LOW_PX = 300
_WIDE = 3


class EditorBody(QWidget):
    """Canvas and spectrum: where a panel is low and wide, the spectrum stands at the right."""

    def __init__(self, canvas: QWidget, spectrum: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._layout = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(0)
        self._layout.addWidget(canvas, _CANVAS_PART)
        self._layout.addWidget(spectrum, _SPECTRUM_PART)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        low = self.height() < _LOW_PX and self.width() >= _WIDE * self.height()
        ways = QBoxLayout.Direction
        self._layout.setDirection(ways.LeftToRight if low else ways.TopToBottom)
        self._layout.activate()
