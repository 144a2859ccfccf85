"""What the store ``measured.h5`` looks like inside: names, version, checksums.

The file is in the format of HDF5 1.10, which checks sums of all that is not an array; each array
has a SHA-256 of its own.  All texts are of fixed length: HDF5 leaves others unchecked.
::

    /                        format, format_version, installed_at, source_name,
                             source_sha256, source_bytes, unpublished
    /responses/limb-1 … -4   (20 inputs, 72 outputs, 3 axes, 522 taps) float64, one
                             chunk per input, not compressed; sha256: one per input
    /map/outline …           float64, each with its sha256
    /masks/limb-1 … -4       (rows, columns) uint8, each with its sha256
"""

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.limb import N_AXES, N_INPUTS, N_OUTPUTS, N_TAPS

FILE_NAME = "measured.h5"
FORMAT = "skinsource measured dataset"
FORMAT_VERSION = 2
LIMBS = (1, 2, 3, 4)
RESPONSES_SHAPE = (N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS)
CHUNK = (1, N_OUTPUTS, N_AXES, N_TAPS)
N_VERTICES = 1505
#: (rows, columns) of 1 mm each, for the hand lengths of limbs 1 to 4.
MASK_SHAPES = ((464, 174), (437, 164), (490, 184), (437, 164))
MAP_SHAPES = {
    "outline": (N_VERTICES, 2),
    "output_positions": (N_OUTPUTS, 2),
    "input_positions": (N_INPUTS, 2),
    "visibility": (N_VERTICES, N_OUTPUTS),
}
#: All that is stored in one piece: name in the store, shape.
WHOLE_SHAPES = {f"map/{part}": shape for part, shape in MAP_SHAPES.items()} | {
    f"masks/limb-{limb}": shape for limb, shape in zip(LIMBS, MASK_SHAPES, strict=True)
}
_LIMB_NAMES = tuple(f"limb-{limb}" for limb in LIMBS)
#: Groups of the store, and what is in each.
GROUPS = {"responses": _LIMB_NAMES, "map": tuple(MAP_SHAPES), "masks": _LIMB_NAMES}
#: What ``unpublished`` says where all files were the published ones; else their names, with commas.
ALL_PUBLISHED = "none"
FLOATS, BYTES = "<f8", "u1"


def responses_name(limb: int) -> str:
    """Name of the impulse responses of one limb in the store."""
    return f"responses/limb-{limb}"


def mask_name(limb: int) -> str:
    """Name of the mask of one limb in the store."""
    return f"masks/limb-{limb}"


def whole_type(name: str) -> str:
    """Type of the values of what is stored in one piece."""
    return BYTES if name.startswith("masks/") else FLOATS


def checksum(array: NDArray[Any]) -> str:
    """SHA-256 of the values as they lie in the store: C order, little-endian."""
    stored = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<"))
    return hashlib.sha256(stored.data).hexdigest()
