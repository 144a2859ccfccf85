"""Curves through breakpoints, and what can be done to their points.

All are pure functions of points, (x, y, segment) with x never falling.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import scipy

from skinsource.base.arrays import Booleans, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import quoted
from skinsource.specs.breakpoints import SEGMENTS, Breakpoint, Segment, SlopedPoint, slope_of

Points = tuple[Breakpoint, ...]

#: Points that are closer than this are a jump.
CLOSEST = 1e-9
#: Levels that a point may have.
LOWEST, HIGHEST = 0.0, 1000.0
# Beside a point that stands alone where its curve ends.
_ALONE_X = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class _Pieces:
    """What is between the points: ends, (n,), and slopes there; which are smooth, which held.

    ``bent`` are those whose slope counts: an end of something smooth.
    """

    x: Floats
    y: Floats
    slope: Floats
    smooth: Booleans
    held: Booleans
    bent: Booleans


def curve_at(points: Points, x: Floats) -> Floats:
    """The curve at ``x``, of its shape; beyond the ends it has the value of the end.

    From the x of several points on it has the value of the last of them.
    """
    pieces = _pieces(points)
    x = np.asarray(x, np.float64)
    if len(points) == 1:
        return np.full(x.shape, pieces.y[0])
    index = np.searchsorted(pieces.x, x, side="right") - 1
    left = np.clip(index, 0, len(points) - 2)
    y0, y1 = pieces.y[left], pieces.y[left + 1]
    length = pieces.x[left + 1] - pieces.x[left]
    jump = length < CLOSEST
    share = np.clip((x - pieces.x[left]) / np.where(jump, 1.0, length), 0.0, 1.0)
    values = np.where(pieces.held[left] & (index < len(points) - 1), y0, y0 + share * (y1 - y0))
    smooth = pieces.smooth[left] & ~jump
    if smooth.any():
        d0, d1 = pieces.slope[left] * length, pieces.slope[left + 1] * length
        cubic = _hermite(share, y0, y1, d0, d1)
        # Rounding alone could pass the ends.
        cubic = np.clip(cubic, np.minimum(y0, y1), np.maximum(y0, y1))
        values = np.where(smooth, cubic, values)
    return np.where(index >= len(points) - 1, pieces.y[-1], values)


def with_point(points: Points, x: float) -> Points:
    """The points with one more at ``x``, on the curve, which stays as it was but for rounding.

    What is smooth keeps its course by slopes: the new point takes that of the curve, and those
    whose slope would follow from it keep the one that they had.  Beyond the last point it goes on
    straight, as level as it was.
    """
    x = float(x)
    place = place_of(points, x)
    segment = points[place - 1][2] if place else SEGMENTS[0]
    y = float(curve_at(points, np.array([x]))[0])
    new: Breakpoint = (x, y, segment)
    if segment == "smooth" and place < len(points):
        new = SlopedPoint(x, y, segment, _slope_at(points, place - 1, x))
    new_points = [*points[:place], new, *points[place:]]
    if place == len(points) and segment == "smooth":
        new_points[-2] = _like(points[-1], *points[-1][:2], "straight")
    before, after = _pieces(points), _pieces(tuple(new_points))
    rounding = 1e-12 * float(np.abs(before.slope).max())
    for k in np.flatnonzero(before.bent).tolist():
        index, slope = (k if k < place else k + 1), float(before.slope[k])
        if abs(after.slope[index] - slope) > rounding:
            new_points[index] = SlopedPoint(*new_points[index], slope=slope)
    return tuple(new_points)


def place_of(points: Points, x: float) -> int:
    """Where in the list a point at ``x`` is put: behind those that are not later."""
    return sum(point[0] <= x for point in points)


def with_point_after(points: Points, index: int, end_x: float) -> tuple[Points, int]:
    """The points with one more on the curve, halfway from one to the next; and its number.

    After the last one it is halfway to ``end_x``, or where that lies before it as far beyond it;
    where that is its own x, as far beyond it as to the middle of what comes before.
    """
    index = min(max(index, 0), len(points) - 1)
    x = points[index][0]
    following = points[index + 1][0] if index + 1 < len(points) else end_x
    if index + 1 == len(points) and following == x:
        following = points[index - 1][0] if index else x + _ALONE_X
    half = abs(following - x) / 2.0
    added = with_point(points, x + half)
    return added, next(k for k in range(index + 1, len(added)) if added[k][0] == x + half)


def with_point_put(
    points: Points, x: float, y: float, highest: float = HIGHEST
) -> tuple[Points, int]:
    """The points with one more just there, within 0 and ``highest``; and its number."""
    x = max(float(x), 0.0)
    added, index = with_point(points, x), place_of(points, x)
    by_y = min(max(y, LOWEST), highest) - added[index][1]
    return moved(added, (index,), 0.0, by_y), index


def without_chosen(points: Points, indices: Iterable[int]) -> tuple[Points, int]:
    """The points without some, and the one that is chosen then: the one before the first gone."""
    removed = set(indices)
    return without(points, removed), max(min(removed, default=1) - 1, 0)


def without(points: Points, indices: Iterable[int]) -> Points:
    """The points without some; of all of them the first one stays."""
    removed = set(indices)
    stay = [k for k in range(len(points)) if k not in removed] or [0]
    # Those beside a gap.
    next_to_gap = {k for k in range(1, len(stay)) if stay[k] - stay[k - 1] > 1}
    return _settled(tuple(points[k] for k in stay), next_to_gap)


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
        _like(point, *point[:2], segment) if k == index else point for k, point in enumerate(points)
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
    moved_points: list[Breakpoint] = []
    for k, point in enumerate(points):
        x, y, _ = point
        if k not in chosen:
            moved_points.append(point)
            continue
        # The sum may pass a point that stays by its last digit.
        stays = next((points[m][0] for m in range(k, len(points)) if m not in chosen), np.inf)
        least = moved_points[-1][0] if moved_points else 0.0
        moved_points.append(_at(point, min(max(x + step, least), stays), y + by_y))
    return _settled(tuple(moved_points), chosen)


def scaled(
    points: Points,
    indices: Iterable[int],
    about: Sequence[float],
    factor_x: float,
    factor_y: float,
) -> Points:
    """The points with some scaled about a place, (x, y), within the room between the others."""
    chosen = _present(points, indices)
    scaled_points = list(points)
    least = 0.0
    for k, point in enumerate(points):
        x, y, _ = point
        if k in chosen:
            most = next((points[m][0] for m in range(k, len(points)) if m not in chosen), np.inf)
            to_x = about[0] + max(factor_x, 0.0) * (x - about[0])
            to_y = about[1] + factor_y * (y - about[1])
            scaled_points[k] = _at(point, min(max(to_x, least), most), to_y)
            slope = slope_of(point)
            if slope is not None and factor_x > 0.0:
                scaled_points[k] = SlopedPoint(*scaled_points[k], slope=slope * factor_y / factor_x)
        least = scaled_points[k][0]
    return _settled(tuple(scaled_points), chosen)


def _present(points: Points, indices: Iterable[int]) -> set[int]:
    return {k for k in indices if 0 <= k < len(points)}


def _at(point: Breakpoint, x: float, y: float) -> Breakpoint:
    """A point at another place."""
    return _like(point, max(float(x), 0.0), float(min(max(y, LOWEST), HIGHEST)), point[2])


def _like(point: Breakpoint, x: float, y: float, segment: Segment) -> Breakpoint:
    """Another point with the slope, if any, of ``point``."""
    slope = slope_of(point)
    return (x, y, segment) if slope is None else SlopedPoint(x, y, segment, slope)


def _settled(points: Points, moved_ones: Iterable[int]) -> Points:
    """The points, with slopes of their own as steep as the curve can be where some were moved.

    Beside a moved point a slope that was kept may lead beyond the level of the next one; it is
    made as steep as a cubic surely can be that rises, or falls, throughout.
    """
    if SlopedPoint not in set(map(type, points)):
        return points
    settled = list(points)
    pieces = _pieces(points)
    for k in sorted({k + d for k in moved_ones for d in (-1, 0)}):
        if not 0 <= k < len(points) - 1 or not pieces.smooth[k]:
            continue
        length = pieces.x[k + 1] - pieces.x[k]
        rise = (pieces.y[k + 1] - pieces.y[k]) / max(length, CLOSEST)
        if length < CLOSEST or _is_monotone(rise, pieces.slope[k], pieces.slope[k + 1]):
            continue
        for end in (k, k + 1):
            slope = slope_of(settled[end])
            if slope is not None:
                within = float(np.clip(slope, min(0.0, 3.0 * rise), max(0.0, 3.0 * rise)))
                settled[end] = SlopedPoint(*settled[end], slope=within)
    return tuple(settled)


def _is_monotone(rise: float, slope0: float, slope1: float) -> bool:
    """Whether the cubic of these slopes at its ends rises, or falls, throughout."""
    if rise == 0.0:
        return slope0 == slope1 == 0.0
    a, b = slope0 / rise, slope1 / rise
    # The region of Fritsch and Carlson: a triangle and an ellipse.
    return min(a, b) >= 0.0 and (a + b <= 3.0 or a * a + a * (b - 6.0) + (b - 3.0) ** 2 <= 1e-9)


def _slope_at(points: Points, left: int, x: float) -> float:
    """The slope of the smooth curve after a point, at an ``x`` before the next one."""
    pieces = _pieces(points)
    length = float(pieces.x[left + 1] - pieces.x[left])
    if length < CLOSEST:
        return 0.0
    share = (x - float(pieces.x[left])) / length
    rise = float(pieces.y[left + 1] - pieces.y[left]) / length
    d0, d1 = float(pieces.slope[left]), float(pieces.slope[left + 1])
    steep = 6.0 * share * (1.0 - share) * rise
    return steep + (1.0 - share) * (1.0 - 3.0 * share) * d0 + share * (3.0 * share - 2.0) * d1


def _hermite(share: Any, y0: Any, y1: Any, d0: Any, d1: Any) -> Any:
    """Cubic from y0 to y1 with the rises d0 and d1 over the whole length."""
    rest = 1.0 - share
    bend = share * rest * (rest * (d0 - (y1 - y0)) - share * (d1 - (y1 - y0)))
    return y0 + share * (y1 - y0) + bend


@lru_cache(maxsize=64)
def _pieces(points: Points) -> _Pieces:
    kinds = [point[2] for point in points]
    x, y = (np.array([point[k] for point in points], np.float64) for k in (0, 1))
    smooth, held = (np.array([segment == kind for segment in kinds]) for kind in ("smooth", "held"))
    slope = np.zeros(len(points))
    # What is smooth does not look beyond a jump; a held segment ends with one.
    breaks = np.flatnonzero((np.diff(x) < CLOSEST) | held[:-1]) + 1
    # Where nothing is smooth, no slope follows from the points beside.
    for run in np.split(np.arange(len(points)), breaks) if smooth.any() else ():
        if len(run) > 1 and smooth[run[:-1]].any():
            with np.errstate(over="ignore"):  # beside a step of next to nothing it is level
                curve = scipy.interpolate.PchipInterpolator(x[run], y[run])
            slope[run] = curve.derivative()(x[run])
    for k, point in enumerate(points):
        if type(point) is SlopedPoint:
            slope[k] = point.slope
    before_smooth = np.append(smooth[:-1], False)
    bent = before_smooth | np.append(False, before_smooth[:-1])
    return _Pieces(x, y, slope, smooth, held, bent)
