"""Numbers and choices of inputs and of what they play."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from skinsource.design import AMPLITUDE, ONSET, Design, Input
from skinsource.edits.edit import NOTHING_CHOSEN, Edit, Refusal, changed, present, refused
from skinsource.edits.kinds import as_kind, nearest
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec, Spec, specs_of
from skinsource.quoting import quoted
from skinsource.view import View
from skinsource.waveforms import Waveform, kinds

_OWN = frozenset({"amplitude", "onset_s"})


def change_kind(design: Design, view: View, ids: Iterable[int], kind: str) -> Edit | Refusal:
    """Let inputs play another kind of waveform, with what both kinds share."""
    wanted = next((one for one in kinds() if one.__name__ == kind), None)
    if wanted is None:
        known = ", ".join(one.__name__ for one in kinds())
        return Refusal(sentence=f"No waveform is called {quoted(kind)}; there are {known}.")
    changes = {one.id: {"waveform": as_kind(one.waveform, wanted)} for one in present(design, ids)}
    return changed(design, view, "Change waveform of", changes)


def change_waveform(
    design: Design, view: View, ids: Iterable[int], waveform: Waveform
) -> Edit | Refusal:
    """Let inputs play a waveform."""
    changes = {one.id: {"waveform": waveform} for one in present(design, ids)}
    return changed(design, view, "Change waveform of", changes)


def change_field(
    design: Design, view: View, ids: Iterable[int], name: str, value: Any
) -> Edit | Refusal:
    """Set a number or a choice of inputs, or of what they play, to one value.

    Inputs whose waveform has no field of this name are left as they are.
    """
    chosen = [one for one in present(design, ids) if name in fields_of(one)]
    if not chosen:
        return NOTHING_CHOSEN
    try:
        changes = {one.id: _setting(one, name, value) for one in chosen}
    except InvalidInputError as error:
        return refused(error)
    return changed(design, view, f"Change {_label(chosen[0], name)} of", changes)


def drag_field(
    design: Design,
    view: View,
    ids: Iterable[int],
    name: str,
    value: float,
    *,
    lead: int | None,
    start: Design,
) -> Edit | Refusal:
    """Set a number of the input ``lead``; the others move as far from where they were.

    They move by the same step, or by the same factor where the number is logarithmic, and stay
    within what is allowed.  ``start`` is the design as the drag began: the way back leads to it.
    """
    ids = tuple(ids)
    chosen = [one for one in present(design, ids) if name in fields_of(one)]
    dragged = next((one for one in chosen if one.id == lead), None)
    if dragged is None or not isinstance(fields_of(dragged)[name], NumberSpec):
        return change_field(design, view, ids, name, value)
    began = {one.id: one for one in start.inputs if name in fields_of(one)}
    origin = value_of(began.get(dragged.id, dragged), name)
    try:
        fields_of(dragged)[name].checked(value)
        changes = {dragged.id: _setting(dragged, name, value)}
        for one in chosen:
            spec = fields_of(one)[name]
            if one is not dragged and isinstance(spec, NumberSpec):
                moved = _moved(value_of(began.get(one.id, one), name), origin, value, spec)
                changes[one.id] = _setting(one, name, moved)
    except InvalidInputError as error:
        return refused(error)
    return changed(design, view, f"Change {_label(dragged, name)} of", changes)


def _moved(own: float, origin: float, value: float, spec: NumberSpec) -> float:
    """``own`` moved as ``origin`` was to become ``value``."""
    by_factor = spec.logarithmic and min(own, origin, value) > 0
    moved = own * (value / origin) if by_factor else own + (value - origin)
    # Sums of decimal steps shall be short to read.
    return nearest(float(f"{moved:.12g}"), spec)


def fields_of(one: Input) -> dict[str, Spec]:
    """What of an input can be set: its amplitude and onset, and the fields of what it plays."""
    return {"amplitude": AMPLITUDE, "onset_s": ONSET} | specs_of(one.waveform)


def value_of(one: Input, name: str) -> Any:
    """Value of one of `fields_of`."""
    return getattr(one if name in _OWN else one.waveform, name)


def _label(one: Input, name: str) -> str:
    return fields_of(one)[name].label.lower()


def _setting(one: Input, name: str, value: Any) -> dict[str, Any]:
    """Changes that give the field of an input its value."""
    if name in _OWN:
        return {name: value}
    waveform: Any = one.waveform
    return {"waveform": replace(waveform, **{name: value})}
