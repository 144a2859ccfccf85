"""What the timeline shows: lanes, clips and gain curves in pixels, and which part of the time."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt

from skinsource.base.conventions import SAMPLE_RATE_HZ, Floats
from skinsource.base.decibels import decibels
from skinsource.design.clips import Clip, Marker
from skinsource.design.design import MAX_INPUTS, Design, Input, View
from skinsource.design.display_units import value_text
from skinsource.design.edits.cutting import FadedEnd, faded_ends
from skinsource.design.edits.edit import Edit, clips_of, leading_clip
from skinsource.design.effects.breakpoints import Points, curve_at
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource_gui.plots.ranges import number_text
from skinsource_gui.plots.time_scale import Range, TimeScale, grid_step_s
from skinsource_gui.qt.keys import MOUSE, key_text
from skinsource_gui.qt.layouts import tooltip

#: Free space above and below a clip, px.
MARGIN_PX = 3.0
#: No clip is painted narrower, so that it can be seen and clicked.
NARROWEST_PX = 3.0
#: Distance outside a clip within which its ends can be dragged, px.
REACH_PX = 4.0
# Distance at which the pointer catches a marker or an end of the loop, px.
_CATCH_PX = 6.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """The strip of one track.

    Attributes
    ----------
    top_px, height_px
        Where the lane lies.
    silent
        Why the track is silent, or "".
    problem
        Why the track cannot be played, or "".
    """

    track: Input
    top_px: float
    height_px: float
    silent: str
    selected: bool
    problem: str = ""

    @property
    def bottom_px(self) -> float:
        """Return where the next lane begins, px."""
        return self.top_px + self.height_px


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """The place of a clip on its lane, what fades its ends, and how far that reaches, px."""

    clip: Clip
    lane: Lane
    rect: QRectF
    ends: tuple[FadedEnd | None, FadedEnd | None] = (None, None)
    fades_px: tuple[float, float] = (0.0, 0.0)


Curve = tuple[tuple[float, float], ...]

#: Distance within which the pointer catches a point, and the line, px.
POINT_PX, LINE_PX = 8.0, 5.0
# A lane has room for gains up to this, and for a little more than the largest one.
_LEAST_TOP, _ROOM = 2.0, 1.15
_MARGIN_PX = 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GainStrip:
    """A gain curve on its lane.

    Attributes
    ----------
    top
        The gain at the upper edge of the lane.
    shown
        Whether the curve is edited; else it is a thin line.
    """

    lane: Lane
    scale: TimeScale
    top: float
    shown: bool

    @property
    def points(self) -> Points:
        """The breakpoints of the curve."""
        return points_of(self.lane.track.gain_curve)

    @property
    def height_px(self) -> float:
        """Height from a gain of 0 up to the largest one, px."""
        return max(self.lane.height_px - 2 * _MARGIN_PX, 1.0)

    def at(self, time_s: float, gain: float) -> QPointF:
        """Return the place of a gain at a time, px."""
        return QPointF(self.scale.x(time_s), self.y(gain))

    def y(self, gain: float) -> float:
        """Return the height of a gain, px."""
        return self.lane.bottom_px - _MARGIN_PX - gain / self.top * self.height_px

    def gain_at(self, time_s: float) -> float:
        """Return the gain at a time."""
        points = self.points or ((0.0, 1.0, "straight"),)
        return float(curve_at(points, np.array([time_s]))[0])

    def point_at(self, at: QPointF) -> int | None:
        """Return the number of the point within reach of the pointer."""
        away = [
            (max(abs(place.x() - at.x()), abs(place.y() - at.y())), k)
            for k, place in enumerate(self.at(x, y) for x, y, _ in self.points)
        ]
        nearest = min(away, default=None)
        return None if nearest is None or nearest[0] > POINT_PX else nearest[1]

    def is_on_line(self, at: QPointF) -> bool:
        """Return whether the curve passes here."""
        return abs(self.y(self.gain_at(self.scale.time(at.x()))) - at.y()) <= LINE_PX

    def points_around(self, time_s: float) -> tuple[int, ...]:
        """Return the numbers of the points around a time; beyond the ends of the last one."""
        points = self.points
        before = sum(x <= time_s for x, _, _ in points)
        return tuple(k for k in (before - 1, before) if 0 <= k < len(points))


def points_of(curve: Curve) -> Points:
    """Return a gain curve as breakpoints."""
    return tuple((x, y, "straight") for x, y in curve)


def curve_of(points: Points) -> Curve:
    """Return breakpoints as a gain curve, rounded so that its numbers are short."""
    return tuple((round(x, 9), round(y, 6)) for x, y, _ in points)


def top_gain_of(curve: Curve) -> float:
    """Return the largest gain for which the lane has room."""
    return max(_LEAST_TOP, _ROOM * max((y for _, y in curve), default=0.0))


def gain_point_text(time_s: float, gain: float) -> str:
    """Return the text of a point: ``"120 ms · × 0.5 · −6.0 dB"``."""
    level = f"{number_text(float(decibels(np.array([gain]))[0]), 1)} dB" if gain > 0.0 else "silent"
    return f"{value_text(time_s, 's', digits=5)} · × {gain:.4g} · {level}"


#: The timeline shows so much time behind the last clip, and at least so much in all.
AFTER_S, LEAST_S = 0.4, 0.5
# Fitted clips end a little before the right edge.
_FIT = 1.02


class ClipLengths:
    """Lengths of the clips of a design.

    Attributes
    ----------
    durations_s
        Length of each clip, by its id.
    end_s
        End of the last clip.
    whole_s
        From 0 to a little behind the last clip.
    """

    def __init__(self, design: Design) -> None:
        self.design = design
        self.durations_s = {clip.id: clip.duration_s for clip in design.clips}
        ends = [clip.onset_s + self.durations_s[clip.id] for clip in design.clips]
        self.end_s = max(ends, default=0.0)
        self.whole_s: Range = (0.0, max(self.end_s + AFTER_S, LEAST_S))

    @property
    def content_s(self) -> Range:
        """The time that the clips take; the last one does not touch the edge."""
        return (0.0, _FIT * self.end_s) if self.end_s else self.whole_s

    def of(self, design: Design) -> "ClipLengths":
        """Return the lengths for a design."""
        return self if design is self.design else ClipLengths(design)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DrawnClip:
    """What a clip plays with the gain curve of its track.

    Attributes
    ----------
    played
        What it plays without the curve, (n_times,).
    depends_on
        The curve, and the onset, which says where on the curve it lies.
    samples
        What is drawn, (n_times,).
    peak
        The largest of them.
    """

    played: Floats
    depends_on: object
    samples: Floats
    peak: float

    @classmethod
    def of(cls, track: Input, clip: Clip, played: Floats, sample_rate_hz: float) -> "DrawnClip":
        """Return what is drawn of a clip."""
        samples = played
        if track.gain_curve:
            times_s = clip.onset_s + np.arange(played.size) / sample_rate_hz
            samples = played * curve_at(points_of(track.gain_curve), times_s)
        peak = float(max(samples.max(initial=0.0), -samples.min(initial=0.0)))
        return cls(played=played, depends_on=_on_curve(track, clip), samples=samples, peak=peak)


def _on_curve(track: Input, clip: Clip) -> object:
    return track.gain_curve and (track.gain_curve, clip.onset_s)


def drawn_clips(
    design: Design,
    waveforms: Mapping[int, Floats],
    sample_rate_hz: float,
    before: Mapping[int, DrawnClip],
) -> dict[int, DrawnClip]:
    """Return what is drawn of each clip, by its id; what is the same as before stays."""
    drawn = {}
    for track in design.inputs:
        for clip in track.clips:
            played, known = waveforms.get(clip.id), before.get(clip.id)
            if played is None:
                continue
            if (
                known is None
                or known.played is not played
                or known.depends_on != _on_curve(track, clip)
            ):
                known = DrawnClip.of(track, clip, played, sample_rate_hz)
            drawn[clip.id] = known
    return drawn


def loudest_of(design: Design, drawn: Mapping[int, DrawnClip]) -> float:
    """Return the largest value that any clip plays on its track."""
    return max(
        (
            abs(clip.gain * track.amplitude) * drawn[clip.id].peak
            for track in design.inputs
            for clip in track.clips
            if clip.id in drawn
        ),
        default=0.0,
    )


# Shorter overlaps are rounding errors of clips that follow each other, s.
_LEAST_S = 1e-9


def overlaps_of(spans_s: Iterable[Range]) -> list[Range]:
    """Return the stretches of time that two of these spans or more share, in order, s."""
    overlaps: list[Range] = []
    last_s = float("-inf")
    for start_s, end_s in sorted(spans_s):
        shared_s = min(last_s, end_s)
        if shared_s - start_s > _LEAST_S:
            if overlaps and start_s <= overlaps[-1][1]:
                start_s, before_s = overlaps.pop()
                shared_s = max(before_s, shared_s)
            overlaps.append((start_s, shared_s))
        last_s = max(last_s, end_s)
    return overlaps


def next_id(ids: Sequence[int], current: int | None) -> int | None:
    """Return the id after this one, the first after the last; None where there is no other."""
    if len(ids) < 2:
        return None
    return ids[(ids.index(current) + 1) % len(ids)] if current in ids else ids[0]


def overlapping(track: Input, clip: Clip) -> tuple[int, ...]:
    """Return the ids of one clip of a track, and of those that play at the same time."""
    return tuple(
        other.id
        for other in sorted(track.clips, key=lambda each: (each.onset_s, each.id))
        if min(other.end_s, clip.end_s) - max(other.onset_s, clip.onset_s) > _LEAST_S
        or other is clip
    )


def clip_name(clip: Clip) -> str:
    """Return the label of a clip, or the name of its file, or of what it plays."""
    return clip.label or getattr(clip.waveform, "name", "") or clip.waveform.title


def clip_text(clip: Clip) -> str:
    """Return the text of a clip in a list: ``"Tone · 120 ms"``."""
    return f"{clip_name(clip)} · {value_text(clip.onset_s, 's', digits=5)}"


#: Height of the ruler for text of the usual size, px.
RULER_PX = 24.0


@dataclass(frozen=True, kw_only=True, eq=False)
class TimelineContent:
    """What the timeline shows, and where; a new one is made at each change.

    Attributes
    ----------
    lanes
        Lanes from top to bottom, also those out of sight.
    height_px
        Where the lowest visible lane ends.
    waveforms, sample_rate_hz
        What clips play, (n_times,) each, by their ids, as far as it is known, and its rate.
    drawn, loudest
        What is drawn of them, and the largest value of all tracks, which takes the full height.
    awaited
        Ids of the clips whose waveform is being computed.
    gain_tops
        The largest gain on a lane, by the id of its track, while a drag lasts.
    chosen_point
        Id of a track and number of a point on its gain curve, or None.
    """

    design: Design
    view: View
    lengths: ClipLengths
    lanes: tuple[Lane, ...] = ()
    scale: TimeScale = field(default_factory=lambda: TimeScale(shown_s=(0.0, LEAST_S)))
    height_px: float = 0.0
    waveforms: Mapping[int, Floats] = field(default_factory=dict)
    drawn: Mapping[int, DrawnClip] = field(default_factory=dict)
    loudest: float = 0.0
    awaited: frozenset[int] = frozenset()
    snaps: bool = True
    ruler_px: float = RULER_PX
    sample_rate_hz: float = SAMPLE_RATE_HZ
    gain_tops: Mapping[int, float] = field(default_factory=dict)
    chosen_point: tuple[int, int] | None = None

    @cached_property
    def selected(self) -> frozenset[int]:
        """Ids of the selected clips."""
        return frozenset(self.view.selected_clips)

    @cached_property
    def gain_shown(self) -> frozenset[int]:
        """Ids of the tracks whose gain curve is edited."""
        return shown_gain_curves(self.view)

    @cached_property
    def boxes(self) -> list[Box]:
        """Visible clips in painting order: the selected ones lie on top."""
        boxes = [box for lane in self.lanes for box in self.boxes_on(lane)]
        return sorted(boxes, key=lambda box: box.clip.id in self.selected)

    @cached_property
    def strips(self) -> list[GainStrip]:
        """Gain curves that are painted: those that are edited, and those that are not flat."""
        return [
            GainStrip(
                lane=lane,
                scale=self.scale,
                top=self.gain_tops.get(lane.track.id) or top_gain_of(lane.track.gain_curve),
                shown=lane.track.id in self.gain_shown,
            )
            for lane in self.lanes
            if lane.track.gain_curve or lane.track.id in self.gain_shown
        ]

    def unplayable_on(self, lane: Lane) -> frozenset[int]:
        """Return the ids of the clips that keep a lane from being played."""
        if not lane.problem:
            return frozenset()
        sounding = [clip.id for clip in lane.track.clips if not clip.muted]
        known = self.waveforms.keys() | self.awaited
        return frozenset([clip_id for clip_id in sounding if clip_id not in known] or sounding)

    def boxes_on(self, lane: Lane) -> list[Box]:
        """Return the visible clips of a lane, in painting order."""
        if lane.bottom_px <= self.ruler_px or lane.top_px >= self.height_px:
            return []
        boxes, scale = [], self.scale
        top, height = lane.top_px + MARGIN_PX, lane.height_px - 2 * MARGIN_PX
        for clip in lane.track.clips:
            left = scale.x(clip.onset_s)
            width = max(self.lengths.durations_s[clip.id] * scale.px_per_s, NARROWEST_PX)
            if scale.left_px - width < left < scale.left_px + scale.width_px:
                rect = QRectF(left, top, width, height)
                ends = faded_ends(clip)
                in_px = ends[0].length_s * scale.px_per_s if ends[0] else 0.0
                out_px = ends[1].length_s * scale.px_per_s if ends[1] else 0.0
                fades_px = (in_px, out_px)
                boxes.append(Box(clip=clip, lane=lane, rect=rect, ends=ends, fades_px=fades_px))
        return sorted(boxes, key=lambda box: box.clip.id in self.selected)

    def overlaps_on(self, lane: Lane) -> list[Range]:
        """Return the stretches of time in which clips of a lane overlap, s."""
        clips = lane.track.clips
        return overlaps_of((clip.onset_s, self._end_s(clip)) for clip in clips)

    def _end_s(self, clip: Clip) -> float:
        return clip.onset_s + self.lengths.durations_s[clip.id]

    @cached_property
    def chosen(self) -> tuple[int, ...]:
        """Clips that the clip panel edits: of each selected track the selected ones, or its first.

        The last is the one that it shows.
        """
        design, view = self.design, self.view
        tracks = (track for track in design.inputs if track.id in view.selected_inputs)
        clips = (clip.id for track in tracks for clip in clips_of(track, view))
        chosen = list(dict.fromkeys((*view.selected_clips, *clips)))
        last = leading_clip(design, view) if len(chosen) > 1 else None
        if last is not None and last.id in chosen:
            chosen.remove(last.id)
            chosen.append(last.id)
        return tuple(chosen)

    @property
    def keyboard_place(self) -> QPointF:
        """Place that keys refer to: the clip that was selected last, or else the playhead."""
        last = self.view.selected_clip
        for box in self.boxes:
            if box.clip.id == last:
                return box.rect.center()
        lane = next((lane for lane in self.lanes if lane.selected), None)
        y = self.ruler_px / 2 if lane is None else lane.top_px + lane.height_px / 2
        return QPointF(self.scale.x(self.view.playhead_s), y)

    @property
    def grid_s(self) -> float:
        """Step of the grid that is painted, s."""
        return grid_step_s(self.scale.px_per_s)

    def box_at(self, at: QPointF) -> Box | None:
        """Return the uppermost clip at a place, or else one of which an end is within reach."""
        if at.y() < self.ruler_px:
            return None
        for reach in (0.0, REACH_PX):
            for box in reversed(self.boxes):
                if box.rect.adjusted(-reach, 0, reach, 0).contains(at):
                    return box
        return None

    def boxes_at(self, at: QPointF) -> list[Box]:
        """Return all clips at a place, in the order in which their track lists them."""
        if at.y() < self.ruler_px:
            return []
        boxes = [box for box in self.boxes if box.rect.contains(at)]
        return sorted(boxes, key=lambda box: box.lane.track.clips.index(box.clip))

    def lane_at(self, y_px: float) -> Lane | None:
        """Return the lane at a height."""
        if y_px < self.ruler_px:
            return None
        return next((lane for lane in self.lanes if lane.top_px <= y_px < lane.bottom_px), None)

    def marker_at(self, at: QPointF) -> Marker | None:
        """Return the marker whose flag is here."""
        distances = (
            (abs(self.scale.x(marker.time_s) - at.x()), index)
            for index, marker in enumerate(self.design.markers)
        )
        nearest = min(distances, default=None)
        if nearest is None or nearest[0] > _CATCH_PX or at.y() > self.ruler_px / 2:
            return None
        return self.design.markers[nearest[1]]

    def other_loop_end_at(self, at: QPointF) -> float | None:
        """Return the other end of the loop region, if one end is here, s."""
        start_s, end_s = self.design.loop_s or (0.0, 0.0)
        for here, other in ((start_s, end_s), (end_s, start_s)):
            if here != other and abs(self.scale.x(here) - at.x()) <= _CATCH_PX:
                return other
        return None

    def neighbours_s(self, without: frozenset[int] = frozenset()) -> list[float]:
        """Return the times to which edges of clips snap, in order, but for clips ``without``."""
        times_s = {0.0, self.view.playhead_s, *(marker.time_s for marker in self.design.markers)}
        if self.design.loop_s is not None:
            times_s.update(self.design.loop_s)
        for lane in self.lanes:
            for clip in lane.track.clips:
                if clip.id not in without:
                    times_s.update((clip.onset_s, self._end_s(clip)))
        return sorted(times_s)


def ruler_px(line_px: float) -> float:
    """Return the height of the ruler for lines of text of this height, px."""
    return max(RULER_PX, line_px + 10.0)


#: Name of the panel, under which a view keeps its settings.
TIMELINE = "timeline"
GAIN_CURVES = ListSpec(
    label="Gain curves",
    of=NumberSpec(label="Id of an input", minimum=1, maximum=2**31 - 1, whole=True),
    most=MAX_INPUTS,
    different=True,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TimelineSettings(fields.CheckedModel):
    """Settings of the timeline: ``gain_curves``, ids of the tracks whose gain curve is shown."""

    gain_curves: tuple[int, ...] = fields.field(GAIN_CURVES, ())


def shown_gain_curves(view: View) -> frozenset[int]:
    """Return the ids of the tracks whose gain curve is shown for editing."""
    return frozenset(settings_of(view, TIMELINE, TimelineSettings).gain_curves)


def show_gain_curves(view: View, ids: Iterable[int]) -> View:
    """Return the view in which these tracks, and no others, show their gain curve."""
    settings = settings_of(view, TIMELINE, TimelineSettings)
    shown = replace(settings, gain_curves=tuple(sorted(set(ids))))
    return with_settings(view, TIMELINE, shown)


def toggle_gain_curves(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Show the gain curves of tracks; if all of them are shown, hide them."""
    toggled, shown = set(ids) & set(design.ids), shown_gain_curves(view) & set(design.ids)
    after = shown - toggled if toggled <= shown else shown | toggled
    return Edit(label="Show gain curves", design=design, view=show_gain_curves(view, after))


