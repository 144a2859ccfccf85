"""What lies over results of an older design until newer ones are there."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.over.over_all import OverAll

#: What stands on them.
UPDATING = "Updating…"
#: How much of them is still seen.
PALE = 0.45
_LEAST_LINES = 2
_RADIUS_PX = 4.0


class Veil(OverAll):
    """Lies over all of another widget, which stays readable and can be used.

    Parameters
    ----------
    part
        What belongs to an older design; also its parent.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self.setObjectName("veil")
        self.setAccessibleName(UPDATING)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, palette = QPainter(self), self.palette()
        ground = palette.color(QPalette.ColorRole.Base)
        thin = QColor(ground)
        thin.setAlphaF(1.0 - PALE)
        painter.fillRect(self.rect(), thin)
        # Beside something larger that says it, a line of words says nothing.
        if self.height() >= _LEAST_LINES * self.fontMetrics().height():
            words = palette.color(QPalette.ColorRole.Text)
            paint_updating(painter, QRectF(self.rect()), ground, words)
        painter.end()


def paint_updating(painter: QPainter, room: QRectF, ground: QColor, words: QColor) -> None:
    """Write in the middle of ``room``, on a ground of its own, that its content is not new."""
    metrics = painter.fontMetrics()
    card = QRectF(0, 0, metrics.horizontalAdvance(UPDATING) + 2 * UNIT_PX, 1.6 * metrics.height())
    card.moveCenter(room.center())
    painter.setPen(words)
    painter.setBrush(ground)
    painter.drawRoundedRect(card, _RADIUS_PX, _RADIUS_PX)
    painter.drawText(card, Qt.AlignmentFlag.AlignCenter, UPDATING)
