"""Split, join, trim, stretch and fade clips; insert and remove time on all tracks at once.

A part of a clip is the same waveform through a `Trim`, so that it plays the same samples.  The
`Trim` stands before the fades, which stay at the ends; only a split within a fade cuts the fade.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import LATEST_S, MAX_EFFECTS, ONSET, Clip, numbered
from skinsource.design.design import Design, Input, View
from skinsource.design.edits.clips import (
    SAME_S,
    chosen_clips,
    clips_selected,
    clips_text,
    present_clips,
    short,
    with_clips,
)
from skinsource.design.edits.edit import Edit, Refusal, change_clips, kept_selection, refusing
from skinsource.design.effects.effect import Effect, KeepsTime
from skinsource.design.effects.level import Fade
from skinsource.design.effects.playing import played_s
from skinsource.design.effects.time import Reverse, Stretch, Trim
from skinsource.design.signal_path import Curve
from skinsource.specs.models import specs_of

# Of its course.
_FADE_POINTS = 17
#: Shortest clip that dragging an end can make.
SHORTEST_S = 0.001
_TOO_MANY_EFFECTS = (
    f"A clip has at most {MAX_EFFECTS} effects, and a split adds one; remove one first."
)


@refusing
def split_clips(design: Design, view: View, ids: Iterable[int], at_s: float) -> Edit | Refusal:
    """Cut clips in two at a time of the design, and select the later parts.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.split_clips(design, ss.View(), [1], 0.1)
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.1, 0.0]
    """
    chosen = chosen_clips(design, ids)
    cut = parts_by_id(chosen, at_s)
    if not cut:
        return Refusal(sentence=_why_uncut(chosen, float(at_s)))
    after = with_parts(design, cut)
    known = {clip.id for clip in design.clips}
    later = tuple(clip.id for clip in after.clips if clip.id not in known)
    text = clips_text(design, tuple(clip for clip in chosen if clip.id in cut))
    return Edit(label=f"Split {text}", design=after, view=clips_selected(after, view, later))


def _why_uncut(chosen: Sequence[Clip], at_s: float) -> str:
    """Say why none of the clips can be cut at a time."""
    whose, which = ("The", "it") if len(chosen) == 1 else ("A", "one of them")
    reason = f"None of the selected clips plays at {at_s:.6g} s"
    for verb, attribute in (("begins", "onset_s"), ("ends", "end_s")):
        if any(abs(getattr(clip, attribute) - at_s) <= SAME_S for clip in chosen):
            reason = f"{whose} selected clip {verb} at {at_s:.6g} s: there is nothing to split"
    return f"{reason}; put the playhead inside {which}."


@refusing
def join_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Join parts of one clip again where they follow each other.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> split = ss.edits.split_clips(design, ss.View(), [1], 0.1).design
    >>> ids = [clip.id for clip in split.inputs[0].clips]
    >>> edit = ss.edits.join_clips(split, ss.View(), ids)
    >>> print(len(edit.design.inputs[0].clips))
    1
    """
    chosen_ids = {clip.id for clip in chosen_clips(design, ids)}
    joined: list[int] = []

    def clips_of(track: Input) -> list[Clip]:
        clips = {clip.id: clip for clip in track.clips}
        in_time = sorted((c for c in track.clips if c.id in chosen_ids), key=lambda c: c.onset_s)
        for right in in_time:
            for left in [clips[c.id] for c in in_time if c.id in clips and c.id != right.id]:
                joined_clip = _join(left, clips[right.id])
                if joined_clip is not None:
                    del clips[right.id]
                    clips[left.id] = joined_clip
                    joined.append(left.id)
                    break
        return list(clips.values())

    after = with_clips(design, clips_of)
    if not joined:
        return Refusal(
            sentence="None of the selected clips continues another one; select parts that follow "
            "each other."
        )
    remaining = {clip.id for clip in after.clips}
    left_over = tuple(clip_id for clip_id in view.selected_clips if clip_id in remaining)
    return Edit(
        label="Join clips",
        design=after,
        view=clips_selected(after, view, left_over or tuple(dict.fromkeys(joined))),
    )


