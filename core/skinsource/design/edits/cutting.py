"""Parts of clips: split, join, trim, stretch, fade.

A recipe cannot be cut, but what it plays can: a part is the same recipe through a `Trim`, and plays
the same samples.  Trims made by dragging an end stand before the fades, which stay at the ends.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np

from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import LATEST_S, MAX_EFFECTS, ONSET, Clip, Marker, numbered
from skinsource.design.design import MAX_CLIPS, Design, Input
from skinsource.design.edits.clips import (
    NO_CLIP,
    NO_TIME,
    clips_selected,
    clips_text,
    present_clips,
    replace_clips,
    short,
)
from skinsource.design.edits.edit import (
    Edit,
    Refusal,
    kept_selection,
    refused,
    why_uncut,
    with_clips,
)
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.level import Fade
from skinsource.design.effects.playing import played_s
from skinsource.design.effects.time import Stretch, Trim
from skinsource.design.signal_path import Curve
from skinsource.design.view import View
from skinsource.specs.models import specs_of

#: Times that differ by less are the same.
SAME_S = 1e-9
#: What a drag of an end leaves at least.
SHORTEST_S = 0.001
_FULL = (
    f"A clip has at most {MAX_EFFECTS} effects, and cut in two it needs one more; remove one first."
)
_GONE = Refusal(sentence="That clip is no longer there; choose another one.")


def split_clips(design: Design, view: View, ids: Iterable[int], at_s: float) -> Edit | Refusal:
    """Cut clips in two at a time of the design, and select the later parts."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    if not _is_time(at_s):
        return NO_TIME
    cut = parts_by_id(chosen, at_s)
    if isinstance(cut, Refusal):
        return cut
    if not cut:
        return Refusal(sentence=why_uncut(chosen, at_s, SAME_S))
    after = with_parts(design, cut)
    if isinstance(after, Refusal):
        return after
    known = {clip.id for clip in design.clips}
    later = tuple(clip.id for clip in after.clips if clip.id not in known)
    text = clips_text(design, tuple(clip for clip in chosen if clip.id in cut))
    return Edit(label=f"Split {text}", design=after, view=clips_selected(after, view, later))


