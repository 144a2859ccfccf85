"""Which inputs and clips are selected, and which after an edit."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.clips import Clip
from skinsource.design import Design, Input
from skinsource.edits.edit import Edit
from skinsource.view import View


def select_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select inputs, the last of them the one that stands apart."""
    there = dict.fromkeys(one for one in ids if one in design.ids)
    on_them = {clip.id for one in design.inputs if one.id in there for clip in one.clips}
    clips = tuple(one for one in view.selected_clips if one in on_them)
    return Edit(
        label="Select inputs",
        design=design,
        view=replace(view, selected_inputs=tuple(there), selected_clips=clips),
    )


def select_all_inputs(design: Design, view: View) -> Edit:
    """Select every input; the one that stood apart still does."""
    last = () if view.selected_input is None else (view.selected_input,)
    others = (one for one in design.ids if one not in last)
    return select_inputs(design, view, (*others, *last))


def toggle_selected(design: Design, view: View, id: int) -> Edit:
    """Add an input to the selected ones, or take it out."""
    left = tuple(one for one in view.selected_inputs if one != id)
    return select_inputs(design, view, left if id in view.selected_inputs else (*left, id))


def select_through(design: Design, view: View, start: int | None, end: int) -> Edit:
    """Select all inputs from ``start`` to ``end`` as they are listed; ``end`` stands apart."""
    if end not in design.ids:
        return select_inputs(design, view, view.selected_inputs)
    if start not in design.ids:
        return select_inputs(design, view, (end,))
    first, last = design.index_of(start), design.index_of(end)
    between = design.ids[min(first, last) : max(first, last) + 1]
    return select_inputs(design, view, between if first <= last else between[::-1])


def clips_of(one: Input, view: View) -> tuple[Clip, ...]:
    """Clips of an input that edits of it are about: the selected ones, or else its first."""
    return tuple(clip for clip in one.clips if clip.id in view.selected_clips) or one.clips[:1]


def clip_of(one: Input, view: View) -> Clip | None:
    """The one of them that stands apart: selected last; None where there is no clip."""
    order = {id: place for place, id in enumerate(view.selected_clips)}
    return max(clips_of(one, view), key=lambda clip: order.get(clip.id, 0), default=None)


def kept_selection(view: View, before: Design, after: Design) -> View:
    """Return ``view`` with those selected inputs and clips that ``after`` still has.

    Where no input is left, the neighbour of the one that stood apart is selected: the next that is
    still there, or else the one before.
    """
    clip_ids = {one.id for one in after.clips} if view.selected_clips else set()
    if not clip_ids.issuperset(view.selected_clips):
        left = tuple(one for one in view.selected_clips if one in clip_ids)
        view = replace(view, selected_clips=left)
    there = set(after.ids)
    if there.issuperset(view.selected_inputs):
        return view
    left = tuple(one for one in view.selected_inputs if one in there)
    if not left and view.selected_input in before.ids:
        place = before.index_of(view.selected_input)
        following = [one for one in before.ids[place:] if one in there]
        preceding = [one for one in before.ids[:place] if one in there]
        left = tuple([*preceding[-1:], *following[:1]][-1:])
    return replace(view, selected_inputs=left)
