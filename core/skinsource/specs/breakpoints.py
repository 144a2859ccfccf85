"""Breakpoints: points of a curve that say how it goes on after each."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite
from operator import is_
from typing import Any, Literal, Self, get_args

from skinsource.base.json_text import Tree
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import Address, Spec, ValidationError

#: How a curve goes on: by a line, smoothly without passing its points, or as it is.
Segment = Literal["straight", "smooth", "held"]
SEGMENTS: tuple[Segment, ...] = get_args(Segment)
#: x, y, and how the curve goes on.
Breakpoint = tuple[float, float, Segment]


class SlopedPoint(tuple[float, float, Segment]):
    """A breakpoint, x, y and segment, with a slope of its own: what is smooth leaves it so.

    It unpacks as any other breakpoint.  Of one without, the slope follows from its neighbours.

    >>> x, y, segment = SlopedPoint(0.1, 0.5, "smooth", slope=2.0)
    """

    slope: float

    def __new__(cls, x: float, y: float, segment: Segment, slope: float) -> Self:
        """Make a point; what its values may be is for `BreakpointsSpec` to say."""
        made = super().__new__(cls, (x, y, segment))
        object.__setattr__(made, "slope", slope)
        return made

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{name} of a breakpoint cannot be changed; make another one")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SlopedPoint):
            return False if isinstance(other, tuple) else NotImplemented
        return tuple(self) == tuple(other) and self.slope == other.slope

    def __ne__(self, other: object) -> bool:
        # Without this one the tuple's own would be asked.
        equal = self.__eq__(other)
        return equal if equal is NotImplemented else not equal

    def __hash__(self) -> int:
        return hash((*self, self.slope))

    def __repr__(self) -> str:
        return repr((*self, self.slope))

    def __getnewargs__(self) -> tuple[Any, ...]:
        return (*self, self.slope)


def slope_of(point: Breakpoint) -> float | None:
    """The slope of its own that a breakpoint has, or None."""
    return point.slope if isinstance(point, SlopedPoint) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class BreakpointsSpec(Spec):
    """Breakpoints, x never falling; two of equal x are a jump.

    Attributes
    ----------
    x, y
        What the numbers of a point may be.
    most
        How many points there may be; there is at least one.
    """

    x: NumberSpec
    y: NumberSpec
    most: int = 10_000

    def checked(self, value: Any) -> tuple[Breakpoint, ...]:
        """Return a tuple of points; the segment after one of two numbers is straight.

        A fourth number is the slope of a point's own, in units of y per unit of x.
        """
        expected = _expected(self)
        if not isinstance(value, tuple) or not 1 <= len(value) <= self.most:
            raise ValidationError(expected)
        # While one of many points is dragged, the others are those that were checked before.
        before = _checked.get(self, ())
        known = before if len(before) == len(value) else (_NO_POINT,) * len(value)
        try:
            points = tuple(
                point if point is same or self._is_kept(point) else self._point(point, expected)
                for point, same in zip(value, known, strict=True)
            )
        except ValidationError:
            raise ValidationError(expected) from None
        x = [point[0] for point in points]
        if x != sorted(x):
            raise ValidationError(expected)
        # What is as it was keeps its identity.
        points = value if all(map(is_, points, value)) else points
        if len(_checked) >= _MOST_CHECKED:
            _checked.clear()
        _checked[self] = points
        return points

    def encoded(self, value: tuple[Breakpoint, ...]) -> Tree:
        """Return a list of lists of three values, or of four where a point has its own slope."""
        return [
            [*point, point.slope] if isinstance(point, SlopedPoint) else list(point)
            for point in value
        ]

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a tuple of tuples; of too long a list, unread."""
        del at
        if not isinstance(tree, list) or len(tree) > self.most:
            return tree
        return tuple(tuple(point) if isinstance(point, list) else point for point in tree)

    def _is_kept(self, point: Any) -> bool:
        """Whether a point is in the form that points are kept in; most are, when one is dragged."""
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

    def _point(self, point: Any, expected: str) -> Breakpoint:
        if not isinstance(point, Sequence) or isinstance(point, str) or not 2 <= len(point) <= 4:
            raise ValidationError(expected)
        segment = point[2] if len(point) > 2 else SEGMENTS[0]
        if not isinstance(segment, str) or segment not in SEGMENTS:
            raise ValidationError(expected)
        x, y = float(self.x.checked(point[0])), float(self.y.checked(point[1]))
        slope = point.slope if isinstance(point, SlopedPoint) else None
        slope = point[3] if len(point) == 4 else slope
        return (x, y, segment) if slope is None else SlopedPoint(x, y, segment, _slope(slope))


# By specification, the points that fitted it last.  They are kept, so that no other point can take
# the place of one in memory.
_checked: "dict[BreakpointsSpec, tuple[Breakpoint, ...]]" = {}
_MOST_CHECKED = 16
# In the place of a point that was checked: none is the same, not even None.
_NO_POINT = object()


@lru_cache(maxsize=64)
def _expected(spec: BreakpointsSpec) -> str:
    return (
        f"1 to {spec.most} points (x, y, segment), x {spec.x.expected} and never falling, "
        f"y {spec.y.expected}, segment {', '.join(SEGMENTS)}, and perhaps a finite slope"
    )


def _slope(value: Any) -> float:
    return float(NumberSpec(label="Slope").checked(value))
