"""Shortest ways inside the outline, for outline vertices that see no output."""

from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.arrays import Floats, Indices
from skinsource.surface.visibility import SightRegion

if TYPE_CHECKING:
    from scipy.sparse import csr_array


# Column, row of half of the 16 moves to a neighbour, and the raster points passed on the way.
_MOVES = (
    ((1, 0), ()),
    ((0, 1), ()),
    ((1, 1), ()),
    ((1, -1), ()),
    ((2, 1), ((1, 0), (1, 1))),
    ((2, -1), ((1, 0), (1, -1))),
    ((1, 2), ((0, 1), (1, 1))),
    ((-1, 2), ((0, 1), (-1, 1))),
)


def distances_inside(region: SightRegion, starts: Floats, ends: Floats) -> Floats:
    """Lengths of the shortest ways inside the region, in units of the coordinates.

    Ways lead over raster points by 16 moves, which makes them up to 2.8 % too long.

    Parameters
    ----------
    region
        From `skinsource.surface.visibility.sight_region`.
    starts, ends : (n_starts, 2) and (n_ends, 2)

    Returns
    -------
    (n_starts, n_ends)
        Infinite where there is no way.
    """
    if len(ends) < len(starts):
        return distances_inside(region, ends, starts).T
    number = np.cumsum(region.filled).reshape(region.filled.shape) - 1
    graph = _moves_between(region, number)
    start, to_start = _nearest_filled(region, starts)
    end, to_end = _nearest_filled(region, ends)
    start_number, end_number = number[*start], number[*end]
    steps = scipy.sparse.csgraph.dijkstra(graph, directed=False, indices=start_number)
    return np.asarray((to_start[:, None] + steps[:, end_number] + to_end) * region.unit)


def _moves_between(region: SightRegion, number: Indices) -> "csr_array[np.float64]":
    """Lengths of the moves between filled raster points, each given once."""
    row, column = np.nonzero(region.filled)
    begin, finish, length = [], [], []
    for (right, up), passed in _MOVES:
        # The rim is empty and at least two wide, so no index leaves the raster.
        free = region.filled[row + up, column + right]
        for right_passed, up_passed in passed:
            free = free & region.filled[row + up_passed, column + right_passed]
        begin.append(number[row[free], column[free]])
        finish.append(number[row[free] + up, column[free] + right])
        length.append(np.full(int(free.sum()), np.hypot(right, up)))
    place = (np.concatenate(begin), np.concatenate(finish))
    lengths = (np.concatenate(length), place)
    return scipy.sparse.csr_array(scipy.sparse.coo_array(lengths, shape=(len(row), len(row))))


def _nearest_filled(region: SightRegion, points: Floats) -> tuple[tuple[Indices, Indices], Floats]:
    """Row and column of the filled raster point nearest to each point, and how far it is."""
    row, column = np.nonzero(region.filled)
    at = region.raster_coordinates(points)
    distance, nearest = scipy.spatial.KDTree(np.column_stack([column, row])).query(at)
    return (row[nearest], column[nearest]), np.asarray(distance)
