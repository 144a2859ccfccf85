"""Paints clips, ruler and lanes.

Lanes are kept as a picture, into which only lanes that look different are painted again.
"""

from collections.abc import Hashable, Sequence
from math import inf
from typing import Any

from PySide6 import QtGui
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt

from skinsource.base.conventions import Floats
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.panels.timeline.content import MARGIN_PX, Box, Lane, TimelineContent, clip_name
from skinsource_gui.panels.timeline.gestures import GesturePreview
from skinsource_gui.plots.plot import CanvasItem
from skinsource_gui.plots.preview import ClipPictures, ClipStyle
from skinsource_gui.plots.ranges import Tick, linear_ticks
from skinsource_gui.plots.small_map import paint_band
from skinsource_gui.plots.time_scale import Range, TimeScale
from skinsource_gui.qt.frames import paint_card
from skinsource_gui.qt.theme import Theme, current_theme, dots_in_px, translucent

_ROUNDING_PX = 3.0
_LABEL_FROM_PX = 40.0
_BODY_ALPHA, _PALE_BODY_ALPHA, _SELECTED_ALPHA = 46, 18, 84
_PALE = 0.45
_HANDLE_PX = 5.0


def paint_clip(
    painter: QtGui.QPainter,
    box: Box,
    content: TimelineContent,
    pictures: ClipPictures,
    *,
    unplayable: bool,
    handles: bool,
    view: QRectF,
) -> None:
    """Paint a clip.

    Parameters
    ----------
    unplayable
        Whether the track cannot be played because of the clip.
    handles
        Whether to show that its ends can be dragged.
    view
        The visible rectangle: no more is painted.
    """
    theme, clip = current_theme(), box.clip
    drawn, selected = content.drawn.get(clip.id), clip.id in content.selected
    edited = clip.id in content.chosen
    pale = clip.muted or bool(box.lane.silent and not unplayable)
    colour = QtGui.QColor(theme.dim) if pale else theme.input_colour(box.lane.track.colour)
    if unplayable:
        colour = QtGui.QColor(theme.error)
    shown = box.rect.intersected(view.adjusted(-2, 0, 2, 0))
    if shown.isEmpty():
        # Of its lane no more is in sight than the edge.
        return
    _paint_body(painter, box.rect, shown, colour, selected=selected, pale=pale)
    if drawn is not None and shown.width() >= 1:
        painter.setOpacity(_PALE if pale else 1.0)
        _paint_samples(painter, box, shown, drawn.samples, content, pictures, colour)
        painter.setOpacity(1.0)
    if any(box.ends):
        _paint_fades(painter, box, content.scale.px_per_s, QtGui.QColor(theme.text))
    # Over the lines of fades: the name is read first.
    if shown.width() >= _LABEL_FROM_PX:
        text = f"{clip_name(clip)}{' · updating…' if clip.id in content.awaited else ''}"
        # As far as the next clip, which has a name of its own.
        own, clips = (clip.onset_s, clip.id), box.lane.track.clips
        after = [each.onset_s for each in clips if (each.onset_s, each.id) > own]
        end = content.scale.x(min(after, default=inf))
        free = shown.adjusted(0, 0, min(end - shown.right(), 0), 0)
        if free.width() >= _LABEL_FROM_PX:
            _write(painter, text, box.rect, free, theme, pale=pale)
    _paint_frame(painter, box.rect, shown, theme, colour, selected=selected, edited=edited)
    if handles:
        _paint_handles(painter, box, QtGui.QColor(theme.text))


def _paint_body(
    painter: QtGui.QPainter,
    rect: QRectF,
    shown: QRectF,
    colour: QtGui.QColor,
    *,
    selected: bool,
    pale: bool,
) -> None:
    alpha = _PALE_BODY_ALPHA if pale else _BODY_ALPHA
    painter.fillRect(shown, translucent(colour, _SELECTED_ALPHA if selected else alpha))
    # A mark at the start separates clips that follow each other.
    if rect.left() >= shown.left():
        painter.fillRect(QRectF(rect.left(), rect.top(), 2, rect.height()), colour)


