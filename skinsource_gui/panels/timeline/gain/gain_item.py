"""Gain curves as an item of the scene, over the clips."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen, QPolygonF

from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gain.gain_strip import GainStrip, gain_words
from skinsource_gui.theme import current_theme

_DOT_PX, _CHOSEN_PX = 3.5, 5.0
_HALO_ALPHA, _HINT_ALPHA = 190, 110
#: How a curve begins.
HINT = "Gain: double click on the line adds a point"


def has_hint(strip: GainStrip) -> bool:
    """Whether it is said how a curve begins: of a selected track that has none."""
    return strip.shown and strip.lane.selected and not strip.points


class GainItem(pyqtgraph.GraphicsObject):
    """Paints gain curves: those that are edited with points, others that do something as a hint."""

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.setZValue(0.5)
        self._content: Content | None = None
        self._font = QFont()
        self._rect = QRectF(0, 0, 1, 1)

    def show_content(self, content: Content, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        had = self._content is not None and bool(self._content.strips)
        self._content = content
        self.setVisible(bool(content.strips))
        if had or content.strips:
            self.update()

    def show_font(self, font: QFont) -> None:
        """Take over a font."""
        self._font = font
        self.update()

    def boundingRect(self) -> QRectF:
        return self._rect

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        content = self._content
        if content is None:
            return
        painter.setFont(self._font)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        below = self._rect.adjusted(0, content.ruler_px, 0, 0)
        for strip in content.strips:
            lane = strip.lane
            room = QRectF(below.left(), lane.top_px, below.width(), lane.height_px)
            painter.save()
            painter.setClipRect(room.intersected(below))
            self._paint_curve(painter, strip, room)
            if strip.shown:
                chosen = content.chosen_point
                own = chosen is not None and chosen[0] == lane.track.id
                number = chosen[1] if chosen and own and chosen[1] < len(strip.points) else None
                self._paint_points(painter, strip, room, number)
            painter.restore()

    def _paint_curve(self, painter: QPainter, strip: GainStrip, room: QRectF) -> None:
        line, words = QColor(current_theme().text), QColor(current_theme().dim)
        if strip.shown:
            unity = strip.y(1.0)
            painter.setPen(QPen(words, 1, Qt.PenStyle.DotLine))
            painter.drawLine(QLineF(room.left(), unity, room.right(), unity))
        points = strip.points or ((0.0, 1.0, "straight"),)
        places = [strip.at(x, y) for x, y, _ in points]
        places = [
            QPointF(room.left(), places[0].y()),
            *places,
            QPointF(max(room.right(), places[-1].x()), places[-1].y()),
        ]
        curve = QPolygonF(places)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if strip.shown:
            halo = QColor(current_theme().base)
            halo.setAlpha(_HALO_ALPHA)
            painter.setPen(QPen(halo, 4))
            painter.drawPolyline(curve)
            painter.setPen(QPen(line, 1.5))
        else:
            line.setAlpha(_HINT_ALPHA)
            painter.setPen(QPen(line, 1, Qt.PenStyle.DashLine))
        painter.drawPolyline(curve)

    def _paint_points(
        self, painter: QPainter, strip: GainStrip, room: QRectF, chosen: int | None
    ) -> None:
        theme = current_theme()
        for k, (x, y, _) in enumerate(strip.points):
            radius = _CHOSEN_PX if k == chosen else _DOT_PX
            painter.setPen(QPen(QColor(theme.text), 1.5))
            painter.setBrush(QColor(theme.accent if k == chosen else theme.base))
            painter.drawEllipse(strip.at(x, y), radius, radius)
        words = "Gain" if chosen is None else gain_words(*strip.points[chosen][:2])
        metrics = QFontMetricsF(self._font)
        height, top = metrics.height() + 1, room.top() + 2
        if has_hint(strip):
            # Below, as names of clips stand above.
            words, top = HINT, room.bottom() - height - 2
        width = metrics.horizontalAdvance(words) + 8
        label = QRectF(room.right() - width - 4, top, width, height)
        ground = QColor(theme.base)
        ground.setAlpha(_HALO_ALPHA)
        painter.fillRect(label, ground)
        painter.setPen(QColor(theme.text))
        painter.drawText(label, Qt.AlignmentFlag.AlignCenter, words)