_EDGE_PX, _CORNER_PX = 6.0, 11.0
# The inside of a narrower clip only moves it; its ends are dragged from outside.
_NARROW_PX = 26.0


class Part(Enum):
    """Part of a clip; each is dragged for another purpose."""

    BODY = "body"
    START = "start"
    END = "end"
    FADE_IN = "fade in"
    FADE_OUT = "fade out"


CURSORS = {
    Part.BODY: Qt.CursorShape.OpenHandCursor,
    Part.START: Qt.CursorShape.SizeHorCursor,
    Part.END: Qt.CursorShape.SizeHorCursor,
    Part.FADE_IN: Qt.CursorShape.SizeFDiagCursor,
    Part.FADE_OUT: Qt.CursorShape.SizeBDiagCursor,
}


def part_at(rect: QRectF, at: QPointF, fades_px: tuple[float, float] = (0.0, 0.0)) -> Part:
    """Return the part of a clip painted in ``rect`` that lies at ``at``.

    Fades are dragged where they end, ``fades_px`` from the ends of the clip.
    """
    from_start, from_end = at.x() - rect.left(), rect.right() - at.x()
    if from_start < 0 or from_end < 0:
        return Part.START if from_start < 0 else Part.END
    if rect.width() < _NARROW_PX:
        return Part.BODY
    if at.y() - rect.top() < _CORNER_PX:
        for part, away, reach in (
            (Part.FADE_IN, from_start, fades_px[0]),
            (Part.FADE_OUT, from_end, fades_px[1]),
        ):
            if max(reach - _CORNER_PX / 2, 0.0) <= away < reach + _CORNER_PX:
                return part
    if from_start < _EDGE_PX:
        return Part.START
    return Part.END if from_end < _EDGE_PX else Part.BODY


_NEXT = key_text("timeline", "below")
_END = ("trim", "stretch")
_CORNER = ("fade",)
_GESTURES = {
    Part.START: _END,
    Part.END: _END,
    Part.FADE_IN: _CORNER,
    Part.FADE_OUT: _CORNER,
}


def timeline_tooltip(content: TimelineContent, at: QPointF) -> str:
    """Return why a clip cannot be played, what can be dragged, and how many clips are here."""
    box = content.box_at(at)
    if box is None:
        return ""
    count = len(content.boxes_at(at))
    several = f"{count} clips here: click again, or {_NEXT}, for the next" if count > 1 else ""
    names = _GESTURES.get(part_at(box.rect, at, box.fades_px), ())
    return tooltip(box.lane.problem, several, *MOUSE["clips"].sentences(*names))
