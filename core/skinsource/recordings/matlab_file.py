"""MATLAB files of version 5 (saved with -v6 or -v7), through scipy.

scipy's reader believes what it reads, so the elements of the file are walked first: their lengths
must lie in the file, and what is unpacked must be of a size that can be.
"""

import struct
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np
import scipy

from skinsource.recordings import limits
from skinsource.recordings.members import Member, Members
from skinsource.recordings.reader import refusal

HEADER_BYTES = 128
_MATRIX, _COMPRESSED = 14, 15
_MOST_ELEMENTS = 4096
_AGAIN = "The file is damaged or incomplete; save it again in MATLAB, with -v7 or -v7.3."


@contextmanager
def opened(path: Path) -> Iterator[Members]:
    """Give the arrays of a MATLAB file, those in structures too."""
    check_elements(path)
    members = Members()
    for name, value in scipy.io.loadmat(path, simplify_cells=True).items():
        if not name.startswith("__"):
            _collect(name, value, members, 0)
    yield members


def check_elements(path: Path) -> None:
    """Refuse a file whose elements cannot be what they declare, before anything is allocated."""
    size = path.stat().st_size
    with path.open("rb") as file:
        header = file.read(HEADER_BYTES)
        order = {b"IM": "<", b"MI": ">"}.get(header[126:128])
        if len(header) < HEADER_BYTES or order is None:
            raise refusal(path, "it has no MATLAB header", "MATLAB v5, v7 or v7.3", _AGAIN)
        unpacked = 0
        for _ in range(_MOST_ELEMENTS):
            tag = file.read(8)
            if not tag:
                return
            if len(tag) < 8:
                raise refusal(path, "it ends within a tag", "whole elements", _AGAIN)
            kind, length = struct.unpack(f"{order}II", tag)
            after = file.tell() + length
            if kind not in (_MATRIX, _COMPRESSED) or after > size:
                raise refusal(
                    path,
                    f"an element of kind {kind} declares {length} bytes and {size - file.tell()} "
                    "are left",
                    "variables that lie within the file",
                    _AGAIN,
                )
            if kind == _COMPRESSED:
                unpacked += _unpacked_bytes(path, file, length, order)
                _check_size(path, unpacked, size)
            file.seek(after)
    raise refusal(path, f"it has over {_MOST_ELEMENTS} variables", "fewer", _AGAIN)


def _unpacked_bytes(path: Path, file: IO[bytes], length: int, order: str) -> int:
    beginning = zlib.decompressobj().decompress(file.read(min(length, 4096)), 8)
    if len(beginning) < 8:
        raise refusal(path, "a variable cannot be unpacked", "whole variables", _AGAIN)
    kind, inner = struct.unpack(f"{order}II", beginning)
    if kind != _MATRIX:
        raise refusal(path, f"a variable is of kind {kind}", f"kind {_MATRIX}", _AGAIN)
    return int(inner)


def _check_size(path: Path, unpacked: int, size: int) -> None:
    suspicious = unpacked > limits.SUSPICIOUS_BYTES and unpacked > limits.MOST_RATIO * size
    if unpacked > limits.MOST_BYTES or suspicious:
        raise refusal(
            path,
            f"it would unpack to {unpacked} bytes",
            f"at most {limits.MOST_BYTES}, and {limits.MOST_RATIO} times its own size",
            "Save the part that you need, or save it with -v7.3.",
        )


def _collect(name: str, value: Any, members: Members, depth: int) -> None:
    if depth >= limits.MOST_DEPTH:
        members.leave_out(name, f"it is more than {limits.MOST_DEPTH} structures deep")
    elif isinstance(value, Mapping):
        for inner, one in list(value.items())[:_MOST_ELEMENTS]:
            _collect(f"{name}/{inner}", one, members, depth + 1)
    elif isinstance(value, str):
        return  # a comment, such as the unit
    elif isinstance(value, bool | int | float | np.generic | np.ndarray):
        array = np.asarray(value)
        if array.dtype.kind in "iuf":
            members.members.append(Member(name=name, array=array))
        else:
            members.leave_out(name, f"it holds {array.dtype}, not real numbers")
    else:
        members.leave_out(name, "it is neither an array nor a structure")
