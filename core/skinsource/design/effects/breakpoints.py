"""Evaluate curves through breakpoints, and edit their points.

All are pure functions of points, (x, y, segment), whose x never falls.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from skinsource.base.arguments import one_of
from skinsource.base.conventions import Booleans, Floats
from skinsource.specs.breakpoints import SEGMENTS, Breakpoint, Segment, SlopedPoint, slope_of

Points = tuple[Breakpoint, ...]

#: Two points that are closer than this make a jump.
CLOSEST = 1e-9
#: Levels that a point may have.
LOWEST, HIGHEST = 0.0, 1000.0
# Distance of a second point from a single one at the end of its curve.
_SECOND_POINT_X = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class _Pieces:
    """The points as arrays, (n,), with slopes, and which segments are smooth or held.

    ``bent`` are the points whose slope matters: ends of smooth segments.
    """

    x: Floats
    y: Floats
    slope: Floats
    smooth: Booleans
    held: Booleans
    bent: Booleans


def curve_at(points: Points, x: Floats) -> Floats:
    """Return the curve at ``x``, of its shape; beyond an end it has the value of that end.

    At the x of several points it has the value of the last of them.
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
        # The cubic with end slopes d0 and d1, per length of the segment.
        rest = 1.0 - share
        bend = share * rest * (rest * (d0 - (y1 - y0)) - share * (d1 - (y1 - y0)))
        cubic = y0 + share * (y1 - y0) + bend
        # Rounding could pass the levels of the ends.
        cubic = np.clip(cubic, np.minimum(y0, y1), np.maximum(y0, y1))
        values = np.where(smooth, cubic, values)
    return np.where(index >= len(points) - 1, pieces.y[-1], values)


def with_point(points: Points, x: float) -> Points:
    """Add a point on the curve at ``x``; the curve changes by rounding alone.

    Slopes keep smooth segments as they are: the new point gets the slope of the curve, and
    neighbours whose slope would change keep the one that they had.  Beyond the last point the
    curve stays level.
    """
    x = float(x)
    new_index = index_for(points, x)
    segment = points[new_index - 1][2] if new_index else SEGMENTS[0]
    y = float(curve_at(points, np.array([x]))[0])
    new: Breakpoint = (x, y, segment)
    if segment == "smooth" and new_index < len(points):
        new = SlopedPoint(x, y, segment, _slope_at(points, new_index - 1, x))
    new_points = [*points[:new_index], new, *points[new_index:]]
    if new_index == len(points) and segment == "smooth":
        new_points[-2] = _with_slope_of(points[-1], *points[-1][:2], "straight")
    before, after = _pieces(points), _pieces(tuple(new_points))
    rounding = 1e-12 * float(np.abs(before.slope).max())
    for k in np.flatnonzero(before.bent).tolist():
        index, slope = (k if k < new_index else k + 1), float(before.slope[k])
        if abs(after.slope[index] - slope) > rounding:
            new_points[index] = SlopedPoint(*new_points[index], slope=slope)
    return tuple(new_points)


def index_for(points: Points, x: float) -> int:
    """Return the index for a new point at ``x``: after all points that are not later."""
    return sum(point[0] <= x for point in points)


def with_point_after(points: Points, index: int, end_x: float) -> tuple[Points, int]:
    """Add a point on the curve halfway from one to the next; return the points and its index.

    After the last point it lies halfway to ``end_x``, or as far beyond the last point if ``end_x``
    lies before it; if they are equal, as far beyond as to the middle of the segment before.
    """
    index = min(max(index, 0), len(points) - 1)
    x = points[index][0]
    following = points[index + 1][0] if index + 1 < len(points) else end_x
    if index + 1 == len(points) and following == x:
        following = points[index - 1][0] if index else x + _SECOND_POINT_X
    half = abs(following - x) / 2.0
    added = with_point(points, x + half)
    return added, next(k for k in range(index + 1, len(added)) if added[k][0] == x + half)


def with_point_put(
    points: Points, x: float, y: float, highest: float = HIGHEST
) -> tuple[Points, int]:
    """Add a point at (x, y), with y from 0 to ``highest``; return the points and its index."""
    x = max(float(x), 0.0)
    added, index = with_point(points, x), index_for(points, x)
    by_y = min(max(y, LOWEST), highest) - added[index][1]
    return moved(added, (index,), 0.0, by_y), index


def without_chosen(points: Points, indices: Iterable[int]) -> tuple[Points, int]:
    """Remove points; return the rest and the index to select, before the first removed one."""
    removed = set(indices)
    return without(points, removed), max(min(removed, default=1) - 1, 0)


def without(points: Points, indices: Iterable[int]) -> Points:
    """Remove points; if these are all, the first one stays."""
    removed = set(indices)
    stay = [k for k in range(len(points)) if k not in removed] or [0]
    next_to_gap = {k for k in range(1, len(stay)) if stay[k] - stay[k - 1] > 1}
    return _settled(tuple(points[k] for k in stay), next_to_gap)


