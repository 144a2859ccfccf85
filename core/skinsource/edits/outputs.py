"""Which outputs are looked at closely."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.view import View


def select_outputs(design: Design, view: View, outputs: Iterable[int]) -> Edit | Refusal:
    """Select outputs, in this order; none are allowed."""
    chosen = tuple(outputs)
    try:
        after = replace(view, outputs=chosen)
    except InvalidInputError as error:
        return refused(error)
    if len(chosen) == 1:
        return Edit(label=f"Select output {chosen[0]}", design=design, view=after)
    return Edit(label=f"Select {len(chosen) or 'no'} outputs", design=design, view=after)
