"""The folder of icons, themes and tables of the window."""

import tomllib
from pathlib import Path

from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

_PACKAGE = Path(__file__).resolve().parents[1]


def resource_folder() -> Path:
    """Return the folder of resources: ``skinsource_gui/_resources`` in a wheel, else a checkout."""
    installed = _PACKAGE / "_resources"
    return installed if installed.is_dir() else _PACKAGE.parent / "resources"


def read_text(name: str) -> str:
    """Return the content of a text resource."""
    return (resource_folder() / name).read_text(encoding="utf-8")


_CHOICES = tomllib.loads(read_text("choices.toml"))
_COLUMNS = tomllib.loads(read_text("columns.toml"))
_NUMBERS = tomllib.loads(read_text("numbers.toml"))


def choice_of(name: str) -> ChoiceSpec:
    """Return the choice of this name in ``choices.toml``."""
    entry = _CHOICES[name]
    return ChoiceSpec(**{**entry, "options": tuple(entry["options"].items())})


def number_named(name: str, **limits: float) -> NumberSpec:
    """Return the number of this name in ``numbers.toml``, with limits that the library names."""
    return NumberSpec(**{**_NUMBERS[name], **limits})


def columns_of(table: str, **numbers: float) -> dict[str, str]:
    """Return what the columns of a table in ``columns.toml`` mean, by their titles."""
    return {each["title"]: each["meaning"].format(**numbers) for each in _COLUMNS[table]}
