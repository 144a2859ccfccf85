"""Frequency and amplitude of a glide, each as a curve of its own.

A glide keeps both at the same times.  A curve of one of them has only the points at which it bends;
put back, it keeps the other one as it is.
"""

from bisect import bisect_left, bisect_right
from itertools import pairwise
from typing import Literal

from skinsource.errors import InvalidInputError

Column = Literal["frequency", "amplitude"]
#: (time, value), times never falling; two at one time are a step.
Curve = tuple[tuple[float, float], ...]
#: (time, frequency, amplitude).
Points = tuple[tuple[float, float, float], ...]

_PLACES: dict[str, int] = {"frequency": 1, "amplitude": 2}
#: A point this near to the line between its neighbours, in parts of the larger value, is on it.
_STRAIGHT = 1e-12


def curve_of(points: Points, column: Column) -> Curve:
    """Points at which the frequency, or the amplitude, bends; and both ends.

    >>> curve_of(((0.0, 50.0, 0.0), (0.1, 60.0, 1.0), (0.2, 70.0, 1.0)), "frequency")
    ((0.0, 50.0), (0.2, 70.0))
    """
    place = _PLACES[column]
    return bends_of(tuple((one[0], one[place]) for one in points))


def bends_of(curve: Curve) -> Curve:
    """The same curve without the points that lie on the line between their neighbours."""
    kept = list(curve[:1])
    for here, after in pairwise(curve[1:]):
        if not _is_between(kept[-1], here, after):
            kept.append(here)
    return (*kept, *curve[-1:]) if len(curve) > 1 else curve


def with_curve(points: Points, column: Column, curve: Curve) -> Points:
    """Points of a glide with another curve of frequency, or of amplitude.

    It ends with that curve: the other one is cut there, or held until then.

    Raises
    ------
    InvalidInputError
        The curve has no points.
    """
    if not curve:
        raise InvalidInputError(f"the curve of {column} is empty, expected two points or more")
    other: Column = "amplitude" if column == "frequency" else "frequency"
    kept = curve_of(points, other)
    end_s = curve[-1][0]
    times = sorted({one[0] for one in (*curve, *kept) if one[0] <= end_s})
    found = []
    for time_s in times:
        own, beside = _around(curve, time_s), _around(kept, time_s)
        both = zip(own, beside, strict=True)
        values = [(a, b) if column == "frequency" else (b, a) for a, b in both]
        found += [(time_s, *one) for one in dict.fromkeys(values)]
    return tuple(found)


def _around(curve: Curve, time_s: float) -> tuple[float, float]:
    """Values just before a time, and from it on."""
    first = bisect_left(curve, time_s, key=_time)
    after = bisect_right(curve, time_s, key=_time)
    if first < after:
        return curve[first][1], curve[after - 1][1]
    if first in (0, len(curve)):
        held = curve[max(first - 1, 0)][1]
        return held, held
    (start_s, low), (end_s, high) = curve[first - 1], curve[first]
    value = low + (high - low) * ((time_s - start_s) / (end_s - start_s))
    return value, value


def _time(point: tuple[float, float]) -> float:
    return point[0]


def _is_between(
    before: tuple[float, float], here: tuple[float, float], after: tuple[float, float]
) -> bool:
    """Whether the line from one point to another goes through a third."""
    if not before[0] < here[0] < after[0]:
        return before == here or here == after
    part = (here[0] - before[0]) / (after[0] - before[0])
    line = before[1] + (after[1] - before[1]) * part
    return abs(here[1] - line) <= _STRAIGHT * max(abs(before[1]), abs(after[1]), abs(here[1]))
