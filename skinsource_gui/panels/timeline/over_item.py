"""What a gesture shows over the lanes."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gestures.gesture import Shown
from skinsource_gui.theme import current_theme

_WORDS_GAP_PX = 8.0


class OverItem(pyqtgraph.GraphicsObject):
    """A guide, a marquee and words, an item of its own: the lanes below are not painted with it."""

    def __init__(self) -> None:
        super().__init__()
        self.setZValue(2)
        self._shown, self._pointer = Shown(), QPointF()
        self._content: Content | None = None
        self._rect = QRectF(0, 0, 1, 1)
        self._font = QFont()

    @property
    def shown(self) -> Shown:
        """What is shown."""
        return self._shown

    def show_content(self, content: Content, rect: QRectF) -> None:
        """Lie over these lanes, in this rectangle."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        moved = self._content is not None and self._content.scale != content.scale
        self._content = content
        if moved and self._shown.guide_s is not None:
            self.update()

    def show_over(self, shown: Shown, pointer: QPointF) -> None:
        """Show this, with words beside the pointer."""
        if (shown, pointer) != (self._shown, self._pointer):
            self._update_places()
            self._shown, self._pointer = shown, pointer
            self._update_places()

    def show_font(self, font: QFont) -> None:
        """Take over a font."""
        self._font = font
        self.update()

    def boundingRect(self) -> QRectF:
        return self._rect

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        painter.setFont(self._font)
        guide = self._guide()
        if guide is not None:
            painter.setPen(QPen(QColor(current_theme().warning), 2))
            painter.drawLine(guide)
        if self._shown.covered is not None:
            tint = QColor(current_theme().accent)
            painter.setPen(QPen(tint, 1))
            tint.setAlpha(30)
            painter.setBrush(tint)
            painter.drawRect(self._shown.covered)
        if self._shown.words:
            room = self._room_for_words()
            painter.setPen(QPen(QColor(current_theme().border), 1))
            painter.setBrush(QColor(current_theme().raised))
            painter.drawRect(room)
            painter.setPen(QColor(current_theme().text))
            painter.drawText(room, Qt.AlignmentFlag.AlignCenter, self._shown.words)

    def _update_places(self) -> None:
        """Have painted anew where something is shown."""
        guide = self._guide()
        if guide is not None:
            self.update(QRectF(guide.p1(), guide.p2()).adjusted(-2, -2, 2, 2))
        if self._shown.covered is not None:
            self.update(self._shown.covered.adjusted(-2, -2, 2, 2))
        if self._shown.words:
            self.update(self._room_for_words().adjusted(-2, -2, 2, 2))

    def _guide(self) -> QLineF | None:
        if self._shown.guide_s is None or self._content is None:
            return None
        x = self._content.scale.x(self._shown.guide_s)
        return QLineF(x, self._content.ruler_px, x, self._rect.bottom())

    def _room_for_words(self) -> QRectF:
        metrics = QFontMetricsF(self._font)
        ruler_px = 0.0 if self._content is None else self._content.ruler_px
        width = metrics.horizontalAdvance(self._shown.words) + 8
        left = min(self._pointer.x() + _WORDS_GAP_PX, self._rect.right() - width - 2)
        top = max(self._pointer.y() - metrics.height() - _WORDS_GAP_PX, ruler_px + 2)
        return QRectF(left, top, width, metrics.height() + 2)
