"""Recipes in lists within recipes: what a new part may be, how parts are called and put in order.

A clip is a part of layers, an effect one of a clip.  All functions are pure; what they return goes
into a design by `skinsource.edits.change_field`, as any value of a field does.
"""

from typing import Any

from skinsource.clips import Clip
from skinsource.edits.effects import fitted
from skinsource.edits.kinds import KindSpec
from skinsource.effects import effect_kinds
from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, ListSpec, RecipeSpec, Spec, specs_of
from skinsource.quoting import quoted
from skinsource.waveforms import kinds as waveform_kinds

Parts = tuple[Any, ...]


def choices_of(spec: RecipeSpec) -> ChoiceSpec:
    """What can be chosen for a recipe: its kinds, by name and title.

    Where there is one kind alone, it is what that holds which is chosen: of a clip the waveform.
    """
    found = _chosen(spec)
    options = tuple((kind.__name__, _title(kind)) for kind in found)
    made = KindSpec if set(found) <= set(waveform_kinds()) else ChoiceSpec
    return made(label=spec.label, hint=spec.hint, options=options)


def new_part(spec: RecipeSpec, name: str, holder: Any = None) -> Any:
    """A new recipe of `choices_of` ``spec``; an effect fits the clip that is to hold it.

    Raises
    ------
    InvalidInputError
        Nothing that can be chosen is called so.
    """
    kinds, chosen = spec.kinds(), _chosen(spec)
    kind = next((one for one in chosen if one.__name__ == name), None)
    if kind is None:
        known = ", ".join(one.__name__ for one in chosen)
        raise InvalidInputError(f"{spec.label} is {quoted(name)}, expected one of {known}")
    held = _held(kinds[0])
    if kind not in kinds and held is not None:
        return kinds[0](**{held[0]: kind()})
    if kind in effect_kinds() and isinstance(holder, Clip):
        return fitted(kind, holder)
    return kind()


def part_words(part: Any) -> str:
    """What a part is called: the user's label, or the title of its kind or of what it holds."""
    held = _held(type(part))
    inside = _title(type(getattr(part, held[0]))) if held else ""
    words = getattr(part, "label", "") or inside or _title(type(part))
    off = getattr(part, "muted", False) or not getattr(part, "on", True)
    return f"{words} (off)" if off else words


def without_part(parts: Parts, index: int) -> Parts:
    """The parts without one."""
    return (*parts[:index], *parts[index + 1 :])


def moved_part(parts: Parts, index: int, to: int) -> Parts:
    """The parts, where one stands at another place, from 0; as far as there is room."""
    rest = list(parts)
    moved = rest.pop(index)
    rest.insert(min(max(to, 0), len(rest)), moved)
    return tuple(rest)


def with_part(parts: Parts, index: int, part: Any) -> Parts:
    """The parts with another one in place of one."""
    return (*parts[:index], part, *parts[index + 1 :])


def changing_words(spec: Spec, before: Any, after: Any) -> str:
    """What is done to a field, for the history: "Change onset of", "Add to parts of"."""
    label = spec.label.lower()
    if isinstance(spec, ListSpec) and spec.nests:
        more = len(after) - len(before)
        if more:
            return f"{'Add to' if more > 0 else 'Remove from'} {label} of"
        if before != after and all(before.count(one) == after.count(one) for one in after):
            return f"Reorder {label} of"
    return f"Change {label} of"


def _chosen(spec: RecipeSpec) -> tuple[type, ...]:
    kinds = spec.kinds()
    held = _held(kinds[0]) if len(kinds) == 1 else None
    return kinds if held is None else held[1].kinds()


def _held(kind: type) -> tuple[str, RecipeSpec] | None:
    """The first field of a recipe that holds another one, if any does."""
    pairs = specs_of(kind).items()
    return next(((name, spec) for name, spec in pairs if isinstance(spec, RecipeSpec)), None)


def _title(kind: type) -> str:
    return str(getattr(kind, "title", kind.__name__))
