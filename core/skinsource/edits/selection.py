"""Which inputs are selected after an edit."""

from dataclasses import replace

from skinsource.design import Design
from skinsource.view import View


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
