"""What the store ``measured.h5`` looks like inside: names, version, checksums.

::

    /                        format, format_version, installed_at, source_name,
                             source_sha256, source_bytes
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
FORMAT_VERSION = 1
LIMBS = (1, 2, 3, 4)
RESPONSES_SHAPE = (N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS)
CHUNK = (1, N_OUTPUTS, N_AXES, N_TAPS)
MAP_PARTS = ("outline", "output_positions", "input_positions", "visibility")


def responses_name(limb: int) -> str:
    """Name of the impulse responses of one limb in the store."""
    return f"responses/limb-{limb}"


def mask_name(limb: int) -> str:
    """Name of the mask of one limb in the store."""
    return f"masks/limb-{limb}"


def checksum(array: NDArray[Any]) -> str:
    """SHA-256 of the values as they lie in the store: C order, little-endian."""
    stored = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<"))
    return hashlib.sha256(stored.data).hexdigest()
