"""A widget that can be drawn for a page or a slide."""

from PySide6.QtCore import QPoint, QRectF
from PySide6.QtGui import QColor, QPainter, QRegion
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import LIGHT, Theme
from skinsource_gui.widgets.focus_frame import on_paper


class Pictured(QWidget):
    """Draws itself as it is, unless it knows better."""

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw what it shows for a page or a slide; size in px.

        Unless it knows better that is in the colours in use: whoever wants others sees to it that
        these are in use.
        """
        scale = min(width / max(self.width(), 1), height / max(self.height(), 1))
        painter.save()
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
        painter.translate((width - scale * self.width()) / 2, 0.0)
        painter.scale(scale, scale)
        flags = QWidget.RenderFlag.DrawWindowBackground | QWidget.RenderFlag.DrawChildren
        with on_paper():
            self.render(painter, QPoint(), QRegion(), flags)
        painter.restore()
