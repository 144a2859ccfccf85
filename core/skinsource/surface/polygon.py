"""A closed polygon in the plane: tidied, split finely, and its inside on a grid."""

import numpy as np

from skinsource.arrays import Booleans, Floats, Indices
from skinsource.errors import InvalidInputError


def distinct_vertices(outline: Floats) -> Indices:
    """Indices of the vertices that are left when immediate repetitions are dropped.

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
    if not _span_a_plane(outline[keep]):
        raise InvalidInputError(
            f"the outline has {len(keep)} distinct vertices, which enclose no area; expected a "
            "closed polygon of at least three. Correct the outline of the limb's map."
        )
    return keep


def _span_a_plane(points: Floats) -> bool:
    """Whether there are points, and not all on one line."""
    if len(points) < 3:
        return False
    aside = points - points[0]
    distance = np.hypot(*aside.T)
    along = aside[np.argmax(distance)]
    height = np.abs(aside[:, 0] * along[1] - aside[:, 1] * along[0])
    return bool(height.max() > 1e-9 * distance.max() ** 2)


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
    one, other = np.nonzero(overlap)

    def side(edge: Indices, point: Floats) -> Floats:
        along, aside = end[edge] - start[edge], point - start[edge]
        return np.sign(along[:, 0] * aside[:, 1] - along[:, 1] * aside[:, 0])

    apart = side(one, start[other]) * side(one, end[other]) < 0
    return int(np.sum(apart & (side(other, start[one]) * side(other, end[one]) < 0)))


def ranges(start: Indices, stop: Indices) -> tuple[Indices, Indices]:
    """Return the owner and the value of every integer in each ``range(start[i], stop[i])``."""
    count = np.maximum(stop - start, 0)
    owner = np.repeat(np.arange(len(count)), count)
    first = np.cumsum(count) - count
    return owner, np.arange(len(owner)) - first[owner] + start[owner]


def grid_inside(outline: Floats, x: Floats, y: Floats, tolerance: float = 1e-9) -> Booleans:
    """Which points of a grid lie inside the closed polygon, by the even-odd rule.

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
    """Even-odd rule; points exactly on an edge fall on either side."""
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
    """Row and column of the grid points no farther than ``tolerance`` from an edge."""
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
