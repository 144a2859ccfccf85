"""Specifications of numbers, of ranges and curves, and of fields that hold several values."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np

from skinsource.base.conventions import BAND_HZ, Band
from skinsource.base.errors import InvalidInputError
from skinsource.base.json_text import Tree
from skinsource.specs.models import decode, encode, nesting
from skinsource.specs.samples import MAX_SAMPLES, Samples
from skinsource.specs.spec import MAX_DEPTH, Address, Spec, ValidationError, tuple_of_points

#: Minimum of numbers that must be above 0 and have no other bound.
SMALLEST = 5e-324

#: Low and high.
Range = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberSpec(Spec):
    """A number: its SI unit, and the values that it may have.

    Attributes
    ----------
    unit
        ``"s"``, ``"Hz"``, ``"rad"``, ``"m/s²"`` or empty.
    minimum, maximum
        Both are allowed values.
    step
        What one notch of the wheel, one arrow key or a few pixels of a drag add; with
        ``logarithmic`` it is a share of the value: 0.02 adds 2 %.
    whole
        Whether only whole numbers are allowed.
    below_half_rate
        Whether it is a frequency that a limb can play only below half its sample rate.
    measured_band_hz
        For a frequency of the motion itself the band in which the limb was measured; None where
        that is not known, and for all other numbers.
    unset
        Text in the place of 0, where 0 means that there is no number.
    """

    unit: str = ""
    minimum: float = -np.inf
    maximum: float = np.inf
    step: float = 1.0
    logarithmic: bool = False
    whole: bool = False
    below_half_rate: bool = False
    measured_band_hz: Band | None = None
    unset: str = ""

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "NumberSpec":
        """Return the specification on a limb of this rate: frequencies end below half of it.

        The largest frequency is a whole number of hertz.  The measured band is that of the limb.

        >>> NumberSpec(label="Frequency", unit="Hz", below_half_rate=True).at_rate(1300.0).maximum
        649.0
        """
        measured_band_hz = None if self.measured_band_hz is None else band_hz
        if not self.below_half_rate:
            return (
                self
                if measured_band_hz == self.measured_band_hz
                else replace(self, measured_band_hz=measured_band_hz)
            )
        highest = max(float(np.ceil(sample_rate_hz / 2)) - 1.0, self.minimum)
        return replace(self, maximum=min(self.maximum, highest), measured_band_hz=measured_band_hz)

    @property
    def about(self) -> str:
        """The hint, and the measured band."""
        if self.measured_band_hz is None:
            return self.hint
        low_hz, high_hz = self.measured_band_hz
        band = f"{low_hz:g} to {high_hz:g} Hz is the measured band"
        return f"{self.hint}; {band}" if self.hint else band

    def is_known(self, value: float) -> bool:
        """Whether ``value`` lies in the measured band; True where there is none."""
        return (
            self.measured_band_hz is None
            or self.measured_band_hz[0] <= value <= self.measured_band_hz[1]
        )

    @property
    def expected(self) -> str:
        """Text that says which numbers are allowed."""
        text = f"a {'whole ' if self.whole else ''}number"
        if np.isfinite([self.minimum, self.maximum]).all():
            text += f" from {self.minimum:g} to {self.maximum:g}"
        elif self.minimum == SMALLEST:
            text += " above 0"
        elif np.isfinite(self.minimum):
            text += f" of at least {self.minimum:g}"
        return f"{text} {self.unit}" if self.unit else text

    def checked(self, value: Any) -> float | int:
        """Return a plain ``float`` or ``int``, so that files hold what memory holds."""
        is_number = isinstance(value, int | float | np.integer | np.floating)
        if not is_number or isinstance(value, bool | np.timedelta64):
            raise ValidationError(self.expected)
        # The range is checked first: ``isfinite`` fails for integers beyond all floats.
        if not self.minimum <= value <= self.maximum or value in (-np.inf, np.inf):
            raise ValidationError(self.expected)
        if not self.whole:
            try:
                return float(value)
            except OverflowError:
                raise ValidationError(self.expected) from None
        if value != int(value):
            raise ValidationError(self.expected)
        return int(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeSpec(Spec):
    """A lower and an upper end, or ``None``: everything.

    Attributes
    ----------
    unit
        SI unit of both ends.
    minimum, maximum
        Limits of the ends.
    """

    unit: str = ""
    minimum: float = -1e300
    maximum: float = 1e300

    def checked(self, value: Any) -> Range | None:
        """Return two plain floats, or ``None``."""
        if value is None:
            return None
        end = NumberSpec(label=self.label, minimum=self.minimum, maximum=self.maximum)
        expected = f"None or two finite numbers, low < high, each {end.expected}"
        if not isinstance(value, tuple) or len(value) != 2:
            raise ValidationError(expected)
        try:
            low, high = (end.checked(number) for number in value)
        except ValidationError:
            raise ValidationError(expected) from None
        if not low < high:
            raise ValidationError(expected)
        return low, high

    def encoded(self, value: Range | None) -> Tree:
        """Return a list of two numbers, or ``None``."""
        return None if value is None else list(value)

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a tuple."""
        return tuple(tree) if isinstance(tree, list) else tree


