"""Curves through breakpoints, and what can be done to their points.

All are pure functions of points, (x, y, segment) with x never falling.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import scipy

from skinsource.arrays import Booleans, Floats
from skinsource.errors import InvalidInputError
from skinsource.fields import SEGMENTS, Breakpoint, Segment
from skinsource.quoting import quoted

Points = tuple[Breakpoint, ...]

#: Points that are closer than this are a jump.
CLOSEST = 1e-9
#: Levels that a point may have.
LOWEST, HIGHEST = 0.0, 1000.0


@dataclass(frozen=True, slots=True, eq=False)
class _Pieces:
    """What is between the points: ends, (n,), and slopes there; which are smooth, which held."""

    x: Floats
    y: Floats
    slope: Floats
    smooth: Booleans
    held: Booleans


def curve_at(points: Points, x: Floats) -> Floats:
    """The curve at ``x``, of its shape; beyond the ends it has the value of the end.

    From the x of several points on it has the value of the last of them.
    """
    pieces = _pieces(points)
    x = np.asarray(x, np.float64)
    if len(points) == 1:
        return np.full(x.shape, pieces.y[0])
    at = np.searchsorted(pieces.x, x, side="right") - 1
    left = np.clip(at, 0, len(points) - 2)
    y0, y1 = pieces.y[left], pieces.y[left + 1]
    length = pieces.x[left + 1] - pieces.x[left]
    jump = length < CLOSEST
    share = np.clip((x - pieces.x[left]) / np.where(jump, 1.0, length), 0.0, 1.0)
    found = np.where(pieces.held[left] & (at < len(points) - 1), y0, y0 + share * (y1 - y0))
    smooth = pieces.smooth[left] & ~jump
    if smooth.any():
        d0, d1 = pieces.slope[left] * length, pieces.slope[left + 1] * length
        cubic = _hermite(share, y0, y1, d0, d1)
        # Rounding alone could pass the ends.
        cubic = np.clip(cubic, np.minimum(y0, y1), np.maximum(y0, y1))
        found = np.where(smooth, cubic, found)
    return np.where(at >= len(points) - 1, pieces.y[-1], found)


def with_point(points: Points, x: float) -> Points:
    """The points with one more at ``x``, on the curve.

    A straight or held curve stays as it was to the last bit but rounding.  A smooth one goes
    through the new point too, and changes beside it by a little, because its slopes follow from
    its points.
    """
    before = [point for point in points if point[0] <= x]
    segment = before[-1][2] if before else SEGMENTS[0]
    y = float(curve_at(points, np.array([x]))[0])
    return (*before, (float(x), y, segment), *points[len(before) :])


def with_point_after(points: Points, index: int, end_x: float) -> tuple[Points, int]:
    """The points with one more on the curve, halfway from one to the next; and its number.

    After the last one it is halfway to ``end_x``, or where that lies before it as far beyond it.
    """
    index = min(max(index, 0), len(points) - 1)
    x = points[index][0]
    following = points[index + 1][0] if index + 1 < len(points) else end_x
    half = abs(following - x) / 2.0
    added = with_point(points, x + half)
    return added, next(k for k in range(index + 1, len(added)) if added[k][0] == x + half)


def without(points: Points, indices: Iterable[int]) -> Points:
    """The points without some; of all of them the first one stays."""
    gone = set(indices)
    return tuple(point for k, point in enumerate(points) if k not in gone) or points[:1]


def with_segment(points: Points, index: int, segment: Segment) -> Points:
    """The points, where the curve goes on otherwise after one.

    Raises
    ------
    InvalidInputError
        No segment is called so.
    """
    if segment not in SEGMENTS:
        raise InvalidInputError(
            f"segment {quoted(segment)} is not known; choose from {', '.join(SEGMENTS)}"
        )
    return tuple(
        (x, y, segment) if k == index else (x, y, own) for k, (x, y, own) in enumerate(points)
    )


def moved(points: Points, indices: Iterable[int], by_x: float, by_y: float) -> Points:
    """The points with some moved together, as far along as those that stay leave room.

    Their x stays 0 or more, their y within what is allowed.
    """
    chosen = _present(points, indices)
    back, forth = -np.inf, np.inf
    for k in chosen:
        x = points[k][0]
        back = max(back, (points[k - 1][0] if k and k - 1 not in chosen else 0.0) - x)
        if k + 1 < len(points) and k + 1 not in chosen:
            forth = min(forth, points[k + 1][0] - x)
    step = float(np.clip(by_x, min(back, 0.0), max(forth, 0.0)))
    found: list[Breakpoint] = []
    for k, (x, y, segment) in enumerate(points):
        if k not in chosen:
            found.append((x, y, segment))
            continue
        # The sum may pass a point that stays by its last digit.
        stays = next((points[m][0] for m in range(k, len(points)) if m not in chosen), np.inf)
        least = found[-1][0] if found else 0.0
        found.append(_at(min(max(x + step, least), stays), y + by_y, segment))
    return tuple(found)


def scaled(
    points: Points,
    indices: Iterable[int],
    about: Sequence[float],
    factor_x: float,
    factor_y: float,
) -> Points:
    """The points with some scaled about a place, (x, y), within the room between the others."""
    chosen = _present(points, indices)
    found = list(points)
    least = 0.0
    for k, (x, y, segment) in enumerate(points):
        if k in chosen:
            most = next((points[m][0] for m in range(k, len(points)) if m not in chosen), np.inf)
            to_x = about[0] + max(factor_x, 0.0) * (x - about[0])
            to_y = about[1] + factor_y * (y - about[1])
            found[k] = _at(min(max(to_x, least), most), to_y, segment)
        least = found[k][0]
    return tuple(found)


def _present(points: Points, indices: Iterable[int]) -> set[int]:
    return {k for k in indices if 0 <= k < len(points)}


def _at(x: float, y: float, segment: Segment) -> Breakpoint:
    return max(float(x), 0.0), float(min(max(y, LOWEST), HIGHEST)), segment


def _hermite(share: Any, y0: Any, y1: Any, d0: Any, d1: Any) -> Any:
    """Cubic from y0 to y1 with the rises d0 and d1 over the whole length."""
    rest = 1.0 - share
    bend = share * rest * (rest * (d0 - (y1 - y0)) - share * (d1 - (y1 - y0)))
    return y0 + share * (y1 - y0) + bend


@lru_cache(maxsize=64)
def _pieces(points: Points) -> _Pieces:
    x, y = (np.array([point[k] for point in points], np.float64) for k in (0, 1))
    kinds = np.array([point[2] for point in points])
    slope = np.zeros(len(points))
    # What is smooth does not look beyond a jump; a held segment ends with one.
    breaks = np.flatnonzero((np.diff(x) < CLOSEST) | (kinds[:-1] == "held")) + 1
    for run in np.split(np.arange(len(points)), breaks):
        if len(run) > 1 and (kinds[run[:-1]] == "smooth").any():
            slope[run] = scipy.interpolate.PchipInterpolator(x[run], y[run]).derivative()(x[run])
    return _Pieces(x, y, slope, kinds == "smooth", kinds == "held")
