"""The order in which inputs are listed; no number depends on it, but for rounding."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.design import Design
from skinsource.edits.edit import NOTHING_CHOSEN, Edit, Refusal, inputs_words, present
from skinsource.view import View


def put_inputs_before(design: Design, view: View, ids: Iterable[int], index: int) -> Edit | Refusal:
    """List inputs together, before the one that is ``index``-th now; the number of all: last."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    before = [one for one in design.inputs[: max(index, 0)] if one not in chosen]
    after = [one for one in design.inputs[max(index, 0) :] if one not in chosen]
    return Edit(
        label=f"Reorder {inputs_words(chosen, design.limb)}",
        design=replace(design, inputs=(*before, *chosen, *after)),
        view=view,
    )


def shift_inputs(design: Design, view: View, ids: Iterable[int], down: bool) -> Edit | Refusal:
    """List each input one place further up or down, as far as there is room."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    order = list(design.inputs[::-1] if down else design.inputs)
    for place in range(1, len(order)):
        if order[place] in chosen and order[place - 1] not in chosen:
            order[place - 1], order[place] = order[place], order[place - 1]
    return Edit(
        label=f"Reorder {inputs_words(chosen, design.limb)}",
        design=replace(design, inputs=tuple(order[::-1] if down else order)),
        view=view,
    )
