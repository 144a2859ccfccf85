"""Models: frozen dataclasses whose fields have specifications.

They are checked when they are made, and turned into trees for files and the clipboard and back.
"""

import dataclasses
from collections.abc import Callable
from contextlib import suppress
from functools import cached_property, lru_cache
from typing import Any

from skinsource.base.errors import FileFormatError, InvalidInputError, printable, quoted
from skinsource.base.json_text import Tree
from skinsource.specs.spec import Address, Spec, ValidationError

#: Key of the kind of a model in a tree.
KIND = "kind"
_NEWER = "Open it with a newer SkinSource studio."
_DAMAGED = "The content is damaged; go back to an earlier copy."


def field(
    spec: Spec,
    default: Any = dataclasses.MISSING,
    *,
    factory: Callable[[], Any] | None = None,
) -> Any:
    """Return a dataclass field of this specification; without a default it is required.

    A ``factory`` makes the default when it is needed, where it cannot be made with the class.
    """
    if factory is not None:
        return dataclasses.field(default_factory=factory, metadata={"spec": spec})
    return dataclasses.field(default=default, metadata={"spec": spec})


def specs_of(model: Any) -> dict[str, Spec]:
    """Return the specification of each field of a model, or of its class, in order."""
    return dict(_specs(model if isinstance(model, type) else type(model)))


def check(model: Any) -> None:
    """Raise `InvalidInputError` unless every field of ``model`` fits its specification.

    Values are stored in one form (plain ``float``, ``int``, ``bool``), so that equal models compare
    equal and files hold the same values as memory.
    """
    kind: type = type(model)
    for name, spec, default in _specs_and_defaults(kind):
        value = getattr(model, name)
        if value is default:
            continue
        try:
            checked = spec.checked(_with_tuples(value))
        except ValidationError as error:
            raise InvalidInputError(
                f"{kind.__name__}.{name} is {quoted(value)}, expected {error}"
            ) from None
        if checked is not value:
            object.__setattr__(model, name, checked)


def _with_tuples(value: Any, depth: int = 2) -> Any:
    """Return a list, and lists in it, such as points, as tuples."""
    if not isinstance(value, list) or depth == 0:
        return value
    return tuple(_with_tuples(part, depth - 1) for part in value)


def encode(model: Any) -> Tree:
    """Return a model as a tree: its kind, and its fields by name."""
    kind: type = type(model)
    tree = {KIND: kind.__name__}
    for name, spec in _specs(kind):
        value = getattr(model, name)
        if value or not getattr(spec, "left_out_empty", False):
            tree[name] = spec.encoded(value)
    return tree


def decode(tree: Tree, kinds: tuple[type, ...], at: Address) -> Any:
    """Return the model in ``tree``.

    A missing field has its default: an older version wrote the tree, and did not know the field.
    A checksum must have shown before that nothing got lost.

    Raises
    ------
    FileFormatError
        The kind is not known, a field is not known, or a field that every version writes is
        missing.
    """
    if not isinstance(tree, dict) or not isinstance(tree.get(KIND), str):
        raise FileFormatError(f"{at} is {quoted(tree)}, expected a value with its kind. {_DAMAGED}")
    at.check_depth()
    kind = next((kind for kind in kinds if kind.__name__ == tree[KIND]), None)
    if kind is None:
        known = ", ".join(kind.__name__ for kind in kinds)
        raise FileFormatError(
            f"{at} is of kind {quoted(tree[KIND])}, and this studio knows {known}. {_NEWER}"
        )
    specs = dict(_specs(kind))
    unknown = sorted(set(tree) - set(specs) - {KIND})
    if unknown:
        raise FileFormatError(
            f"{at} holds {printable(', '.join(unknown[:10]))}, which this studio does not "
            f"understand. {_NEWER}"
        )
    missing = [name for name in _required(kind) if name not in tree]
    if missing:
        raise FileFormatError(f"{at} lacks {', '.join(missing)}. {_DAMAGED}")
    values = {
        name: spec.decoded(tree[name], at.inside(name))
        for name, spec in specs.items()
        if name in tree
    }
    try:
        return kind(**values)
    except InvalidInputError as error:
        raise FileFormatError(f"{at}: {str(error).rstrip('.')}. {_DAMAGED}") from error


class CheckedModel:
    """A model that checks its fields when it is made, and nothing else."""

    __slots__ = ()

    def __post_init__(self) -> None:
        """Check the fields."""
        check(self)


class Nesting:
    """A model that may hold others of its kind: it counts their levels once."""

    @cached_property
    def _levels(self) -> int:
        """How many levels of models it holds, with its own."""
        return _levels(self)


def nesting(model: Any) -> int:
    """Return how many levels of models a model holds, with its own."""
    return model._levels if isinstance(model, Nesting) else _levels(model)


def _levels(model: Any) -> int:
    kind: type = type(model)
    deepest = 0
    for name, spec in _nesting_specs(kind):
        value = getattr(model, name)
        # Most lists are empty, and hold no models.
        if value != ():
            deepest = max(deepest, spec.depth(value))
    return 1 + deepest


# Specifications of classes are cached: each edit makes a design of a thousand models anew.
_Specs = tuple[tuple[str, Spec], ...]
_MOST_KINDS = 1000


@lru_cache(_MOST_KINDS)
def _specs(kind: type) -> _Specs:
    """Return the specifications of all fields."""
    return tuple(
        (field.name, field.metadata["spec"])
        for field in dataclasses.fields(kind)
        if "spec" in field.metadata
    )


@lru_cache(_MOST_KINDS)
def _nesting_specs(kind: type) -> _Specs:
    """Return the specifications of the fields that may hold models."""
    return tuple((name, spec) for name, spec in _specs(kind) if spec.nests)


@lru_cache(_MOST_KINDS)
def _specs_and_defaults(kind: type) -> tuple[tuple[str, Spec, Any], ...]:
    """Return the specifications of all fields, each with its default if that is valid.

    Such a default needs no further check.  Elsewhere it is `dataclasses.MISSING`, which no model
    holds.
    """
    defaults = {field.name: field.default for field in dataclasses.fields(kind)}
    return tuple((name, spec, _valid_default(spec, defaults[name])) for name, spec in _specs(kind))


def _valid_default(spec: Spec, default: Any) -> Any:
    """Return the default if the check does not change it, else `dataclasses.MISSING`."""
    if default is not dataclasses.MISSING:
        with suppress(ValidationError):
            if spec.checked(default) is default:
                return default
    return dataclasses.MISSING


def _required(kind: type) -> tuple[str, ...]:
    return tuple(
        field.name
        for field in dataclasses.fields(kind)
        if field.default is dataclasses.MISSING
        and field.default_factory is dataclasses.MISSING
        and "spec" in field.metadata
    )
