"""Breakpoints: points of a curve, each with the form of the segment that follows."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite
from operator import is_
from typing import Any, Literal, Self, get_args

from skinsource.base.json_text import Tree
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import Address, Spec, ValidationError, tuple_of_points

#: Form of a segment: a line, a smooth curve without overshoot, or a constant.
Segment = Literal["straight", "smooth", "held"]
SEGMENTS: tuple[Segment, ...] = get_args(Segment)
#: x, y, and the form of the segment that follows.
Breakpoint = tuple[float, float, Segment]


class SlopedPoint(tuple[float, float, Segment]):
    """A breakpoint, x, y and segment, with its own slope for smooth segments.

    It unpacks as any other breakpoint, whose slope follows from its neighbours.

    >>> x, y, segment = SlopedPoint(0.1, 0.5, "smooth", slope=2.0)
    """

    slope: float

    def __new__(cls, x: float, y: float, segment: Segment, slope: float) -> Self:
        """Make a point; `BreakpointsSpec` checks the values."""
        point = super().__new__(cls, (x, y, segment))
        object.__setattr__(point, "slope", slope)
        return point

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{name} of a breakpoint cannot be changed; make another one")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SlopedPoint):
            return False if isinstance(other, tuple) else NotImplemented
        return tuple(self) == tuple(other) and self.slope == other.slope

    def __ne__(self, other: object) -> bool:
        # Python would call that of tuple otherwise.
        equal = self.__eq__(other)
        return equal if equal is NotImplemented else not equal

    def __hash__(self) -> int:
        return hash((*self, self.slope))

    def __repr__(self) -> str:
        return repr((*self, self.slope))

    def __getnewargs__(self) -> tuple[Any, ...]:
        return (*self, self.slope)


def slope_of(point: object) -> float | None:
    """Return the own slope of a breakpoint; None if it has none."""
    return point.slope if isinstance(point, SlopedPoint) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class BreakpointsSpec(Spec):
    """Breakpoints, x never falling; two of equal x are a jump.

    Attributes
    ----------
    x, y
        Specifications of the numbers of a point.
    most
        Most points; there is at least one.
    """

    x: NumberSpec
    y: NumberSpec
    most: int = 10_000

    def checked(self, value: Any) -> tuple[Breakpoint, ...]:
        """Return a tuple of points; a point of two numbers begins a straight segment.

        A fourth number is the own slope of a point, in units of y per unit of x.
        """
        expected = _expected(self)
        if not isinstance(value, tuple) or not 1 <= len(value) <= self.most:
            raise ValidationError(expected)
        try:
            points = tuple(
                point if self._is_normal(point) else self._normalised(point, expected)
                for point in value
            )
        except ValidationError:
            raise ValidationError(expected) from None
        x = [point[0] for point in points]
        if x != sorted(x):
            raise ValidationError(expected)
        # An unchanged tuple keeps its identity.
        return value if all(map(is_, points, value)) else points

    def encoded(self, value: tuple[Breakpoint, ...]) -> Tree:
        """Return a list of lists of three values, or of four where a point has its own slope."""
        return [
            [*point, point.slope] if isinstance(point, SlopedPoint) else list(point)
            for point in value
        ]

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a tuple of tuples; of too long a list, unread."""
        return tuple_of_points(tree, self.most)

    def _is_normal(self, point: Any) -> bool:
        """Whether a point is valid and in the form of `checked`."""
        if type(point) is SlopedPoint:
            if type(point.slope) is not float or not isfinite(point.slope):
                return False
        elif type(point) is not tuple or len(point) != 3:
            return False
        x, y, segment = point
        return (
            type(x) is float
            and type(y) is float
            and self.x.minimum <= x <= self.x.maximum
            and self.y.minimum <= y <= self.y.maximum
            and isfinite(x)
            and isfinite(y)
            and type(segment) is str
            and segment in SEGMENTS
        )

    def _normalised(self, point: Any, expected: str) -> Breakpoint:
        if not isinstance(point, Sequence) or isinstance(point, str) or not 2 <= len(point) <= 4:
            raise ValidationError(expected)
        segment = point[2] if len(point) > 2 else SEGMENTS[0]
        if not isinstance(segment, str) or segment not in SEGMENTS:
            raise ValidationError(expected)
        x, y = float(self.x.checked(point[0])), float(self.y.checked(point[1]))
        slope: Any = point[3] if len(point) == 4 else slope_of(point)
        if slope is None:
            return (x, y, segment)
        return SlopedPoint(x, y, segment, float(NumberSpec(label="Slope").checked(slope)))


@lru_cache(maxsize=64)
def _expected(spec: BreakpointsSpec) -> str:
    return (
        f"1 to {spec.most} points (x, y, segment), x {spec.x.expected} and never falling, "
        f"y {spec.y.expected}, segment {', '.join(SEGMENTS)}, and perhaps a finite slope"
    )
