"""HDF5, and MATLAB 7.3, which is HDF5.

Walked link by link: what leads to other files, or is computed from them, is not followed, and what
declares much more than the file can hold is not believed.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.files import hdf5
from skinsource.recordings import limits
from skinsource.recordings.members import Member, Members, rate_in

# deflate, shuffle, checksum, szip, nbit, scale and offset, lzf: those that come with the library.
_FILTERS = frozenset({1, 2, 3, 4, 5, 6, 32000})
_MOST_CHUNK_BYTES = 64 * 2**20
_MOST_LINKS = 10_000
# Where MATLAB keeps what others refer to.
_MATLABS_OWN = ("#refs#", "#subsystem#")
_ELSEWHERE = "it lies in another file"


@contextmanager
def opened(path: Path) -> Iterator[Members]:
    """Give the datasets of a file, which are read where they are needed."""
    with hdf5.File(path, "r", locking=False) as file:
        members = Members()
        _walk(file, "", members, _Walk(path.stat().st_size), 0)
        yield members


class _Walk:
    """How far the walk is."""

    def __init__(self, file_bytes: int) -> None:
        self.file_bytes = file_bytes
        self.seen: set[Any] = set()
        self.links = 0

    def is_new(self, thing: Any) -> bool:
        """Whether this has not been met before: groups can hold themselves."""
        about = hdf5.h5o.get_info(thing.id)
        known = (about.fileno, about.addr)
        if known in self.seen:
            return False
        self.seen.add(known)
        return True


def _walk(group: Any, prefix: str, members: Members, walk: _Walk, depth: int) -> None:
    for name in group:
        walk.links += 1
        if walk.links > _MOST_LINKS:
            members.leave_out(prefix or "/", f"it holds more than {_MOST_LINKS} things")
            return
        full = f"{prefix}{name}"
        if not prefix and name in _MATLABS_OWN:
            continue
        if not isinstance(group.get(name, getlink=True), hdf5.HardLink):
            members.leave_out(full, "it is a link that leads elsewhere")
            continue
        thing = group[name]
        if not walk.is_new(thing):
            continue
        if isinstance(thing, hdf5.Dataset):
            _add(thing, full, members, walk)
        elif isinstance(thing, hdf5.Group):
            if depth + 1 >= limits.MOST_DEPTH:
                members.leave_out(full, f"it is more than {limits.MOST_DEPTH} groups deep")
            else:
                _walk(thing, f"{full}/", members, walk, depth + 1)


def _add(dataset: Any, name: str, members: Members, walk: _Walk) -> None:
    reason = reason_against(dataset, walk.file_bytes)
    if reason:
        members.leave_out(name, reason)
        return
    if "MATLAB_empty" in dataset.attrs or dataset.attrs.get("MATLAB_class") == b"char":
        return
    unit, rate_hz = _attributes(dataset)
    members.members.append(Member(name=name, array=dataset, unit=unit, rate_hz=rate_hz))


def reason_against(dataset: Any, file_bytes: int) -> str:
    """Why a dataset cannot be read; empty if it can."""
    if dataset.shape is None:
        return "it is empty"
    if dataset.external or dataset.is_virtual:
        return _ELSEWHERE
    kind = dataset.dtype
    if kind.kind not in "iuf":
        return f"it holds {'text or objects' if kind.kind in 'OSU' else kind}, not real numbers"
    made = dataset.id.get_create_plist()
    filters = [made.get_filter(k)[0] for k in range(made.get_nfilters())]
    if not _FILTERS.issuperset(filters):
        return "it is packed in a way that is not known here"
    if dataset.chunks and prod(dataset.chunks) * kind.itemsize > _MOST_CHUNK_BYTES:
        return f"its chunks are larger than {_MOST_CHUNK_BYTES} bytes"
    declared = prod(dataset.shape) * kind.itemsize
    believed = max(limits.MOST_RATIO * file_bytes, limits.SUSPICIOUS_BYTES)
    if declared > believed:
        return f"it declares {declared} bytes and the file has {file_bytes}"
    stored = dataset.id.get_storage_size()
    if (not stored and declared) or (not filters and stored < declared):
        return f"it declares {declared} bytes and holds {stored}"
    return ""


def _attributes(dataset: Any) -> tuple[str, float | None]:
    """Unit and rate, where attributes that are called so hold them."""
    unit, rate_hz = "", None
    for name in list(dataset.attrs)[:100]:
        kind = dataset.attrs.get_id(name)
        if kind.get_storage_size() > 1024:
            continue
        value = dataset.attrs[name]
        if name.lower() in ("unit", "units"):
            text = value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
            unit = text[:40]
        elif isinstance(value, np.generic | np.ndarray) and np.size(value) == 1:
            rate_hz = rate_in(name, value) or rate_hz
    return unit, rate_hz
