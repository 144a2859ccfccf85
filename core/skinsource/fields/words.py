"""Choices, yes or no, and texts."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.fields.spec import Misfit, Spec


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
class FlagSpec(Spec):
    """Yes or no."""

    def checked(self, value: Any) -> bool:
        """Return a plain ``bool``."""
        if not isinstance(value, bool | np.bool_):
            raise Misfit("True or False")
        return bool(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextSpec(Spec):
    """A text.

    Attributes
    ----------
    most
        How many characters it may have.
    lines
        Whether it may have several lines.
    """

    most: int = 200
    lines: bool = False

    def checked(self, value: Any) -> str:
        """Return a plain ``str``."""
        where = "several lines" if self.lines else "one line"
        expected = f"a text of at most {self.most} characters in {where}"
        if not isinstance(value, str) or len(value) > self.most:
            raise Misfit(expected)
        if not self.lines and len(value.splitlines()) > 1:
            raise Misfit(expected)
        try:
            value.encode()
        except UnicodeEncodeError:  # half of a pair: no file can hold it
            raise Misfit(expected) from None
        return str(value)
