"""What is dragged on the lanes and on the ruler. All edits of one gesture are one undo step."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, Qt

from skinsource.design import edits
from skinsource.design.clips import Marker
from skinsource.design.design import Design
from skinsource.design.display_units import value_text
from skinsource.design.edits.clips import SAME_S
from skinsource.design.edits.cutting import faded_ends
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects.breakpoints import Points, moved
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.panels.timeline.content import (
    Box,
    GainStrip,
    Part,
    TimelineContent,
    curve_of,
    gain_point_text,
)
from skinsource_gui.plots.time_scale import REACH_PX, Snap, panned, snap_of
from skinsource_gui.qt.frames import DropPlace

if TYPE_CHECKING:
    from skinsource_gui.panels.timeline.lanes import LanesView

Modifier = Qt.KeyboardModifier


@dataclass(frozen=True, slots=True, kw_only=True)
class GesturePreview:
    """What is painted over the lanes during a gesture.

    Attributes
    ----------
    guide_s
        The time that something snapped to.
    covered
        The rectangle that selects clips, px.
    label
        Text beside the pointer.
    forbidden
        Whether nothing would be dropped here.
    """

    guide_s: float | None = None
    covered: QRectF | None = None
    label: str = ""
    forbidden: bool = False


@dataclass(slots=True, kw_only=True)
class GestureContext:
    """What a gesture can read and do.

    Attributes
    ----------
    before
        What the lanes showed when the button went down.
    number
        Number of this gesture: all its edits are one step of the history.
    applied
        The design after the last edit; None before there is any.
    """

    lanes: "LanesView"
    before: TimelineContent
    number: int = field(default_factory=new_gesture)
    applied: Design | None = None

    @property
    def now(self) -> TimelineContent:
        """What the lanes show now."""
        return self.lanes.content

    @property
    def disturbed(self) -> bool:
        """Whether something else has changed the design since the button went down."""
        now, expected = self.now.design, self.applied or self.before.design
        return now is not expected and now != expected

    def edit(self, edit: Callable[..., Edit | Refusal], *more: object) -> None:
        """Edit the design that there was before; the drag ends if another came since."""
        if self.disturbed:
            self.lanes.mouse.cancel()
            return
        outcome = edit(self.before.design, self.now.view, *more)
        self.lanes.edited.emit(outcome, self.number)
        if isinstance(outcome, Edit):
            # A motion that was edited by hand has become single clips.
            self.applied = self.now.design

    def rest(self, edges_s: Sequence[float], by_s: float, neighbours_s: Sequence[float]) -> Snap:
        """Return how far edges move that are dragged ``by_s``: they snap, if that is on."""
        content = self.now
        if not content.snaps:
            return Snap(by_s=by_s)
        grid_s, reach_s = content.grid_s, REACH_PX / content.scale.px_per_s
        return snap_of(edges_s, by_s, neighbours_s=neighbours_s, grid_s=grid_s, reach_s=reach_s)

    def undo(self) -> None:
        """Put the design back as if the gesture had not begun."""
        if self.applied is not None and not self.disturbed:
            before = self.before
            back = Edit(label="", design=before.design, view=before.view)
            self.lanes.edited.emit(back, self.number)
            # It may go on from there.
            self.applied = None


class Gesture:
    """A drag, from pressing a button to letting it go."""

    def __init__(self, context: GestureContext) -> None:
        self._context = context

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        """Follow the pointer to a place, with these keys held."""
        raise NotImplementedError

    def finish(self) -> None:
        """End when the button goes up: what has changed stays."""

    def cancel(self) -> None:
        """Put everything back as if the drag had not begun."""
        self._context.undo()


# No clip becomes shorter, s.
_SHORTEST_S = 0.001
# Ends that are dragged freely come to rest on tenths of a millisecond.
_DECIMALS = 4


class _EndDrag(Gesture):
    """Drag of one end of a clip."""

    def __init__(self, context: GestureContext, box: Box, at: QPointF, part: Part) -> None:
        super().__init__(context)
        self._clip, self._at, self._part = box.clip, at, part
        self._start_s = box.clip.onset_s
        self._end_s = self._start_s + context.before.lengths.durations_s[box.clip.id]
        self._neighbours = context.before.neighbours_s(frozenset({box.clip.id}))

    def _rest(self, at: QPointF, edge_s: float) -> Snap:
        by_s = (at.x() - self._at.x()) / self._context.now.scale.px_per_s
        rest = self._context.rest((edge_s,), by_s, self._neighbours)
        if rest.guide_s is not None:
            return rest
        return Snap(by_s=round(edge_s + rest.by_s, _DECIMALS) - edge_s)


class MoveEnd(_EndDrag):
    """Drag of the start or the end of a clip: trims it; with Alt or Shift held stretches it.

    Some desktops take Alt and a drag for themselves.
    """

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        start_s, end_s = self._start_s, self._end_s
        if self._part is Part.START:
            rest = self._rest(at, start_s)
            start_s = min(max(start_s + rest.by_s, 0.0), end_s - _SHORTEST_S)
        else:
            rest = self._rest(at, end_s)
            end_s = max(end_s + rest.by_s, start_s + _SHORTEST_S)
        stretches = held & (Modifier.AltModifier | Modifier.ShiftModifier)
        act = edits.stretch_clip if stretches else edits.trim_clip
        self._context.edit(act, self._clip.id, start_s, end_s)
        # It is as long as it can be, and may be gone.
        lasts_s = self._context.now.lengths.durations_s.get(self._clip.id, 0.0)
        length = value_text(lasts_s, "s", digits=5)
        text = f"Stretched to {length}" if stretches else f"{length} · Shift: stretch"
        edge_s = end_s - lasts_s if self._part is Part.START else start_s + lasts_s
        # A clip that plays no more than that does not follow to where the pointer snaps.
        reached = rest.guide_s is not None and abs(edge_s - rest.guide_s) < SAME_S
        return GesturePreview(guide_s=rest.guide_s if reached else None, label=text)


class FadeEnd(_EndDrag):
    """Drag of an upper corner of a clip: sets how long it fades in, or out."""

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        in_s, out_s = (end.length_s if end else 0.0 for end in faded_ends(self._clip))
        length_s = self._end_s - self._start_s
        if self._part is Part.FADE_IN:
            rest = self._rest(at, self._start_s + in_s)
            changed = in_s = round(min(max(in_s + rest.by_s, 0.0), length_s - out_s), 9)
        else:
            rest = self._rest(at, self._end_s - out_s)
            changed = out_s = round(min(max(out_s - rest.by_s, 0.0), length_s - in_s), 9)
        self._context.edit(edits.fade_clip, self._clip.id, in_s, out_s)
        return GesturePreview(guide_s=rest.guide_s, label=value_text(changed, "s", digits=4))


class Marquee(Gesture):
    """Selects the clips that a rectangle touches, over all lanes; with Ctrl held adds them."""

    def __init__(self, context: GestureContext, at: QPointF) -> None:
        super().__init__(context)
        scale = context.before.scale
        # It stays at its time while the view pans.
        self._from = (scale.time(at.x()), at.y())

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        content = self._context.now
        down = QPointF(content.scale.x(self._from[0]), self._from[1])
        covered = QRectF(down, at).normalized()
        # One that is drawn straight along a lane has no height, and would touch nothing.
        touching = covered.adjusted(-0.5, -0.5, 0.5, 0.5)
        touched = [box.clip.id for box in content.boxes if box.rect.intersects(touching)]
        added_to = (
            self._context.before.view.selected_clips if held & Modifier.ControlModifier else ()
        )
        chosen = (*(clip_id for clip_id in added_to if clip_id not in touched), *touched)
        self._context.lanes.select(*chosen)
        return GesturePreview(covered=covered)

    def cancel(self) -> None:
        view = self._context.before.view
        self._context.lanes.view_changed.emit(
            replace(
                self._context.now.view,
                selected_clips=view.selected_clips,
                selected_inputs=view.selected_inputs,
            )
        )


class MoveClips(Gesture):
    """Drags the selected clips in time and from lane to lane.

    Shift: along time only.  Ctrl: copies.  Alt: without snapping.  A free drag goes by whole
    samples, so that what clips play need not be computed again.  While they are held over the
    hand, the design is as before; dropped, they go to a place there, and beside all places nowhere.
    """

    def __init__(self, context: GestureContext, box: Box, at: QPointF) -> None:
        super().__init__(context)
        self._box, self._at = box, at
        self._sample_s = 1.0 / context.before.sample_rate_hz
        # Where in another panel they would go, and whether as copies.
        self._place: DropPlace | None = None
        self._copies = False
        content = context.before
        chosen = content.view.selected_clips
        self._ids = chosen if box.clip.id in chosen else (box.clip.id,)
        ids = frozenset(self._ids)
        clips = [clip for lane in content.lanes for clip in lane.track.clips if clip.id in ids]
        self._first_s = min(clip.onset_s for clip in clips)
        own = box.clip
        self._edges = (own.onset_s, own.onset_s + content.lengths.durations_s[own.id])
        self._snap_times_s = {
            copies: content.neighbours_s(frozenset() if copies else ids) for copies in (False, True)
        }

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        copies = self._copies = bool(held & Modifier.ControlModifier)
        before, self._place = self._place, self._context.lanes.elsewhere(at)
        if self._place is not None:
            if before is None:
                self._context.undo()
            return GesturePreview(forbidden=self._place.location is None)
        rest = self._rest(at, copies=copies, free=bool(held & Modifier.AltModifier))
        by_tracks = 0 if held & Modifier.ShiftModifier else self._lanes_to(at)
        act = edits.copy_clips if copies else edits.move_clips
        self._context.edit(act, self._ids, rest.by_s, by_tracks)
        onset_s = self._edges[0] + rest.by_s
        return GesturePreview(guide_s=rest.guide_s, label=value_text(onset_s, "s", digits=5))

    def finish(self) -> None:
        """Drop the clips on the place in another panel over which they are held, if any."""
        self._context.lanes.elsewhere(None)
        if self._place is not None and self._place.location is not None:
            place = self._place.location
            self._context.edit(edits.move_clips_to_place, self._ids, place, self._copies)

    def cancel(self) -> None:
        self._context.lanes.elsewhere(None)
        self._context.undo()

    def _rest(self, at: QPointF, *, copies: bool, free: bool) -> Snap:
        by_s = (at.x() - self._at.x()) / self._context.now.scale.px_per_s
        by_s = max(round(by_s / self._sample_s) * self._sample_s, -self._first_s)
        if free:
            return Snap(by_s=by_s)
        rest = self._context.rest(self._edges, by_s, self._snap_times_s[copies])
        return rest if self._first_s + rest.by_s >= 0.0 else Snap(by_s=-self._first_s)

    def _lanes_to(self, at: QPointF) -> int:
        lanes = self._context.now.lanes
        # Its lane when the button went down: the track may have been removed since.
        here = self._context.before.design.index_of(self._box.lane.track.id)
        target = next(
            (k for k, lane in enumerate(lanes) if at.y() < lane.bottom_px), len(lanes) - 1
        )
        return target - here


_FINE = 0.1
# From how far away a point comes to rest on a gain of 1, px.
_REACH_PX = 2.5


class MoveGain(Gesture):
    """Drags points of a gain curve: one of them, or both ends of a line up and down.

    Shift: along time or gain only.  Ctrl: finely.  Alt: without snapping.

    Parameters
    ----------
    points, chosen
        The points when the button goes down, and the numbers of those that move.
    vertical
        Whether they only move up and down.
    fine
        Whether Ctrl makes the drag fine; not where Ctrl has just added the point.
    """

    def __init__(
        self,
        context: GestureContext,
        strip: GainStrip,
        at: QPointF,
        points: Points,
        chosen: tuple[int, ...],
        *,
        vertical: bool = False,
        fine: bool = True,
    ) -> None:
        super().__init__(context)
        self._strip, self._at = strip, at
        self._points, self._chosen = points, chosen
        self.vertical, self._fine = vertical, fine

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        strip, scale = self._strip, self._context.now.scale
        moved_px = at - self._at
        by_s, by_gain = moved_px.x() / scale.px_per_s, -moved_px.y() * strip.top / strip.height_px
        if self._fine and held & Modifier.ControlModifier:
            by_s, by_gain = by_s * _FINE, by_gain * _FINE
        vertical = self.vertical
        if held & Modifier.ShiftModifier:
            vertical = vertical or abs(moved_px.y()) > abs(moved_px.x())
            by_gain = by_gain if vertical else 0.0
        if vertical:
            by_s = 0.0
        time_s, gain, _ = self._points[self._chosen[0]]
        free = bool(held & Modifier.AltModifier)
        guide_s = None
        if by_s and not free:
            rest = self._context.rest((time_s,), by_s, self._context.before.neighbours_s())
            by_s, guide_s = rest.by_s, rest.guide_s
        if not free and abs(strip.y(gain + by_gain) - strip.y(1.0)) <= _REACH_PX and by_gain:
            by_gain = 1.0 - gain
        after = moved(self._points, self._chosen, by_s, by_gain)
        self.put(after)
        x, y, _ = after[self._chosen[0]]
        return GesturePreview(guide_s=guide_s, label=gain_point_text(x, y))

    def put(self, points: Points) -> None:
        """Set the points of the track's curve."""
        self._context.edit(edits.set_gain_curve, self._strip.lane.track.id, curve_of(points))


