"""Build the surface operator of a map: natural neighbours within its outline.

Operators are cached on disk, because building one takes longer than all else of a start.  A cached
operator is used only for the same map, hand and spacing, and the same code and versions.  The
folder has a size limit and may be deleted at any time.  What cannot be read is built again; what
cannot be written is not cached.

A vertex of the outline takes a mean of the two nearest outputs that it sees.  The rule of sight
gives the published map's table of distances, pair by pair: the outline is drawn on a raster of one
pixel, widened by two pixels, and its border traced through pixel centres; a vertex sees an output
if the straight line between them stays inside that border.  Vertices that see no output lie between
those beside them that do.
"""

import hashlib
import io
import json
import os
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.base.arguments import checking, real_number
from skinsource.base.assets import cache_folder
from skinsource.base.conventions import Booleans, Floats, Indices
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.base.files import make_folder, read_bytes, write_bytes
from skinsource.base.job import Stop, never, stop_if
from skinsource.base.work import tally
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.surface.natural_neighbour import (
    natural_neighbour_weights,
    snapped_to_lattice,
    triangulate,
)
from skinsource.limbs.surface.operator import SurfaceOperator, pairs_at_same_place
from skinsource.version import __version__

if TYPE_CHECKING:
    from scipy.sparse import csr_array


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
    """Return the boundary by the rule of `skinsource.limbs.surface.surface`.

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


# Longest edge of an own outline, in raster units.
_LONGEST_EDGE = 4.0
_LENGTHS = "a positive number of 1e-9 to 1e9"
_MOST_PIXELS = 20_000_000
# Pixels this near to an edge, as a part of the outline's extent, are inside.
_ON_EDGE = 1e-12
# Bounds the memory in use while the operator is built.
_PIXELS_PER_CHUNK = 4096


@checking
def surface_operator(
    limb: Limb | str, spacing_mm: float = 1.0, stop: Stop = never
) -> SurfaceOperator:
    """Build the natural neighbour interpolation over a limb's outline.

    It takes a fraction of a second at 1 mm; half the spacing takes four times as long.

    Parameters
    ----------
    limb
        A limb, or its name.  Its map and hand length are used, not its responses.
    spacing_mm
        Distance between pixels; the published masks have 1 mm.
    stop
        Asked now and then; once true, `skinsource.base.errors.Stopped` is raised.

    Raises
    ------
    InvalidInputError
        The spacing or the limb's map cannot be used.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> heatmap = ss.surface_operator("synthetic-1", 2.0).interpolate(np.arange(72.0))
    >>> print(heatmap.shape)
    (230, 76)
    """
    limb = limb_of(limb)
    return surface_operator_from_map(limb.map, limb.hand_length_mm, spacing_mm, stop)


def surface_operator_from_map(
    limb_map: LimbMap, hand_length_mm: float, spacing_mm: float = 1.0, stop: Stop = never
) -> SurfaceOperator:
    """Build the natural neighbour interpolation over the outline of a map.

    Sites are the outputs and the outline's vertices; a vertex takes the mean of the two nearest
    outputs it sees, weighted by the other one's distance.  Everything is built in outline pixels:
    there the published coordinates are multiples of one half, and lie exactly on the lattice that
    keeps the triangulation sound.  Sites that coincide there share the mean of their values.  An
    outline that crosses itself is filled by the even-odd rule.

    Parameters
    ----------
    limb_map
        If it has ``visibility``, its outline is not split, even if ``densify`` is set.
    hand_length_mm
        Length of the hand the map is scaled to.
    spacing_mm
        Distance between pixels.
    stop
        Asked now and then; once true, `skinsource.base.errors.Stopped` is raised.

    Raises
    ------
    InvalidInputError
        A length is not positive, no output has a place, the outline encloses nothing, or the
        grid is too fine or too coarse.
    """
    _check_map(limb_map, hand_length_mm, spacing_mm)
    stop_if(stop)
    outline, boundary, crossings = _outline_and_boundary(limb_map)
    stop_if(stop)
    mm_per_px = hand_length_mm / limb_map.hand_length_px
    x, y, mask = _pixels(outline, spacing_mm, mm_per_px)
    row, column = np.nonzero(mask)
    points = np.column_stack([x[column], y[row]])
    outputs = limb_map.output_positions
    weights, fallback_count = _point_weights(outline, outputs, boundary, points, stop)
    return SurfaceOperator(
        weights=_with_empty_rows(weights, mask.ravel()),
        mask=mask,
        x_mm=x * mm_per_px,
        y_mm=y * mm_per_px,
        fallback_count=fallback_count,
        blind_vertices=len(boundary.blind),
        single_vertices=len(boundary.single),
        same_place=pairs_at_same_place(outputs, float(np.ptp(outline, axis=0).max())),
        warnings=_warnings(fallback_count, boundary, crossings),
    )


def _check_map(limb_map: LimbMap, hand_length_mm: float, spacing_mm: float) -> None:
    lengths = {
        "spacing_mm": spacing_mm,
        "hand_length_mm": hand_length_mm,
        "hand_length_px": limb_map.hand_length_px,
    }
    for name, length in lengths.items():
        real_number(name, length, _LENGTHS, least=1e-9, most=1e9)
    outputs, outline, table = limb_map.output_positions, limb_map.outline, limb_map.visibility
    if outputs.ndim != 2 or outputs.shape[1] != 2 or not np.isfinite(outputs).all(axis=1).any():
        raise InvalidInputError(
            f"the map's output positions have shape {outputs.shape}, and none is finite, or they "
            "are not points; expected (n_outputs, 2) with at least one finite row. Place an output."
        )
    if table is not None and table.shape != (len(outline), len(outputs)):
        raise InvalidInputError(
            f"the map's visibility has shape {table.shape}; expected {len(outline), len(outputs)} "
            "(outline vertices, outputs). Correct it, or leave it out to have it computed."
        )


def _outline_and_boundary(limb_map: LimbMap) -> tuple[Floats, Boundary, int]:
    """Return the outline as used, the weights at its vertices, and its self-crossings."""
    outputs = limb_map.output_positions
    distinct = distinct_vertices(limb_map.outline)
    outline = limb_map.outline[distinct]
    unit = raster_unit(outline, limb_map.hand_length_px)
    if limb_map.visibility is not None:
        table = limb_map.visibility[distinct]
        return outline, boundary_from_table(table, outline, outputs), 0
    crossings = count_crossings(outline)
    if limb_map.densify:
        outline = densified(outline, _LONGEST_EDGE * unit)
    return outline, boundary_by_sight(outline, outputs, unit), crossings


def _pixels(
    outline: Floats, spacing_mm: float, mm_per_px: float
) -> tuple[Floats, Floats, Booleans]:
    """Return x of columns and y of rows in outline pixels, and the mask (rows, columns)."""
    spacing = spacing_mm / mm_per_px
    low, high = outline.min(axis=0), outline.max(axis=0)
    # The last pixel may be missed by rounding.
    columns, rows = np.floor((high - low) / spacing + 1e-9) + 1
    if columns * rows > _MOST_PIXELS:
        raise InvalidInputError(
            f"a spacing of {spacing_mm:g} mm makes {columns:.0f} x {rows:.0f} pixels; at most "
            f"{_MOST_PIXELS} are possible. Choose a wider spacing."
        )
    x = np.minimum(low[0] + np.arange(columns) * spacing, high[0])
    y = np.minimum(low[1] + np.arange(rows) * spacing, high[1])
    mask = grid_inside(outline, x, y, _ON_EDGE * float((high - low).max()))
    if not mask.any():
        raise InvalidInputError(
            f"no pixel lies inside the outline at a spacing of {spacing_mm:g} mm. Choose a "
            "narrower spacing."
        )
    return x, y, mask


def _point_weights(
    outline: Floats, outputs: Floats, boundary: Boundary, points: Floats, stop: Stop
) -> "tuple[csr_array[np.float64], int]":
    """Return the outputs' weights at the points, and how many of them are linear."""
    placed = np.flatnonzero(np.isfinite(outputs).all(axis=1))
    values = np.concatenate([np.eye(len(outputs))[placed], boundary.weights])
    snapped = snapped_to_lattice(np.concatenate([outputs[placed], outline]))
    sites, merged = np.unique(snapped, axis=0, return_inverse=True)
    site_values = np.zeros((len(sites), len(outputs)))
    np.add.at(site_values, merged.ravel(), values)
    site_values /= np.bincount(merged.ravel())[:, None]
    from_outputs = scipy.sparse.csr_array(site_values)
    check_area(sites)
    triangulation = triangulate(sites)
    parts, fallback_count = [], 0
    for first in range(0, len(points), _PIXELS_PER_CHUNK):
        stop_if(stop)
        part = points[first : first + _PIXELS_PER_CHUNK]
        weights = natural_neighbour_weights(triangulation, part)
        parts.append(weights.weights @ from_outputs)
        fallback_count += int(weights.fallback.sum())
    stacked = scipy.sparse.csr_array(scipy.sparse.vstack(parts, format="csr"))
    stacked.sort_indices()
    return stacked, fallback_count