@refusing
def trim_clip(design: Design, view: View, id: int, start_s: float, end_s: float) -> Edit | Refusal:
    """Trim a clip to begin and end at times of the design, within what it plays.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.trim_clip(design, ss.View(), 1, 0.05, 0.15)
    >>> print(round(edit.design.clips[0].end_s, 3))
    0.15
    """
    clip = _one_clip(design, id)
    before, fades = _without_fades(clip.effects)
    old = before[-1] if before and isinstance(before[-1], Trim) and before[-1].on else None
    inner = before if old is None else before[:-1]
    whole_s = played_s(clip.waveform, inner)
    lead_s = 0.0 if old is None else old.start_s
    origin_s = clip.onset_s - lead_s
    shortest_s = min(SHORTEST_S, whole_s)
    start_s = min(max(start_s, origin_s, 0.0), origin_s + whole_s - shortest_s)
    end_s = min(max(end_s, start_s + shortest_s), origin_s + whole_s)
    left_out_s, length_s = short(max(start_s - origin_s, 0.0)), short(end_s - start_s)
    trim: tuple[Effect, ...] = ()
    if left_out_s > SAME_S or length_s < whole_s - SAME_S:
        trim = (Trim(start_s=left_out_s, duration_s=length_s),)
    changes = {"onset_s": short(max(start_s, 0.0)), "effects": (*inner, *trim, *fades)}
    return _with_clip(design, view, "Trim", clip, changes)


@refusing
def stretch_clip(
    design: Design, view: View, id: int, start_s: float, end_s: float
) -> Edit | Refusal:
    """Stretch a clip in time so that it begins and ends at times of the design.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.stretch_clip(design, ss.View(), 1, 0.0, 0.4)
    >>> print(edit.design.clips[0].end_s)
    0.4
    """
    clip = _one_clip(design, id)
    if clip.duration_s == 0.0:
        return Refusal(sentence="This clip cannot be stretched; change its duration instead.")
    start_s = max(start_s, 0.0)
    factor = max(end_s - start_s, SHORTEST_S) / clip.duration_s
    inner, fades = _without_fades(clip.effects)
    old = Stretch()
    if inner and isinstance(inner[-1], Stretch) and inner[-1].on:
        old, inner = inner[-1], inner[:-1]
        factor *= old.factor_of(played_s(clip.waveform, inner))
    spec: Any = specs_of(Stretch)["factor"]
    allowed = min(max(short(factor), spec.minimum), spec.maximum)
    changed = replace(old, factor=allowed, to_s=0.0)
    stretch = () if abs(factor - 1.0) < SAME_S else (changed,)
    effects = (*inner, *stretch, *fades)
    from_end_s = max(end_s - played_s(clip.waveform, effects), 0.0)
    if abs(start_s - clip.onset_s) > SAME_S and abs(from_end_s - start_s) > SAME_S:
        # The factor is at its limit: when the start was dragged, the end has to stay.
        start_s = from_end_s
    changes = {"onset_s": short(start_s), "effects": effects}
    return _with_clip(design, view, "Stretch", clip, changes)


@refusing
def fade_clip(design: Design, view: View, id: int, in_s: float, out_s: float) -> Edit | Refusal:
    """Set how long a clip fades in and out; 0: it does not.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.fade_clip(design, ss.View(), 1, 0.01, 0.05)
    >>> print(edit.design.clips[0].effects)
    (Fade(in_s=0.01, out_s=0.05, shape='smooth', on=True),)
    """
    clip = _one_clip(design, id)
    in_s = short(min(max(in_s, 0.0), clip.duration_s))
    out_s = short(min(max(out_s, 0.0), max(clip.duration_s - in_s, 0.0)))
    effects: list[Any] = list(clip.effects)
    ends = faded_ends(clip)
    at = next((end.at for end in ends if end and not end.behind_trim), len(effects))
    for name, length_s, end in zip(("in_s", "out_s"), (in_s, out_s), ends, strict=True):
        if end is not None:
            if length_s != end.length_s:
                to_s = short(length_s + end.cut_s) if length_s else 0.0
                effects[end.at] = replace(effects[end.at], **{name: to_s})
        elif length_s:
            old = effects[at : at + 1] or [Fade(in_s=0.0, out_s=0.0)]
            effects[at : at + 1] = [replace(old[0], **{name: length_s})]
    left = tuple(each for each in effects if not isinstance(each, Fade) or each.in_s or each.out_s)
    return _with_clip(design, view, "Fade", clip, {"effects": left})


