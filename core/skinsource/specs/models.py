"""Recipes: frozen dataclasses that describe each of their fields."""

import dataclasses
from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache
from typing import Any

from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.base.json_text import Tree
from skinsource.base.quoting import printable, quoted
from skinsource.specs.spec import Address, Spec, ValidationError

#: Name in a tree under which a recipe says what it is.
KIND = "kind"
_NEWER = "Open it with a newer SkinSource studio."
_DAMAGED = "The content is damaged; go back to an earlier copy."


def field(
    spec: Spec,
    default: Any = dataclasses.MISSING,
    *,
    factory: Callable[[], Any] | None = None,
) -> Any:
    """Make a dataclass field that is described by ``spec``; without a default it must be given.

    A ``factory`` makes the default when it is needed, where it cannot be made with the class.
    """
    if factory is not None:
        return dataclasses.field(default_factory=factory, metadata={"spec": spec})
    return dataclasses.field(default=default, metadata={"spec": spec})


def specs_of(recipe: Any) -> dict[str, Spec]:
    """Return the specification of each field of a recipe, or of its class, in order."""
    return dict(_specs(recipe if isinstance(recipe, type) else type(recipe)))


def check(recipe: Any) -> None:
    """Raise `InvalidInputError` unless every field of ``recipe`` fits its specification.

    Values are kept in one form (plain ``float``, ``int``, ``bool``), so that equal recipes are
    equal and files hold what memory holds.
    """
    kind: type = type(recipe)
    for name, spec, default in _specs_and_defaults(kind):
        value = getattr(recipe, name)
        if value is default:
            continue
        try:
            kept = spec.checked(value)
        except ValidationError as misfit:
            raise InvalidInputError(
                f"{kind.__name__}.{name} is {quoted(value)}, expected {misfit}"
            ) from None
        if kept is not value:
            object.__setattr__(recipe, name, kept)


def encode(recipe: Any) -> Tree:
    """Return a recipe as a tree: its kind, and its fields by name."""
    tree = {KIND: type(recipe).__name__}
    for name, spec in _specs(type(recipe)):
        tree[name] = spec.encoded(getattr(recipe, name))
    return tree


def decode(tree: Tree, kinds: tuple[type, ...], at: Address) -> Any:
    """Return the recipe that ``tree`` holds.

    A field that is missing was not known to the older version that wrote the tree: it takes its
    default.  Whether anything got lost has to be known before, from a checksum.

    Raises
    ------
    FileFormatError
        The tree is of no known kind, holds what no known version writes, or lacks what every
        version writes.
    """
    if not isinstance(tree, dict) or not isinstance(tree.get(KIND), str):
        raise FileFormatError(f"{at} is {quoted(tree)}, expected a recipe. {_DAMAGED}")
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


def nesting(recipe: Any) -> int:
    """How many recipes stand within each other, this one counted."""
    deepest = 0
    for name, spec in _nesting_specs(type(recipe)):
        value = getattr(recipe, name)
        # An empty list, which most are, holds none.
        depth = spec.depth(value) if value != () else 0
        if depth > deepest:
            deepest = depth
    return 1 + deepest


# A design holds a thousand recipes and is made anew with each edit; classes do not change.
_Specs = tuple[tuple[str, Spec], ...]
_MOST_KINDS = 1000


def _specs(kind: type) -> _Specs:
    return _both(kind)[0]


def _nesting_specs(kind: type) -> _Specs:
    return _both(kind)[1]


@lru_cache(_MOST_KINDS)
def _both(kind: type) -> tuple[_Specs, _Specs]:
    """Specifications of all fields, and of those that may hold recipes."""
    specs = tuple(
        (field.name, field.metadata["spec"])
        for field in dataclasses.fields(kind)
        if "spec" in field.metadata
    )
    return specs, tuple(pair for pair in specs if pair[1].nests)


@lru_cache(_MOST_KINDS)
def _specs_and_defaults(kind: type) -> tuple[tuple[str, Spec, Any], ...]:
    """Specifications of all fields, each with the default that needs no check any more.

    That is no value of any recipe where there is none.
    """
    defaults = {field.name: field.default for field in dataclasses.fields(kind)}
    return tuple((name, spec, _sound(spec, defaults[name])) for name, spec in _specs(kind))


def _sound(spec: Spec, default: Any) -> Any:
    """The default if it is kept as it is."""
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
