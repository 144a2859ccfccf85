"""Gain curves over the clips: how they are painted, and what mouse and keys do to them."""

from typing import TYPE_CHECKING, Any

from PySide6 import QtGui
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt

from skinsource.design import edits
from skinsource.design.effects.breakpoints import Points, moved, with_point
from skinsource_gui.fields.editor import Burst
from skinsource_gui.panels.timeline.content import (
    GainStrip,
    TimelineContent,
    curve_of,
    gain_point_text,
    show_gain_curves,
)
from skinsource_gui.panels.timeline.gestures import Gesture, GestureContext, Modifier, MoveGain
from skinsource_gui.panels.timeline.painting import paint_silence_reason
from skinsource_gui.plots.plot import CanvasItem
from skinsource_gui.qt.keys import arrow_steps, meaning_of
from skinsource_gui.qt.theme import current_theme, translucent

if TYPE_CHECKING:
    from skinsource_gui.panels.timeline.lanes import LanesView

_DOT_PX, _CHOSEN_PX = 3.5, 5.0
_HALO_ALPHA, _HINT_ALPHA = 190, 110
#: How a curve begins.
HINT = "Gain curve: double-click the line to add a point"


class GainItem(CanvasItem):
    """Paints gain curves: those that are edited with their points, others as a thin line."""

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.setZValue(0.5)
        self._content: TimelineContent | None = None

    def show_content(self, content: TimelineContent, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        self._set_rect(rect)
        had = self._content is not None and bool(self._content.strips)
        self._content = content
        self.setVisible(bool(content.strips))
        if had or content.strips:
            self.update()

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        content = self._content
        if content is None:
            return
        painter.setFont(self._font)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        below = self._rect.adjusted(0, content.ruler_px, 0, 0)
        for strip in content.strips:
            lane = strip.lane
            room = QRectF(below.left(), lane.top_px, below.width(), lane.height_px)
            painter.save()
            painter.setClipRect(room.intersected(below))
            self._paint_curve(painter, strip, room)
            # The line does not cross the words; no other words cover them.
            room.setRight(paint_silence_reason(painter, lane, room))
            if strip.shown:
                chosen = content.chosen_point
                own = chosen is not None and chosen[0] == lane.track.id
                number = chosen[1] if chosen and own and chosen[1] < len(strip.points) else None
                self._paint_points(painter, strip, room, number)
            painter.restore()

    def _paint_curve(self, painter: QtGui.QPainter, strip: GainStrip, room: QRectF) -> None:
        line, text_colour = QtGui.QColor(current_theme().text), QtGui.QColor(current_theme().dim)
        if strip.shown:
            unity = strip.y(1.0)
            painter.setPen(QtGui.QPen(text_colour, 1, Qt.PenStyle.DotLine))
            painter.drawLine(QLineF(room.left(), unity, room.right(), unity))
        points = strip.points or ((0.0, 1.0, "straight"),)
        places = [strip.at(x, y) for x, y, _ in points]
        places = [
            QPointF(room.left(), places[0].y()),
            *places,
            QPointF(max(room.right(), places[-1].x()), places[-1].y()),
        ]
        curve = QtGui.QPolygonF(places)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if strip.shown:
            painter.setPen(QtGui.QPen(translucent(current_theme().base, _HALO_ALPHA), 4))
            painter.drawPolyline(curve)
            painter.setPen(QtGui.QPen(line, 1.5))
        else:
            line.setAlpha(_HINT_ALPHA)
            painter.setPen(QtGui.QPen(line, 1, Qt.PenStyle.DashLine))
        painter.drawPolyline(curve)

    def _paint_points(
        self, painter: QtGui.QPainter, strip: GainStrip, room: QRectF, chosen: int | None
    ) -> None:
        theme = current_theme()
        for k, (x, y, _) in enumerate(strip.points):
            radius = _CHOSEN_PX if k == chosen else _DOT_PX
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.text), 1.5))
            painter.setBrush(QtGui.QColor(theme.accent if k == chosen else theme.base))
            painter.drawEllipse(strip.at(x, y), radius, radius)
        text = "Gain curve" if chosen is None else gain_point_text(*strip.points[chosen][:2])
        metrics = QtGui.QFontMetricsF(self._font)
        height, top = metrics.height() + 1, room.top() + 2
        if strip.lane.selected and not strip.points:
            # At the foot of the lane, as names of clips are at its top.
            text, top = HINT, room.bottom() - height - 2
        width = metrics.horizontalAdvance(text) + 8
        label = QRectF(room.right() - width - 4, top, width, height)
        painter.fillRect(label, translucent(theme.base, _HALO_ALPHA))
        painter.setPen(QtGui.QColor(theme.text))
        painter.drawText(label, Qt.AlignmentFlag.AlignCenter, text)


_PLACE = "timeline"
#: Steps of the arrow keys, s and gain.
STEP_S, STEP_GAIN = 0.001, 0.01