def _one_clip(design: Design, id: int) -> Clip:
    """Return the clip with this id."""
    chosen = present_clips(design, (id,))
    if not chosen:
        raise InvalidInputError("That clip is no longer there; choose another one.")
    return chosen[0]


@dataclass(frozen=True, slots=True)
class FadedEnd:
    """What fades an end of a clip.

    Attributes
    ----------
    fade, at
        The effect, and which one of the clip it is.
    length_s, cut_s
        How long the clip fades there, and how much of the fade a split cut off before that.
    behind_trim
        Whether a `Trim` behind the fade cuts the clip.
    """

    fade: Fade
    at: int
    length_s: float
    cut_s: float
    behind_trim: bool

    def course(self, *, fades_out: bool) -> tuple[Floats, Floats]:
        """Return times since its end of the clip, s, and the levels there, some of each."""
        inside_s = np.linspace(0.0, self.length_s, _FADE_POINTS)
        whole_s = self.fade.out_s if fades_out else self.fade.in_s
        fade = replace(self.fade, in_s=whole_s, out_s=0.0)
        return inside_s, fade.values_at(self.cut_s + inside_s, 2 * whole_s)


def faded_ends(clip: Clip) -> tuple[FadedEnd | None, FadedEnd | None]:
    """Return the last fade of the start and of the end, unless time is moved behind it."""
    ends: list[FadedEnd | None] = [None, None]
    cut_s, trimmed = [0.0, 0.0], False
    for at, effect in reversed(list(enumerate(clip.effects))):
        if not effect.on:
            continue
        if isinstance(effect, Fade):
            for side, whole_s in enumerate((effect.in_s, effect.out_s)):
                if ends[side] is None and whole_s > cut_s[side] + SAME_S:
                    length_s = min(short(whole_s - cut_s[side]), clip.duration_s)
                    ends[side] = FadedEnd(effect, at, length_s, cut_s[side], trimmed)
        elif isinstance(effect, Trim):
            before_s = played_s(clip.waveform, clip.effects[:at])
            cut_s[0] += effect.start_s
            cut_s[1] += max(round(before_s - effect.start_s - effect.duration_s, 12), 0.0)
            trimmed = True
        elif isinstance(effect, Reverse) or not isinstance(effect, KeepsTime):
            break
    return ends[0], ends[1]


def parts_by_id(clips: Sequence[Clip], at_s: float) -> dict[int, tuple[Clip, Clip]]:
    """Return the two parts of each clip that plays at a time, see `parts_of`."""
    try:
        parts_of_clip = {clip.id: parts_of(clip, at_s) for clip in clips}
    except InvalidInputError as error:
        reason = str(error)
        if at_s > ONSET.maximum:
            reason = (
                f"A clip plays at {at_s:.6g} s, and none can begin after {ONSET.maximum:g} s; cut "
                "it before that."
            )
        elif any(len(clip.effects) == MAX_EFFECTS for clip in clips):
            reason = _TOO_MANY_EFFECTS
        raise InvalidInputError(reason) from error
    return {id: parts for id, parts in parts_of_clip.items() if parts is not None}


