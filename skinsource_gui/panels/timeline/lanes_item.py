"""The lanes as one item of pyqtgraph's scene: many clips, one paint."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QLineF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

from skinsource_gui.panels.timeline.clip_painter import paint_clip
from skinsource_gui.panels.timeline.clip_pictures import ClipPictures
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.lane import MARGIN_PX, Lane
from skinsource_gui.panels.timeline.lane_look import (
    frame_of,
    same_choice,
    same_chosen,
    same_clips,
    same_ground,
)
from skinsource_gui.panels.timeline.overlaps import paint_overlaps
from skinsource_gui.panels.timeline.ruler_painter import grid_lines, paint_ruler
from skinsource_gui.theme import current_theme

# Clips lie deeper in their lanes than this.  What is painted anew is one px larger than asked for:
# so far inside it does not reach the next lane.
# The last line of the grid stands there; words end before it.
_SIDE_PX = 14.0
# Between words and the lines that stop around them.
_AROUND_PX = 3.0
_INSIDE_PX = MARGIN_PX - 1.0


class LanesItem(pyqtgraph.GraphicsObject):
    """Paints lanes, clips and ruler; knows nothing of the mouse.

    It is kept as a picture, over which the playhead moves and gestures show what they do.  Only
    lanes that look different now are painted into it again.

    Attributes
    ----------
    pictures
        What clips play, painted once.
    painted, painted_lanes
        How often it was painted, and how many lanes in all.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        # Told what is to be painted, it paints no more.
        self.setFlag(self.GraphicsItemFlag.ItemUsesExtendedStyleOption)
        self.pictures = ClipPictures()
        self.painted = self.painted_lanes = 0
        self._content: Content | None = None
        self._hovered: int | None = None
        self._font = QFont()
        self._rect = QRectF(0, 0, 1, 1)

    def show_content(self, content: Content, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        before, self._content = self._content, content
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
            self.update()
        elif before is None or frame_of(before) != frame_of(content):
            self.update()
        else:
            self._update_lanes(before, content)

    def show_hovered(self, clip: int | None) -> None:
        """The clip under the pointer shows what can be dragged."""
        if clip != self._hovered:
            for one in (self._hovered, clip):
                self._update_lane_of(one)
            self._hovered = clip

    def show_font(self, font: QFont) -> None:
        """Take over a font."""
        self._font = font
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
        rect, exposed = self._rect, option.exposedRect
        lanes = QRectF(
            rect.left(), content.ruler_px, rect.width(), rect.height() - content.ruler_px
        )
        painter.save()
        painter.setClipRect(lanes)
        shown = [lane for lane in content.lanes if self._strip(lane).intersects(exposed)]
        for lane in shown:
            self._paint_ground(painter, lane)
        painter.setPen(QPen(QColor(current_theme().grid), 1))
        painter.drawLines(grid_lines(content.scale, lanes))
        self._paint_after_end(painter, content, lanes)
        for lane in shown:
            self._paint_why_silent(painter, lane)
            self._paint_clips(painter, content, lane, lanes)
            found = content.overlaps.of(lane.track)
            paint_overlaps(painter, lane, found, content.scale, current_theme())
        self.painted_lanes += len(shown)
        painter.restore()
        ruler = QRectF(rect.left(), 0, rect.width(), content.ruler_px)
        if ruler.intersects(exposed):
            paint_ruler(painter, content, ruler, current_theme())

    def _update_lane_of(self, clip: int | None) -> None:
        for lane in () if self._content is None or clip is None else self._content.lanes:
            if any(one.id == clip for one in lane.track.clips):
                self.update(self._strip(lane).adjusted(0, _INSIDE_PX, 0, -_INSIDE_PX))

    def _update_lanes(self, before: Content, after: Content) -> None:
        """Have painted the lanes that look different now."""
        chosen_alike = same_chosen(before, after)
        for then, now in zip(before.lanes, after.lanes, strict=True):
            if not same_ground(then, now):
                self.update(self._strip(now))
            elif not same_clips(before, then, after, now) or not (
                chosen_alike or same_choice(before, after, now)
            ):
                self.update(self._strip(now).adjusted(0, _INSIDE_PX, 0, -_INSIDE_PX))

    @property
    def _ground(self) -> QColor:
        """Of the lanes."""
        return QColor(current_theme().base)

    @property
    def _tint(self) -> QColor:
        """What lies over the ground of lanes that are selected."""
        tint = QColor(current_theme().accent)
        tint.setAlpha(18)
        return tint

    def _strip(self, lane: Lane) -> QRectF:
        return QRectF(self._rect.left(), lane.top_px, self._rect.width(), lane.height_px)

    def _paint_ground(self, painter: QPainter, lane: Lane) -> None:
        strip = self._strip(lane)
        if lane.selected:
            painter.fillRect(strip, self._tint)
        painter.setPen(QPen(QColor(current_theme().border), 1))
        painter.drawLine(
            QLineF(strip.left(), strip.bottom() - 0.5, strip.right(), strip.bottom() - 0.5)
        )

    def _paint_why_silent(self, painter: QPainter, lane: Lane) -> None:
        """Say it over the grid, whose lines stop around the words."""
        if not lane.silent:
            return
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom
        room = self._strip(lane).adjusted(0, 0, -_SIDE_PX, -3)
        words = QRectF(painter.boundingRect(room, flags, lane.silent))
        painter.fillRect(words.adjusted(-_AROUND_PX, 0, _AROUND_PX, 0), self._ground)
        if lane.selected:
            painter.fillRect(words.adjusted(-_AROUND_PX, 0, _AROUND_PX, 0), self._tint)
        theme = current_theme()
        painter.setPen(QColor(theme.error if lane.problem else theme.dim))
        painter.drawText(room, flags, lane.silent)

    def _paint_after_end(self, painter: QPainter, content: Content, lanes: QRectF) -> None:
        if content.design.loop_s is None:
            return
        start, end = (content.scale.x(one) for one in content.design.loop_s)
        shade = QColor(current_theme().dim)
        shade.setAlpha(22)
        for left, right in ((lanes.left(), start), (end, lanes.right())):
            if right > left:
                painter.fillRect(QRectF(left, lanes.top(), right - left, lanes.height()), shade)

    def _paint_clips(self, painter: QPainter, content: Content, lane: Lane, lanes: QRectF) -> None:
        loudest = max((abs(one.gain) for one in lane.track.clips), default=0.0)
        unplayable = content.unplayable_on(lane)
        for box in content.boxes_on(lane):
            paint_clip(
                painter,
                box,
                content.waveforms.get(box.clip.id),
                content.sample_rate_hz,
                self.pictures,
                current_theme(),
                loudest=loudest,
                selected=box.clip.id in content.selected,
                shown_elsewhere=box.clip.id in content.chosen,
                unplayable=box.clip.id in unplayable,
                awaited=box.clip.id in content.awaited,
                handles=box.clip.id == self._hovered and box.rect.width() > 40,
                view=lanes,
            )