class GainPoints:
    """Adds, moves and removes points of gain curves, and shows and hides the curves."""

    def __init__(self, lanes: "LanesView") -> None:
        self._lanes = lanes
        self._burst = Burst(lanes)

    def strip_at(self, at: QPointF) -> GainStrip | None:
        """Return the edited curve that passes here."""
        content = self._lanes.content
        if at.y() < content.ruler_px:
            return None
        for strip in content.strips:
            inside = strip.lane.top_px <= at.y() < strip.lane.bottom_px
            if strip.shown and inside and (strip.point_at(at) is not None or strip.is_on_line(at)):
                return strip
        return None

    def press(self, context: GestureContext, at: QPointF, held: Modifier) -> Gesture | None:
        """Begin a drag where the left button goes down; return None where no curve is hit."""
        strip = self.strip_at(at)
        if strip is None:
            self.choose(None)
            return None
        self._burst.end()
        track, near = strip.lane.track.id, strip.point_at(at)
        if near is not None:
            self.choose((track, near))
            return MoveGain(context, strip, at, strip.points, (near,))
        time_s = max(strip.scale.time(at.x()), 0.0)
        if held & Modifier.ControlModifier:
            points, number = _added(strip, time_s)
            gesture = MoveGain(context, strip, at, points, (number,), fine=False)
            gesture.put(points)
            self.choose((track, number))
            return gesture
        points = strip.points or ((0.0, 1.0, "straight"),)
        return MoveGain(
            context, strip, at, points, strip.points_around(time_s) or (0,), vertical=True
        )

    def double_click(self, at: QPointF) -> bool:
        """Add a point where the curve is pressed twice; whether one is there."""
        strip = self.strip_at(at)
        if strip is None:
            return False
        if strip.point_at(at) is None:
            self._add(strip, max(strip.scale.time(at.x()), 0.0))
        return True

    def key(self, event: QtGui.QKeyEvent) -> bool:
        """Do what a key does to a curve; return whether it does anything."""
        command = meaning_of(_PLACE, event)
        if command == "gain_curve":
            self._lanes.toggle_gain(*self._lanes.content.view.selected_inputs)
            self.choose(None)
        elif command == "gain_point":
            self._walk(-1 if event.key() == Qt.Key.Key_PageUp else 1)
        elif command == "gain_add":
            strip = self._selected_strip()
            if strip is not None:
                self._add(strip, self._lanes.content.view.playhead_s)
        else:
            return self._key_of_point(command, event)
        return True

    def remove(self, track: int, numbers: tuple[int, ...]) -> None:
        """Remove points of a track's curve."""
        design = self._lanes.content.design
        if track not in design.ids:
            return
        curve = design.input(track).gain_curve
        left = tuple(point for k, point in enumerate(curve) if k not in numbers)
        self.choose(None)
        self._emit(track, tuple((x, y, "straight") for x, y in left), None)

    def choose(self, chosen: tuple[int, int] | None) -> None:
        """Choose another point for the keys, or none."""
        if chosen != self._lanes.content.chosen_point:
            self._lanes.change(chosen_point=chosen)

    def description(self) -> str:
        """Return the text of the chosen point, or "" where there is none."""
        strip, number = self._chosen_strip()
        if strip is None:
            return ""
        return f"Point {number + 1} of the gain curve: {gain_point_text(*strip.points[number][:2])}"

    def _key_of_point(self, command: str, event: QtGui.QKeyEvent) -> bool:
        strip, number = self._chosen_strip()
        if strip is None:
            # Held as for a point, where there is none it is for the clips.
            return False
        if command == "give_up":
            self.choose(None)
        elif command == "remove":
            self.remove(strip.lane.track.id, (number,))
        elif command in ("nudge", "change_track", "gain_far"):
            right, up = arrow_steps(event)
            after = moved(strip.points, (number,), right * STEP_S, up * STEP_GAIN)
            self._emit(strip.lane.track.id, after, self._burst.gesture())
        else:
            return False
        return True

    def _walk(self, step: int) -> None:
        strip = self._selected_strip()
        if strip is None or not strip.points:
            return
        track, last = strip.lane.track.id, len(strip.points) - 1
        before = self._lanes.content.chosen_point
        chosen = before if before and before[0] == track else None
        number = (0 if step > 0 else last) if chosen is None else chosen[1] + step
        self._burst.end()
        self.choose((track, min(max(number, 0), last)))

    def _add(self, strip: GainStrip, time_s: float) -> None:
        points, number = _added(strip, time_s)
        track = strip.lane.track.id
        self._emit(track, points, None)
        self.choose((track, number))

    def _emit(self, track: int, points: Points, gesture: int | None) -> None:
        content = self._lanes.content
        curve = curve_of(points)
        outcome = edits.set_gain_curve(content.design, content.view, track, curve)
        self._lanes.edited.emit(outcome, gesture)

    def _selected_strip(self) -> GainStrip | None:
        """Return the curve of the track that was selected last, and show it."""
        content = self._lanes.content
        track = content.view.selected_input
        if track is None:
            return None
        shown = {strip.lane.track.id for strip in content.strips if strip.shown}
        if track not in shown:
            self._lanes.view_changed.emit(show_gain_curves(content.view, shown | {track}))
        strips = self._lanes.content.strips
        return next(
            (strip for strip in strips if strip.lane.track.id == track and strip.shown), None
        )

    def _chosen_strip(self) -> tuple[GainStrip | None, int]:
        track, number = self._lanes.content.chosen_point or (0, 0)
        for strip in self._lanes.content.strips:
            if strip.lane.track.id == track and strip.shown and number < len(strip.points):
                return strip, number
        return None, 0


def _added(strip: GainStrip, time_s: float) -> tuple[Points, int]:
    """Return the points with one more on the curve, and its number."""
    points = strip.points
    if not points:
        return ((time_s, 1.0, "straight"),), 0
    return with_point(points, time_s), sum(x <= time_s for x, _, _ in points)