def parts_of(clip: Clip, at_s: float) -> tuple[Clip, Clip] | None:
    """Cut a clip in two at a time; None where it does not play then.

    Raises
    ------
    InvalidInputError
        The clip has the most effects already, or the later part would begin too late.
    """
    length_s, own_s = clip.duration_s, at_s - clip.onset_s
    if not SAME_S < own_s < length_s - SAME_S:
        return None
    own_s, rest_s = short(own_s), short(length_s - own_s)
    kept, fades = _without_fades(clip.effects)
    if any(fade.in_s > own_s or fade.out_s > rest_s for fade in fades):
        kept, fades = clip.effects, ()
    *inner, last = kept or (None,)
    if not isinstance(last, Trim) or not last.on:
        inner, last = list(kept), Trim(duration_s=length_s)
    first = replace(last, duration_s=own_s)
    second = replace(last, start_s=short(last.start_s + own_s), duration_s=rest_s)
    ins = (replace(fade, out_s=0.0) for fade in fades if fade.in_s)
    outs = (replace(fade, in_s=0.0) for fade in fades if fade.out_s)
    return (
        replace(clip, effects=(*inner, first, *ins)),
        replace(clip, onset_s=short(at_s), effects=(*inner, second, *outs), id=0),
    )


def with_parts(design: Design, cut: dict[int, tuple[Clip, Clip]]) -> Design:
    """Return the design with clips replaced by pairs; the later of each pair gets a new id."""
    known = [clip.id for clip in design.clips]
    ids = iter(numbered([*known, *(0 for _ in cut)], "clips")[len(known) :])

    def clips_of(track: Input) -> list[Clip]:
        clips: list[Clip] = []
        for clip in track.clips:
            first, *rest = cut.get(clip.id, (clip,))
            clips += [first, *(replace(part, id=next(ids)) for part in rest)]
        return clips

    return with_clips(design, clips_of)


def _join(left: Clip, right: Clip) -> Clip | None:
    """Return the clip of which these are parts that follow each other; None: they are not."""
    kept, ins = _without_fades(left.effects)
    others, outs = _without_fades(right.effects)
    if not kept or not others:
        return None
    (*inner, first), (*others_inner, second) = kept, others
    if not (isinstance(first, Trim) and isinstance(second, Trim) and first.on and second.on):
        return None
    same_content = (left.waveform, left.gain, left.muted, inner) == (
        right.waveform,
        right.gain,
        right.muted,
        others_inner,
    )
    follows = abs(left.end_s - right.onset_s) < SAME_S
    goes_on = abs(first.start_s + first.duration_s - second.start_s) < SAME_S
    # A fade that is longer than its part is shortened with it.
    outside = any(fade.out_s or fade.in_s > first.duration_s for fade in ins) or any(
        fade.in_s or fade.out_s > second.duration_s for fade in outs
    )
    if outside or not (same_content and follows and goes_on):
        return None
    whole_s = played_s(left.waveform, tuple(inner))
    length_s = short(second.start_s + second.duration_s - first.start_s)
    trim: tuple[Effect, ...] = ()
    if first.start_s > SAME_S or length_s < whole_s - SAME_S:
        trim = (replace(first, duration_s=length_s),)
    joined = [replace(fade, out_s=out.out_s) for fade, out in zip(ins, outs, strict=False)]
    if [(fade.shape, fade.on) for fade in ins] != [(fade.shape, fade.on) for fade in outs]:
        joined = [*ins, *outs]
    return replace(left, effects=(*inner, *trim, *joined))


def _without_fades(effects: tuple[Effect, ...]) -> tuple[tuple[Effect, ...], tuple[Any, ...]]:
    """Split effects into those before the fades at the end, and those fades."""
    count = len(effects)
    while count and isinstance(effects[count - 1], Fade):
        count -= 1
    return effects[:count], effects[count:]


def _with_clip(design: Design, view: View, verb: str, clip: Clip, changes: dict[str, Any]) -> Edit:
    after = change_clips(design, {clip.id: changes})
    return Edit(label=f"{verb} {clips_text(design, (clip,))}", design=after, view=view)


_NO_TIME_RANGE = Refusal(sentence="Choose a time range: a start, and an end after it.")


@refusing
def insert_time(design: Design, view: View, at_s: float, length_s: float) -> Edit | Refusal:
    """Move everything from a time on later; clips that play then are cut in two.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.insert_time(design, ss.View(), 0.0, 0.1)
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.1, 0.1]
    """
    if not _is_stretch(at_s, at_s + length_s):
        return _NO_TIME_RANGE
    return _shifted(design, view, "Insert time", at_s, at_s, length_s)


