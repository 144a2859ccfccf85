"""The outline of a map: its inside on a grid, and the weights of the outputs at its vertices.

A vertex takes a mean of the two nearest outputs that it sees.  The rule of sight gives the
published map's table of distances, pair by pair: the outline is drawn on a raster of one pixel,
widened by two pixels, and its border traced through pixel centres; a vertex sees an output if the
straight line between them stays inside that border.  Vertices that see no output lie between those
beside them that do.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.base.arrays import Booleans, Floats, Indices
from skinsource.base.errors import InvalidInputError


def distinct_vertices(outline: Floats) -> Indices:
    """Return the indices of the vertices that remain without immediate repetitions.

    Parameters
    ----------
    outline : (n_vertices, 2)
        Polygon; a last vertex that repeats the first counts as a repetition.

    Raises
    ------
    InvalidInputError
        The outline is no list of finite points, or encloses no area.
    """
    if outline.ndim != 2 or outline.shape[1] != 2 or not np.isfinite(outline).all():
        raise InvalidInputError(
            f"the outline has shape {outline.shape}; expected (n_vertices, 2), with finite "
            "coordinates. Correct the outline of the limb's map."
        )
    keep = np.flatnonzero(np.any(outline != np.roll(outline, 1, axis=0), axis=1))
    check_area(outline[keep])
    return keep


def check_area(points: Floats) -> None:
    """Raise where there are no points, or all of them lie on one line."""
    aside = points - points[:1]
    distance = np.hypot(*aside.T)
    along = aside[np.argmax(distance)] if len(points) else np.zeros(2)
    height = np.abs(aside[:, 0] * along[1] - aside[:, 1] * along[0])
    if not height.max(initial=0.0) > 1e-9 * distance.max(initial=0.0) ** 2:
        raise InvalidInputError(
            f"the outline has {len(points)} distinct vertices, which enclose no area; expected a "
            "closed polygon of at least three. Correct the outline of the limb's map."
        )


def densified(outline: Floats, longest: float) -> Floats:
    """Return the outline with every edge split evenly into parts no longer than ``longest``."""
    edge = np.roll(outline, -1, axis=0) - outline
    parts = np.maximum(1, np.ceil(np.hypot(*edge.T) / longest - 1e-9)).astype(np.intp)
    owner, part = ranges(np.zeros_like(parts), parts)
    return np.asarray(outline[owner] + edge[owner] * (part / parts[owner])[:, None])


def count_crossings(outline: Floats) -> int:
    """Count the pairs of edges that cross each other properly; 0 for a simple polygon."""
    start, end = outline, np.roll(outline, -1, axis=0)
    low, high = np.minimum(start, end), np.maximum(start, end)
    overlap = np.triu(np.ones((len(outline), len(outline)), dtype=bool), 2)
    for axis in range(2):
        overlap &= low[:, None, axis] <= high[None, :, axis]
        overlap &= low[None, :, axis] <= high[:, None, axis]
    first, other = np.nonzero(overlap)

    def side(edge: Indices, point: Floats) -> Floats:
        along, aside = end[edge] - start[edge], point - start[edge]
        return np.sign(along[:, 0] * aside[:, 1] - along[:, 1] * aside[:, 0])

    straddles = side(first, start[other]) * side(first, end[other]) < 0
    return int(np.sum(straddles & (side(other, start[first]) * side(other, end[first]) < 0)))


def ranges(start: Indices, stop: Indices) -> tuple[Indices, Indices]:
    """Return the owner and the value of every integer in each ``range(start[i], stop[i])``."""
    count = np.maximum(stop - start, 0)
    owner = np.repeat(np.arange(len(count)), count)
    first = np.cumsum(count) - count
    return owner, np.arange(len(owner)) - first[owner] + start[owner]


def grid_inside(outline: Floats, x: Floats, y: Floats, tolerance: float = 1e-9) -> Booleans:
    """Return which points of a grid lie inside the closed polygon, by the even-odd rule.

    Parameters
    ----------
    outline : (n_vertices, 2)
        Polygon, last vertex not repeated.
    x, y : (n_columns,) and (n_rows,)
        Ascending coordinates of the grid.
    tolerance
        Points this near to an edge, in units of the outline, count as inside.

    Returns
    -------
    (n_rows, n_columns) of bool
    """
    end = np.roll(outline, -1, axis=0)
    inside = _grid_enclosed(outline, end, x, y)
    row, column = _grid_points_near(outline, end, x, y, tolerance)
    inside[row, column] = True
    return inside


def _grid_enclosed(start: Floats, end: Floats, x: Floats, y: Floats) -> Booleans:
    """Apply the even-odd rule; points exactly on an edge fall on either side."""
    low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
    # Half open, so that a vertex between two edges is counted once; horizontal edges drop out.
    edge, row = ranges(np.searchsorted(y, low), np.searchsorted(y, high))
    fraction = (y[row] - start[edge, 1]) / (end[edge, 1] - start[edge, 1])
    crossing = start[edge, 0] + fraction * (end[edge, 0] - start[edge, 0])
    column = np.searchsorted(x, crossing)
    width = len(x) + 1
    toggles = np.bincount(row * width + column, minlength=len(y) * width)
    toggles = toggles.reshape(len(y), width)[:, :-1]
    return np.cumsum(toggles, axis=1) % 2 == 1


def _grid_points_near(
    start: Floats, end: Floats, x: Floats, y: Floats, tolerance: float
) -> tuple[Indices, Indices]:
    """Return row and column of the grid points no farther than ``tolerance`` from an edge."""
    low = np.minimum(start[:, 1], end[:, 1]) - tolerance
    high = np.maximum(start[:, 1], end[:, 1]) + tolerance
    edge, row = ranges(np.searchsorted(y, low), np.searchsorted(y, high, side="right"))
    origin, along = start[edge], end[edge] - start[edge]
    # The stretch of the edge that is within the tolerance of the row: all of a horizontal edge.
    level = np.abs(along[:, 1]) <= tolerance
    rise = np.where(level, 1.0, along[:, 1])
    offset = y[row] - origin[:, 1]
    ends = np.sort(np.stack([offset - tolerance, offset + tolerance]) / rise, axis=0)
    first, last = np.where(level, np.array([[0.0], [1.0]]), np.clip(ends, 0.0, 1.0))
    bounds = np.sort(origin[:, 0] + np.stack([first, last]) * along[:, 0], axis=0)
    left = np.searchsorted(x, bounds[0] - tolerance)
    right = np.searchsorted(x, bounds[1] + tolerance, side="right")
    place, column = ranges(left, right)
    row, origin, along = row[place], origin[place], along[place]
    aside = np.column_stack([x[column], y[row]]) - origin
    share = np.clip(np.sum(aside * along, axis=1) / np.sum(along**2, axis=1), 0.0, 1.0)
    near = np.hypot(*(aside - share[:, None] * along).T) <= tolerance
    return row[near], column[near]


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
    reach = np.where(_is_filled(filled, at)[:, None, :], outward @ corner.T, -np.inf).max(axis=2)
    return np.asarray(np.all(aside @ outward.T <= reach + _TOLERANCE, axis=1))


def _is_filled(filled: Booleans, at: Indices) -> Booleans:
    """Return whether the raster is filled at (…, 2) of column, row; empty beyond it."""
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
    inside[owner[~_is_filled(filled, at).all(axis=1)]] = False


def nearest_visible(
    region: SightRegion, vertices: Floats, outputs: Floats
) -> tuple[Indices, Floats]:
    """Find the two nearest outputs that each vertex sees.

    Parameters
    ----------
    region
        From `sight_region`.
    vertices, outputs : (n_vertices, 2) and (n_outputs, 2)
        Finite coordinates.

    Returns
    -------
    index : (n_vertices, 2) of int
        Nearest first; equally near ones in their order; -1 where fewer are seen.
    distance : (n_vertices, 2)
        In units of the coordinates; infinite where fewer are seen.
    """
    distances = np.hypot(*np.moveaxis(vertices[:, None] - outputs, 2, 0))
    order = np.argsort(distances, axis=1, kind="stable")
    index = np.full((len(vertices), 2), -1)
    distance = np.full((len(vertices), 2), np.inf)
    n_found = np.zeros(len(vertices), dtype=np.intp)
    for rank in range(order.shape[1]):
        vertex = np.flatnonzero(n_found < 2)
        output = order[vertex, rank]
        visible = sees(region, vertices[vertex], outputs[output])
        vertex, output = vertex[visible], output[visible]
        index[vertex, n_found[vertex]] = output
        distance[vertex, n_found[vertex]] = distances[vertex, output]
        n_found[vertex] += 1
    return index, distance


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Boundary:
    """Weights of the outputs at the outline's vertices.

    Attributes
    ----------
    weights : (n_vertices, n_outputs)
        Rows sum to 1.
    blind : (n_blind,)
        Vertices that see no output; their weights run evenly along the outline, from those of the
        last vertex that sees one to those of the next.
    single : (n_single,)
        Vertices that see one output only, and take its value.
    """

    weights: Floats
    blind: Indices
    single: Indices


def boundary_from_table(table: Floats, outline: Floats, outputs: Floats) -> Boundary:
    """Return the boundary by given distances.

    Parameters
    ----------
    table : (n_vertices, n_outputs)
        Distance where the vertex sees the output, else NaN.
    outline, outputs : (n_vertices, 2) and (n_outputs, 2)
        Outputs without a place are NaN.
    """
    placed = np.isfinite(outputs).all(axis=1)
    known = np.where(np.isfinite(table) & placed, table, np.inf)
    index = np.argsort(known, axis=1, kind="stable")[:, :2]
    distance = np.take_along_axis(known, index, axis=1)
    return _boundary(np.where(np.isfinite(distance), index, -1), distance, outline, outputs)


def boundary_by_sight(outline: Floats, outputs: Floats, unit: float) -> Boundary:
    """Return the boundary by the rule of `skinsource.limbs.surface.outline`.

    Parameters
    ----------
    outline, outputs : (n_vertices, 2) and (n_outputs, 2)
        Outputs without a place are NaN.
    unit
        Raster unit; twice it is the tolerance of the rule.
    """
    placed = np.flatnonzero(np.isfinite(outputs).all(axis=1))
    region = sight_region(outline, unit)
    index, distance = nearest_visible(region, outline, outputs[placed])
    index = np.where(index >= 0, placed[index], -1)
    return _boundary(index, distance, outline, outputs)


def _boundary(index: Indices, distance: Floats, outline: Floats, outputs: Floats) -> Boundary:
    """Make weights from the two nearest (n_vertices, 2), of which any may be missing (-1)."""
    n_vertices, n_outputs = len(outline), len(outputs)
    nearest = np.zeros((n_vertices, 2), dtype=np.intp)
    away = np.full((n_vertices, 2), np.inf)
    nearest[:, : index.shape[1]], away[:, : index.shape[1]] = index, distance
    blind = np.flatnonzero(~np.isfinite(away[:, 0]))
    single = np.flatnonzero(np.isfinite(away[:, 0]) & ~np.isfinite(away[:, 1]))
    if len(blind) == n_vertices:
        # All outputs lie outside: the straight distances have to do.
        straight = np.hypot(*np.moveaxis(outline[:, None] - outputs, 2, 0))
        boundary = boundary_from_table(straight, outline, outputs)
        return Boundary(weights=boundary.weights, blind=blind, single=single)
    near, far = away.T
    share = np.ones(n_vertices)
    both = np.isfinite(far) & (near > 0)
    share[both] = far[both] / (near[both] + far[both])
    weights = np.zeros((n_vertices, n_outputs))
    every = np.arange(n_vertices)
    weights[every, nearest[:, 0]] = share
    weights[every[both], nearest[both, 1]] = 1 - share[both]
    weights[blind] = _between_neighbours(outline, weights, blind)
    return Boundary(weights=weights, blind=blind, single=single)


def _between_neighbours(outline: Floats, weights: Floats, blind: Indices) -> Floats:
    """Return weights of vertices, (n_blind, n_outputs), interpolated along the closed outline."""
    ends = np.cumsum(np.hypot(*(np.roll(outline, -1, axis=0) - outline).T))
    place = np.concatenate([[0.0], ends[:-1]])
    known = np.delete(np.arange(len(outline)), blind)
    columns = [
        np.interp(place[blind], place[known], column, period=ends[-1])
        for column in weights[known].T
    ]
    return np.stack(columns, axis=-1)
