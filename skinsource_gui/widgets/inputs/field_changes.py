"""A field of several inputs, typed or dragged."""

from typing import Any

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View


class FieldChanges:
    """Makes edits of one field of several inputs: typing sets all, a drag moves all by as much.

    It remembers the design that a drag started from.
    """

    def __init__(self) -> None:
        self._gesture: int | None = None
        self._start: Design | None = None

    def change(
        self,
        design: Design,
        view: View,
        ids: tuple[int, ...],
        name: str,
        value: Any,
        *,
        lead: int,
        gesture: int | None,
    ) -> Edit | Refusal:
        """Give field ``name`` of input ``lead`` this value; the others of ``ids`` go with it."""
        if gesture is None or len(ids) == 1:
            return edits.change_field(design, view, ids, name, value)
        if gesture != self._gesture or self._start is None:
            self._gesture, self._start = gesture, design
        return edits.drag_field(design, view, ids, name, value, lead=lead, start=self._start)