def _paint_samples(
    painter: QtGui.QPainter,
    box: Box,
    shown: QRectF,
    samples: Floats,
    content: TimelineContent,
    pictures: ClipPictures,
    colour: QtGui.QColor,
) -> None:
    rect, part, area = box.rect, (0.0, 1.0), box.rect
    if shown.width() < rect.width() - 1:
        area = shown
        ends_px = shown.left() - rect.left(), shown.right() - rect.left()
        part = (ends_px[0] / rect.width(), ends_px[1] / rect.width())
    reach = box.clip.gain * box.lane.track.amplitude / (content.loudest or 1.0)
    width, height = max(round(area.width()), 1), max(round(rect.height()) - 2, 1)
    room = QRectF(area.left(), rect.top() + 1, width, height)
    rate_hz, ratio = content.sample_rate_hz, dots_in_px(painter)
    style = ClipStyle(rate_hz, colour.rgba(), reach, part, ratio)
    pictures.paint(painter, samples, room, style)


def _write(
    painter: QtGui.QPainter, words: str, rect: QRectF, shown: QRectF, theme: Theme, *, pale: bool
) -> None:
    metrics = QtGui.QFontMetricsF(painter.font())
    line_px = metrics.height()
    # It stays in its row when that goes out of sight under the ruler.
    top = min(shown.top() + 1, rect.bottom() - line_px)
    room = QRectF(shown.left() + 5, top, shown.width() - 10, line_px)
    text, width = words, metrics.horizontalAdvance(words)
    if width > room.width():
        text = metrics.elidedText(words, Qt.TextElideMode.ElideRight, room.width())
        width = metrics.horizontalAdvance(text)
    ground = translucent(theme.base, 190)
    painter.fillRect(QRectF(room.left() - 2, room.top(), width + 4, line_px), ground)
    painter.setPen(QtGui.QColor(theme.dim if pale else theme.text))
    painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)


