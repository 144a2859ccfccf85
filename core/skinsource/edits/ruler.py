"""What stands on the ruler: markers, the loop; and the gain curve of a track, which lies below."""

from dataclasses import replace
from typing import Any

from skinsource.clips import Marker
from skinsource.design import MAX_MARKERS, Design
from skinsource.edits.edit import Edit, Refusal, changed, refused
from skinsource.errors import InvalidInputError
from skinsource.view import View

_GONE = Refusal(sentence="That marker is no longer there.")


def add_marker(design: Design, view: View, time_s: float, name: str = "") -> Edit | Refusal:
    """Set a marker at a time."""
    if len(design.markers) >= MAX_MARKERS:
        return Refusal(sentence=f"A design holds at most {MAX_MARKERS} markers; remove one first.")
    try:
        new = Marker(time_s=time_s, name=name)
    except InvalidInputError as error:
        return refused(error)
    after = replace(design, markers=(*design.markers, new))
    return Edit(label="Add marker", design=after, view=view)


def move_marker(design: Design, view: View, index: int, time_s: float) -> Edit | Refusal:
    """Put a marker, the ``index``-th of the design, at another time."""
    return _changed(design, view, "Move marker", index, time_s=time_s)


def rename_marker(design: Design, view: View, index: int, name: str) -> Edit | Refusal:
    """Give a marker another name."""
    return _changed(design, view, "Rename marker", index, name=name)


def remove_marker(design: Design, view: View, index: int) -> Edit | Refusal:
    """Take a marker away."""
    if index not in range(len(design.markers)):
        return _GONE
    markers = (*design.markers[:index], *design.markers[index + 1 :])
    return Edit(label="Remove marker", design=replace(design, markers=markers), view=view)


def set_loop(design: Design, view: View, loop_s: tuple[float, float] | None) -> Edit | Refusal:
    """Choose what is played again and again, begin and end; None: nothing is."""
    try:
        after = replace(design, loop_s=loop_s)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label="Remove loop" if loop_s is None else "Set loop", design=after, view=view)


def set_gain_curve(
    design: Design, view: View, id: int, points: tuple[tuple[float, float], ...]
) -> Edit | Refusal:
    """Give a track a gain curve, breakpoints of s and factor; none: it changes nothing."""
    return changed(design, view, "Change gain curve of", {id: {"gain_curve": points}})


def _changed(design: Design, view: View, label: str, index: int, **changes: Any) -> Edit | Refusal:
    if index not in range(len(design.markers)):
        return _GONE
    try:
        moved = replace(design.markers[index], **changes)
    except InvalidInputError as error:
        return refused(error)
    markers = (*design.markers[:index], moved, *design.markers[index + 1 :])
    return Edit(label=label, design=replace(design, markers=markers), view=view)