def join_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Put parts of one clip together again where they follow each other."""
    chosen_ids = {clip.id for clip in present_clips(design, ids)}
    if not chosen_ids:
        return NO_CLIP
    inputs, joined = [], []
    for track in design.inputs:
        clips = {clip.id: clip for clip in track.clips}
        in_time = sorted((c for c in track.clips if c.id in chosen_ids), key=lambda c: c.onset_s)
        for right in in_time:
            for left in [clips[c.id] for c in in_time if c.id in clips and c.id != right.id]:
                joined_clip = _joined(left, clips[right.id])
                if joined_clip is not None:
                    del clips[right.id]
                    clips[left.id] = joined_clip
                    joined.append(left.id)
                    break
        inputs.append(replace_clips(track, list(clips.values())))
    if not joined:
        return Refusal(
            sentence="None of the selected clips goes on where another one of them ends; select "
            "parts that follow each other."
        )
    after = replace(design, inputs=tuple(inputs))
    remaining = {clip.id for clip in after.clips}
    left_over = tuple(clip_id for clip_id in view.selected_clips if clip_id in remaining)
    return Edit(
        label="Join clips",
        design=after,
        view=clips_selected(after, view, left_over or tuple(dict.fromkeys(joined))),
    )


def trim_clip(design: Design, view: View, id: int, start_s: float, end_s: float) -> Edit | Refusal:
    """Let a clip begin and end at times of the design, as far as it plays anything there."""
    clip = _one_clip(design, id, start_s, end_s)
    if isinstance(clip, Refusal):
        return clip
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
    return _changed(design, view, "Trim", clip, changes)


def stretch_clip(
    design: Design, view: View, id: int, start_s: float, end_s: float
) -> Edit | Refusal:
    """Let a clip play faster or slower, so that it begins and ends at times of the design."""
    clip = _one_clip(design, id, start_s, end_s)
    if isinstance(clip, Refusal):
        return clip
    if clip.duration_s == 0.0:
        return Refusal(sentence="This clip cannot be stretched; change its duration instead.")
    start_s = max(start_s, 0.0)
    factor = max(end_s - start_s, SHORTEST_S) / clip.duration_s
    inner, fades = _without_fades(clip.effects)
    old = Stretch()
    if inner and isinstance(inner[-1], Stretch) and inner[-1].on:
        old, inner = inner[-1], inner[:-1]
        factor *= old.factor_of(played_s(clip.waveform, inner))
    try:
        changed = replace(old, factor=_nearest(factor), to_s=0.0)
    except InvalidInputError as error:
        return refused(error)
    stretch = () if abs(factor - 1.0) < SAME_S else (changed,)
    effects = (*inner, *stretch, *fades)
    from_end_s = max(end_s - played_s(clip.waveform, effects), 0.0)
    if abs(start_s - clip.onset_s) > SAME_S and abs(from_end_s - start_s) > SAME_S:
        # The factor goes no farther: the end stays, whose start was moved.
        start_s = from_end_s
    changes = {"onset_s": short(start_s), "effects": effects}
    return _changed(design, view, "Stretch", clip, changes)


def fade_clip(design: Design, view: View, id: int, in_s: float, out_s: float) -> Edit | Refusal:
    """Let a clip fade in and out within some times; 0 for neither."""
    clip = _one_clip(design, id, in_s, out_s)
    if isinstance(clip, Refusal):
        return clip
    in_s = short(min(max(in_s, 0.0), clip.duration_s))
    out_s = short(min(max(out_s, 0.0), clip.duration_s - in_s))
    effects: list[Any] = list(clip.effects)
    last = effects[-1] if effects and isinstance(effects[-1], Fade) and effects[-1].on else None
    try:
        if last is not None:
            effects[-1:] = [replace(last, in_s=in_s, out_s=out_s)] if in_s or out_s else []
        elif in_s or out_s:
            effects.append(Fade(in_s=in_s, out_s=out_s))
    except InvalidInputError as error:
        return refused(error)
    return _changed(design, view, "Fade", clip, {"effects": tuple(effects)})


def _one_clip(design: Design, id: int, *times_s: float) -> Clip | Refusal:
    """The clip that is to be changed to these times; or why that cannot be."""
    chosen = present_clips(design, (id,))
    if not chosen:
        return _GONE
    return chosen[0] if all(_is_time(time_s) for time_s in times_s) else NO_TIME


def fades_of(clip: Clip) -> tuple[float, float]:
    """How long a clip takes to fade in and out by what `fade_clip` did to it, s."""
    last = clip.effects[-1] if clip.effects else None
    if not isinstance(last, Fade) or not last.on:
        return (0.0, 0.0)
    return (last.in_s, last.out_s)


def parts_by_id(clips: Sequence[Clip], at_s: float) -> dict[int, tuple[Clip, Clip]] | Refusal:
    """Parts of those clips that play at a time, see `parts_of`."""
    try:
        found = {clip.id: parts_of(clip, at_s) for clip in clips}
    except InvalidInputError as error:
        if at_s > ONSET.maximum:
            return Refusal(
                sentence=f"A clip plays at {at_s:.6g} s, and none can begin after "
                f"{ONSET.maximum:g} s; cut it before that."
            )
        return Refusal(sentence=_FULL) if _any_is_full(clips) else refused(error)
    return {id: parts for id, parts in found.items() if parts is not None}


def parts_of(clip: Clip, at_s: float) -> tuple[Clip, Clip] | None:
    """What a clip plays before a time and from it on; None where it does not play then.

    Raises
    ------
    InvalidInputError
        It has no room for another effect, or the later part would begin too late.
    """
    length_s, own_s = clip.duration_s, at_s - clip.onset_s
    if not SAME_S < own_s < length_s - SAME_S:
        return None
    *inner, last = clip.effects or (None,)
    if not isinstance(last, Trim) or not last.on:
        inner, last = list(clip.effects), Trim(duration_s=length_s)
    first = replace(last, duration_s=short(own_s))
    second = replace(last, start_s=short(last.start_s + own_s), duration_s=short(length_s - own_s))
    return (
        replace(clip, effects=(*inner, first)),
        replace(clip, onset_s=short(at_s), effects=(*inner, second), id=0),
    )


def with_parts(design: Design, cut: dict[int, tuple[Clip, Clip]]) -> Design | Refusal:
    """The design with pairs in place of clips; the later of each pair has a new id."""
    known = [clip.id for clip in design.clips]
    ids = iter(numbered([*known, *(0 for _ in cut)], "clips")[len(known) :])
    if any(_count_after(track, cut) > MAX_CLIPS for track in design.inputs):
        return Refusal(sentence=f"A track holds at most {MAX_CLIPS} clips.")
    inputs = []
    for track in design.inputs:
        clips: list[Clip] = []
        for clip in track.clips:
            first, *rest = cut.get(clip.id, (clip,))
            clips += [first, *(replace(part, id=next(ids)) for part in rest)]
        inputs.append(replace_clips(track, clips))
    try:
        return replace(design, inputs=tuple(inputs))
    except InvalidInputError as error:
        return refused(error)


def _any_is_full(clips: Sequence[Clip]) -> bool:
    return any(len(clip.effects) == MAX_EFFECTS for clip in clips)


def _count_after(track: Input, cut: dict[int, tuple[Clip, Clip]]) -> int:
    return len(track.clips) + sum(clip.id in cut for clip in track.clips)


def _joined(left: Clip, right: Clip) -> Clip | None:
    """The clip of which these are parts, the second right after the first; None: they are not."""
    if not left.effects or not right.effects:
        return None
    (*inner, first), (*others, second) = left.effects, right.effects
    if not (isinstance(first, Trim) and isinstance(second, Trim) and first.on and second.on):
        return None
    same_content = (left.waveform, left.gain, left.muted, inner) == (
        right.waveform,
        right.gain,
        right.muted,
        others,
    )
    follows = abs(left.end_s - right.onset_s) < SAME_S
    goes_on = abs(first.start_s + first.duration_s - second.start_s) < SAME_S
    if not (same_content and follows and goes_on):
        return None
    whole_s = played_s(left.waveform, tuple(inner))
    length_s = short(second.start_s + second.duration_s - first.start_s)
    trim: tuple[Effect, ...] = ()
    if first.start_s > SAME_S or length_s < whole_s - SAME_S:
        trim = (replace(first, duration_s=length_s),)
    return replace(left, effects=(*inner, *trim))


def _without_fades(effects: tuple[Effect, ...]) -> tuple[tuple[Effect, ...], tuple[Effect, ...]]:
    """The effects up to the fades at the end of the chain, and those fades."""
    count = len(effects)
    while count and isinstance(effects[count - 1], Fade):
        count -= 1
    return effects[:count], effects[count:]


def _nearest(factor: float) -> float:
    spec: Any = specs_of(Stretch)["factor"]
    return min(max(short(factor), spec.minimum), spec.maximum)


def _changed(
    design: Design, view: View, verb: str, clip: Clip, changes: dict[str, Any]
) -> Edit | Refusal:
    try:
        after = with_clips(design, {clip.id: changes})
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"{verb} {clips_text(design, (clip,))}", design=after, view=view)


def _is_time(value: Any) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and abs(value) < 1e9


# Inserting and removing time on all tracks at once.

_NO_TIME = Refusal(sentence="Choose a stretch of time: a start, and an end after it.")


def insert_time(design: Design, view: View, at_s: float, length_s: float) -> Edit | Refusal:
    """Let everything from a time on come later; clips that play then are cut in two."""
    are_numbers = _is_number(at_s) and _is_number(length_s)
    if not are_numbers or not _is_stretch(at_s, at_s + length_s):
        return _NO_TIME
    return _shifted(design, view, "Insert time", at_s, at_s, length_s)


def remove_time(design: Design, view: View, start_s: float, end_s: float) -> Edit | Refusal:
    """Take a stretch of time out: what plays then is cut away, what comes later comes earlier."""
    if not _is_stretch(start_s, end_s):
        return _NO_TIME
    return _shifted(design, view, "Remove time", start_s, end_s, start_s - end_s)


def _shifted(
    design: Design, view: View, label: str, start_s: float, end_s: float, by_s: float
) -> Edit | Refusal:
    """What begins in between goes; what begins at ``end_s`` or later moves by ``by_s``."""
    cut = _cut(_cut(design, end_s), start_s)
    if isinstance(cut, Refusal):
        return cut

    def later(time_s: float) -> float | None:
        if time_s < start_s - SAME_S:
            return time_s
        return None if time_s < end_s - SAME_S else short(max(time_s + by_s, 0.0))

    try:
        after = replace(
            cut,
            inputs=tuple(_moved(track, later, start_s, end_s, by_s) for track in cut.inputs),
            markers=_markers(design.markers, later),
            loop_s=_loop(design.loop_s, start_s, end_s, by_s),
        )
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=label, design=after, view=kept_selection(view, design, after))


def _cut(design: Design | Refusal, at_s: float) -> Design | Refusal:
    if isinstance(design, Refusal):
        return design
    cut = parts_by_id(design.clips, at_s)
    if isinstance(cut, Refusal):
        return cut
    return with_parts(design, cut) if cut else design


def _moved(
    track: Input, later: Callable[[float], float | None], start_s: float, end_s: float, by_s: float
) -> Input:
    clips: list[Clip] = []
    for clip in track.clips:
        onset_s = later(clip.onset_s)
        if onset_s is not None:
            clips.append(clip if onset_s == clip.onset_s else replace(clip, onset_s=onset_s))
    after = replace_clips(track, clips)
    curve = _curve(track.gain_curve, start_s, end_s, by_s)
    return after if curve == track.gain_curve else replace(after, gain_curve=curve)


def _markers(
    markers: tuple[Marker, ...], later: Callable[[float], float | None]
) -> tuple[Marker, ...]:
    times_s = [later(marker.time_s) for marker in markers]
    return tuple(
        replace(marker, time_s=min(time_s, LATEST_S))
        for marker, time_s in zip(markers, times_s, strict=True)
        if time_s is not None
    )


def _loop(
    loop_s: tuple[float, float] | None, start_s: float, end_s: float, by_s: float
) -> tuple[float, float] | None:
    if loop_s is None:
        return None
    # What lies in between shrinks to its start.
    low, high = (
        time_s if time_s < start_s else start_s if time_s < end_s else short(time_s + by_s)
        for time_s in loop_s
    )
    return (low, min(high, LATEST_S)) if low < high <= LATEST_S else None


def _curve(curve: Curve, start_s: float, end_s: float, by_s: float) -> Curve:
    """The curve with the same gain at what is left; a step where time was taken out.

    Time that comes in has the gain before it.
    """
    if not curve or curve[-1][0] <= start_s:
        return curve
    times_s, gains = np.array(curve).T
    # Where two points lie at one time, the first one ends what is before, the last begins what
    # follows.
    at_start = next((y for x, y in curve if x == start_s), None)
    ending = float(np.interp(start_s, times_s, gains)) if at_start is None else at_start
    following = float(np.interp(end_s, times_s, gains))
    before = [point for point in curve if point[0] < start_s]
    following_points = [(short(x + by_s), y) for x, y in curve if x > end_s]
    after_s = short(end_s + by_s)
    edges = [(start_s, ending), (after_s, ending), (after_s, following)]
    # Of points that are all the same one is enough.
    points = [point for point, _ in groupby([*before, *edges, *following_points])]
    return tuple((min(x, LATEST_S), y) for x, y in points)


def _is_number(value: Any) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and abs(value) <= LATEST_S


def _is_stretch(start_s: Any, end_s: Any) -> bool:
    return _is_number(start_s) and _is_number(end_s) and 0.0 <= start_s < end_s
