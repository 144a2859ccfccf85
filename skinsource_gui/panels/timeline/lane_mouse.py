"""What the mouse does on the lanes and on the ruler."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from PySide6.QtCore import QObject, QPointF, Qt, Signal

from skinsource.design import edits
from skinsource.design.clips import Marker
from skinsource_gui.panels.timeline.clip_part import CURSORS, Part, part_at
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gain.gain_points import GainPoints
from skinsource_gui.panels.timeline.gestures.clip_ends import FadeEnd, MoveEnd
from skinsource_gui.panels.timeline.gestures.gesture import Gesture, Held, Shown, Stage
from skinsource_gui.panels.timeline.gestures.marquee import Marquee
from skinsource_gui.panels.timeline.gestures.move_clips import MoveClips
from skinsource_gui.panels.timeline.gestures.move_gain import MoveGain
from skinsource_gui.panels.timeline.gestures.times import (
    MoveLoop,
    MoveMarker,
    MovePlayhead,
    Pan,
    snapped_time,
)
from skinsource_gui.panels.timeline.gestures.up_or_along import Either
from skinsource_gui.panels.timeline.lane import Box
from skinsource_gui.panels.timeline.overlaps import after
from skinsource_gui.widgets.drop_place import DropPlace

# A movement shorter than this is a click.
_DRAG_PX = 4.0
_CATCH_PX = 6.0


class LaneMouse(QObject):
    """Turns what the buttons do into gestures, and single clicks into selections.

    Parameters
    ----------
    content
        Returns what is shown now.
    gain
        Knows where gain curves are, which lie over the clips.

    Attributes
    ----------
    elsewhere
        Returns where in another panel something goes that is held over a place, px.
    """

    edited = Signal(object, object)
    looked = Signal(object)
    playhead_wanted = Signal(float)
    #: `Shown`: what is painted over the lanes.
    shown = Signal(object)
    #: A double click on a clip, with its id; on an empty lane, with track and time; on the ruler.
    opened = Signal(int)
    clip_wanted = Signal(int, float)
    marker_wanted = Signal(float)

    def __init__(self, content: Callable[[], Content], gain: GainPoints, parent: QObject) -> None:
        super().__init__(parent)
        self._content, self._gain = content, gain
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

    def press(self, at: QPointF, button: Qt.MouseButton, held: Held, rate_hz: float) -> None:
        """A button went down."""
        if self.busy:
            return
        content = self._content()
        stage = self._stage()
        self._at, self._moving, self._click = at, False, None
        box = content.box_at(at)
        if button == Qt.MouseButton.MiddleButton:
            self._gesture = Pan(stage, at)
        elif button != Qt.MouseButton.LeftButton:
            return
        elif at.y() < content.ruler_px:
            self._gesture = self._on_ruler(stage, at, held)
        elif (curve := self._gain.press(stage, at, held)) is not None:
            on_line = isinstance(curve, MoveGain) and curve.upright
            if on_line and box is not None:
                curve = self._on_line(curve, box, at, held, rate_hz)
            self._gesture = curve
        elif box is not None:
            self._gesture = self._on_clip(box, at, held, rate_hz)
        else:
            self._gesture = Marquee(stage, at)
            self._click = self._on_ground(stage, at)

    def move(self, at: QPointF, held: Held) -> None:
        """The pointer moved."""
        if self._gesture is None:
            return
        away = at - self._at
        self._moving = self._moving or max(abs(away.x()), abs(away.y())) >= _DRAG_PX
        if self._moving:
            self._click = None
            self.shown.emit(self._gesture.move(at, held))

    def release(self) -> None:
        """The button went up."""
        gesture, click, self._gesture, self._click = self._gesture, self._click, None, None
        if gesture is not None:
            gesture.finish()
            self.shown.emit(Shown())
        if click is not None:
            click()

    def cancel(self) -> bool:
        """Give up the gesture as if it had not begun; whether there was one."""
        gesture, self._gesture, self._click = self._gesture, None, None
        if gesture is None:
            return False
        gesture.cancel()
        self.shown.emit(Shown())
        return True

    def double_click(self, at: QPointF) -> None:
        """The left button was pressed twice."""
        self.cancel()
        content = self._content()
        box, lane = content.box_at(at), content.lane_at(at.y())
        if at.y() < content.ruler_px:
            self.marker_wanted.emit(max(content.scale.time(at.x()), 0.0))
        elif self._gain.double_click(at):
            return
        elif box is not None:
            # The first of the two clicks may have gone on to a clip below.
            under = [one.clip.id for one in content.boxes_at(at)]
            wanted = self._pressed if self._pressed in under else box.clip.id
            self._select(wanted)
            self.opened.emit(wanted)
        elif lane is not None:
            self.clip_wanted.emit(lane.track.id, self.time_at(at))

    def time_at(self, at: QPointF) -> float:
        """The time to which something would snap that is put there, s."""
        return snapped_time(self._stage(), at)[0]

    def cursor_at(self, at: QPointF) -> Qt.CursorShape:
        """Shape of the pointer."""
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

    def _stage(self) -> Stage:
        return Stage(
            content=self._content,
            apply=self.edited.emit,
            look=self.looked.emit,
            put_playhead=self.playhead_wanted.emit,
            elsewhere=lambda at: self.elsewhere(at),
            before=self._content(),
        )

    def _on_clip(self, box: Box, at: QPointF, held: Held, rate_hz: float) -> Gesture:
        content, clip = self._content(), box.clip
        self._pressed = clip.id
        chosen = clip.id in content.view.selected_clips
        if held & Held.ControlModifier:
            # Ctrl copies if it moves, and otherwise adds to the selection or takes away.
            toggled = edits.toggle_clip(content.design, content.view, clip.id).view
            self._click = lambda: self.looked.emit(toggled)
        elif content.view.selected_clips == (clip.id,):
            # Clips may lie over each other: another click goes on to the next one below.
            ids = [one.clip.id for one in content.boxes_at(at)]
            self._click = partial(self._select, after(ids, clip.id) or clip.id)
        elif not chosen:
            self.looked.emit(edits.select_clips(content.design, content.view, (clip.id,)).view)
        else:
            self._click = partial(self._select, clip.id)
        stage = self._stage()
        part = part_at(box.rect, at, box.fades_px)
        if part is Part.BODY or held & Held.ControlModifier:
            return MoveClips(stage, box, at, rate_hz)
        ends = (Part.START, Part.END)
        return MoveEnd(stage, box, at, part) if part in ends else FadeEnd(stage, box, at, part)

    def _on_line(
        self, curve: Gesture, box: Box, at: QPointF, held: Held, rate_hz: float
    ) -> Gesture:
        """The curve of a track where it passes over a clip."""

        def clip() -> Gesture:
            found = self._on_clip(box, at, held, rate_hz)
            self._click = None
            return found

        self._pressed = box.clip.id
        self._click = partial(self._select, box.clip.id)
        return Either(at, lambda: curve, clip)

    def _select(self, clip: int) -> None:
        content = self._content()
        self.looked.emit(edits.select_clips(content.design, content.view, (clip,)).view)

    def _on_ruler(self, stage: Stage, at: QPointF, held: Held) -> Gesture:
        content = stage.before
        marker, fixed_s = marker_at(content, at), _loop_end_at(content, at)
        if held & Held.ShiftModifier:
            return MoveLoop(stage, snapped_time(stage, at)[0])
        if marker is not None:
            return MoveMarker(stage, marker)
        if fixed_s is not None:
            return MoveLoop(stage, fixed_s)
        gesture = MovePlayhead(stage)
        gesture.move(at, held)
        return gesture

    def _on_ground(self, stage: Stage, at: QPointF) -> Callable[[], None]:
        def click() -> None:
            content = self._content()
            lane = content.lane_at(at.y())
            time_s = snapped_time(stage, at)[0]
            tracks = () if lane is None else (lane.track.id,)
            self.looked.emit(replace(content.view, selected_inputs=tracks, selected_clips=()))
            self.playhead_wanted.emit(time_s)

        return click


def marker_at(content: Content, at: QPointF) -> Marker | None:
    """The marker whose flag is at this place."""
    near = (
        (abs(content.scale.x(one.time_s) - at.x()), index)
        for index, one in enumerate(content.design.markers)
    )
    found = min(near, default=None)
    if found is None or found[0] > _CATCH_PX or at.y() > content.ruler_px / 2:
        return None
    return content.design.markers[found[1]]


def _loop_end_at(content: Content, at: QPointF) -> float | None:
    """The other end of the loop region, if one is at this place."""
    if content.design.loop_s is None:
        return None
    start_s, end_s = content.design.loop_s
    for here, other in ((start_s, end_s), (end_s, start_s)):
        if abs(content.scale.x(here) - at.x()) <= _CATCH_PX:
            return other
    return None
