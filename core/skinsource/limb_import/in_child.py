"""What the child process does for limbs."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from skinsource.arrays import Floats
from skinsource.limb_import import arrays, layout
from skinsource.limb_import.points import points_of
from skinsource.recordings.readers import reader_of

_HDF5 = "HDF5", "MATLAB 7.3"
#: What such files can be.
EXPECTED = {
    "limb": "responses in the layout of docs/limbs.md, or in NPY, NPZ, MATLAB or HDF5",
    "points": "a CSV or SVG file",
    "responses": "responses in the layout of docs/limbs.md, or in NPY, NPZ, MATLAB or HDF5",
    "arrays": "a table of numbers, NPY, NPZ, MATLAB or HDF5",
}


def look(request: dict[str, Any], path: Path) -> dict[str, Any]:
    """Answer what a file says besides its responses."""
    if request["do"] == "points":
        return {"points": points_of(path)}
    if request["do"] == "arrays":
        return arrays.offered_by(path)
    if reader_of(path).name in _HDF5 and layout.is_limb_file(path):
        return {"limb": {"header": layout.header_of(path), "arrays": []}}
    return {"limb": {"header": None, "arrays": arrays.arrays_of(path)}}


def blocks(request: dict[str, Any], path: Path) -> Iterator[Floats]:
    """Give the responses to one input after another, (n_channels, n_taps)."""
    if request["array"] is None:
        return layout.response_blocks(path)
    return arrays.array_blocks(path, str(request["array"]), str(request["order"]))
