"""Clips that are moved, or copied."""

from PySide6.QtCore import QPointF

from skinsource.design import edits
from skinsource_gui.panels.timeline.gestures.gesture import Held, Shown, Stage
from skinsource_gui.panels.timeline.lane import Box
from skinsource_gui.widgets.drop_place import DropPlace
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.time.snapping import Rest, rest_of


class MoveClips:
    """Drags the selected clips in time and from lane to lane.

    Shift: along time only.  Ctrl: copies.  Alt: without snapping.  A free drag goes by whole
    samples, so that what clips play need not be drawn anew.  Held over a place in another panel,
    on the hand, they lie where they were until they are dropped there.
    """

    def __init__(self, stage: Stage, box: Box, at: QPointF, sample_rate_hz: float) -> None:
        self._stage, self._box, self._at = stage, box, at
        self._sample_s = 1.0 / sample_rate_hz
        # Where in another panel they would go, and whether as copies.
        self._place: DropPlace | None = None
        self._copies = False
        content = stage.before
        chosen = content.view.selected_clips
        self._ids = chosen if box.clip.id in chosen else (box.clip.id,)
        ids = frozenset(self._ids)
        clips = [clip for lane in content.lanes for clip in lane.track.clips if clip.id in ids]
        self._first_s = min(clip.onset_s for clip in clips)
        own = box.clip
        self._edges = (own.onset_s, own.onset_s + content.durations_s[own.id])
        self._rests = {
            copies: content.neighbours_s(frozenset() if copies else ids) for copies in (False, True)
        }

    def move(self, at: QPointF, held: Held) -> Shown:
        copies = self._copies = bool(held & Held.ControlModifier)
        found = self._stage.elsewhere(at)
        if found is not None and found.location is not None:
            if self._place is None:
                self._stage.take_back()
            self._place = found
            return Shown()
        self._place = None
        rest = self._rest(at, copies=copies, free=bool(held & Held.AltModifier))
        by_tracks = 0 if held & Held.ShiftModifier else self._lanes_to(at)
        before, view = self._stage.before, self._stage.content().view
        act = edits.copy_clips if copies else edits.move_clips
        self._stage.edit(act(before.design, view, self._ids, rest.by_s, by_tracks))
        onset_s = self._edges[0] + rest.by_s
        return Shown(guide_s=rest.guide_s, words=value_text(onset_s, "s", digits=5))

    def finish(self) -> None:
        """What is moved stays; what is held over a place goes there."""
        self._stage.elsewhere(None)
        if self._place is not None and self._place.location is not None:
            design, view = self._stage.before.design, self._stage.content().view
            place = self._place.location
            self._stage.edit(
                edits.move_clips_to_place(design, view, self._ids, place, self._copies)
            )

    def cancel(self) -> None:
        self._stage.elsewhere(None)
        self._stage.take_back()

    def _rest(self, at: QPointF, *, copies: bool, free: bool) -> Rest:
        content = self._stage.content()
        by_s = (at.x() - self._at.x()) / content.scale.px_per_s
        by_s = max(round(by_s / self._sample_s) * self._sample_s, -self._first_s)
        if free or not content.snaps:
            return Rest(by_s=by_s)
        rest = rest_of(
            self._edges,
            by_s,
            neighbours_s=self._rests[copies],
            grid_s=content.grid_s,
            reach_s=content.reach_s,
        )
        return rest if self._first_s + rest.by_s >= 0.0 else Rest(by_s=-self._first_s)

    def _lanes_to(self, at: QPointF) -> int:
        lanes = self._stage.content().lanes
        # Where it was when the button went down: its track may have gone meanwhile.
        here = self._stage.before.design.index_of(self._box.lane.track.id)
        under = next((k for k, lane in enumerate(lanes) if at.y() < lane.bottom_px), len(lanes) - 1)
        return under - here