def _with_empty_rows(weights: "csr_array[np.float64]", filled: Booleans) -> "csr_array[np.float64]":
    """Spread the rows over those that are ``filled``, leaving the others empty."""
    counts = np.zeros(len(filled) + 1, dtype=weights.indptr.dtype)
    counts[1:][filled] = np.diff(weights.indptr)
    starts = np.cumsum(counts, dtype=weights.indptr.dtype)
    return scipy.sparse.csr_array(
        (weights.data, weights.indices, starts), shape=(len(filled), weights.shape[1])
    )


def _warnings(fallback_count: int, boundary: Boundary, crossings: int) -> tuple[str, ...]:
    n_blind, n_single = len(boundary.blind), len(boundary.single)
    cases = (
        (fallback_count, "Pixels that had to be interpolated linearly"),
        (n_blind, "Outline points that see no output, and follow those nearest along the limb"),
        (n_single, "Outline points that see only one output, and take its value"),
        (crossings, "Places where the outline crosses itself"),
    )
    return tuple(f"{what}: {count}." for count, what in cases if count)


#: Most bytes of all cached operators, and of one.
MOST_ON_DISK_BYTES, LARGEST_BYTES = 64 * 2**20, 16 * 2**20
_HEAD = b"skinsource operator 1\n"
_DIGEST_BYTES = 32
_COUNTS = ("fallback_count", "blind_vertices", "single_vertices")


