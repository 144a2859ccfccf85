"""The lanes as one item of pyqtgraph's scene: many clips, one paint."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from skinsource_gui.panels.timeline.clip_painter import paint_clip
from skinsource_gui.panels.timeline.clip_pictures import ClipPictures
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gestures.gesture import Shown
from skinsource_gui.panels.timeline.lane import Lane
from skinsource_gui.panels.timeline.overlaps import paint_overlaps
from skinsource_gui.panels.timeline.ruler_painter import grid_lines, paint_ruler
from skinsource_gui.theme import LIGHT, Theme

_STALE = 0.5
_WORDS_GAP_PX = 8.0


class LanesItem(pyqtgraph.GraphicsObject):
    """Paints lanes, clips and ruler; knows nothing of the mouse.

    It is kept as a picture, over which the playhead moves.

    Attributes
    ----------
    pictures
        What clips play, painted once.
    painted
        How often it was painted.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.pictures = ClipPictures()
        self.painted = 0
        self._content: Content | None = None
        self._shown = Shown()
        self._hovered: int | None = None
        self._pointer = QPointF()
        self._theme = LIGHT
        self._font = QFont()
        self._rect = QRectF(0, 0, 1, 1)
        self._stale = False

    def show_content(self, content: Content, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self._content = content
        self.update()

    @property
    def over(self) -> Shown:
        """What a gesture shows over the lanes."""
        return self._shown

    def show_over(self, shown: Shown, pointer: QPointF) -> None:
        """What a gesture shows over the lanes, and where the pointer is."""
        self._shown, self._pointer = shown, pointer
        self.update()

    def show_hovered(self, clip: int | None) -> None:
        """The clip under the pointer shows what can be dragged."""
        if clip != self._hovered:
            self._hovered = clip
            self.update()

    def show_stale(self, stale: bool) -> None:
        """Whether curves belong to an older design."""
        if stale != self._stale:
            self._stale = stale
            self.update()

    def show_look(self, theme: Theme, font: QFont) -> None:
        """Take over colours and font."""
        self._theme, self._font = theme, font
        self.pictures.forget()
        self.update()

    def boundingRect(self) -> QRectF:
        return self._rect

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        content = self._content
        if content is None:
            return
        self.painted += 1
        painter.setFont(self._font)
        rect = self._rect
        lanes = QRectF(
            rect.left(), content.ruler_px, rect.width(), rect.height() - content.ruler_px
        )
        painter.save()
        painter.setClipRect(lanes)
        for lane in content.lanes:
            self._paint_ground(painter, lane)
        painter.setPen(QPen(QColor(self._theme.grid), 1))
        painter.drawLines(grid_lines(content.scale, lanes))
        self._paint_after_end(painter, content, lanes)
        self._paint_clips(painter, content, lanes)
        for lane in content.lanes:
            found = content.overlaps.of(lane.track)
            paint_overlaps(painter, lane, found, content.scale, self._theme)
        painter.restore()
        paint_ruler(
            painter, content, QRectF(rect.left(), 0, rect.width(), content.ruler_px), self._theme
        )
        self._paint_guide(painter, content)
        self._paint_over(painter, content)

    def _paint_ground(self, painter: QPainter, lane: Lane) -> None:
        strip = QRectF(self._rect.left(), lane.top_px, self._rect.width(), lane.height_px)
        if lane.selected:
            tint = QColor(self._theme.accent)
            tint.setAlpha(18)
            painter.fillRect(strip, tint)
        painter.setPen(QPen(QColor(self._theme.border), 1))
        painter.drawLine(
            QLineF(strip.left(), strip.bottom() - 0.5, strip.right(), strip.bottom() - 0.5)
        )
        if lane.silent:
            painter.setPen(QColor(self._theme.dim))
            flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom
            painter.drawText(strip.adjusted(0, 0, -6, -3), flags, lane.silent)

    def _paint_after_end(self, painter: QPainter, content: Content, lanes: QRectF) -> None:
        if content.design.loop_s is None:
            return
        start, end = (content.scale.x(one) for one in content.design.loop_s)
        shade = QColor(self._theme.dim)
        shade.setAlpha(22)
        for left, right in ((lanes.left(), start), (end, lanes.right())):
            if right > left:
                painter.fillRect(QRectF(left, lanes.top(), right - left, lanes.height()), shade)

    def _paint_clips(self, painter: QPainter, content: Content, lanes: QRectF) -> None:
        chosen = frozenset(content.view.selected_clips)
        loudest: dict[int, float] = {}
        for box in content.boxes:
            track = box.lane.track
            if track.id not in loudest:
                loudest[track.id] = max(abs(one.gain) for one in track.clips)
            paint_clip(
                painter,
                box,
                content.waveforms.get(box.clip.id),
                self.pictures,
                self._theme,
                loudest=loudest[track.id],
                selected=box.clip.id in chosen,
                shown_elsewhere=box.clip.id in content.chosen,
                handles=box.clip.id == self._hovered and box.rect.width() > 40,
                view=lanes,
            )

    def _paint_guide(self, painter: QPainter, content: Content) -> None:
        if self._shown.guide_s is not None:
            x = content.scale.x(self._shown.guide_s)
            painter.setPen(QPen(QColor(self._theme.warning), 2))
            painter.drawLine(QLineF(x, content.ruler_px, x, self._rect.bottom()))

    def _paint_over(self, painter: QPainter, content: Content) -> None:
        if self._shown.covered is not None:
            tint = QColor(self._theme.accent)
            painter.setPen(QPen(tint, 1))
            tint.setAlpha(30)
            painter.setBrush(tint)
            painter.drawRect(self._shown.covered)
        if self._shown.words:
            metrics = QFontMetricsF(self._font)
            width = metrics.horizontalAdvance(self._shown.words) + 8
            left = min(self._pointer.x() + _WORDS_GAP_PX, self._rect.right() - width - 2)
            top = max(self._pointer.y() - metrics.height() - _WORDS_GAP_PX, content.ruler_px + 2)
            room = QRectF(left, top, width, metrics.height() + 2)
            painter.setPen(QPen(QColor(self._theme.border), 1))
            painter.setBrush(QColor(self._theme.raised))
            painter.drawRect(room)
            painter.setPen(QColor(self._theme.text))
            painter.drawText(room, Qt.AlignmentFlag.AlignCenter, self._shown.words)
