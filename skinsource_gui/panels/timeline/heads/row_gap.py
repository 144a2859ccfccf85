"""Where rows would go that are dragged."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QFrame, QWidget

_HIGH_PX = 3


class RowGap(QFrame):
    """A line between two rows, or before or behind all of them."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._column = parent
        self.setObjectName("input_gap")
        self.setBackgroundRole(QPalette.ColorRole.Highlight)
        self.setAutoFillBackground(True)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.hide()

    def show_behind(self, above: Sequence[QWidget] | None) -> None:
        """Show it below the last of these, at the top where there is none; None: nowhere."""
        self.setVisible(above is not None)
        if above is not None:
            bottom = above[-1].geometry().bottom() + 1 if above else 0
            self.setGeometry(0, max(bottom - _HIGH_PX // 2, 0), self._column.width(), _HIGH_PX)
            self.raise_()
