"""Fields that hold more than one value: lists, recipes, samples, and what may be absent."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from skinsource.errors import InvalidInputError
from skinsource.fields.recipes import decode, encode, nesting
from skinsource.fields.spec import MAX_DEPTH, Address, Misfit, Spec, Tree
from skinsource.limb import BAND_HZ, Band
from skinsource.samples import MAX_SAMPLES, Samples


@dataclass(frozen=True, slots=True, kw_only=True)
class OptionalSpec(Spec):
    """Something, or ``None``.

    Attributes
    ----------
    of
        What it is where it is not ``None``.
    """

    of: Spec

    def checked(self, value: Any) -> Any:
        """Return ``None``, or the value as it is kept."""
        if value is None:
            return None
        try:
            return self.of.checked(value)
        except Misfit as misfit:
            raise Misfit(f"None or {misfit}") from None

    def encoded(self, value: Any) -> Tree:
        """Return ``None`` for ``None``."""
        return None if value is None else self.of.encoded(value)

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return ``None`` for ``None``."""
        return None if tree is None else self.of.decoded(tree, at)

    @property
    def nests(self) -> bool:
        """Whether the value may."""
        return self.of.nests

    def depth(self, value: Any) -> int:
        """That of the value."""
        return 0 if value is None else self.of.depth(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class ListSpec(Spec):
    """A tuple of any length.

    Attributes
    ----------
    of
        What each part is.
    fewest, most
        How many there may be.
    different
        Whether no two may be equal.
    """

    of: Spec
    fewest: int = 0
    most: int = 10_000
    different: bool = False

    def checked(self, value: Any) -> tuple[Any, ...]:
        """Return a tuple of the parts as they are kept."""
        many = f"{self.fewest} to {self.most}{' different' if self.different else ''} parts"
        if not isinstance(value, tuple) or not self.fewest <= len(value) <= self.most:
            raise Misfit(f"a tuple of {many}")
        try:
            parts = tuple(self.of.checked(part) for part in value)
        except Misfit as misfit:
            raise Misfit(f"a tuple of {many}, each {misfit}") from None
        if self.different and len(set(parts)) < len(parts):
            raise Misfit(f"a tuple of {many}")
        # What is as it was keeps its identity.
        return value if all(a is b for a, b in zip(parts, value, strict=True)) else parts

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "ListSpec":
        """What is allowed on a limb of this rate, part by part."""
        return replace(self, of=self.of.at_rate(sample_rate_hz, band_hz))

    def encoded(self, value: tuple[Any, ...]) -> Tree:
        """Return a list of trees."""
        return [self.of.encoded(part) for part in value]

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a tuple; of too long a list, unread."""
        if not isinstance(tree, list) or len(tree) > self.most:
            return tree
        return tuple(self.of.decoded(part, at.inside(k)) for k, part in enumerate(tree))

    @property
    def nests(self) -> bool:
        """Whether a part may."""
        return self.of.nests

    def depth(self, value: tuple[Any, ...]) -> int:
        """That of the deepest part."""
        return max(map(self.of.depth, value), default=0) if value else 0


@dataclass(frozen=True, slots=True, kw_only=True)
class RecipeSpec(Spec):
    """A recipe of one of several kinds.

    Attributes
    ----------
    kinds
        Gives the classes that are allowed, and those made from them, which are computed but not
        written.  Asked anew each time, so that a kind can be added.
    rate_hz, band_hz
        Sample rate of the limb on which it is played, None: not said; and the band in which that
        was measured, None: not known.
    """

    kinds: Callable[[], tuple[type, ...]]
    rate_hz: float | None = None
    band_hz: Band | None = BAND_HZ

    def checked(self, value: Any) -> Any:
        """Return ``value`` itself."""
        if not isinstance(value, self.kinds()):
            raise Misfit(f"one of {', '.join(kind.__name__ for kind in self.kinds())}")
        if self.depth(value) > MAX_DEPTH:
            raise Misfit(f"recipes within recipes at most {MAX_DEPTH} deep")
        return value

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "RecipeSpec":
        """The same, for a limb of this rate: what its fields allow follows from that."""
        return replace(self, rate_hz=sample_rate_hz, band_hz=band_hz)

    def encoded(self, value: Any) -> Tree:
        """Return the fields by name, and the kind."""
        kind = type(value)
        if kind not in self.kinds():
            names = ", ".join(one.__name__ for one in self.kinds())
            raise InvalidInputError(
                f"a {kind.__name__} cannot be written, nothing could read it: choose {names}."
            )
        return encode(value)

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a recipe of the kind that the tree names."""
        return decode(tree, self.kinds(), at)

    @property
    def nests(self) -> bool:
        """It does."""
        return True

    def depth(self, value: Any) -> int:
        """One more than that of the fields."""
        return nesting(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class SamplesSpec(Spec):
    """A recorded or drawn signal, `Samples`.

    Attributes
    ----------
    unit
        The unit that they must have; None: any.
    most
        How many there may be.
    """

    unit: str | None = ""
    most: int = MAX_SAMPLES

    def checked(self, value: Any) -> Samples:
        """Return ``value`` itself."""
        if not isinstance(value, Samples) or value.values.size > self.most:
            raise Misfit(f"Samples, at most {self.most} of them")
        if self.unit is not None and value.unit != self.unit:
            raise Misfit(f"Samples in {self.unit or 'no unit'}")
        return value
