"""Arrays of any number of dimensions in NPY, NPZ, MATLAB and HDF5 files; for the child process."""

from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.limb_import.refusing import refusal
from skinsource.quoting import quoted
from skinsource.recordings import hdf5_file, matlab_file, numpy_file
from skinsource.recordings.members import Members, stated_rate
from skinsource.recordings.readers import reader_of

_OPENED = {
    "NPY": numpy_file.opened_npy,
    "NPZ": numpy_file.opened_npz,
    "MATLAB": matlab_file.opened,
    "MATLAB 7.3": hdf5_file.opened,
    "HDF5": hdf5_file.opened,
}
#: What the letters of an order stand for.
ORDER_LETTERS = "ioat"
_KINDS, _MOST_ARRAYS = "iuf", 200


def arrays_of(path: Path) -> list[dict[str, Any]]:
    """Name and shape of each array of numbers with three or four dimensions."""
    with _opened(path) as members:
        found = [
            {"name": one.name, "shape": [int(n) for n in one.array.shape]}
            for one in members.members
            if len(one.array.shape) in (3, 4) and np.dtype(one.array.dtype).kind in _KINDS
        ]
        if not found:
            raise refusal(
                path,
                f"it holds no array of 3 or 4 dimensions. {' '.join(members.notes)}".rstrip(" ."),
                "responses: inputs, outputs, axes and taps in some order",
            )
        return found[:_MOST_ARRAYS]


def offered_by(path: Path) -> dict[str, Any]:
    """Name, shape and rate of each array of three dimensions, and the rate of the file.

    None of tables and sound, which are read signal by signal.
    """
    if reader_of(path).name not in _OPENED:
        return {"arrays": [], "rate_hz": None}
    with _opened(path) as members:
        found = [
            {
                "name": one.name,
                "shape": [int(n) for n in one.array.shape],
                "rate_hz": one.rate_hz,
            }
            for one in members.members
            if len(one.array.shape) == 3 and np.dtype(one.array.dtype).kind in _KINDS
        ]
        stated = stated_rate(members)
        return {"arrays": found[:_MOST_ARRAYS], "rate_hz": stated[1] if stated else None}


def array_blocks(path: Path, name: str, order: str) -> Iterator[Floats]:
    """Responses to one input after another, (n_outputs x n_axes, n_taps).

    Parameters
    ----------
    name
        Of the array; empty: the only one, or the largest.
    order
        A letter for each dimension, in the order of the file: i input, o output, a axis, t tap.
    """
    with _opened(path) as members:
        array = _chosen(path, members, name)
        shape = tuple(int(n) for n in array.shape)
        if sorted(order) != sorted(ORDER_LETTERS.replace("a", "") if len(shape) == 3 else "ioat"):
            raise refusal(
                path,
                f"the order of its {len(shape)} dimensions is {quoted(order)}",
                "i, o, a and t, each once (without a where there are three)",
            )
        for number in range(shape[order.index("i")]):
            at: list[Any] = [slice(None)] * len(shape)
            at[order.index("i")] = number
            found = np.asarray(array[tuple(at)], np.float64)
            rest = order.replace("i", "")
            if "a" not in rest:
                found, rest = found[..., None], f"{rest}a"
            found = found.transpose([rest.index(letter) for letter in "oat"])
            yield found.reshape(-1, found.shape[-1])


def _chosen(path: Path, members: Members, name: str) -> Any:
    offered = [one for one in members.members if len(one.array.shape) in (3, 4)]
    named = [one for one in offered if one.name == name] if name else offered
    if not named:
        names = ", ".join(quoted(one.name) for one in offered[:10]) or "none"
        raise refusal(path, f"it has no array {quoted(name)}", f"one of {names}")
    return max(named, key=lambda one: int(np.prod(one.array.shape))).array


def _opened(path: Path) -> AbstractContextManager[Members]:
    file_format = reader_of(path).name
    if file_format not in _OPENED:
        raise refusal(path, f"it is a {file_format} file", "NPY, NPZ, MATLAB or HDF5")
    return _OPENED[file_format](path)
