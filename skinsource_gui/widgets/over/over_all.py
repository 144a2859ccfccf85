"""What lies over all of another widget, however large that becomes."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QWidget


class OverAll(QWidget):
    """Lies over all of another widget until it is taken away.

    Parameters
    ----------
    part
        What lies below; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self._part = part
        part.installEventFilter(self)
        self.setGeometry(part.rect())
        self.show()
        self.raise_()

    def take_away(self) -> None:
        """Show what is below as it is."""
        self._part.removeEventFilter(self)
        self.hide()
        self.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._part.rect())
        return super().eventFilter(watched, event)
