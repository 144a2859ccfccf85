"""What a number or a choice of a recipe may be: label, unit, range.

A recipe is a frozen dataclass whose fields are made here.  Checks, files and editors are all
driven by these specifications, so that a new recipe is one new file.
"""

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.errors import InvalidInputError


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberSpec:
    """A number: what it is called, its SI unit, and the values it may have.

    Attributes
    ----------
    label, unit, hint
        Words for the user; ``unit`` is ``"s"``, ``"Hz"``, ``"rad"``, ``"m/s²"`` or empty.
    minimum, maximum
        Both are allowed values.
    step
        What one turn of the wheel adds; with ``logarithmic`` the factor is one plus it.
    whole
        Whether only whole numbers are allowed.
    """

    label: str
    unit: str = ""
    minimum: float = -np.inf
    maximum: float = np.inf
    step: float = 1.0
    logarithmic: bool = False
    whole: bool = False
    hint: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceSpec:
    """One of several names.

    Attributes
    ----------
    label, hint
        Words for the user.
    options
        The allowed values, and what each is called.
    """

    label: str
    options: tuple[tuple[str, str], ...]
    hint: str = ""


Spec = NumberSpec | ChoiceSpec


def number(default: float, spec: NumberSpec) -> Any:
    """Make a dataclass field for a number."""
    return dataclasses.field(default=default, metadata={"spec": spec})


def choice(default: str, spec: ChoiceSpec) -> Any:
    """Make a dataclass field for one of several names."""
    return dataclasses.field(default=default, metadata={"spec": spec})


def specs_of(recipe: Any) -> dict[str, Spec]:
    """Return the specification of each field of a recipe, or of its class, in order."""
    return {
        field.name: field.metadata["spec"]
        for field in dataclasses.fields(recipe)
        if "spec" in field.metadata
    }


def check(recipe: Any) -> None:
    """Raise `InvalidInputError` unless every field of ``recipe`` fits its specification.

    Numbers are stored as plain ``float`` or ``int``, so that equal recipes are equal and files
    hold what memory holds.
    """
    kind = type(recipe).__name__
    for name, spec in specs_of(recipe).items():
        value = getattr(recipe, name)
        if isinstance(spec, ChoiceSpec):
            if value not in [option for option, _ in spec.options]:
                allowed = ", ".join(option for option, _ in spec.options)
                raise InvalidInputError(f"{kind}.{name} is {value!r}, expected one of {allowed}")
        else:
            object.__setattr__(recipe, name, _checked_number(kind, name, value, spec))


def _checked_number(kind: str, name: str, value: Any, spec: NumberSpec) -> float | int:
    allowed = f"a {'whole ' if spec.whole else ''}number from {spec.minimum:g} to {spec.maximum:g}"
    if spec.unit:
        allowed += f" {spec.unit}"
    message = f"{kind}.{name} is {value!r}, expected {allowed}"
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        raise InvalidInputError(message)
    # The range first: a whole number beyond all floats cannot be asked whether it is finite.
    if not spec.minimum <= value <= spec.maximum or not np.isfinite(value):
        raise InvalidInputError(message)
    if spec.whole:
        if value != int(value):
            raise InvalidInputError(message)
        return int(value)
    return float(value)