def _paint_frame(
    painter: QtGui.QPainter,
    rect: QRectF,
    shown: QRectF,
    theme: Theme,
    colour: QtGui.QColor,
    *,
    selected: bool,
    edited: bool,
) -> None:
    if selected:
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 2))
    elif edited:
        # The clip panel shows it, but keys do not act on it.
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1, Qt.PenStyle.DotLine))
    else:
        painter.setPen(QtGui.QPen(translucent(colour, 130), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    # It is cut a little outside of what is shown of the clip.
    frame = rect.intersected(shown.adjusted(-2, 0, 2, 0)).adjusted(0.5, 0.5, -0.5, -0.5)
    painter.drawRoundedRect(frame, _ROUNDING_PX, _ROUNDING_PX)


def _paint_fades(painter: QtGui.QPainter, box: Box, px_per_s: float, colour: QtGui.QColor) -> None:
    """Paint the course of fades, as their shape has it, without what a split cut off."""
    rect = box.rect
    painter.setPen(QtGui.QPen(colour, 1, Qt.PenStyle.DashLine))
    for start, way, end in zip((rect.left(), rect.right()), (1, -1), box.ends, strict=True):
        if end is not None:
            inside_s, levels = end.course(fades_out=way < 0)
            x, y = start + way * px_per_s * inside_s, rect.bottom() - levels * rect.height()
            painter.drawPolyline(QtGui.QPolygonF(list(map(QPointF, x, y))))


def _paint_handles(painter: QtGui.QPainter, box: Box, colour: QtGui.QColor) -> None:
    rect, (in_px, out_px) = box.rect, box.fades_px
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    fades = (
        (rect.topLeft() + QPointF(in_px, 0), 1),
        (rect.topRight() - QPointF(out_px, 0), -1),
    )
    for corner, side in fades:
        ends = (
            corner,
            corner + QPointF(side * 2 * _HANDLE_PX, 0),
            corner + QPointF(0, 2 * _HANDLE_PX),
        )
        painter.drawPolygon(QtGui.QPolygonF(ends))
    middle = rect.center().y()
    for x in (rect.left() + 2, rect.right() - 4):
        painter.drawRect(QRectF(x, middle - _HANDLE_PX, 2, 2 * _HANDLE_PX))


def frame_of(content: TimelineContent) -> Hashable:
    """Return what all lanes and the ruler depend on, but for the content of single lanes."""
    design = content.design
    places = tuple((lane.track.id, lane.top_px, lane.height_px) for lane in content.lanes)
    return content.scale, content.ruler_px, design.loop_s, design.markers, places


def ground_of(lane: Lane) -> Hashable:
    """Return what the look of a lane depends on, but for its clips."""
    return lane.selected, lane.silent, lane.problem


def restyled_clips(before: TimelineContent, after: TimelineContent) -> set[int]:
    """Return the ids of the clips that are marked otherwise, or drawn from other samples."""
    then, now = before.drawn, after.drawn
    return {
        *before.selected.symmetric_difference(after.selected),
        *set(before.chosen).symmetric_difference(after.chosen),
        *before.awaited.symmetric_difference(after.awaited),
        *(clip for clip in then.keys() | now.keys() if then.get(clip) is not now.get(clip)),
    }


_TICK_PX = 64.0
_GAP_PX = 6.0
_LOOP_ALPHA = 60


def ticks_of(scale: TimeScale) -> tuple[str, tuple[Tick, ...]]:
    """Return the unit of the ruler, and its ticks."""
    unit, factor = axis_unit(scale.shown_s[1])
    return unit, linear_ticks(*scale.shown_s, max(scale.width_px / _TICK_PX, 2), factor)


def grid_lines(scale: TimeScale, room: QRectF) -> list[QLineF]:
    """Return the vertical lines below the ticks."""
    places = (scale.x(tick.value) for tick in ticks_of(scale)[1])
    return [
        QLineF(x, room.top(), x, room.bottom()) for x in places if room.left() <= x <= room.right()
    ]


def paint_ruler(
    painter: QtGui.QPainter, content: TimelineContent, room: QRectF, theme: Theme
) -> None:
    """Paint ticks, loop region and markers."""
    painter.fillRect(room, QtGui.QColor(theme.window))
    if content.design.loop_s is not None:
        _paint_loop(painter, content, content.design.loop_s, room, theme)
    names = []
    for marker in content.design.markers:
        x = content.scale.x(marker.time_s)
        names.append(_paint_marker(painter, x, marker.name, room, theme))
    _paint_ticks(painter, content.scale, room, theme, names)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.drawLine(QLineF(room.left(), room.bottom() - 0.5, room.right(), room.bottom() - 0.5))


def _paint_ticks(
    painter: QtGui.QPainter, scale: TimeScale, room: QRectF, theme: Theme, names: Sequence[QRectF]
) -> None:
    """Paint ticks, and their numbers where there is no name of a marker."""
    metrics = QtGui.QFontMetricsF(painter.font())
    unit, ticks = ticks_of(scale)
    painter.setPen(QtGui.QColor(theme.dim))
    unit_left = room.right() - metrics.horizontalAdvance(unit) - _GAP_PX
    painter.drawText(QPointF(unit_left, room.top() + metrics.ascent() + 1), unit)
    free_from = room.left()
    for tick in ticks:
        x = scale.x(tick.value)
        if not room.left() - 1 <= x <= room.right():
            continue
        painter.drawLine(QLineF(x, room.bottom() - 5, x, room.bottom()))
        width = metrics.horizontalAdvance(tick.label)
        left = max(x - width / 2, room.left() + 2)
        number = QRectF(left, room.top(), width, metrics.height())
        free = not any(name.intersects(number) for name in names)
        if free and left >= free_from and left + width < unit_left - _GAP_PX:
            painter.drawText(QPointF(left, room.top() + metrics.ascent() + 1), tick.label)
            free_from = left + width + _GAP_PX


def _paint_loop(
    painter: QtGui.QPainter, content: TimelineContent, loop_s: Range, room: QRectF, theme: Theme
) -> None:
    start, end = (content.scale.x(time_s) for time_s in loop_s)
    half = QRectF(room.left(), room.top(), room.width(), room.height() / 2)
    band = QRectF(start, room.top(), end - start, room.height()).intersected(half)
    painter.fillRect(band, translucent(theme.accent, _LOOP_ALPHA))
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 2))
    for x in (start, end):
        if room.left() <= x <= room.right():
            painter.drawLine(QLineF(x, room.top(), x, room.center().y()))