@dataclass(frozen=True, slots=True, kw_only=True)
class PointsSpec(Spec):
    """Points of several numbers, the first of which never falls.

    Attributes
    ----------
    columns
        Specifications of the numbers of a point.
    fewest, most
        Limits of the number of points.
    """

    columns: tuple[NumberSpec, ...]
    fewest: int = 2
    most: int = 10_000

    def checked(self, value: Any) -> tuple[tuple[float, ...], ...]:
        """Return a tuple of points of plain numbers."""
        names = ", ".join(f"{column.label.lower()} {column.expected}" for column in self.columns)
        expected = f"{self.fewest} to {self.most} points ({names}), the first never falling"
        if not isinstance(value, tuple) or not self.fewest <= len(value) <= self.most:
            raise ValidationError(expected)
        if not all(isinstance(point, tuple) and len(point) == len(self.columns) for point in value):
            raise ValidationError(expected)
        try:
            points = tuple(
                tuple(
                    column.checked(number)
                    for column, number in zip(self.columns, point, strict=True)
                )
                for point in value
            )
        except ValidationError:
            raise ValidationError(expected) from None
        if any(after[0] < before[0] for before, after in pairwise(points)):
            raise ValidationError(expected)
        return points

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "PointsSpec":
        """Return the specification with those of the columns on a limb of this rate."""
        columns = tuple(column.at_rate(sample_rate_hz, band_hz) for column in self.columns)
        return replace(self, columns=columns)

    def encoded(self, value: tuple[tuple[float, ...], ...]) -> Tree:
        """Return a list of lists of numbers."""
        return [list(point) for point in value]

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a tuple of tuples; of too long a list, unread."""
        return tuple_of_points(tree, self.most)


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveSpec(PointsSpec):
    """Points of a curve: pairs of x and y, x never falling.

    Attributes
    ----------
    x, y
        Specifications of the numbers of a point.
    """

    columns: tuple[NumberSpec, ...] = field(init=False)
    x: NumberSpec
    y: NumberSpec

    def __post_init__(self) -> None:
        object.__setattr__(self, "columns", (self.x, self.y))

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "CurveSpec":
        """Return the specification itself: a curve holds no frequencies."""
        return self


@dataclass(frozen=True, slots=True, kw_only=True)
class OptionalSpec(Spec):
    """A value of another specification, or ``None``.

    Attributes
    ----------
    of
        Specification of a value that is not ``None``.
    left_out_empty
        Whether ``None`` is left out of files, which older versions can read then.
    """

    of: Spec
    left_out_empty: bool = False
    unset: str = "none"

    def checked(self, value: Any) -> Any:
        """Return ``None``, or the checked value."""
        if value is None:
            return None
        try:
            return self.of.checked(value)
        except ValidationError as error:
            raise ValidationError(f"None or {error}") from None

    def encoded(self, value: Any) -> Tree:
        """Return ``None`` for ``None``."""
        return None if value is None else self.of.encoded(value)

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return ``None`` for ``None``."""
        return None if tree is None else self.of.decoded(tree, at)

    @property
    def nests(self) -> bool:
        """Whether the value may hold models."""
        return self.of.nests

    def depth(self, value: Any) -> int:
        """Return the depth of the value."""
        return 0 if value is None else self.of.depth(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class ListSpec(Spec):
    """A tuple of any length.

    Attributes
    ----------
    of
        Specification of the parts.
    fewest, most
        Limits of the number of parts.
    different
        Whether equal parts are forbidden.
    left_out_empty
        Whether an empty list is left out of files, which older versions can read then.
    unset
        Text in the place of an empty list.
    """

    of: Spec
    fewest: int = 0
    most: int = 10_000
    different: bool = False
    left_out_empty: bool = False
    unset: str = "none"

    def checked(self, value: Any) -> tuple[Any, ...]:
        """Return a tuple of the checked parts; the same one if no part changed."""
        expected = (
            f"a tuple of {self.fewest} to {self.most}{' different' if self.different else ''} parts"
        )
        if not isinstance(value, tuple) or not self.fewest <= len(value) <= self.most:
            raise ValidationError(expected)
        try:
            parts = tuple(self.of.checked(part) for part in value)
        except ValidationError as error:
            raise ValidationError(f"{expected}, each {error}") from None
        if self.different and len(set(parts)) < len(parts):
            raise ValidationError(expected)
        return value if all(a is b for a, b in zip(parts, value, strict=True)) else parts

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "ListSpec":
        """Return the specification with that of the parts on a limb of this rate."""
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
        """Whether a part may hold models."""
        return self.of.nests

    def depth(self, value: tuple[Any, ...]) -> int:
        """Return the depth of the deepest part."""
        return max(map(self.of.depth, value), default=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelSpec(Spec):
    """A model of one of several kinds.

    Attributes
    ----------
    kinds
        Returns the classes that are allowed; their subclasses can be computed, but not written.
        It is called each time, so that kinds can be added.
    rate_hz, band_hz
        Sample rate of the limb that plays it, None: any; and the band in which that limb was
        measured, None: not known.
    """

    kinds: Callable[[], tuple[type, ...]]
    rate_hz: float | None = None
    band_hz: Band | None = BAND_HZ

    def checked(self, value: Any) -> Any:
        """Return ``value`` itself."""
        if not isinstance(value, self.kinds()):
            raise ValidationError(f"one of {', '.join(kind.__name__ for kind in self.kinds())}")
        if self.depth(value) > MAX_DEPTH:
            raise ValidationError(f"recipes within recipes at most {MAX_DEPTH} deep")
        return value

    def at_rate(self, sample_rate_hz: float, band_hz: Band | None = BAND_HZ) -> "ModelSpec":
        """Return the specification on a limb of this rate, for the fields of its models."""
        return replace(self, rate_hz=sample_rate_hz, band_hz=band_hz)

    def encoded(self, value: Any) -> Tree:
        """Return the fields by name, with the kind."""
        kind = type(value)
        if kind not in self.kinds():
            names = ", ".join(kind.__name__ for kind in self.kinds())
            raise InvalidInputError(
                f"a {kind.__name__} cannot be written, as nothing could read it: choose {names}."
            )
        return encode(value)

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a model of the kind that the tree names."""
        return decode(tree, self.kinds(), at)

    @property
    def nests(self) -> bool:
        """Always True."""
        return True

    def depth(self, value: Any) -> int:
        """Return one level more than that of the fields."""
        return nesting(value)


@dataclass(frozen=True, slots=True, kw_only=True)
class SamplesSpec(Spec):
    """A recorded or drawn signal, `Samples`.

    Attributes
    ----------
    unit
        The required unit; None: any.
    most
        Most samples.
    """

    unit: str | None = ""
    most: int = MAX_SAMPLES

    def checked(self, value: Any) -> Samples:
        """Return ``value`` itself."""
        if not isinstance(value, Samples) or value.values.size > self.most:
            raise ValidationError(f"Samples, at most {self.most} of them")
        if self.unit is not None and value.unit != self.unit:
            raise ValidationError(f"Samples in {self.unit or 'no unit'}")
        return value
