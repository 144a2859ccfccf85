"""What hides a picture from an audience that shall guess first."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QWidget

from skinsource_gui.widgets.over.over_all import OverAll

#: What stands on what is covered.
COVERED = "Covered"
_LEAST_LINES = 2


class Cover(OverAll):
    """Lies over all of another widget, and lets neither eyes nor the mouse through.

    Parameters
    ----------
    part
        What it hides; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self.setObjectName("cover")
        self.setAccessibleName(COVERED)
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)

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
