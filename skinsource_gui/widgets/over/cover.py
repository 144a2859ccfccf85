"""What hides a picture from an audience that shall guess first."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QWidget

#: What stands on what is covered.
COVERED = "Covered"
_LEAST_LINES = 2


class Cover(QWidget):
    """Lies over all of another widget, and lets neither eyes nor the mouse through.

    Parameters
    ----------
    part
        What it hides; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self._part = part
        self.setObjectName("cover")
        self.setAccessibleName(COVERED)
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        part.installEventFilter(self)
        self.setGeometry(part.rect())
        self.show()
        self.raise_()

    def take_away(self) -> None:
        """Reveal what is below."""
        self._part.removeEventFilter(self)
        self.hide()
        self.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._part.rect())
        return super().eventFilter(watched, event)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip:
            return True  # that of what is below would tell
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, palette = QPainter(self), self.palette()
        painter.fillRect(self.rect(), palette.color(QPalette.ColorRole.Window))
        # Beside something larger that says it, a line of words says nothing.
        if self.height() >= _LEAST_LINES * self.fontMetrics().height():
            painter.setPen(palette.color(QPalette.ColorRole.WindowText))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, COVERED)
        painter.end()
