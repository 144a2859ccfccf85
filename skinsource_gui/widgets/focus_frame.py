"""The frame around what has the keyboard."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource_gui.theme import Theme
from skinsource_gui.widgets.paper import is_on_paper


def paint_focus_frame(painter: QPainter, area: QRectF, theme: Theme) -> None:
    """Draw the frame just inside ``area``; in a picture there is none."""
    if is_on_paper():
        return
    painter.setPen(QPen(QColor(theme.accent), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area.adjusted(0.5, 0.5, -0.5, -0.5))
