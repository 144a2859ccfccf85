"""Inserting and removing time on all tracks at once."""

from collections.abc import Callable
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np

from skinsource.chain import Curve
from skinsource.clips import Clip, Marker
from skinsource.clips.marker import LATEST_S
from skinsource.design import Design, Input
from skinsource.edits.clips import replace_clips, short
from skinsource.edits.cutting import SAME_S, parts_by_id, with_parts
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.edits.selection import kept_selection
from skinsource.errors import InvalidInputError
from skinsource.view import View

_NO_TIME = Refusal(sentence="Choose a stretch of time: a start, and an end after it.")


def insert_time(design: Design, view: View, at_s: float, length_s: float) -> Edit | Refusal:
    """Let everything from a time on come later; clips that play then are cut in two."""
    both = _is_number(at_s) and _is_number(length_s)
    if not both or not _is_stretch(at_s, at_s + length_s):
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
            inputs=tuple(_moved(one, later, start_s, end_s, by_s) for one in cut.inputs),
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
    one: Input, later: Callable[[float], float | None], start_s: float, end_s: float, by_s: float
) -> Input:
    clips: list[Clip] = []
    for clip in one.clips:
        onset_s = later(clip.onset_s)
        if onset_s is not None:
            clips.append(clip if onset_s == clip.onset_s else replace(clip, onset_s=onset_s))
    after = replace_clips(one, clips)
    curve = _curve(one.gain_curve, start_s, end_s, by_s)
    return after if curve == one.gain_curve else replace(after, gain_curve=curve)


def _markers(
    markers: tuple[Marker, ...], later: Callable[[float], float | None]
) -> tuple[Marker, ...]:
    times_s = [later(one.time_s) for one in markers]
    return tuple(
        replace(one, time_s=min(time_s, LATEST_S))
        for one, time_s in zip(markers, times_s, strict=True)
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
    behind = [(short(x + by_s), y) for x, y in curve if x > end_s]
    after_s = short(end_s + by_s)
    edges = [(start_s, ending), (after_s, ending), (after_s, following)]
    # Of points that are all the same one is enough.
    points = [point for point, _ in groupby([*before, *edges, *behind])]
    return tuple((min(x, LATEST_S), y) for x, y in points)


def _is_number(value: Any) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and abs(value) <= LATEST_S


def _is_stretch(start_s: Any, end_s: Any) -> bool:
    return _is_number(start_s) and _is_number(end_s) and 0.0 <= start_s < end_s
