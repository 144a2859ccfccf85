"""Breakpoints: points of a curve that say how it goes on after each."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from operator import is_
from typing import Any, Literal, get_args

from skinsource.fields.numbers import NumberSpec
from skinsource.fields.spec import Address, Misfit, Spec, Tree

#: How a curve goes on: by a line, smoothly without passing its points, or as it is.
Segment = Literal["straight", "smooth", "held"]
SEGMENTS: tuple[Segment, ...] = get_args(Segment)
#: x, y, and how the curve goes on.
Breakpoint = tuple[float, float, Segment]


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
        """Return a tuple of points; the segment after one of two numbers is straight."""
        expected = (
            f"1 to {self.most} points (x, y, segment), x {self.x.expected} and never falling, "
            f"y {self.y.expected}, segment {', '.join(SEGMENTS)}"
        )
        if not isinstance(value, tuple) or not 1 <= len(value) <= self.most:
            raise Misfit(expected)
        try:
            points = tuple(
                point if self._is_kept(point) else self._point(point, expected) for point in value
            )
        except Misfit:
            raise Misfit(expected) from None
        if any(after[0] < before[0] for before, after in pairwise(points)):
            raise Misfit(expected)
        # What is as it was keeps its identity.
        return value if all(map(is_, points, value)) else points

    def encoded(self, value: tuple[Breakpoint, ...]) -> Tree:
        """Return a list of lists."""
        return [list(point) for point in value]

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return a tuple of tuples; of too long a list, unread."""
        del at
        if not isinstance(tree, list) or len(tree) > self.most:
            return tree
        return tuple(tuple(point) if isinstance(point, list) else point for point in tree)

    def _is_kept(self, point: Any) -> bool:
        """Whether a point is in the form that points are kept in; most are, when one is dragged."""
        if type(point) is not tuple or len(point) != 3:
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
        if not isinstance(point, Sequence) or isinstance(point, str) or len(point) not in (2, 3):
            raise Misfit(expected)
        segment = point[2] if len(point) == 3 else SEGMENTS[0]
        if segment not in SEGMENTS:
            raise Misfit(expected)
        return float(self.x.checked(point[0])), float(self.y.checked(point[1])), segment