def _paint_marker(
    painter: QtGui.QPainter, x: float, name: str, room: QRectF, theme: Theme
) -> QRectF:
    """Paint a flag and a name; where they are."""
    if not room.left() - 200 <= x <= room.right():
        return QRectF()
    metrics = QtGui.QFontMetricsF(painter.font())
    colour = QtGui.QColor(theme.warning)
    painter.setPen(QtGui.QPen(colour, 1))
    painter.drawLine(QLineF(x, room.top(), x, room.bottom()))
    painter.setBrush(colour)
    painter.drawPolygon(
        QtGui.QPolygonF(
            (QPointF(x, room.top()), QPointF(x + 7, room.top() + 4), QPointF(x, room.top() + 8))
        )
    )
    shown = metrics.elidedText(name, Qt.TextElideMode.ElideRight, 110)
    ground = QRectF(x + 8, room.top(), metrics.horizontalAdvance(shown) + 4, metrics.height())
    painter.fillRect(ground, QtGui.QColor(theme.window))
    painter.drawText(ground, Qt.AlignmentFlag.AlignCenter, shown)
    return ground.adjusted(-10, 0, 2, 0)


# Text ends before the last line of the grid.
_SIDE_PX = 14.0
# Clips lie farther inside their lanes. Qt paints one px more than is updated: this does not reach
# the next lane.
_INSIDE_PX = MARGIN_PX - 1.0
_OVERLAP_PX, _OVERLAP_ALPHA, _TINT_ALPHA = 4.0, 190, 18


def paint_silence_reason(painter: QtGui.QPainter, lane: Lane, strip: QRectF) -> float:
    """Write why a lane is silent at the right end of its strip; return where what is free ends."""
    if not lane.silent:
        return strip.right()
    theme, metrics = current_theme(), QtGui.QFontMetricsF(painter.font())
    width, height = metrics.horizontalAdvance(lane.silent) + 6, metrics.height()
    left, top = strip.right() - _SIDE_PX - width, strip.bottom() - MARGIN_PX - height
    room = QRectF(left, top, width, height)
    painter.fillRect(room, QtGui.QColor(theme.base))
    painter.setPen(QtGui.QColor(theme.error if lane.problem else theme.dim))
    painter.drawText(room, Qt.AlignmentFlag.AlignCenter, lane.silent)
    return left