def with_segment(points: Points, index: int, segment: Segment) -> Points:
    """Change the kind of the segment after a point.

    Raises
    ------
    InvalidInputError
        No kind of segment has this name.
    """
    one_of("segment", segment, SEGMENTS)
    return tuple(
        _with_slope_of(point, *point[:2], segment) if k == index else point
        for k, point in enumerate(points)
    )


def moved(points: Points, indices: Iterable[int], by_x: float, by_y: float) -> Points:
    """Move points together, along x only as far as the other points leave room.

    Their x stays 0 or more, their y within the allowed levels.
    """
    chosen = {k for k in indices if 0 <= k < len(points)}
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
        # Rounding of the sum could pass a point that stays.
        stays = next((points[m][0] for m in range(k, len(points)) if m not in chosen), np.inf)
        least = moved_points[-1][0] if moved_points else 0.0
        moved_points.append(_moved_to(point, min(max(x + step, least), stays), y + by_y))
    return _settled(tuple(moved_points), chosen)


def scaled(
    points: Points,
    indices: Iterable[int],
    about: Sequence[float],
    factor_x: float,
    factor_y: float,
) -> Points:
    """Scale points about a centre, (x, y), within the room between the others."""
    chosen = {k for k in indices if 0 <= k < len(points)}
    scaled_points = list(points)
    least = 0.0
    for k, point in enumerate(points):
        x, y, _ = point
        if k in chosen:
            most = next((points[m][0] for m in range(k, len(points)) if m not in chosen), np.inf)
            to_x = about[0] + max(factor_x, 0.0) * (x - about[0])
            to_y = about[1] + factor_y * (y - about[1])
            scaled_points[k] = _moved_to(point, min(max(to_x, least), most), to_y)
            slope = slope_of(point)
            if slope is not None and factor_x > 0.0:
                scaled_points[k] = SlopedPoint(*scaled_points[k], slope=slope * factor_y / factor_x)
        least = scaled_points[k][0]
    return _settled(tuple(scaled_points), chosen)


def _moved_to(point: Breakpoint, x: float, y: float) -> Breakpoint:
    return _with_slope_of(point, max(float(x), 0.0), float(min(max(y, LOWEST), HIGHEST)), point[2])


def _with_slope_of(point: Breakpoint, x: float, y: float, segment: Segment) -> Breakpoint:
    """Return another point with the slope of ``point``, if that has one."""
    slope = slope_of(point)
    return (x, y, segment) if slope is None else SlopedPoint(x, y, segment, slope)


def _settled(points: Points, moved_ones: Iterable[int]) -> Points:
    """Limit own slopes next to moved points, so that the curve stays between its points.

    With an old slope the curve could pass the level of the next point.  The limit is the slope with
    which a cubic surely rises, or falls, throughout.
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
    """Whether the cubic with these slopes at its ends rises, or falls, throughout."""
    if rise == 0.0:
        return slope0 == slope1 == 0.0
    a, b = slope0 / rise, slope1 / rise
    # The region of Fritsch and Carlson: a triangle and an ellipse.
    return min(a, b) >= 0.0 and (a + b <= 3.0 or a * a + a * (b - 6.0) + (b - 3.0) ** 2 <= 1e-9)


def _slope_at(points: Points, left: int, x: float) -> float:
    """Return the slope at ``x`` of the smooth segment after the point ``left``."""
    pieces = _pieces(points)
    length = float(pieces.x[left + 1] - pieces.x[left])
    if length < CLOSEST:
        return 0.0
    share = (x - float(pieces.x[left])) / length
    rise = float(pieces.y[left + 1] - pieces.y[left]) / length
    d0, d1 = float(pieces.slope[left]), float(pieces.slope[left + 1])
    steep = 6.0 * share * (1.0 - share) * rise
    return steep + (1.0 - share) * (1.0 - 3.0 * share) * d0 + share * (3.0 * share - 2.0) * d1


@lru_cache(maxsize=64)
def _pieces(points: Points) -> _Pieces:
    segments = [point[2] for point in points]
    x, y = (np.array([point[k] for point in points], np.float64) for k in (0, 1))
    smooth, held = (
        np.array([segment == name for segment in segments]) for name in ("smooth", "held")
    )
    slope = np.zeros(len(points))
    # Slopes do not depend on points beyond a jump; a held segment ends with one.
    breaks = np.flatnonzero((np.diff(x) < CLOSEST) | held[:-1]) + 1
    # Without a smooth segment no slope is needed.
    for run in np.split(np.arange(len(points)), breaks) if smooth.any() else ():
        if len(run) > 1 and smooth[run[:-1]].any():
            with np.errstate(over="ignore"):  # next to a tiny step the slope is 0
                curve = scipy.interpolate.PchipInterpolator(x[run], y[run])
            slope[run] = curve.derivative()(x[run])
    for k, point in enumerate(points):
        if type(point) is SlopedPoint:
            slope[k] = point.slope
    before_smooth = np.append(smooth[:-1], False)
    bent = before_smooth | np.append(False, before_smooth[:-1])
    return _Pieces(x, y, slope, smooth, held, bent)
