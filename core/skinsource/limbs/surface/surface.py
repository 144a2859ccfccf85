"""Build the surface operator of a map: natural neighbours within its outline.

Operators are cached on disk, because building one takes longer than all else of a start.  A cached
operator is used only for the same map, hand and spacing, and the same code and versions.  The
folder has a size limit and may be deleted at any time.  What cannot be read is built again; what
cannot be written is not cached.
"""

import hashlib
import io
import json
import os
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.base.arguments import checking, real_number
from skinsource.base.arrays import Booleans, Floats
from skinsource.base.assets import cache_folder
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
from skinsource.limbs.surface.outline import (
    Boundary,
    boundary_by_sight,
    boundary_from_table,
    check_area,
    count_crossings,
    densified,
    distinct_vertices,
    grid_inside,
    raster_unit,
)
from skinsource.version import __version__

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
