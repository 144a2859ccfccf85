"""What every specification can do: check a value, and turn it into a tree and back.

A tree is what files and the clipboard carry: texts, numbers, True, False, None, `Samples`, lists
of trees, and dictionaries of trees with texts as keys.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.limb import BAND_HZ, Band
from skinsource.quoting import quoted
from skinsource.tree import Tree

#: Recipes within recipes; whoever nests deeper has made a mistake, or means harm.
MAX_DEPTH = 32

Thing = TypeVar("Thing")


@dataclass(frozen=True, slots=True)
class Address:
    """Where in a tree something stands, for messages: ``inputs/3/waveform``."""

    names: tuple[str, ...] = ()

    def inside(self, name: object) -> "Address":
        """Address of a part."""
        if len(self.names) > 3 * MAX_DEPTH:
            raise FileFormatError(f"{self} is nested too deep, expected {MAX_DEPTH} levels at most")
        return Address((*self.names, str(name)))

    def __str__(self) -> str:
        return "/".join(self.names[-8:]) or "the content"


class Misfit(InvalidInputError):
    """A value does not fit a specification; the text says what was expected."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spec(ABC):
    """A field of a recipe.

    Attributes
    ----------
    label, hint
        Words for the user.
    asked
        Whether a user can be asked for it; what only tells things apart is for nobody to choose.
    """

    label: str
    hint: str = ""
    asked: bool = True

    @abstractmethod
    def checked(self, value: Any) -> Any:
        """Return ``value`` as it is kept; raise `Misfit` with what was expected instead."""

    def encoded(self, value: Any) -> Tree:
        """Return a value that was checked as a tree."""
        return value

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return the value of a tree; whether it fits is checked by the recipe that takes it."""
        del at
        return tree

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "Spec":
        """What is allowed on a limb of this sample rate, known in its band: for most, the same."""
        del sample_rate_hz, band_hz
        return self

    @property
    def about(self) -> str:
        """What is said of it where it is edited."""
        return self.hint

    @property
    def nests(self) -> bool:
        """Whether a value may hold recipes."""
        return False

    def depth(self, value: Any) -> int:
        """How many recipes within recipes a value holds."""
        del value
        return 0


def made_for(spec: Spec, table: Mapping[type[Spec], Thing]) -> Thing:
    """Return the entry of ``table`` for the kind of ``spec``.

    For whatever has to tell numbers from choices, texts, …: a kind that is missing in the table
    is never taken for another one.

    Raises
    ------
    TypeError
        The table knows nothing of this kind.
    """
    for kind in type(spec).__mro__:
        if kind in table:
            return table[kind]
    raise TypeError(f"{type(spec).__name__} of {quoted(spec.label)} is not in the table")