@refusing
def remove_time(design: Design, view: View, start_s: float, end_s: float) -> Edit | Refusal:
    """Remove a stretch of time: what plays in it is cut away, and the rest moves earlier.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.remove_time(design, ss.View(), 0.05, 0.1)
    >>> print(edit.label)
    Remove time
    """
    if not _is_stretch(start_s, end_s):
        return _NO_TIME_RANGE
    return _shifted(design, view, "Remove time", start_s, end_s, start_s - end_s)


def _shifted(
    design: Design, view: View, label: str, start_s: float, end_s: float, by_s: float
) -> Edit | Refusal:
    """Remove what begins in between, and move what begins at ``end_s`` or later by ``by_s``."""
    cut = _cut(_cut(design, end_s), start_s)

    def shift(time_s: float) -> float | None:
        if time_s < start_s - SAME_S:
            return time_s
        return None if time_s < end_s - SAME_S else short(max(time_s + by_s, 0.0))

    def clips_of(track: Input) -> list[Clip]:
        onsets_s = [(clip, shift(clip.onset_s)) for clip in track.clips]
        return [
            clip if onset_s == clip.onset_s else replace(clip, onset_s=onset_s)
            for clip, onset_s in onsets_s
            if onset_s is not None
        ]

    shifted = with_clips(cut, clips_of)
    markers = tuple(
        replace(marker, time_s=min(time_s, LATEST_S))
        for marker in design.markers
        if (time_s := shift(marker.time_s)) is not None
    )
    after = replace(
        shifted,
        inputs=tuple(_with_shifted_curve(track, start_s, end_s, by_s) for track in shifted.inputs),
        markers=markers,
        loop_s=_shifted_loop(design.loop_s, start_s, end_s, by_s),
    )
    return Edit(label=label, design=after, view=kept_selection(view, design, after))


def _cut(design: Design, at_s: float) -> Design:
    cut = parts_by_id(design.clips, at_s)
    return with_parts(design, cut) if cut else design


def _with_shifted_curve(track: Input, start_s: float, end_s: float, by_s: float) -> Input:
    curve = _shifted_curve(track.gain_curve, start_s, end_s, by_s)
    return track if curve == track.gain_curve else replace(track, gain_curve=curve)


def _shifted_loop(
    loop_s: tuple[float, float] | None, start_s: float, end_s: float, by_s: float
) -> tuple[float, float] | None:
    if loop_s is None:
        return None
    # An end of the loop in between moves to its start.
    low, high = (
        time_s if time_s < start_s else start_s if time_s < end_s else short(time_s + by_s)
        for time_s in loop_s
    )
    return (low, min(high, LATEST_S)) if low < high <= LATEST_S else None


def _shifted_curve(curve: Curve, start_s: float, end_s: float, by_s: float) -> Curve:
    """Return the curve with the same gain at what remains, and a step where time was removed.

    Inserted time has the gain before it.
    """
    if not curve or curve[-1][0] <= start_s:
        return curve
    times_s, gains = np.array(curve).T
    # Of two points at one time the first one ends the segment before, the last one begins the next.
    at_start = next((y for x, y in curve if x == start_s), None)
    ending = float(np.interp(start_s, times_s, gains)) if at_start is None else at_start
    following = float(np.interp(end_s, times_s, gains))
    before = [point for point in curve if point[0] < start_s]
    # Rounding could pass the time of the cut.
    after_s = max(short(end_s + by_s), start_s)
    following_points = [(max(short(x + by_s), after_s), y) for x, y in curve if x > end_s]
    edges = [(start_s, ending), (after_s, ending), (after_s, following)]
    # Equal points in a row are one point.
    points = [point for point, _ in groupby([*before, *edges, *following_points])]
    return tuple((min(x, LATEST_S), y) for x, y in points)


def _is_stretch(start_s: float, end_s: float) -> bool:
    return 0.0 <= start_s < end_s <= LATEST_S
