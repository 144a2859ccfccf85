"""Specifications of fields: each checks values, and turns them into trees and back.

A tree is what files and the clipboard hold: texts, numbers, True, False, None, `Samples`, lists
of trees, and dictionaries of trees with texts as keys.  A model is a frozen dataclass whose fields
have specifications.
"""

import base64
import binascii
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, TypeVar

import numpy as np

from skinsource.base.conventions import BAND_HZ, Band
from skinsource.base.errors import FileFormatError, InvalidInputError, quoted
from skinsource.base.json_text import Tree

#: Most levels of models within models; a deeper tree is a mistake or an attack.
MAX_DEPTH = 32

Thing = TypeVar("Thing")


@dataclass(frozen=True, slots=True)
class Address:
    """Position in a tree, for messages: ``inputs/3/waveform``."""

    names: tuple[str, ...] = ()

    def inside(self, name: object) -> "Address":
        """Return the address of a part."""
        if len(self.names) > 3 * MAX_DEPTH:
            raise self._too_deep()
        return Address((*self.names, str(name)))

    def check_depth(self) -> None:
        """Raise `FileFormatError` where a model would stand below too many others.

        That is before its parts are read: each level may hold a hundred of them.
        """
        if sum(not name.isdigit() for name in self.names) >= MAX_DEPTH:
            raise self._too_deep()

    def _too_deep(self) -> FileFormatError:
        return FileFormatError(f"{self} is nested too deep, expected {MAX_DEPTH} levels at most")

    def __str__(self) -> str:
        return "/".join(self.names[-8:]) or "the content"


class ValidationError(InvalidInputError):
    """A value does not fit a specification; the message says what was expected."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spec(ABC):
    """A field of a model.

    Attributes
    ----------
    label, hint
        Texts for the user.
    asked
        Whether the user can edit it; identifiers are not for editing.
    """

    label: str
    hint: str = ""
    editable: bool = True

    @abstractmethod
    def checked(self, value: Any) -> Any:
        """Return ``value`` as models store it; raise `ValidationError` if it does not fit."""

    def encoded(self, value: Any) -> Tree:
        """Return a checked value as a tree."""
        return value

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return the value in a tree; the model that gets it checks whether it fits."""
        return tree

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "Spec":
        """Return the specification on a limb of this sample rate, measured in its band."""
        return self

    @property
    def about(self) -> str:
        """The hint for the user in an editor."""
        return self.hint

    @property
    def nests(self) -> bool:
        """Whether a value may hold models."""
        return False

    def depth(self, value: Any) -> int:
        """Return how many levels of models a value holds."""
        return 0


def tuple_of_points(tree: Tree, most: int) -> Any:
    """Return a list of lists as a tuple of tuples; the tree itself if it is none or too long."""
    if not isinstance(tree, list) or len(tree) > most:
        return tree
    return tuple(tuple(point) if isinstance(point, list) else point for point in tree)


def made_for(spec: Spec, table: Mapping[type[Spec], Thing]) -> Thing:
    """Return the entry of ``table`` for the kind of ``spec``.

    Code that treats numbers, choices, texts, … differently uses this: a kind that is missing in
    the table is an error.

    Raises
    ------
    TypeError
        The table does not hold this kind.
    """
    for kind in type(spec).__mro__:
        if kind in table:
            return table[kind]
    raise TypeError(f"{type(spec).__name__} of {quoted(spec.label)} is not in the table")


