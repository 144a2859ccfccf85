"""Which inputs are selected, and which after an edit."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.design import Design
from skinsource.edits.edit import Edit
from skinsource.view import View


def select_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select inputs, the last of them the one that stands apart."""
    there = dict.fromkeys(one for one in ids if one in design.ids)
    return Edit(
        label="Select inputs", design=design, view=replace(view, selected_inputs=tuple(there))
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


def kept_selection(view: View, before: Design, after: Design) -> View:
    """Return ``view`` with those selected inputs that ``after`` still has.

    Where none is left, the neighbour of the one that stood apart is selected: the next that is
    still there, or else the one before.
    """
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
