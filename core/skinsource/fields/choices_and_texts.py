"""Choices, yes or no, texts, and bytes."""

import base64
import binascii
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.fields.spec import Address, Misfit, Spec, Tree


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceSpec(Spec):
    """One of several names.

    Attributes
    ----------
    options
        The allowed values, and what each is called.
    """

    options: tuple[tuple[str, str], ...]

    def checked(self, value: Any) -> str:
        """Return the name."""
        if not isinstance(value, str) or value not in dict(self.options):
            raise Misfit(f"one of {', '.join(option for option, _ in self.options)}")
        return value


@dataclass(frozen=True, slots=True, kw_only=True)
class SwitchSpec(Spec):
    """Yes or no."""

    def checked(self, value: Any) -> bool:
        """Return a plain ``bool``."""
        if not isinstance(value, bool | np.bool_):
            raise Misfit("True or False")
        return bool(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextSpec(Spec):
    """Words of the user.

    Attributes
    ----------
    longest
        How many characters there may be.
    one_line
        Whether they must stand in one line.
    reader
        Understands a text that is more than words, or raises `InvalidInputError`, whose ``column``,
        if it has one, is where it stopped.  Such a text is edited live.
    """

    longest: int
    one_line: bool = False
    reader: Callable[[str], object] | None = None

    def checked(self, value: Any) -> str:
        """Return a plain ``str``."""
        expected = (
            f"{'one line' if self.one_line else 'a text'} of at most {self.longest} characters"
        )
        if not isinstance(value, str) or len(value) > self.longest:
            raise Misfit(expected)
        if self.one_line and "".join(value.splitlines()) != value:
            raise Misfit(expected)
        try:
            value.encode()
        except UnicodeEncodeError:  # half of a pair: no file can hold it
            raise Misfit(expected) from None
        if self.reader is not None:
            self.reader(value)
        return str(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class BytesSpec(Spec):
    """Bytes whose meaning others know.

    Attributes
    ----------
    longest
        How many there may be.
    """

    longest: int

    def checked(self, value: Any) -> bytes:
        """Return ``value`` itself."""
        if not isinstance(value, bytes) or len(value) > self.longest:
            raise Misfit(f"at most {self.longest} bytes")
        return value

    def encoded(self, value: bytes) -> Tree:
        """Return them in base 64."""
        return base64.b64encode(value).decode()

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return the bytes."""
        del at
        try:
            return base64.b64decode(tree, validate=True)
        except (TypeError, ValueError, binascii.Error):
            return tree