class LanesItem(CanvasItem):
    """Paints lanes, clips and ruler.

    It is cached as a picture, over which the playhead and the overlay move. Only lanes that look
    different are painted into it again.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        # Told what is to be painted, it paints no more.
        self.setFlag(self.GraphicsItemFlag.ItemUsesExtendedStyleOption)
        self.pictures = ClipPictures()
        self._content: TimelineContent | None = None
        self._hovered: int | None = None

    def show_content(self, content: TimelineContent, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        before, self._content = self._content, content
        if self._set_rect(rect) or before is None or frame_of(before) != frame_of(content):
            self.update()
        else:
            self._update_lanes(before, content)

    def show_hovered(self, clip: int | None) -> None:
        """Show on the clip under the pointer what can be dragged."""
        if clip != self._hovered:
            for clip_id in (self._hovered, clip):
                self._update_lane_of(clip_id)
            self._hovered = clip

    def show_font(self, font: QtGui.QFont) -> None:
        self.pictures.forget()
        super().show_font(font)

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        theme = current_theme()
        content = self._content
        if content is None:
            return
        painter.setFont(self._font)
        rect, exposed = self._rect, option.exposedRect
        lanes = QRectF(
            rect.left(), content.ruler_px, rect.width(), rect.height() - content.ruler_px
        )
        painter.save()
        painter.setClipRect(lanes)
        top, bottom = exposed.top(), exposed.bottom()
        shown = [lane for lane in content.lanes if lane.top_px < bottom and lane.bottom_px > top]
        for lane in shown:
            self._paint_ground(painter, lane)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
        painter.drawLines(grid_lines(content.scale, lanes))
        self._paint_after_end(painter, content, lanes)
        for lane in shown:
            self._paint_clips(painter, content, lane, lanes)
            self._paint_overlaps(painter, content, lane)
            paint_silence_reason(painter, lane, self._strip(lane))
        painter.restore()
        ruler = QRectF(rect.left(), 0, rect.width(), content.ruler_px)
        if ruler.intersects(exposed):
            paint_ruler(painter, content, ruler, theme)

    def _update_lane_of(self, clip: int | None) -> None:
        for lane in () if self._content is None or clip is None else self._content.lanes:
            if any(own.id == clip for own in lane.track.clips):
                self.update(self._strip(lane).adjusted(0, _INSIDE_PX, 0, -_INSIDE_PX))

    def _update_lanes(self, before: TimelineContent, after: TimelineContent) -> None:
        """Update the lanes that look different now."""
        restyled, scaled = restyled_clips(before, after), before.loudest != after.loudest
        for then, now in zip(before.lanes, after.lanes, strict=True):
            if then is not now and ground_of(then) != ground_of(now):
                self.update(self._strip(now))
            elif (
                scaled
                or then.track is not now.track
                or not restyled.isdisjoint(clip.id for clip in now.track.clips)
            ):
                self.update(self._strip(now).adjusted(0, _INSIDE_PX, 0, -_INSIDE_PX))

    def _strip(self, lane: Lane) -> QRectF:
        return QRectF(self._rect.left(), lane.top_px, self._rect.width(), lane.height_px)

    def _paint_ground(self, painter: QtGui.QPainter, lane: Lane) -> None:
        strip = self._strip(lane)
        if lane.selected:
            painter.fillRect(strip, translucent(current_theme().accent, _TINT_ALPHA))
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().border), 1))
        painter.drawLine(
            QLineF(strip.left(), strip.bottom() - 0.5, strip.right(), strip.bottom() - 0.5)
        )

    def _paint_after_end(
        self, painter: QtGui.QPainter, content: TimelineContent, lanes: QRectF
    ) -> None:
        if content.design.loop_s is None:
            return
        start, end = (content.scale.x(time_s) for time_s in content.design.loop_s)
        shade = translucent(current_theme().dim, 22)
        for left, right in ((lanes.left(), start), (end, lanes.right())):
            if right > left:
                painter.fillRect(QRectF(left, lanes.top(), right - left, lanes.height()), shade)

    def _paint_clips(
        self, painter: QtGui.QPainter, content: TimelineContent, lane: Lane, lanes: QRectF
    ) -> None:
        unplayable = content.unplayable_on(lane)
        for box in content.boxes_on(lane):
            paint_clip(
                painter,
                box,
                content,
                self.pictures,
                unplayable=box.clip.id in unplayable,
                handles=box.clip.id == self._hovered and box.rect.width() > 40,
                view=lanes,
            )

    def _paint_overlaps(
        self, painter: QtGui.QPainter, content: TimelineContent, lane: Lane
    ) -> None:
        """Mark at the foot of a lane where its clips overlap."""
        colour = translucent(current_theme().text, _OVERLAP_ALPHA)
        top = lane.bottom_px - MARGIN_PX - _OVERLAP_PX
        for start_s, end_s in content.overlaps_on(lane):
            left, right = max(content.scale.x(start_s), -10.0), min(content.scale.x(end_s), 1e5)
            if right > left:
                painter.fillRect(QRectF(left, top, max(right - left, 2.0), _OVERLAP_PX), colour)


_LABEL_GAP_PX = 8.0


class OverlayItem(CanvasItem):
    """Paints guide, marquee and label of a gesture; the lanes below are not painted again."""

    def __init__(self) -> None:
        super().__init__()
        self.setZValue(2)
        self._content: TimelineContent | None = None
        self.preview, self._pointer = GesturePreview(), QPointF()

    def show_content(self, content: TimelineContent, rect: QRectF) -> None:
        """Take over the lanes below, and the rectangle to lie in."""
        self._set_rect(rect)
        moved = self._content is not None and self._content.scale != content.scale
        self._content = content
        if moved and self.preview.guide_s is not None:
            self.update()

    def show_preview(self, preview: GesturePreview, pointer: QPointF) -> None:
        """Show a preview, with its label beside the pointer."""
        if (preview, pointer) != (self.preview, self._pointer):
            self._update_places()
            self.preview, self._pointer = preview, pointer
            self._update_places()

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        painter.setFont(self._font)
        guide = self._guide()
        if guide is not None:
            painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().warning), 2))
            painter.drawLine(guide)
        if self.preview.covered is not None:
            paint_band(painter, self.preview.covered, current_theme())
        if self.preview.label:
            paint_card(painter, self._label_room(), self.preview.label, current_theme())

    def _update_places(self) -> None:
        """Update the places of what is shown."""
        guide = self._guide()
        if guide is not None:
            self.update(QRectF(guide.p1(), guide.p2()).adjusted(-2, -2, 2, 2))
        if self.preview.covered is not None:
            self.update(self.preview.covered.adjusted(-2, -2, 2, 2))
        if self.preview.label:
            self.update(self._label_room().adjusted(-2, -2, 2, 2))

    def _guide(self) -> QLineF | None:
        if self.preview.guide_s is None or self._content is None:
            return None
        x = self._content.scale.x(self.preview.guide_s)
        return QLineF(x, self._content.ruler_px, x, self._rect.bottom())

    def _label_room(self) -> QRectF:
        metrics = QtGui.QFontMetricsF(self._font)
        ruler_px = 0.0 if self._content is None else self._content.ruler_px
        width = metrics.horizontalAdvance(self.preview.label) + 8
        left = min(self._pointer.x() + _LABEL_GAP_PX, self._rect.right() - width - 2)
        top = max(self._pointer.y() - metrics.height() - _LABEL_GAP_PX, ruler_px + 2)
        return QRectF(left, top, width, metrics.height() + 2)


_HALF_PX, _PLAYHEAD_HANDLE_PX = 5.0, 8.0


class PlayheadItem(CanvasItem):
    """A line with a handle; the lanes below are not painted again when it moves."""

    def __init__(self) -> None:
        super().__init__()
        self.setZValue(1)

    def show_content(self, content: TimelineContent, height_px: float) -> None:
        """Move to the time of the playhead; reach from the ruler down to a height."""
        height = max(height_px - content.ruler_px + _PLAYHEAD_HANDLE_PX, 1.0)
        self._set_rect(QRectF(-_HALF_PX - 1, -3, 2 * _HALF_PX + 2, height + 3))
        at = QPointF(
            content.scale.x(content.view.playhead_s), content.ruler_px - _PLAYHEAD_HANDLE_PX
        )
        if at != self.pos():
            self.setPos(at)

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        colour = QtGui.QColor(current_theme().error)
        painter.setPen(QtGui.QPen(colour, 1))
        painter.drawLine(QLineF(0, 0, 0, self._rect.bottom()))
        painter.setBrush(colour)
        corners = (QPointF(-_HALF_PX, -2), QPointF(_HALF_PX, -2), QPointF(0, 6))
        painter.drawPolygon(QtGui.QPolygonF(corners))
