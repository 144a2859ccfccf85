"""A line for a name that is there already, and is mostly typed anew."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QFocusEvent, QMouseEvent
from PySide6.QtWidgets import QLineEdit


class NameLine(QLineEdit):
    """Selects all it holds when it is entered with the mouse, as Qt does with the Tab key.

    What is typed then takes the place of what was there; a further click sets the cursor.
    """

    def __init__(self) -> None:
        super().__init__()
        self._entered = False

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._entered = event.reason() == Qt.FocusReason.MouseFocusReason

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        # Not before: the press sets the cursor.
        if self._entered and not self.hasSelectedText():
            self.selectAll()
        self._entered = False