def cached_surface_operator(
    limb: Limb, spacing_mm: float = 1.0, *, stop: Stop = never
) -> SurfaceOperator:
    """Return `skinsource.limbs.surface.surface.surface_operator`, from disk if it was built before.

    The same bits either way.  `skinsource.base.work` counts what was built.
    """
    path = cache_folder() / "surface" / f"{_key(limb, spacing_mm)}.operator"
    operator = _read_cached(path)
    if operator is None:
        operator = surface_operator(limb, spacing_mm, stop=stop)
        tally(operators_built=1)
        _write_cached(path, operator)
    return operator


def encoded(operator: SurfaceOperator) -> bytes:
    """Encode an operator as bytes with a checksum."""
    weights = operator.weights
    about = {
        **{name: getattr(operator, name) for name in _COUNTS},
        "same_place": operator.same_place,
        "warnings": operator.warnings,
        "n_outputs": weights.shape[1],
    }
    content = io.BytesIO()
    arrays = (weights.data, weights.indices, weights.indptr, operator.mask)
    header = np.frombuffer(json.dumps(about).encode(), np.uint8)
    for array in (header, *arrays, operator.x_mm, operator.y_mm):
        np.save(content, array, allow_pickle=False)
    image = content.getvalue()
    return _HEAD + hashlib.sha256(image).digest() + image


def decoded(image: bytes) -> SurfaceOperator:
    """Decode the operator from bytes of `encoded`.

    Raises
    ------
    ValueError
        They are damaged, or something else.
    """
    start = len(_HEAD) + _DIGEST_BYTES
    content = memoryview(image)[start:]
    if (
        image[: len(_HEAD)] != _HEAD
        or hashlib.sha256(content).digest() != image[len(_HEAD) : start]
    ):
        raise ValueError("not a stored operator, or damaged")
    stream = io.BytesIO(content)
    header, data, indices, indptr, mask, x_mm, y_mm = (
        np.load(stream, allow_pickle=False) for _ in range(7)
    )
    about = json.loads(header.tobytes())
    weights = scipy.sparse.csr_array((data, indices, indptr), shape=(mask.size, about["n_outputs"]))
    # The bytes may be somebody else's: check that no row points outside.
    weights.check_format(full_check=True)
    return SurfaceOperator(
        weights=weights,
        mask=mask,
        x_mm=x_mm,
        y_mm=y_mm,
        same_place=tuple((first, second) for first, second in about["same_place"]),
        warnings=tuple(about["warnings"]),
        **{name: about[name] for name in _COUNTS},
    )


def _key(limb: Limb, spacing_mm: float) -> str:
    """Return the digest of all that an operator depends on."""
    digest = hashlib.sha256(_version_bytes())
    lengths = limb.map.hand_length_px, limb.hand_length_mm, spacing_mm
    digest.update(repr((*map(float, lengths), limb.map.densify)).encode())
    for array in (limb.map.outline, limb.map.output_positions, limb.map.visibility):
        if array is not None:
            digest.update(f"{array.dtype.str}{array.shape}".encode())
            digest.update(array.tobytes())
        digest.update(b";")
    return digest.hexdigest()[:32]


@cache
def _version_bytes() -> bytes:
    """Return the versions and the source files that operators are computed by."""
    versions = f"{__version__} {np.__version__} {scipy.__version__}".encode()
    sources = sorted(Path(__file__).parent.glob("*.py"))
    return b"\0".join((_HEAD, versions, *(path.read_bytes() for path in sources)))


def _read_cached(path: Path) -> SurfaceOperator | None:
    try:
        operator = decoded(read_bytes(path, most=LARGEST_BYTES))
        os.utime(path)  # used last is deleted last
    except (OSError, SkinSourceError, ValueError, KeyError, TypeError, EOFError):
        return None
    return operator


def _write_cached(path: Path, operator: SurfaceOperator) -> None:
    image = encoded(operator)
    if len(image) > LARGEST_BYTES:
        return
    try:
        make_folder(path.parent)
        write_bytes(path, image)
        _limit_folder(path.parent)
    except (OSError, SkinSourceError):
        return


def _limit_folder(folder: Path) -> None:
    cached_files = [(path.stat(), path) for path in folder.glob("*.operator")]
    cached_files.sort(key=lambda pair: pair[0].st_mtime_ns, reverse=True)
    total = 0
    for about, path in cached_files:
        total += about.st_size
        if total > MOST_ON_DISK_BYTES:
            path.unlink(missing_ok=True)