def snapped_time(
    context: GestureContext, at: QPointF, without: float | None = None
) -> tuple[float, float | None]:
    """Return the time at a place, from 0 on, and what it snapped to, never to ``without``."""
    time_s = max(context.now.scale.time(at.x()), 0.0)
    others_s = [other_s for other_s in context.before.neighbours_s() if other_s != without]
    rest = context.rest((0.0,), time_s, others_s)
    return max(rest.by_s, 0.0), rest.guide_s


class MovePlayhead(Gesture):
    """Puts the playhead under the pointer."""

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        time_s, guide_s = snapped_time(self._context, at, self._context.before.view.playhead_s)
        self._context.lanes.playhead_requested.emit(time_s)
        return GesturePreview(guide_s=guide_s, label=value_text(time_s, "s", digits=5))

    def cancel(self) -> None:
        self._context.lanes.playhead_requested.emit(self._context.before.view.playhead_s)


class MoveLoop(Gesture):
    """Draws the loop region, or moves one of its ends; ``fixed_s`` is the other end."""

    def __init__(self, context: GestureContext, fixed_s: float) -> None:
        super().__init__(context)
        self._fixed_s = fixed_s

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        time_s, guide_s = snapped_time(self._context, at)
        ends = (min(time_s, self._fixed_s), max(time_s, self._fixed_s))
        self._context.edit(edits.set_loop, ends if ends[0] < ends[1] else None)
        return GesturePreview(guide_s=guide_s, label=value_text(ends[1] - ends[0], "s", digits=4))


