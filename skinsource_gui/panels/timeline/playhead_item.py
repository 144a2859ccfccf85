"""The playhead over the lanes."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.theme import current_theme

_HALF_PX, _HANDLE_PX = 5.0, 8.0


class PlayheadItem(pyqtgraph.GraphicsObject):
    """A line with a handle, an item of its own: the lanes below are not painted when it moves.

    Attributes
    ----------
    moved
        How often it was put somewhere else.
    """

    def __init__(self) -> None:
        super().__init__()
        self.moved = 0
        self._height = 1.0
        self.setZValue(1)

    def show_content(self, content: Content, height_px: float) -> None:
        """Stand where the content says, from the ruler down to a height."""
        height = max(height_px - content.ruler_px + _HANDLE_PX, 1.0)
        if height != self._height:
            self.prepareGeometryChange()
            self._height = height
        at = QPointF(content.scale.x(content.view.playhead_s), content.ruler_px - _HANDLE_PX)
        if at != self.pos():
            self.moved += 1
            self.setPos(at)

    def boundingRect(self) -> QRectF:
        return QRectF(-_HALF_PX - 1, -3, 2 * _HALF_PX + 2, self._height + 3)

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        colour = QColor(current_theme().error)
        painter.setPen(QPen(colour, 1))
        painter.drawLine(QLineF(0, 0, 0, self._height))
        painter.setBrush(colour)
        corners = (QPointF(-_HALF_PX, -2), QPointF(_HALF_PX, -2), QPointF(0, 6))
        painter.drawPolygon(QPolygonF(corners))
