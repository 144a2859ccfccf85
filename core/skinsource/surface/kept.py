"""Operators of maps, kept on disk: to build one takes longer than to start the studio without it.

A kept operator is found again only by the same map, hand and spacing, the same source code of this
folder and the same versions of what computes it.  The folder is bounded, and may be deleted at any
time.  Whatever cannot be read is built again; whatever cannot be written is not kept.
"""

import hashlib
import io
import json
import os
from functools import cache
from pathlib import Path

import numpy as np
import scipy

from skinsource import surface
from skinsource.errors import SkinSourceError
from skinsource.files import make_folder, read_bytes, write_bytes
from skinsource.files.assets import cache_folder
from skinsource.job import Stop, never
from skinsource.limb import Limb
from skinsource.surface.operator import SurfaceOperator
from skinsource.version import __version__
from skinsource.work import tally

#: What all kept operators take on disk, at most, and one of them.
MOST_ON_DISK_BYTES, LARGEST_BYTES = 64 * 2**20, 16 * 2**20
_HEAD = b"skinsource operator 1\n"
_DIGEST_BYTES = 32


def kept_surface_operator(
    limb: Limb, spacing_mm: float = 1.0, *, stop: Stop = never
) -> SurfaceOperator:
    """Return `skinsource.surface.surface_operator`, from disk if it was built before.

    The same bits either way.  `skinsource.work` counts what was built.
    """
    path = cache_folder() / "surface" / f"{_key(limb, spacing_mm)}.operator"
    found = _read(path)
    if found is None:
        found = surface.surface_operator(limb, spacing_mm, stop=stop)
        tally(operators_built=1)
        _keep(path, found)
    return found


def encoded(operator: SurfaceOperator) -> bytes:
    """An operator as bytes that know when they are damaged."""
    weights = operator.weights
    about = {
        "fallback_count": operator.fallback_count,
        "blind_vertices": operator.blind_vertices,
        "single_vertices": operator.single_vertices,
        "same_place": operator.same_place,
        "warnings": operator.warnings,
        "n_outputs": weights.shape[1],
    }
    content = io.BytesIO()
    arrays = (weights.data, weights.indices, weights.indptr, operator.mask)
    words = np.frombuffer(json.dumps(about).encode(), np.uint8)
    for array in (words, *arrays, operator.x_mm, operator.y_mm):
        np.save(content, array, allow_pickle=False)
    image = content.getvalue()
    return _HEAD + hashlib.sha256(image).digest() + image


def decoded(image: bytes) -> SurfaceOperator:
    """The operator of such bytes.

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
        raise ValueError("not a kept operator, or damaged")
    stream = io.BytesIO(content)
    words, data, indices, indptr, mask, x_mm, y_mm = (
        np.load(stream, allow_pickle=False) for _ in range(7)
    )
    about = json.loads(words.tobytes())
    weights = scipy.sparse.csr_array((data, indices, indptr), shape=(mask.size, about["n_outputs"]))
    # Of bytes that somebody else wrote: no row points outside.
    weights.check_format(full_check=True)
    return SurfaceOperator(
        weights=weights,
        mask=mask,
        x_mm=x_mm,
        y_mm=y_mm,
        fallback_count=about["fallback_count"],
        blind_vertices=about["blind_vertices"],
        single_vertices=about["single_vertices"],
        same_place=tuple((first, second) for first, second in about["same_place"]),
        warnings=tuple(about["warnings"]),
    )


def _key(limb: Limb, spacing_mm: float) -> str:
    """Digest of all that an operator depends on."""
    found = hashlib.sha256(_code())
    lengths = limb.map.hand_length_px, limb.hand_length_mm, spacing_mm
    found.update(repr((*map(float, lengths), limb.map.densify)).encode())
    for array in (limb.map.outline, limb.map.output_positions, limb.map.visibility):
        if array is not None:
            found.update(f"{array.dtype.str}{array.shape}".encode())
            found.update(array.tobytes())
        found.update(b";")
    return found.hexdigest()[:32]


@cache
def _code() -> bytes:
    """What computes operators: versions, and the source of this folder where it is at hand."""
    versions = f"{__version__} {np.__version__} {scipy.__version__}".encode()
    sources = sorted(Path(__file__).parent.glob("*.py"))
    return b"\0".join((_HEAD, versions, *(path.read_bytes() for path in sources)))


def _read(path: Path) -> SurfaceOperator | None:
    try:
        found = decoded(read_bytes(path, most=LARGEST_BYTES))
        os.utime(path)  # used last is deleted last
    except (OSError, SkinSourceError, ValueError, KeyError, TypeError, EOFError):
        return None
    return found


def _keep(path: Path, operator: SurfaceOperator) -> None:
    image = encoded(operator)
    if len(image) > LARGEST_BYTES:
        return
    try:
        make_folder(path.parent)
        write_bytes(path, image)
        _make_room(path.parent)
    except (OSError, SkinSourceError):
        return


def _make_room(folder: Path) -> None:
    kept = [(one.stat(), one) for one in folder.glob("*.operator")]
    kept.sort(key=lambda pair: pair[0].st_mtime_ns, reverse=True)
    total = 0
    for about, path in kept:
        total += about.st_size
        if total > MOST_ON_DISK_BYTES:
            path.unlink(missing_ok=True)