class MoveMarker(Gesture):
    """Drags a marker."""

    def __init__(self, context: GestureContext, marker: Marker) -> None:
        super().__init__(context)
        self._index = context.before.design.markers.index(marker)
        self._marker, self._wanted_s = marker, marker.time_s

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        time_s, guide_s = snapped_time(self._context, at, self._marker.time_s)
        self._wanted_s = time_s
        self._context.edit(edits.move_marker, self._index, time_s)
        return GesturePreview(guide_s=guide_s, label=value_text(time_s, "s", digits=5))

    def finish(self) -> None:
        now_s = self._context.now.design.markers[self._index].time_s
        if now_s != self._wanted_s:
            stays = f"Another marker is there; this one is at {value_text(now_s, 's', digits=5)}."
            self._context.lanes.edited.emit(Refusal(sentence=stays), None)


class Pan(Gesture):
    """Moves the visible part of the time with the pointer."""

    def __init__(self, context: GestureContext, at: QPointF) -> None:
        super().__init__(context)
        self._at = at

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        before = self._context.before
        by_s = (self._at.x() - at.x()) / before.scale.px_per_s
        shown = panned(before.scale.shown_s, by_s, before.lengths.whole_s)
        self._context.lanes.view_changed.emit(replace(self._context.now.view, time_range_s=shown))
        return GesturePreview()

    def cancel(self) -> None:
        view = self._context.now.view
        range_s = self._context.before.view.time_range_s
        self._context.lanes.view_changed.emit(replace(view, time_range_s=range_s))


class EitherGesture(Gesture):
    """Becomes one of two gestures, by the direction in which the drag begins.

    A gain curve lies over the clips of its track: a drag up or down moves the curve, a drag along
    the time moves the clip.

    Parameters
    ----------
    at
        Where the button went down.
    vertical, along
        Make the gesture for a drag up or down, and that for a drag along the time.
    """

    def __init__(
        self, at: QPointF, vertical: Callable[[], Gesture], along: Callable[[], Gesture]
    ) -> None:
        self._at, self._vertical, self._along = at, vertical, along
        self._gesture: Gesture | None = None

    def move(self, at: QPointF, held: Modifier) -> GesturePreview:
        if self._gesture is None:
            moved_px = at - self._at
            self._gesture = (
                self._along() if abs(moved_px.x()) > abs(moved_px.y()) else self._vertical()
            )
        return self._gesture.move(at, held)

    def finish(self) -> None:
        """Finish the gesture that it has become."""
        if self._gesture is not None:
            self._gesture.finish()

    def cancel(self) -> None:
        """Cancel the gesture that it has become."""
        if self._gesture is not None:
            self._gesture.cancel()
