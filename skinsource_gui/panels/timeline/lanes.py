"""The lanes as a widget: what mouse, keys and menus do to clips, gain curves, markers, the loop."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt, Signal

from skinsource.design import edits
from skinsource.design.clips import NAME, Clip
from skinsource.design.design import Design, View
from skinsource.design.display_units import value_text
from skinsource.design.edits.clips import copy_behind
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.edits.motions import motion_of
from skinsource.design.target import Target
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import Layers
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.editor import Burst
from skinsource_gui.panels.timeline import gestures
from skinsource_gui.panels.timeline.clipboard import NO_CLIPS
from skinsource_gui.panels.timeline.content import (
    CURSORS,
    Box,
    ClipLengths,
    GainStrip,
    Lane,
    Part,
    TimelineContent,
    clip_name,
    clip_text,
    drawn_clips,
    loudest_of,
    next_id,
    overlapping,
    part_at,
    ruler_px,
    timeline_tooltip,
    toggle_gain_curves,
)
from skinsource_gui.panels.timeline.gain import GainItem, GainPoints
from skinsource_gui.panels.timeline.painting import LanesItem, OverlayItem, PlayheadItem
from skinsource_gui.plots.plot import PLAYHEAD, Canvas, moved_playhead
from skinsource_gui.plots.ranges import within
from skinsource_gui.plots.time_scale import Range, TimeScale, panned, range_by_wheel, zoomed
from skinsource_gui.qt.accessible import Told
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.keys import key_text, meaning_of, shortcut_text
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.questions import ask_name
from skinsource_gui.qt.theme import scaled, tabular
from skinsource_gui.qt.wheel import NOTCH

AnyEdit = Callable[..., Edit | Refusal]
_PLACE = "timeline"


class LanesMenu:
    """Opens the menu of what lies under the pointer."""

    def __init__(self, lanes: "LanesView", gain: GainPoints) -> None:
        self._lanes, self._gain = lanes, gain

    def open(self, at: QPoint, place: QPointF) -> None:
        """Open the menu of a place, at a place of the screen."""
        content = self._lanes.content
        box = content.box_at(place)
        menu = passing_menu(self._lanes, "lanes_menu")
        time_s = max(content.scale.time(place.x()), 0.0)
        if place.y() < content.ruler_px:
            self._fill_ruler(menu, content, place, time_s)
        elif (strip := self._gain.strip_at(place)) is not None:
            self._fill_curve(menu, strip, place)
        elif box is not None:
            if box.clip.id not in content.view.selected_clips:
                self._lanes.select(box.clip.id)
            self._fill_clips_here(menu, content.boxes_at(place))
            self._fill_clip(menu, box.clip.id)
        else:
            self._fill_ground(menu, content, place, time_s)
        menu.popup(at)

    def _fill_clips_here(self, menu: QtWidgets.QMenu, boxes: Sequence[Box]) -> None:
        """Offer to select each of several clips that lie over each other."""
        if len(boxes) < 2:
            return
        here = named(menu.addMenu("Clips here"), "clips_here")
        for box in boxes:
            line = here.addAction(clip_text(box.clip))
            line.setCheckable(True)
            line.setChecked(box.clip.id in self._lanes.content.view.selected_clips)
            line.triggered.connect(lambda _=False, clip=box.clip.id: self._lanes.select(clip))
        menu.addSeparator()

    def _fill_clip(self, menu: QtWidgets.QMenu, clip: int) -> None:
        view = self._lanes.content.view
        several = len(view.selected_clips) > 1
        what = f"{len(view.selected_clips)} clips" if several else "clip"
        self._action(menu, "Edit clip", "show_clip_editor")
        design = self._lanes.content.design
        index = motion_of(design, clip)
        if index is not None:
            of_target = isinstance(design.motions[index].motion, Target)
            text, action = ("Edit target", "aim") if of_target else ("Edit motion…", "make_motion")
            menu.addAction(text).triggered.connect(
                partial(self._lanes.action_requested.emit, action)
            )
        menu.addSeparator()
        self._act(menu, "Split at playhead", "split", edits.split_clips, view.playhead_s)
        if several:
            self._act(menu, "Join clip parts", "", edits.join_clips)
            self._act(menu, "Group into one clip", "", edits.group_clips)
        elif isinstance(self._lanes.content.design.clip(clip).waveform, Layers):
            self._act(menu, "Ungroup layers", "", edits.ungroup_clips)
        self._act(menu, f"Repeat {what}", "repeat", copy_behind, "Repeat")
        self._act(menu, f"Duplicate {what}", "duplicate", copy_behind, "Duplicate")
        self._act(menu, f"Mute {what}", "mute", edits.toggle_mute_clips)
        menu.addSeparator()
        self._fill_places(menu, f"Move {what} to")
        self._action(menu, "Copy", "copy_clips")
        self._action(menu, "Cut", "cut_clips")
        self._action(menu, "Paste at playhead", "paste_clips")
        self._act(menu, f"Remove {what}", "remove", edits.remove_clips)

    def _fill_places(self, menu: QtWidgets.QMenu, label: str) -> None:
        places = named(menu.addMenu(label), "lanes_places")
        design = self._lanes.content.design
        occupied = {track.location for track in design.inputs}
        for number in range(1, facts_of(design.limb).n_inputs + 1):
            track = "" if number in occupied else " (new track)"
            title = f"{number} · {input_name(number, design.limb).name}{track}"
            self._act(places, title, "", edits.move_clips_to_place, number)

    def _fill_ground(
        self, menu: QtWidgets.QMenu, content: TimelineContent, place: QPointF, time_s: float
    ) -> None:
        lane = content.lane_at(place.y())
        if lane is not None:
            track = lane.track.id
            self._line(menu, "Add clip here", "", lambda: self._lanes.add_clip(track, time_s))
            text = "Hide gain curve" if track in content.gain_shown else "Show gain curve"
            self._line(menu, text, "gain_curve", lambda: self._lanes.toggle_gain(track))
        self._action(menu, "Paste at playhead", "paste_clips")
        menu.addSeparator()
        self._fill_time(menu, content)

    def _fill_curve(self, menu: QtWidgets.QMenu, strip: GainStrip, place: QPointF) -> None:
        track, near = strip.lane.track.id, strip.point_at(place)
        if near is not None:
            self._gain.choose((track, near))
            self._line(menu, "Remove point", "remove", lambda: self._gain.remove(track, (near,)))
        else:
            self._line(menu, "Add point here", "", lambda: self._gain.double_click(place))
        everything = tuple(range(len(strip.points)))
        self._line(menu, "Remove gain curve", "", lambda: self._gain.remove(track, everything))
        self._line(menu, "Hide gain curve", "gain_curve", lambda: self._lanes.toggle_gain(track))

    def _fill_ruler(
        self, menu: QtWidgets.QMenu, content: TimelineContent, place: QPointF, time_s: float
    ) -> None:
        marker = content.marker_at(place)
        if marker is None:
            self._line(menu, "Add marker here", "", lambda: self._lanes.add_marker(time_s))
        else:
            index = content.design.markers.index(marker)
            self._line(menu, "Rename marker…", "", lambda: self.rename(index))
            self._edit_line(menu, "Remove marker", edits.remove_marker, index)
        menu.addSeparator()
        ends = _ends_of_chosen(content)
        if ends is not None:
            self._edit_line(menu, "Loop the selected clips", edits.set_loop, ends)
        if content.design.loop_s is not None:
            self._edit_line(menu, "Remove loop", edits.set_loop, None)
        self._fill_time(menu, content)

    def _fill_time(self, menu: QtWidgets.QMenu, content: TimelineContent) -> None:
        if content.design.loop_s is None:
            return
        start_s, end_s = content.design.loop_s
        menu.addSeparator()
        insert = edits.insert_time
        self._edit_line(menu, "Insert loop time before", insert, start_s, end_s - start_s)
        self._edit_line(menu, "Delete time in loop", edits.remove_time, start_s, end_s)

    def _act(
        self, menu: QtWidgets.QMenu, text: str, key: str, edit: AnyEdit, *more: object
    ) -> None:
        """Add a line that edits the clips which are selected when it is chosen."""
        lanes = self._lanes
        self._line(
            menu, text, key, lambda: lanes.edit(edit, lanes.content.view.selected_clips, *more)
        )

    def _action(self, menu: QtWidgets.QMenu, text: str, name: str) -> None:
        """Add a line that does what an action of the window does."""
        line = menu.addAction(f"{text}\t{shortcut_text(name)}")
        line.triggered.connect(partial(self._lanes.action_requested.emit, name))

    def _edit_line(self, menu: QtWidgets.QMenu, text: str, edit: AnyEdit, *more: object) -> None:
        self._line(menu, text, "", lambda: self._lanes.edit(edit, *more))

    def _line(self, menu: QtWidgets.QMenu, text: str, key: str, act: Callable[[], object]) -> None:
        # A tab puts the key at the right; the menu has no shortcuts, keys belong to the lanes.
        shown = f"{text}\t{key_text(_PLACE, key)}" if key else text
        menu.addAction(shown).triggered.connect(lambda _=False: act())

    def rename(self, index: int) -> None:
        """Ask for another name of a marker."""
        name = self._lanes.content.design.markers[index].name
        if (new := ask_name(self._lanes, "Rename marker", name, NAME.longest)) is not None:
            self._lanes.edit(edits.rename_marker, index, new)


def _ends_of_chosen(content: TimelineContent) -> tuple[float, float] | None:
    clips = [clip for clip in content.design.clips if clip.id in content.view.selected_clips]
    if not clips:
        return None
    return (min(clip.onset_s for clip in clips), max(clip.end_s for clip in clips))


_Key = Qt.Key
#: How far an arrow moves clips; with Shift ten times as far.
STEP_S, _LEAP = 0.001, 10
# Keys that do what actions of the window do.
_ACTIONS = "fade_in", "fade_out", "stretch_clip"
_STEPS = {_Key.Key_Left: -1, _Key.Key_Right: 1, _Key.Key_Up: -1, _Key.Key_Down: 1}


class LaneKeys:
    """Turns key presses into edits of the selected clips."""

    def __init__(self, lanes: "LanesView") -> None:
        self._lanes = lanes
        self._burst = Burst(lanes)
        self._nudged: object = None

    def press(self, event: QtGui.QKeyEvent) -> bool:
        """Do what a key means; return whether it means anything."""
        if self._lanes.gain.key(event):
            return True
        content = self._lanes.content
        playhead_s = moved_playhead(event, content.design, content.view.playhead_s)
        if playhead_s is not None:
            self._put_playhead(playhead_s)
            return True
        command, step = meaning_of(_PLACE, event), _STEPS.get(_Key(event.key()), 0)
        if command in ("nudge", "change_track"):
            leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            self._nudge(command, step * (_LEAP if leap else 1))
        elif command == "go":
            self._go(step)
        elif command == "below":
            self._go_below()
        elif command == "gain_far":
            self._reach(step)
        elif command == "playhead":
            ends = (clip.end_s for clip in content.design.clips)
            at_start = event.key() == _Key.Key_Home
            self._put_playhead(0.0 if at_start else max(ends, default=0.0))
        elif command:
            self._act(command)
        return command not in ("", "give_up")  # without a drag, Esc is for the window

    def _act(self, command: str) -> None:
        """Do what a command does to the selected clips, or to what is shown."""
        lanes, content = self._lanes, self._lanes.content
        view = content.view
        chosen, at_s = view.selected_clips, view.playhead_s
        acts: dict[str, Callable[[], object]] = {
            "zoom_in": lambda: lanes.zoom(ZOOM),
            "zoom_out": lambda: lanes.zoom(1 / ZOOM),
            "whole": lanes.show_everything,
            "select_all": lambda: lanes.look(edits.select_all_clips(content.design, content.view)),
            "open": partial(lanes.action_requested.emit, "show_clip_editor"),
            "marker": lambda: lanes.add_marker(at_s),
            "add": lambda: lanes.edit(edits.add_waveform, lanes.last),
            "split": lambda: lanes.edit(edits.split_clips, chosen, at_s),
            "repeat": lambda: lanes.edit(copy_behind, chosen, "Repeat"),
            "mute": lambda: lanes.edit(edits.toggle_mute_clips, chosen),
            "duplicate": lambda: lanes.edit(copy_behind, chosen, "Duplicate"),
            **{name: partial(lanes.action_requested.emit, name) for name in _ACTIONS},
            "remove": lambda: lanes.edit(edits.remove_clips, chosen),
        }
        if command in _ACTIONS and not chosen:
            lanes.edited.emit(NO_CLIPS, None)
        elif command in acts:
            acts[command]()

    def _put_playhead(self, time_s: float) -> None:
        content = self._lanes.content
        low, high = content.scale.shown_s
        self._lanes.playhead_requested.emit(time_s)
        if not low <= time_s <= high:
            # Pan to the nearest edge, so that the playhead is visible.
            by_s = time_s - (low if time_s < low else high)
            shown_s = panned((low, high), by_s, content.lengths.whole_s)
            self._lanes.view_changed.emit(replace(self._lanes.content.view, time_range_s=shown_s))

    def _go(self, step: int) -> None:
        """Select the next clip, or the one before, through all tracks."""
        content = self._lanes.content
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
        self._lanes.select(ids[(here + step) % len(ids)])

    def _reach(self, step: int) -> None:
        """Select besides the nearest clip of the next track that has any."""
        content = self._lanes.content
        design = content.design
        for last in content.view.selected_clips[-1:]:
            here, onset_s = design.index_of(design.track_of(last).id), design.clip(last).onset_s
            ahead = design.inputs[here + 1 :] if step > 0 else design.inputs[:here][::-1]
            clips = next((track.clips for track in ahead if track.clips), ())
            nearest = min(clips, key=lambda clip: abs(clip.onset_s - onset_s), default=None)
            if nearest is not None:
                others = (
                    clip_id for clip_id in content.view.selected_clips if clip_id != nearest.id
                )
                self._lanes.select(*others, nearest.id)

    def _go_below(self) -> None:
        """Select the next of the clips that overlap."""
        content = self._lanes.content
        for clip in content.view.selected_clips[-1:]:
            track = content.design.track_of(clip)
            following = next_id(overlapping(track, content.design.clip(clip)), clip)
            self._lanes.select(clip if following is None else following)

    def _nudge(self, command: str, steps: int) -> None:
        content = self._lanes.content
        design, view = content.design, content.view
        in_time = command == "nudge"
        by_s, by_tracks = (steps * STEP_S, 0) if in_time else (0.0, steps)
        outcome = edits.move_clips(design, view, view.selected_clips, by_s, by_tracks)
        # One burst of nudges is one undo step; other clips, or another direction, begin a new one.
        nudged = (in_time, view.selected_clips)
        if nudged != self._nudged:
            self._burst.end()
            self._nudged = nudged
        self._lanes.edited.emit(outcome, self._burst.gesture())


# A movement shorter than this is a click.
_DRAG_PX = 4.0


class LaneMouse:
    """Turns what the mouse buttons do into gestures, and single clicks into selections."""

    def __init__(self, lanes: "LanesView") -> None:
        self._lanes, self._gain = lanes, lanes.gain
        self._gesture: gestures.Gesture | None = None
        self._click: Callable[[], None] | None = None
        self._at = QPointF()
        self._moving = False
        # The clip on which the button went down last.
        self._pressed: int | None = None

    @property
    def busy(self) -> bool:
        """Whether a button is down that means something."""
        return self._gesture is not None

    def press(self, at: QPointF, button: Qt.MouseButton, held: gestures.Modifier) -> None:
        """Begin what a button does that goes down."""
        if self.busy:
            return
        content = self._lanes.content
        context = self._context()
        self._at, self._moving, self._click = at, False, None
        box = content.box_at(at)
        if button == Qt.MouseButton.MiddleButton:
            self._gesture = gestures.Pan(context, at)
        elif button != Qt.MouseButton.LeftButton:
            return
        elif at.y() < content.ruler_px:
            self._gesture = self._on_ruler(context, at, held)
        elif (curve := self._gain.press(context, at, held)) is not None:
            on_line = isinstance(curve, gestures.MoveGain) and curve.vertical
            if on_line and box is not None:
                curve = self._on_line(curve, box, at, held)
            self._gesture = curve
        elif box is not None:
            self._gesture = self._on_clip(box, at, held)
        else:
            self._gesture = gestures.Marquee(context, at)
            if not held & gestures.Modifier.ControlModifier:
                self._click = self._on_ground(context, at)

    def move(self, at: QPointF, held: gestures.Modifier) -> None:
        """Follow the pointer."""
        if self._gesture is None:
            return
        away = at - self._at
        self._moving = self._moving or max(abs(away.x()), abs(away.y())) >= _DRAG_PX
        if self._moving:
            self._click = None
            preview = self._gesture.move(at, held)
            if self.busy:
                self._lanes.overlay.show_preview(preview, at)
            viewport, shapes = self._lanes.viewport(), Qt.CursorShape
            if preview.forbidden:
                viewport.setCursor(shapes.ForbiddenCursor)
            elif viewport.cursor().shape() == shapes.ForbiddenCursor:
                viewport.setCursor(shapes.ClosedHandCursor)

    def release(self) -> None:
        """End what the button did."""
        gesture, click, self._gesture, self._click = self._gesture, self._click, None, None
        if gesture is not None:
            gesture.finish()
            self._lanes.overlay.show_preview(gestures.GesturePreview(), self._at)
        if click is not None:
            click()

    def cancel(self) -> bool:
        """Cancel the gesture; return whether there was one."""
        gesture, self._gesture, self._click = self._gesture, None, None
        if gesture is None:
            return False
        gesture.cancel()
        self._lanes.overlay.show_preview(gestures.GesturePreview(), self._at)
        return True

    def double_click(self, at: QPointF) -> None:
        """Open the clip here, rename the marker, or add a clip, a marker or a point of a curve."""
        self.cancel()
        content = self._lanes.content
        box, lane = content.box_at(at), content.lane_at(at.y())
        if at.y() < content.ruler_px:
            if (marker := content.marker_at(at)) is not None:
                self._lanes.menu.rename(content.design.markers.index(marker))
            else:
                self._lanes.add_marker(self.time_at(at))
        elif self._gain.double_click(at):
            return
        elif box is not None:
            # The first of the two clicks may have selected a clip below.
            ids = [box.clip.id for box in content.boxes_at(at)]
            self._lanes.select(self._pressed if self._pressed in ids else box.clip.id)
            self._lanes.action_requested.emit("show_clip_editor")
        elif lane is not None:
            self._lanes.add_clip(lane.track.id, self.time_at(at))

    def time_at(self, at: QPointF) -> float:
        """Return the time to which something would snap here, s."""
        return gestures.snapped_time(self._context(), at)[0]

    def cursor_at(self, at: QPointF) -> Qt.CursorShape:
        """Return the shape of the pointer."""
        content = self._lanes.content
        if at.y() < content.ruler_px:
            ends = content.other_loop_end_at(at), content.marker_at(at)
            if ends != (None, None):
                return Qt.CursorShape.SizeHorCursor
            upper = at.y() < content.ruler_px / 2
            return Qt.CursorShape.CrossCursor if upper else Qt.CursorShape.PointingHandCursor
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

    def _context(self) -> gestures.GestureContext:
        return gestures.GestureContext(lanes=self._lanes, before=self._lanes.content)

    def _on_clip(self, box: Box, at: QPointF, held: gestures.Modifier) -> gestures.Gesture:
        content, clip = self._lanes.content, box.clip
        self._pressed = clip.id
        chosen = clip.id in content.view.selected_clips
        if held & gestures.Modifier.ControlModifier:
            # Ctrl copies if it moves, and otherwise adds to the selection or takes away.
            toggled = edits.toggle_clip(content.design, content.view, clip.id).view
            self._click = lambda: self._lanes.view_changed.emit(toggled)
        elif content.view.selected_clips == (clip.id,):
            # Clips may lie over each other: another click selects the next one below.
            ids = [box.clip.id for box in content.boxes_at(at)]
            self._click = partial(self._lanes.select, next_id(ids, clip.id) or clip.id)
        elif not chosen:
            self._lanes.select(clip.id)
        else:
            self._click = partial(self._lanes.select, clip.id)
        context = self._context()
        part = part_at(box.rect, at, box.fades_px)
        if part is Part.BODY or held & gestures.Modifier.ControlModifier:
            return gestures.MoveClips(context, box, at)
        ends = (Part.START, Part.END)
        return (
            gestures.MoveEnd(context, box, at, part)
            if part in ends
            else gestures.FadeEnd(context, box, at, part)
        )

    def _on_line(
        self, curve: gestures.Gesture, box: Box, at: QPointF, held: gestures.Modifier
    ) -> gestures.Gesture:
        """Drag the curve of a track where it passes over a clip: up or down it, along the clip."""

        def clip() -> gestures.Gesture:
            gesture = self._on_clip(box, at, held)
            self._click = None
            return gesture

        self._pressed = box.clip.id
        self._click = partial(self._lanes.select, box.clip.id)
        return gestures.EitherGesture(at, lambda: curve, clip)

    def _on_ruler(
        self, context: gestures.GestureContext, at: QPointF, held: gestures.Modifier
    ) -> gestures.Gesture:
        content = context.before
        marker, fixed_s = content.marker_at(at), content.other_loop_end_at(at)
        if marker is not None:
            return gestures.MoveMarker(context, marker)
        if fixed_s is not None:
            return gestures.MoveLoop(context, fixed_s)
        time_s = gestures.snapped_time(context, at)[0]
        if at.y() < content.ruler_px / 2:
            self._click = partial(self._lanes.playhead_requested.emit, time_s)
            return gestures.MoveLoop(context, time_s)
        gesture = gestures.MovePlayhead(context)
        gesture.move(at, held)
        return gesture

    def _on_ground(self, context: gestures.GestureContext, at: QPointF) -> Callable[[], None]:
        def click() -> None:
            content = self._lanes.content
            lane = content.lane_at(at.y())
            time_s = gestures.snapped_time(context, at)[0]
            tracks = () if lane is None else (lane.track.id,)
            view = replace(content.view, selected_inputs=tracks, selected_clips=())
            self._lanes.view_changed.emit(view)
            self._lanes.playhead_requested.emit(time_s)

        return click


_SIDE_PX = 8.0
_TEXT = 0.9
_CTRL = Qt.KeyboardModifier.ControlModifier
#: How much narrower the visible part becomes by a button or a key.
ZOOM = 1.5


class LanesView(Canvas):
    """Lanes and a ruler; mouse and keys edit what is on them.

    Attributes
    ----------
    content
        What is shown.
    elsewhere
        Returns where in another panel something would be dropped that is held over a place, px;
        None ends that.
    item, gains, playhead, overlay
        Layers that are painted.
    gain
        Handles the gain curves.
    last
        What new clips play: what the clip plays that was selected last.
    """

    key_place = "timeline"

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    view_changed = Signal(object)
    playhead_requested = Signal(float)
    #: The name of an action of the window.
    action_requested = Signal(str)
    #: Lanes are to be scrolled by so many notches.
    scroll_requested = Signal(float)

    def __init__(self) -> None:
        super().__init__()
        design = Design(limb="")
        self.content = TimelineContent(design=design, view=View(), lengths=ClipLengths(design))
        self.elsewhere: Callable[[QPointF | None], DropPlace | None] = lambda at: None
        self.last: Waveform = Clip().waveform
        named(self, "lanes", "Timeline")
        self.setMouseTracking(True)
        self.setMinimumSize(120, 60)
        self.item, self.gains, self.overlay = LanesItem(), GainItem(), OverlayItem()
        self.playhead = PlayheadItem()
        for item in (self.item, self.gains, self.playhead, self.overlay):
            self.addItem(item)
        # What was shown when the button went down.
        self._held: TimelineContent | None = None
        # What is shown where nothing is zoomed: fitted, or as the last drag left it.
        self._kept_s: Range | None = None
        self.gain = GainPoints(self)
        self.mouse, self.keys = LaneMouse(self), LaneKeys(self)
        self.menu = LanesMenu(self, self.gain)
        self.update_style()

    @property
    def ruler_px(self) -> float:
        """Height of the ruler, below which the lanes begin, px."""
        return ruler_px(self.fontMetrics().height())

    def show_state(self, design: Design, view: View, lanes: tuple[Lane, ...]) -> None:
        """Show another design or view; lanes in coordinates of this widget."""
        chosen = view.selected_clips[-1:]
        self.last = next(
            (clip.waveform for clip in design.clips if (clip.id,) == chosen), self.last
        )
        self.change(design=design, view=view, lanes=lanes)

    def told_count(self) -> int:
        """Return the number of clips in sight."""
        return len(self.content.boxes)

    def told(self, k: int) -> Told:
        """Return what a screen reader says of a clip; they are counted track by track."""
        boxes = sorted(self.content.boxes, key=lambda box: (box.rect.top(), box.rect.left()))
        box, clip = boxes[k], boxes[k].clip
        onset, duration = (
            value_text(time_s, "s")
            for time_s in (clip.onset_s, self.content.lengths.durations_s[clip.id])
        )
        name = f"{clip_name(clip)}, place {box.lane.track.location}, onset {onset}"
        return Told(f"{name}, duration {duration}", box.rect, clip.id in self.content.selected)

    def show_playhead(self, view: View) -> None:
        """Show a view in which the playhead alone has moved."""
        self.content = replace(self.content, view=view)
        self.playhead.show_content(self.content, float(self.height()))

    def update_style(self) -> None:
        super().update_style()
        for item in (self.item, self.gains, self.overlay):
            item.show_font(scaled(tabular(self.font()), _TEXT))

    def edit(self, edit: Callable[..., Edit | Refusal], *more: object) -> None:
        """Emit what an edit makes of the present design."""
        self.edited.emit(edit(self.content.design, self.content.view, *more), None)

    def look(self, edit: Edit) -> None:
        """Emit the view of an edit that changes nothing else."""
        self.view_changed.emit(edit.view)

    def select(self, *clips: int) -> None:
        """Select these clips and no others."""
        self.look(edits.select_clips(self.content.design, self.content.view, clips))

    def add_clip(self, track: int, at_s: float) -> None:
        """Add a clip of the last used kind to a track."""
        self.edit(edits.add_clip, track, at_s, self.last)

    def add_marker(self, at_s: float) -> None:
        """Add a marker with a number for a name."""
        self.edit(edits.add_marker, at_s, str(len(self.content.design.markers) + 1))

    def toggle_gain(self, *tracks: int) -> None:
        """Show the gain curves of tracks, or hide them."""
        self.look(toggle_gain_curves(self.content.design, self.content.view, tracks))

    def zoom(self, factor: float) -> None:
        """See a part so many times narrower: around the playhead, or the middle."""
        content = self.content
        (low, high), at_s = content.scale.shown_s, content.view.playhead_s
        anchor_s = at_s if low <= at_s <= high else (low + high) / 2
        self._show_range(zoomed((low, high), anchor_s, factor, content.lengths.whole_s))

    def show_range(self, part_s: Range) -> None:
        """See this part."""
        self._show_range(within(part_s, self.content.lengths.whole_s))

    def start_over(self) -> None:
        """Forget what part of the time was seen: another design is open."""
        self._held = self._kept_s = None
        self.change()

    def show_everything(self) -> None:
        """Fit the clips into the width."""
        self._show_range(None)
        self._kept_s = self.content.lengths.content_s
        self.change()

    def claims(self, event: QtGui.QKeyEvent) -> bool:
        return bool(meaning_of(_PLACE, event) or meaning_of(PLAYHEAD, event))

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        self._held = self.content
        self.mouse.press(event.position(), event.button(), event.modifiers())
        event.accept()

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if self.mouse.busy:
            self.mouse.move(event.position(), event.modifiers())
        else:
            box = self.content.box_at(event.position())
            self.item.show_hovered(None if box is None else box.clip.id)
            self.viewport().setCursor(self.mouse.cursor_at(event.position()))
        event.accept()

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            self.mouse.release()
            self._end_drag()
        event.accept()

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.double_click(event.position())
            self._end_drag()
        event.accept()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        place = QPointF(event.pos())
        if event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard:
            # The menu key opens the menu of the clip that was selected last, or of the playhead.
            place = self.content.keyboard_place
        self.menu.open(self.mapToGlobal(place).toPoint(), place)

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        turns, held, content = event.angleDelta(), event.modifiers(), self.content
        if turns.x() or held & (_CTRL | Qt.KeyboardModifier.ShiftModifier):
            self._show_range(range_by_wheel(event, content.scale, content.lengths.whole_s))
        else:
            self.scroll_requested.emit(turns.y() / NOTCH)
        event.accept()

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.mouse.cancel():
            self._end_drag()
        elif not self.keys.press(event):
            event.ignore()

    def viewportEvent(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QtGui.QHelpEvent):
            QtWidgets.QToolTip.showText(
                event.globalPos(), timeline_tooltip(self.content, QPointF(event.pos())), self
            )
            return True
        return super().viewportEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.item.show_hovered(None)

    def lay_out(self) -> None:
        self.change()

    def change(self, **changes: Any) -> None:
        """Show content in which these fields are other ones."""
        before, held = self.content, self._held
        content = replace(before, **changes)
        lengths = before.lengths.of(content.design)
        outside = self._kept_s is not None and lengths.end_s > self._kept_s[1]
        if not held and ((outside and lengths.end_s > before.lengths.end_s) or not lengths.end_s):
            # What came since would be out of sight.
            self._kept_s = None
        shown_s = content.view.time_range_s or self._kept_s or lengths.whole_s
        # A drag keeps the zoom, even if the design becomes longer, and the room for gains.
        if held and not content.view.time_range_s:
            shown_s = held.scale.shown_s
        width = max(self.width() - 2 * _SIDE_PX, 1.0)
        self.content = replace(
            content,
            **self._drawn(content),
            lengths=lengths,
            scale=TimeScale(shown_s=shown_s, left_px=_SIDE_PX, width_px=width),
            height_px=float(self.height()),
            ruler_px=self.ruler_px,
            gain_tops={strip.lane.track.id: strip.top for strip in held.strips} if held else {},
        )
        rect = QRectF(self.rect())
        for item in (self.item, self.gains, self.overlay):
            item.show_content(self.content, rect)
        self.setAccessibleDescription(self.gain.description())
        self.playhead.show_content(self.content, float(self.height()))

    def show_samples(self, **changes: Any) -> None:
        """Show what clips play, on which nothing but the lanes depends."""
        content = replace(self.content, **changes)
        self.content = replace(content, **self._drawn(content))
        self.item.show_content(self.content, QRectF(self.rect()))

    def _drawn(self, content: TimelineContent) -> dict[str, Any]:
        drawn = drawn_clips(
            content.design, content.waveforms, content.sample_rate_hz, self.content.drawn
        )
        # While a clip is computed, which may be the loudest one, the others stay as high.
        loudest = self.content.loudest if content.awaited else loudest_of(content.design, drawn)
        return {"drawn": drawn, "loudest": loudest}

    def _show_range(self, shown_s: Range | None) -> None:
        # Who zooms during a drag wants to see something else.
        self._held = self._kept_s = None
        view = self.content.view
        if shown_s != view.time_range_s:
            self.view_changed.emit(replace(view, time_range_s=shown_s))
        else:
            self.change()

    def _end_drag(self) -> None:
        if self._held is not None and self._held.design is not self.content.design:
            self._kept_s = self.content.scale.shown_s
        self._held = None
        self.change()
