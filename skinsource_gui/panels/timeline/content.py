"""What the timeline shows."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from PySide6.QtCore import QPointF

from skinsource.base.arrays import Floats
from skinsource.base.published import SAMPLE_RATE_HZ
from skinsource.design.design import Design
from skinsource.design.edits.edit import clip_of
from skinsource.design.view import View
from skinsource_gui.panels.timeline.clip_lengths import ClipLengths
from skinsource_gui.panels.timeline.gain.gain_strip import GainStrip, top_of
from skinsource_gui.panels.timeline.lane import Box, Lane, box_at, boxes_of, lane_at
from skinsource_gui.panels.timeline.overlaps import Overlaps, boxes_at
from skinsource_gui.widgets.time.snapping import REACH_PX, grid_step_s
from skinsource_gui.widgets.time.time_scale import Range, TimeScale

#: How high the ruler is where words have their usual size, px.
RULER_PX = 26.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Content:
    """Design, view, and where both are painted; made anew at each change.

    Attributes
    ----------
    design, view
        What is shown.
    lanes
        Lanes from top to bottom, also those out of sight.
    scale
        From times to pixels.
    height_px
        Where the lowest lane that can be seen ends.
    lengths
        How long the clips are.
    waveforms, sample_rate_hz
        What clips play, (n_times,) each, by their id, as far as it is known, at that rate.
    awaited
        Ids of the clips of which it is late.
    snaps
        Whether edges snap.
    ruler_px
        How high the ruler is.
    gain_shown
        Ids of the tracks whose gain curve is edited.
    gain_tops
        The largest gain that a lane has room for, by the id of its track, while it is held.
    chosen_point
        Id of a track and number of a point on its gain curve, or None.
    overlaps
        Knows where clips of a track overlap.
    """

    design: Design
    view: View
    lanes: tuple[Lane, ...]
    scale: TimeScale
    height_px: float
    lengths: ClipLengths
    waveforms: Mapping[int, Floats] = field(default_factory=dict)
    awaited: frozenset[int] = frozenset()
    snaps: bool = True
    ruler_px: float = RULER_PX
    sample_rate_hz: float = SAMPLE_RATE_HZ
    gain_shown: frozenset[int] = frozenset()
    gain_tops: Mapping[int, float] = field(default_factory=dict)
    chosen_point: tuple[int, int] | None = None
    overlaps: Overlaps = field(default_factory=Overlaps)

    @property
    def durations_s(self) -> Mapping[int, float]:
        """Length of each clip, by its id."""
        return self.lengths.durations_s

    @cached_property
    def selected(self) -> frozenset[int]:
        """Clips that are selected."""
        return frozenset(self.view.selected_clips)

    @cached_property
    def boxes(self) -> list[Box]:
        """Clips that can be seen, in painting order: the selected ones lie on top."""
        boxes = [box for lane in self.lanes for box in self.boxes_on(lane)]
        return sorted(boxes, key=lambda box: box.clip.id in self.selected)

    @cached_property
    def strips(self) -> list[GainStrip]:
        """Gain curves that can be seen: those that are edited, and those that do something."""
        return [
            GainStrip(
                lane=lane,
                scale=self.scale,
                top=self.gain_tops.get(lane.track.id) or top_of(lane.track.gain_curve),
                shown=lane.track.id in self.gain_shown,
            )
            for lane in self.lanes
            if lane.track.gain_curve or lane.track.id in self.gain_shown
        ]

    def unplayable_on(self, lane: Lane) -> frozenset[int]:
        """Clips for which a lane cannot be played: that cannot be sampled, or else all of them."""
        if not lane.problem:
            return frozenset()
        sounding = [clip.id for clip in lane.track.clips if not clip.muted]
        known = self.waveforms.keys() | self.awaited
        return frozenset([one for one in sounding if one not in known] or sounding)

    def boxes_on(self, lane: Lane) -> list[Box]:
        """Clips of a lane that can be seen, in painting order."""
        if lane.bottom_px <= self.ruler_px or lane.top_px >= self.height_px:
            return []
        boxes = boxes_of([lane], self.scale, self.durations_s)
        return sorted(boxes, key=lambda box: box.clip.id in self.selected)

    @property
    def whole_s(self) -> Range:
        """All of the time that there is to see."""
        return self.lengths.whole_s

    @cached_property
    def chosen(self) -> tuple[int, ...]:
        """Clips that edits are about: the selected ones, or else the one that the inspector shows.

        That is the first clip of the track that was selected last.
        """
        return chosen_clips(self.design, self.view)

    def with_playhead(self, view: View) -> "Content":
        """The same with the playhead of ``view``, of which all else is as it is here."""
        found = replace(self, view=view)
        # Nothing of what is known already depends on where the playhead is.
        for name in ("selected", "boxes", "strips", "chosen"):
            if name in self.__dict__:
                found.__dict__[name] = self.__dict__[name]
        return found

    @property
    def place_of_keys(self) -> QPointF:
        """Where the keyboard is: on the clip that was selected last, or else at the playhead."""
        last = self.view.selected_clip
        for box in self.boxes:
            if box.clip.id == last:
                return box.rect.center()
        lane = next((one for one in self.lanes if one.selected), None)
        y = self.ruler_px / 2 if lane is None else lane.top_px + lane.height_px / 2
        return QPointF(self.scale.x(self.view.playhead_s), y)

    @property
    def reach_s(self) -> float:
        """From how far away an edge snaps."""
        return REACH_PX / self.scale.px_per_s

    @property
    def grid_s(self) -> float:
        """Step of the grid that is painted."""
        return grid_step_s(self.scale.px_per_s)

    def box_at(self, at: QPointF) -> Box | None:
        """The uppermost clip at a place; the ruler lies over all."""
        return None if at.y() < self.ruler_px else box_at(self.boxes, at)

    def boxes_at(self, at: QPointF) -> list[Box]:
        """All clips at a place, in the order of their track."""
        return [] if at.y() < self.ruler_px else boxes_at(self.boxes, at)

    def lane_at(self, y_px: float) -> Lane | None:
        """The lane at a height."""
        return None if y_px < self.ruler_px else lane_at(self.lanes, y_px)

    def neighbours_s(self, without: frozenset[int] = frozenset()) -> list[float]:
        """Rising times that edges of the clips ``without`` may come to rest on."""
        found = {0.0, self.view.playhead_s, *(one.time_s for one in self.design.markers)}
        if self.design.loop_s is not None:
            found.update(self.design.loop_s)
        for lane in self.lanes:
            for clip in lane.track.clips:
                if clip.id not in without:
                    found.update((clip.onset_s, clip.onset_s + self.durations_s[clip.id]))
        return sorted(found)


def chosen_clips(design: Design, view: View) -> tuple[int, ...]:
    """Clips that edits are about, see `Content.chosen`."""
    if view.selected_clips or view.selected_input not in design.ids:
        return view.selected_clips
    clip = clip_of(design.input(view.selected_input), view)
    return () if clip is None else (clip.id,)


def ruler_px(line_px: float) -> float:
    """How high the ruler is where a line of text is so high, px."""
    return max(RULER_PX, line_px + 10.0)
