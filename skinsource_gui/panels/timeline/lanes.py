"""The lanes as a widget: what mouse and keys do to clips, gain curves, markers and the loop."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QHelpEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource.base.arrays import Floats
from skinsource.design import edits
from skinsource.design.clips import Marker
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.editor import Burst
from skinsource_gui.panels.timeline.content import (
    CURSORS,
    Box,
    ClipLengths,
    Lane,
    Overlaps,
    Part,
    TimelineContent,
    TimeZoom,
    next_id,
    overlapping,
    part_at,
    ruler_px,
    shown_gain_curves,
    timeline_tooltip,
)
from skinsource_gui.panels.timeline.gain import GainItem, GainPoints
from skinsource_gui.panels.timeline.gestures import (
    EitherGesture,
    FadeEnd,
    Gesture,
    GestureContext,
    GesturePreview,
    Marquee,
    Modifier,
    MoveClips,
    MoveEnd,
    MoveGain,
    MoveLoop,
    MoveMarker,
    MovePlayhead,
    Pan,
    snapped_time,
)
from skinsource_gui.panels.timeline.painting import LanesItem, OverlayItem, PlayheadItem
from skinsource_gui.plots.plot import PLAYHEAD, Canvas, moved_playhead
from skinsource_gui.plots.time_scale import TimeScale, panned
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.keys import meaning_of
from skinsource_gui.qt.theme import scaled, tabular
from skinsource_gui.qt.wheel import NOTCH

_PLACE = "timeline"
_Key = Qt.Key
#: How far an arrow moves clips; with Shift ten times as far.
STEP_S, _LEAP = 0.001, 10
_STEPS = {_Key.Key_Left: -1, _Key.Key_Right: 1, _Key.Key_Up: -1, _Key.Key_Down: 1}
_ZOOM = 1.5


class LaneInput(QObject):
    """What keys and mouse on the lanes have in common.

    Parameters
    ----------
    content
        Returns what the lanes show now.
    gain
        Handles the gain curves, which lie over the clips.
    """

    edited = Signal(object, object)
    view_changed = Signal(object)
    playhead_requested = Signal(float)
    #: Id of a clip to open; track and time of a new clip; time of a new marker.
    opened = Signal(int)
    clip_requested = Signal(int, float)
    marker_requested = Signal(float)

    def __init__(
        self, content: Callable[[], TimelineContent], gain: GainPoints, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._content, self._gain = content, gain

    def _select(self, *clips: int) -> None:
        content = self._content()
        self.view_changed.emit(edits.select_clips(content.design, content.view, clips).view)


class LaneKeys(LaneInput):
    """Turns key presses into edits of the selected clips."""

    copied = Signal()
    cut = Signal()
    pasted = Signal()
    zoomed = Signal(float)
    everything_requested = Signal()

    def __init__(
        self, content: Callable[[], TimelineContent], gain: GainPoints, parent: QObject
    ) -> None:
        super().__init__(content, gain, parent)
        self._burst = Burst(self)
        self._nudged: object = None

    def claims(self, event: QKeyEvent) -> bool:
        """Return whether the lanes take this key before any shortcut of the window."""
        return bool(meaning_of(_PLACE, event) or meaning_of(PLAYHEAD, event))

    def press(self, event: QKeyEvent) -> bool:
        """Do what a key means; return whether it means anything."""
        if self._gain.key(event):
            return True
        content = self._content()
        playhead_s = moved_playhead(event, content.design, content.view.playhead_s)
        if playhead_s is not None:
            self._put_playhead(playhead_s)
            return True
        command = meaning_of(_PLACE, event)
        if command in ("nudge", "change_track"):
            leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            self._nudge(command, _STEPS[_Key(event.key())] * (_LEAP if leap else 1))
        elif command == "go":
            self._go(_STEPS[_Key(event.key())])
        elif command == "below":
            self._go_below()
        elif command == "gain_far":
            self._reach(_STEPS[_Key(event.key())])
        elif command == "playhead":
            ends = (clip.end_s for clip in content.design.clips)
            at_start = event.key() == _Key.Key_Home
            self._put_playhead(0.0 if at_start else max(ends, default=0.0))
        else:
            return self._show(command) or self._edit(command)
        return True

    def _show(self, command: str) -> bool:
        """Do what a command does to the view; return whether it does anything."""
        content = self._content()
        design, view = content.design, content.view
        if command in ("zoom_in", "zoom_out"):
            self.zoomed.emit(_ZOOM if command == "zoom_in" else 1 / _ZOOM)
        elif command == "whole":
            self.everything_requested.emit()
        elif command == "select_all":
            self.view_changed.emit(edits.select_all_clips(design, view).view)
        elif command == "open":
            for clip in content.chosen[-1:]:
                self.opened.emit(clip)
        else:
            return False
        return True

    def _edit(self, command: str) -> bool:
        """Do what a command does to the design; return whether it does anything."""
        content = self._content()
        design, view = content.design, content.view
        chosen, at_s = content.chosen, view.playhead_s
        if command == "copy":
            self.copied.emit()
        elif command == "cut":
            self.cut.emit()
        elif command == "paste":
            self.pasted.emit()
        elif command == "marker":
            self.marker_requested.emit(at_s)
        elif command == "add" and view.selected_input is not None:
            self.clip_requested.emit(view.selected_input, at_s)
        outcome = {
            "split": lambda: edits.split_clips(design, view, chosen, at_s),
            "repeat": lambda: edits.repeat_clips(design, view, chosen, 2),
            "mute": lambda: edits.toggle_mute_clips(design, view, chosen),
            "duplicate": lambda: edits.duplicate_clips(design, view, chosen),
            "remove": lambda: edits.remove_clips(design, view, chosen),
        }.get(command)
        if outcome is not None:
            self.edited.emit(outcome(), None)
        return bool(command)

    def _put_playhead(self, time_s: float) -> None:
        content = self._content()
        low, high = content.scale.shown_s
        self.playhead_requested.emit(time_s)
        if not low <= time_s <= high:
            # Pan to the nearest edge, so that the playhead is visible.
            by_s = time_s - (low if time_s < low else high)
            shown_s = panned((low, high), by_s, content.whole_s)
            self.view_changed.emit(replace(self._content().view, time_range_s=shown_s))

    def _go(self, step: int) -> None:
        """Select the next clip, or the one before, through all tracks."""
        content = self._content()
        design, view = content.design, content.view
        ids = [
            clip.id
            for track in design.inputs
            for clip in sorted(track.clips, key=lambda clip: clip.onset_s)
        ]
        if not ids:
            return
        chosen = view.selected_clips
        here = ids.index(chosen[-1]) if chosen and chosen[-1] in ids else (-1 if step > 0 else 0)
        self._select(ids[(here + step) % len(ids)])

    def _reach(self, step: int) -> None:
        """Select besides the nearest clip of the next track that has any."""
        content = self._content()
        design = content.design
        for last in content.chosen[-1:]:
            here, onset_s = design.index_of(design.track_of(last).id), design.clip(last).onset_s
            ahead = design.inputs[here + 1 :] if step > 0 else design.inputs[:here][::-1]
            clips = next((track.clips for track in ahead if track.clips), ())
            nearest = min(clips, key=lambda clip: abs(clip.onset_s - onset_s), default=None)
            if nearest is not None:
                others = (clip_id for clip_id in content.chosen if clip_id != nearest.id)
                self._select(*others, nearest.id)

    def _go_below(self) -> None:
        """Select the next of the clips that overlap."""
        content = self._content()
        for clip in content.chosen[-1:]:
            track = content.design.track_of(clip)
            following = next_id(overlapping(track, content.design.clip(clip)), clip)
            self._select(clip if following is None else following)

    def _nudge(self, command: str, steps: int) -> None:
        content = self._content()
        design, view = content.design, content.view
        in_time = command == "nudge"
        by_s, by_tracks = (steps * STEP_S, 0) if in_time else (0.0, steps)
        outcome = edits.move_clips(design, view, content.chosen, by_s, by_tracks)
        # One burst of nudges is one undo step; other clips, or another direction, begin a new one.
        nudged = (in_time, content.chosen)
        if nudged != self._nudged:
            self._burst.end()
            self._nudged = nudged
        self.edited.emit(outcome, self._burst.gesture())


# A movement shorter than this is a click.
_DRAG_PX = 4.0
_CATCH_PX = 6.0


class LaneMouse(LaneInput):
    """Turns what the mouse buttons do into gestures, and single clicks into selections.

    Attributes
    ----------
    elsewhere
        Returns where in another panel something would be dropped that is held over a place, px.
    """

    #: `GesturePreview`: what is painted over the lanes.
    shown = Signal(object)

    def __init__(
        self, content: Callable[[], TimelineContent], gain: GainPoints, parent: QObject
    ) -> None:
        super().__init__(content, gain, parent)
        self.elsewhere: Callable[[QPointF | None], DropPlace | None] = lambda at: None
        self._gesture: Gesture | None = None
        self._click: Callable[[], None] | None = None
        self._at = QPointF()
        self._moving = False
        # The clip on which the button went down last.
        self._pressed: int | None = None

    @property
    def busy(self) -> bool:
        """Whether a button is down that means something."""
        return self._gesture is not None

    def press(self, at: QPointF, button: Qt.MouseButton, held: Modifier, rate_hz: float) -> None:
        """Begin what a button does that goes down."""
        if self.busy:
            return
        content = self._content()
        context = self._context()
        self._at, self._moving, self._click = at, False, None
        box = content.box_at(at)
        if button == Qt.MouseButton.MiddleButton:
            self._gesture = Pan(context, at)
        elif button != Qt.MouseButton.LeftButton:
            return
        elif at.y() < content.ruler_px:
            self._gesture = self._on_ruler(context, at, held)
        elif (curve := self._gain.press(context, at, held)) is not None:
            on_line = isinstance(curve, MoveGain) and curve.vertical
            if on_line and box is not None:
                curve = self._on_line(curve, box, at, held, rate_hz)
            self._gesture = curve
        elif box is not None:
            self._gesture = self._on_clip(box, at, held, rate_hz)
        else:
            self._gesture = Marquee(context, at)
            self._click = self._on_ground(context, at)

    def move(self, at: QPointF, held: Modifier) -> None:
        """Follow the pointer."""
        if self._gesture is None:
            return
        away = at - self._at
        self._moving = self._moving or max(abs(away.x()), abs(away.y())) >= _DRAG_PX
        if self._moving:
            self._click = None
            self.shown.emit(self._gesture.move(at, held))

    def release(self) -> None:
        """End what the button did."""
        gesture, click, self._gesture, self._click = self._gesture, self._click, None, None
        if gesture is not None:
            gesture.finish()
            self.shown.emit(GesturePreview())
        if click is not None:
            click()

    def cancel(self) -> bool:
        """Cancel the gesture; return whether there was one."""
        gesture, self._gesture, self._click = self._gesture, None, None
        if gesture is None:
            return False
        gesture.cancel()
        self.shown.emit(GesturePreview())
        return True

    def double_click(self, at: QPointF) -> None:
        """Open the clip here, or add a clip, a marker or a point of a gain curve."""
        self.cancel()
        content = self._content()
        box, lane = content.box_at(at), content.lane_at(at.y())
        if at.y() < content.ruler_px:
            self.marker_requested.emit(max(content.scale.time(at.x()), 0.0))
        elif self._gain.double_click(at):
            return
        elif box is not None:
            # The first of the two clicks may have selected a clip below.
            ids = [box.clip.id for box in content.boxes_at(at)]
            clip_id = self._pressed if self._pressed in ids else box.clip.id
            self._select(clip_id)
            self.opened.emit(clip_id)
        elif lane is not None:
            self.clip_requested.emit(lane.track.id, self.time_at(at))

    def time_at(self, at: QPointF) -> float:
        """Return the time to which something would snap here, s."""
        return snapped_time(self._context(), at)[0]

    def cursor_at(self, at: QPointF) -> Qt.CursorShape:
        """Return the shape of the pointer."""
        content = self._content()
        if at.y() < content.ruler_px:
            caught = _loop_end_at(content, at) is not None or marker_at(content, at) is not None
            return Qt.CursorShape.SizeHorCursor if caught else Qt.CursorShape.PointingHandCursor
        strip = self._gain.strip_at(at)
        if strip is not None:
            on_point = strip.point_at(at) is not None
            return Qt.CursorShape.SizeAllCursor if on_point else Qt.CursorShape.SizeVerCursor
        box = content.box_at(at)
        if box is None:
            return Qt.CursorShape.ArrowCursor
        part = part_at(box.rect, at, box.fades_px)
        if part is Part.BODY and self.busy:
            return Qt.CursorShape.ClosedHandCursor
        return CURSORS[part]

    def _context(self) -> GestureContext:
        return GestureContext(
            content=self._content,
            apply=self.edited.emit,
            show_view=self.view_changed.emit,
            put_playhead=self.playhead_requested.emit,
            elsewhere=lambda at: self.elsewhere(at),
            before=self._content(),
        )

    def _on_clip(self, box: Box, at: QPointF, held: Modifier, rate_hz: float) -> Gesture:
        content, clip = self._content(), box.clip
        self._pressed = clip.id
        chosen = clip.id in content.view.selected_clips
        if held & Modifier.ControlModifier:
            # Ctrl copies if it moves, and otherwise adds to the selection or takes away.
            toggled = edits.toggle_clip(content.design, content.view, clip.id).view
            self._click = lambda: self.view_changed.emit(toggled)
        elif content.view.selected_clips == (clip.id,):
            # Clips may lie over each other: another click selects the next one below.
            ids = [box.clip.id for box in content.boxes_at(at)]
            self._click = partial(self._select, next_id(ids, clip.id) or clip.id)
        elif not chosen:
            self._select(clip.id)
        else:
            self._click = partial(self._select, clip.id)
        context = self._context()
        part = part_at(box.rect, at, box.fades_px)
        if part is Part.BODY or held & Modifier.ControlModifier:
            return MoveClips(context, box, at, rate_hz)
        ends = (Part.START, Part.END)
        return MoveEnd(context, box, at, part) if part in ends else FadeEnd(context, box, at, part)

    def _on_line(
        self, curve: Gesture, box: Box, at: QPointF, held: Modifier, rate_hz: float
    ) -> Gesture:
        """Drag the curve of a track where it passes over a clip: up or down it, along the clip."""

        def clip() -> Gesture:
            gesture = self._on_clip(box, at, held, rate_hz)
            self._click = None
            return gesture

        self._pressed = box.clip.id
        self._click = partial(self._select, box.clip.id)
        return EitherGesture(at, lambda: curve, clip)

    def _on_ruler(self, context: GestureContext, at: QPointF, held: Modifier) -> Gesture:
        content = context.before
        marker, fixed_s = marker_at(content, at), _loop_end_at(content, at)
        if held & Modifier.ShiftModifier:
            return MoveLoop(context, snapped_time(context, at)[0])
        if marker is not None:
            return MoveMarker(context, marker)
        if fixed_s is not None:
            return MoveLoop(context, fixed_s)
        gesture = MovePlayhead(context)
        gesture.move(at, held)
        return gesture

    def _on_ground(self, context: GestureContext, at: QPointF) -> Callable[[], None]:
        def click() -> None:
            content = self._content()
            lane = content.lane_at(at.y())
            time_s = snapped_time(context, at)[0]
            tracks = () if lane is None else (lane.track.id,)
            self.view_changed.emit(replace(content.view, selected_inputs=tracks, selected_clips=()))
            self.playhead_requested.emit(time_s)

        return click


def marker_at(content: TimelineContent, at: QPointF) -> Marker | None:
    """Return the marker whose flag is here."""
    distances = (
        (abs(content.scale.x(marker.time_s) - at.x()), index)
        for index, marker in enumerate(content.design.markers)
    )
    nearest = min(distances, default=None)
    if nearest is None or nearest[0] > _CATCH_PX or at.y() > content.ruler_px / 2:
        return None
    return content.design.markers[nearest[1]]


def _loop_end_at(content: TimelineContent, at: QPointF) -> float | None:
    """Return the other end of the loop region, if one end is here."""
    if content.design.loop_s is None:
        return None
    start_s, end_s = content.design.loop_s
    for here, other in ((start_s, end_s), (end_s, start_s)):
        if abs(content.scale.x(here) - at.x()) <= _CATCH_PX:
            return other
    return None


_SIDE_PX = 8.0
_TEXT = 0.9
_CTRL = Qt.KeyboardModifier.ControlModifier


class LanesView(Canvas):
    """Lanes and a ruler; emits what mouse and keys ask for.

    Attributes
    ----------
    item, gains, playhead, overlay
        Layers that are painted.
    gain
        Handles the gain curves.
    time_zoom
        Which part of the time is shown.
    sample_rate_hz
        A free drag moves by whole samples of this rate.
    """

    key_place = "timeline"

    view_changed = Signal(object)
    #: Lanes are to be scrolled by so many notches.
    scroll_requested = Signal(float)
    menu_requested = Signal(object, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("lanes")
        self.setAccessibleName("Timeline")
        self.setMouseTracking(True)
        self.setMinimumSize(120, 60)
        self.item = LanesItem()
        self.addItem(self.item)
        self.gains, self.playhead, self.overlay = GainItem(), PlayheadItem(), OverlayItem()
        self.addItem(self.gains)
        self.addItem(self.playhead)
        self.addItem(self.overlay)
        self.sample_rate_hz = facts_of("").sample_rate_hz
        self._design, self._view = Design(limb=""), View()
        self._lanes: tuple[Lane, ...] = ()
        self._waveforms: Mapping[int, Floats] = {}
        self._awaited: frozenset[int] = frozenset()
        self._lengths = ClipLengths(self._design)
        self._overlaps = Overlaps()
        self._held_tops: Mapping[int, float] = {}
        self.snaps = True
        self.gain = GainPoints(lambda: self.content, self)
        self.time_zoom = TimeZoom(lambda: self.content, self)
        self.content = self._new_content()
        self.mouse = LaneMouse(lambda: self.content, self.gain, self)
        self.keys = LaneKeys(lambda: self.content, self.gain, self)
        for part in (self.time_zoom, self.gain, self.mouse, self.keys):
            part.view_changed.connect(self.view_changed)
        self.gain.choice_changed.connect(self.lay_out)
        self.mouse.shown.connect(self._show_preview)
        self._pointer = QPointF()
        self.update_style()

    @property
    def ruler_px(self) -> float:
        """Height of the ruler, below which the lanes begin, px."""
        return ruler_px(self.fontMetrics().height())

    def show_state(self, design: Design, view: View, lanes: tuple[Lane, ...]) -> None:
        """Show another design or view; lanes in coordinates of this widget."""
        self._design, self._view, self._lanes = design, view, lanes
        self.lay_out()

    def show_playhead(self, view: View) -> None:
        """Show a view in which the playhead alone has moved."""
        self._view = view
        self.content = self.content.with_playhead(view)
        self.playhead.show_content(self.content, float(self.height()))

    def show_waveforms(
        self, waveforms: Mapping[int, Floats], awaited: frozenset[int] = frozenset()
    ) -> None:
        """Show what clips play, (n_times,) each, by id; ``awaited`` ones are being computed."""
        self._waveforms, self._awaited = waveforms, awaited
        self.lay_out()

    def update_style(self) -> None:
        super().update_style()
        for item in (self.item, self.gains, self.overlay):
            item.show_font(scaled(tabular(self.font()), _TEXT))

    def set_snaps(self, snaps: bool) -> None:
        """Set whether edges snap."""
        self.snaps = snaps
        self.lay_out()

    def claims(self, event: QKeyEvent) -> bool:
        return self.keys.claims(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        self.time_zoom.hold()
        self._held_tops = {strip.lane.track.id: strip.top for strip in self.content.strips}
        self.mouse.press(event.position(), event.button(), event.modifiers(), self.sample_rate_hz)
        event.accept()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._pointer = event.position()
        if self.mouse.busy:
            self.mouse.move(event.position(), event.modifiers())
        else:
            box = self.content.box_at(event.position())
            self.item.show_hovered(None if box is None else box.clip.id)
            self.viewport().setCursor(self.mouse.cursor_at(event.position()))
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            self.mouse.release()
            self._end_drag()
        event.accept()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.double_click(event.position())
            self._end_drag()
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        place = QPointF(event.pos())
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            # The menu key opens the menu of the clip that was selected last, or of the playhead.
            place = self.content.keyboard_place
        self.menu_requested.emit(self.mapToGlobal(place).toPoint(), place)

    def wheelEvent(self, event: QWheelEvent) -> None:
        turns, held = event.angleDelta(), event.modifiers()
        if turns.x() or held & (_CTRL | Qt.KeyboardModifier.ShiftModifier):
            self.time_zoom.follow_wheel(event)
        else:
            self.scroll_requested.emit(turns.y() / NOTCH)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.mouse.cancel():
            self._end_drag()
        elif not self.keys.press(event):
            event.ignore()

    def viewportEvent(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(
                event.globalPos(), timeline_tooltip(self.content, QPointF(event.pos())), self
            )
            return True
        return super().viewportEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.item.show_hovered(None)

    def _end_drag(self) -> None:
        self.time_zoom.release()
        self._held_tops = {}
        self.lay_out()

    def _show_preview(self, shown: GesturePreview) -> None:
        self.overlay.show_preview(shown, self._pointer)

    def lay_out(self) -> None:
        self.content = self._new_content()
        rect = QRectF(self.rect())
        for item in (self.item, self.gains, self.overlay):
            item.show_content(self.content, rect)
        self.setAccessibleDescription(self.gain.description())
        self.playhead.show_content(self.content, float(self.height()))

    def _new_content(self) -> TimelineContent:
        self._lengths = self._lengths.of(self._design)
        shown_s = self.time_zoom.range_s(self._view, self._lengths.whole_s)
        width = max(self.width() - 2 * _SIDE_PX, 1.0)
        return TimelineContent(
            design=self._design,
            view=self._view,
            lanes=self._lanes,
            scale=TimeScale(shown_s=shown_s, left_px=_SIDE_PX, width_px=width),
            height_px=float(self.height()),
            lengths=self._lengths,
            waveforms=self._waveforms,
            awaited=self._awaited,
            sample_rate_hz=self.sample_rate_hz,
            snaps=self.snaps,
            ruler_px=self.ruler_px,
            gain_shown=shown_gain_curves(self._view),
            gain_tops=self._held_tops,
            chosen_point=self.gain.chosen,
            overlaps=self._overlaps,
        )
