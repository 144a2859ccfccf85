"""Builds the operator of a map: natural neighbours within its outline."""

from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.arguments import real_number
from skinsource.arrays import Booleans, Floats
from skinsource.errors import InvalidInputError
from skinsource.job import Stop, never, stop_if
from skinsource.limb import Limb, LimbMap
from skinsource.quoting import quoted
from skinsource.surface.boundary import Boundary, boundary_by_sight, boundary_from_table
from skinsource.surface.operator import SurfaceOperator
from skinsource.surface.polygon import count_crossings, densified, distinct_vertices, grid_inside
from skinsource.surface.same_place import pairs_at_same_place
from skinsource.surface.scattered_sites import scattered_sites
from skinsource.surface.triangulation import snapped_to_lattice
from skinsource.surface.visibility import raster_unit

if TYPE_CHECKING:
    from scipy.sparse import csr_array

# Longest edge of an own outline, in raster units.
_LONGEST_EDGE = 4.0
_LENGTHS = "a positive number of 1e-9 to 1e9"
_MOST_PIXELS = 20_000_000
# Pixels this near to an edge, as a part of the outline's extent, are inside.
_ON_EDGE = 1e-12
# Bounds the memory in use while the operator is built.
_PIXELS_PER_CHUNK = 4096


def surface_operator(limb: Limb, spacing_mm: float = 1.0, stop: Stop = never) -> SurfaceOperator:
    """Natural neighbour interpolation over the limb's outline.

    Takes a fraction of a second at 1 mm, longer as the square of the fineness.

    Parameters
    ----------
    limb
        Its map and hand length are used, not its responses.
    spacing_mm
        Distance between pixels; the published masks have 1 mm.
    stop
        Asked now and then; once true, `skinsource.errors.Stopped` is raised.

    Raises
    ------
    InvalidInputError
        The spacing or the limb's map cannot be used.
    """
    if not isinstance(limb, Limb):
        raise InvalidInputError(f"limb is {quoted(limb)}, expected a Limb, see load_limb")
    return surface_operator_from_map(limb.map, limb.hand_length_mm, spacing_mm, stop)


def surface_operator_from_map(
    limb_map: LimbMap, hand_length_mm: float, spacing_mm: float = 1.0, stop: Stop = never
) -> SurfaceOperator:
    """Natural neighbour interpolation over the outline of a map.

    Sites are the outputs and the outline's vertices; a vertex takes the mean of the two nearest
    outputs it sees, weighted by the other one's distance.  Everything is built in outline pixels:
    there the published coordinates are multiples of one half, and lie exactly on the lattice that
    keeps the triangulation sound.  Sites that coincide there share the mean of their values; where
    all lie on one line, values run linearly along it.  An outline that crosses itself is filled by
    the even-odd rule.

    Parameters
    ----------
    limb_map
        If it has ``visibility``, its outline is not split, even if ``densify`` is set.
    hand_length_mm
        Length of the hand the map is scaled to.
    spacing_mm
        Distance between pixels.
    stop
        Asked now and then; once true, `skinsource.errors.Stopped` is raised.

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
    weights, fallback_count, thin = _point_weights(outline, outputs, boundary, points, stop)
    return SurfaceOperator(
        weights=_with_empty_rows(weights, mask.ravel()),
        mask=mask,
        x_mm=x * mm_per_px,
        y_mm=y * mm_per_px,
        fallback_count=fallback_count,
        blind_vertices=len(boundary.blind),
        single_vertices=len(boundary.single),
        same_place=pairs_at_same_place(outputs, float(np.ptp(outline, axis=0).max())),
        warnings=_warnings(fallback_count, boundary, crossings, thin),
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
            f"the map's output positions have shape {outputs.shape}, and none is finite or they "
            "are no points; expected (n_outputs, 2) with at least one finite row. Place an output."
        )
    if table is not None and table.shape != (len(outline), len(outputs)):
        raise InvalidInputError(
            f"the map's visibility has shape {table.shape}; expected {len(outline), len(outputs)} "
            "(outline vertices, outputs). Correct it, or leave it out to have it computed."
        )


def _outline_and_boundary(limb_map: LimbMap) -> tuple[Floats, Boundary, int]:
    """Outline as it is used, values at its vertices, and how often it crosses itself."""
    outputs = limb_map.output_positions
    kept = distinct_vertices(limb_map.outline)
    outline = limb_map.outline[kept]
    unit = raster_unit(outline, limb_map.hand_length_px)
    if limb_map.visibility is not None:
        return outline, boundary_from_table(limb_map.visibility[kept], outline, outputs, unit), 0
    crossings = count_crossings(outline)
    if limb_map.densify:
        outline = densified(outline, _LONGEST_EDGE * unit)
    return outline, boundary_by_sight(outline, outputs, unit), crossings


def _pixels(
    outline: Floats, spacing_mm: float, mm_per_px: float
) -> tuple[Floats, Floats, Booleans]:
    """Coordinates of columns and rows in outline pixels, and the mask (rows, columns)."""
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
) -> "tuple[csr_array[np.float64], int, bool]":
    """Weights of the outputs at the points; how many are by the way out; if all is one line."""
    placed = np.flatnonzero(np.isfinite(outputs).all(axis=1))
    values = np.concatenate([np.eye(len(outputs))[placed], boundary.weights])
    snapped = snapped_to_lattice(np.concatenate([outputs[placed], outline]))
    sites, merged = np.unique(snapped, axis=0, return_inverse=True)
    site_values = np.zeros((len(sites), len(outputs)))
    np.add.at(site_values, merged.ravel(), values)
    site_values /= np.bincount(merged.ravel())[:, None]
    from_outputs = scipy.sparse.csr_array(site_values)
    scattered = scattered_sites(sites)
    parts, fallback_count = [], 0
    for first in range(0, len(points), _PIXELS_PER_CHUNK):
        stop_if(stop)
        found = scattered.weights_at(points[first : first + _PIXELS_PER_CHUNK])
        parts.append(found.weights @ from_outputs)
        fallback_count += int(found.fallback.sum())
    together = scipy.sparse.csr_array(scipy.sparse.vstack(parts, format="csr"))
    together.sort_indices()
    return together, fallback_count, scattered.on_a_line


def _with_empty_rows(weights: "csr_array[np.float64]", filled: Booleans) -> "csr_array[np.float64]":
    """Spread the rows over those that are ``filled``, leaving the others empty."""
    counts = np.zeros(len(filled) + 1, dtype=weights.indptr.dtype)
    counts[1:][filled] = np.diff(weights.indptr)
    starts = np.cumsum(counts, dtype=weights.indptr.dtype)
    return scipy.sparse.csr_array(
        (weights.data, weights.indices, starts), shape=(len(filled), weights.shape[1])
    )


def _warnings(
    fallback_count: int, boundary: Boundary, crossings: int, thin: bool
) -> tuple[str, ...]:
    n_blind, n_single = len(boundary.blind), len(boundary.single)
    cases = (
        (fallback_count, "Pixels that had to be interpolated linearly"),
        (n_blind, "Outline points that see no output, and follow those nearest along the limb"),
        (n_single, "Outline points that see only one output, and take its value"),
        (crossings, "Places where the outline crosses itself"),
    )
    thinness = ("The outline is so thin that values run along a line.",) if thin else ()
    return thinness + tuple(f"{what}: {count}." for count, what in cases if count)