_MAX_PARTS, _MAX_DEPTH, _MAX_CHARACTERS = 10_000, 8, 10_000
_EXPECTED = "None, True, False, finite numbers, texts, and tuples of them"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlainSpec(Spec):
    """Plain data: None, True, False, numbers, texts, and tuples of these, as panels store."""

    def checked(self, value: Any) -> Any:
        """Return ``value`` itself."""
        if _count_parts(value, _MAX_DEPTH) > _MAX_PARTS:
            raise ValidationError(f"at most {_MAX_PARTS} parts")
        return value

    def encoded(self, value: Any) -> Tree:
        """Return lists in place of tuples."""
        return [self.encoded(part) for part in value] if isinstance(value, tuple) else value

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return tuples in place of lists."""
        if isinstance(tree, list):
            return tuple(self.decoded(part, at.inside(k)) for k, part in enumerate(tree))
        return tree


def _count_parts(value: Any, depth: int) -> int:
    """Return the number of parts; raise `ValidationError` if one of them is not plain."""
    if isinstance(value, tuple):
        if depth == 0:
            raise ValidationError(f"tuples in tuples at most {_MAX_DEPTH} deep")
        return 1 + sum(_count_parts(part, depth - 1) for part in value)
    is_plain = value is None or isinstance(value, bool)
    is_plain = is_plain or (isinstance(value, int) and abs(value) < 2**63)
    is_plain = is_plain or (isinstance(value, float) and isfinite(value))
    if not is_plain and not (isinstance(value, str) and _can_be_written(value)):
        raise ValidationError(_EXPECTED)
    return 1


def _can_be_written(text: str) -> bool:
    # Files cannot hold half of a pair of surrogates.
    return len(text) <= _MAX_CHARACTERS and not any(
        "\ud800" <= character <= "\udfff" for character in text
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceSpec(Spec):
    """One of several names.

    Attributes
    ----------
    options
        The allowed values, and what each is called.
    other_names
        Names that scripts may use besides, and the values that they stand for.
    """

    options: tuple[tuple[str, str], ...]
    other_names: tuple[tuple[str, str], ...] = ()

    def checked(self, value: Any) -> str:
        """Return the name."""
        if isinstance(value, str):
            value = dict(self.other_names).get(value, value)
        if not isinstance(value, str) or value not in dict(self.options):
            raise ValidationError(f"one of {', '.join(option for option, _ in self.options)}")
        return value


@dataclass(frozen=True, slots=True, kw_only=True)
class SwitchSpec(Spec):
    """Yes or no."""

    def checked(self, value: Any) -> bool:
        """Return a plain ``bool``."""
        if not isinstance(value, bool | np.bool_):
            raise ValidationError("True or False")
        return bool(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextSpec(Spec):
    """A text of the user.

    Attributes
    ----------
    longest
        Most characters.
    one_line
        Whether line ends are forbidden.
    left_out_empty
        Whether an empty text is left out of files, which older versions can read then.
    reader
        Parses a text in a language, such as a formula, or raises `InvalidInputError`, whose
        ``column``, if it has one, is the position of the mistake.  Such a text is edited live.
    """

    longest: int
    one_line: bool = False
    left_out_empty: bool = False
    reader: Callable[[str], object] | None = None

    def checked(self, value: Any) -> str:
        """Return a plain ``str``."""
        expected = (
            f"{'one line' if self.one_line else 'a text'} of at most {self.longest} characters"
        )
        if not isinstance(value, str) or len(value) > self.longest:
            raise ValidationError(expected)
        if self.one_line and "".join(value.splitlines()) != value:
            raise ValidationError(expected)
        try:
            value.encode()
        except UnicodeEncodeError:  # half of a pair of surrogates
            raise ValidationError(expected) from None
        if self.reader is not None:
            self.reader(value)
        return str(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class BytesSpec(Spec):
    """Bytes of any meaning.

    Attributes
    ----------
    longest
        Most bytes.
    """

    longest: int

    def checked(self, value: Any) -> bytes:
        """Return ``value`` itself."""
        if not isinstance(value, bytes) or len(value) > self.longest:
            raise ValidationError(f"at most {self.longest} bytes")
        return value

    def encoded(self, value: bytes) -> Tree:
        """Return them in base 64."""
        return base64.b64encode(value).decode()

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return the bytes."""
        try:
            return base64.b64decode(tree, validate=True)
        except (TypeError, ValueError, binascii.Error):
            return tree
