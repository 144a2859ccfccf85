"""Fields of models, with label, unit and limits.

A model is a frozen dataclass whose fields are made here::

    frequency_hz: float = fields.number(100.0, NumberSpec(label="Frequency", unit="Hz"))
    muted: bool = fields.switch(False, SwitchSpec(label="Mute"))

and that calls `check` when it is made, as a `CheckedModel` does.  These specifications drive
checks, files, the clipboard and editors, so that a new model is one new file.  Code that treats
kinds of fields differently calls `skinsource.specs.spec.made_for` with a table by class.
"""

from typing import Any

from skinsource.specs.models import CheckedModel, check, field
from skinsource.specs.numbers import NumberSpec, Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec, TextSpec

__all__ = ["CheckedModel", "check", "choice", "field", "interval", "number", "switch", "text"]


def number(default: float, spec: NumberSpec) -> Any:
    """Make a dataclass field for a number."""
    return field(spec, default)


def choice(default: str, spec: ChoiceSpec) -> Any:
    """Make a dataclass field whose value is a name out of several."""
    return field(spec, default)


def switch(default: bool, spec: SwitchSpec) -> Any:
    """Make a dataclass field for yes or no."""
    return field(spec, default)


def interval(default: Range | None, spec: RangeSpec) -> Any:
    """Make a dataclass field for a lower and an upper end."""
    return field(spec, default)


def text(default: str, spec: TextSpec) -> Any:
    """Make a dataclass field for a text."""
    return field(spec, default)
