"""Which outputs an outline vertex sees, and which two it takes its value from.

The rule was found to give the published map's table of distances, pair by pair: the outline is
drawn on a raster of one pixel, widened by two pixels, and its border traced through pixel
centres; a vertex sees an output if the straight line between them stays inside that border.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arrays import Booleans, Floats, Indices
from skinsource.surface.polygon import grid_inside, ranges

#: Raster units in one hand length; two of them, 0.5 % of it, are the rule's tolerance.
UNITS_PER_HAND = 398.1
_WIDENING = 2
_MOST_UNITS = 2500
_TOLERANCE = 1e-9
_SEGMENTS_PER_CHUNK = 4096


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SightRegion:
    """The widened outline on a raster.

    Attributes
    ----------
    origin : (2,)
        Coordinates of the centre of raster point (row 0, column 0).
    unit
        Distance between raster points.
    filled : (n_rows, n_columns) of bool
        Rows along y; empty along its rim.
    """

    origin: Floats
    unit: float
    filled: Booleans

    def raster_coordinates(self, points: Floats) -> Floats:
        """Return points (n_points, 2) in raster units: column, row."""
        return (points - self.origin) / self.unit


def raster_unit(outline: Floats, hand_length: float) -> float:
    """Return the raster's unit for an outline (n_vertices, 2) and its hand length.

    Rounded to three digits, so that it is exactly one pixel on the published map, whose vertices
    then are raster points.  Coarser where the hand length is tiny beside the outline, so that
    the raster stays small.
    """
    smallest = float(np.ptp(outline, axis=0).max()) / _MOST_UNITS
    return float(f"{max(hand_length / UNITS_PER_HAND, smallest):.3g}")


def sight_region(outline: Floats, unit: float) -> SightRegion:
    """Draw the outline (n_vertices, 2) on a raster and widen it."""
    margin = _WIDENING + 2
    low = np.floor(outline.min(axis=0) / unit) - margin
    high = np.ceil(outline.max(axis=0) / unit) + margin
    column, row = (np.arange(a, b + 1) for a, b in zip(low, high, strict=True))
    filled = grid_inside(outline / unit, column, row)
    # A tip may be too thin to hold a raster point.
    near = np.round(outline / unit - low).astype(np.intp)
    filled[near[:, 1], near[:, 0]] = True
    square = np.ones((2 * _WIDENING + 1, 2 * _WIDENING + 1), dtype=bool)
    filled = scipy.ndimage.binary_fill_holes(scipy.ndimage.binary_dilation(filled, square))
    return SightRegion(origin=low * unit, unit=unit, filled=np.asarray(filled))


def sees(region: SightRegion, starts: Floats, ends: Floats) -> Booleans:
    """Whether each straight line from ``starts`` to ``ends``, both (n, 2), stays inside."""
    inside = np.empty(len(starts), dtype=bool)
    for first in range(0, len(starts), _SEGMENTS_PER_CHUNK):
        part = slice(first, first + _SEGMENTS_PER_CHUNK)
        start = region.raster_coordinates(starts[part])
        end = region.raster_coordinates(ends[part])
        inside[part] = _holds_points(region.filled, start) & _holds_points(region.filled, end)
        # Between two raster lines the border is convex, so it is enough to look at the lines.
        for axis in (0, 1):
            _close_crossings(region.filled, start, end, axis, inside[part])
    return inside


def _holds_points(filled: Booleans, points: Floats) -> Booleans:
    """Whether each point lies in the hull of the filled corners of its raster cell."""
    cell = np.floor(points)
    aside = points - cell
    corner = np.array([(0, 0), (1, 0), (0, 1), (1, 1)])
    # The sides of such a hull have one of these eight directions.
    outward = np.array([(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)])
    at = cell.astype(np.intp)[:, None] + corner
    reach = np.where(_look_up(filled, at)[:, None, :], outward @ corner.T, -np.inf).max(axis=2)
    return np.asarray(np.all(aside @ outward.T <= reach + _TOLERANCE, axis=1))


def _look_up(filled: Booleans, at: Indices) -> Booleans:
    """Filled or not at (…, 2) of column, row; empty beyond the raster."""
    last = np.array(filled.shape)[::-1] - 1
    column, row = np.moveaxis(np.clip(at, 0, last), -1, 0)
    return np.asarray(filled[row, column])


def _close_crossings(
    filled: Booleans, start: Floats, end: Floats, axis: int, inside: Booleans
) -> None:
    """Set ``inside`` to False where a segment leaves across a raster line of constant ``axis``."""
    low = np.minimum(start[:, axis], end[:, axis])
    high = np.maximum(start[:, axis], end[:, axis])
    owner, line = ranges(
        np.floor(low).astype(np.intp) + 1, np.where(inside, np.ceil(high), low).astype(np.intp)
    )
    run = end[owner] - start[owner]
    along = start[owner, 1 - axis] + run[:, 1 - axis] * (line - start[owner, axis]) / run[:, axis]
    at = np.empty((len(owner), 2, 2), dtype=np.intp)
    at[:, :, axis] = line[:, None]
    at[:, 0, 1 - axis] = np.floor(along + _TOLERANCE)
    at[:, 1, 1 - axis] = np.ceil(along - _TOLERANCE)
    inside[owner[~_look_up(filled, at).all(axis=1)]] = False


def nearest_seen(
    region: SightRegion, vertices: Floats, outputs: Floats, count: int = 2
) -> tuple[Indices, Floats]:
    """Find the nearest outputs that each vertex sees.

    Parameters
    ----------
    region
        From `sight_region`.
    vertices, outputs : (n_vertices, 2) and (n_outputs, 2)
        Finite coordinates.

    Returns
    -------
    index : (n_vertices, count) of int
        Nearest first; equally near ones in their order; -1 where fewer are seen.
    distance : (n_vertices, count)
        In units of the coordinates; infinite where fewer are seen.
    """
    distances = np.hypot(*np.moveaxis(vertices[:, None] - outputs, 2, 0))
    order = np.argsort(distances, axis=1, kind="stable")
    index = np.full((len(vertices), count), -1)
    distance = np.full((len(vertices), count), np.inf)
    found = np.zeros(len(vertices), dtype=np.intp)
    for rank in range(order.shape[1]):
        vertex = np.flatnonzero(found < count)
        output = order[vertex, rank]
        seen = sees(region, vertices[vertex], outputs[output])
        vertex, output = vertex[seen], output[seen]
        index[vertex, found[vertex]] = output
        distance[vertex, found[vertex]] = distances[vertex, output]
        found[vertex] += 1
    return index, distance
