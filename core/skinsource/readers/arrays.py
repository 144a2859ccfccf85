"""Signals of files that hold named arrays: NPY, NPZ, MAT and HDF5.

Foreign files are not trusted.  Of NPY and NPZ the header is read first, and nothing is unpickled.
Of MATLAB files before 7.3 the sizes of all variables are read before their values.  HDF5,
which MATLAB 7.3 files are too, is read link by link: links to other files are not followed, and a
dataset that declares much more than the file can hold is left out.
"""

import re
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.lib import format as npy

from skinsource.base import files
from skinsource.base.errors import printable, quoted
from skinsource.readers import limits
from skinsource.readers.reader import Block, Found, Series, reading_error, unknown_series_error
from skinsource.readers.units import time_unit_s, unit_named

_RATE_NAMES = re.compile(
    r"(fs|sr|rate|srate|samplerate|samplingrate|samplefrequency|samplingfrequency|frequency)(hz)?"
)
_KINDS = "iuf"
_MOST_MEMBERS = 4096
_ITEM_BYTES = 8

# deflate, shuffle, checksum, szip, nbit, scale and offset, lzf: the filters of the library itself.
_FILTERS = frozenset({1, 2, 3, 4, 5, 6, 32000})
_MOST_CHUNK_BYTES = 64 * 2**20
_MOST_LINKS = 10_000
# Groups in which MATLAB keeps data of its own.
_MATLAB_GROUPS = ("#refs#", "#subsystem#")


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """An array of a file.

    Attributes
    ----------
    name
        Its path in the file: "tap/acceleration".
    array
        Has ``shape`` and ``dtype``, and gives parts of itself; nothing is read before that.
    unit, rate_hz
        As the file states them.
    """

    name: str
    array: Any
    unit: str = ""
    rate_hz: float | None = None


@dataclass(slots=True)
class Members:
    """The arrays of an open file, and notes on arrays that are left out."""

    members: list[Member] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def leave_out(self, name: str, reason: str) -> None:
        """Note why an array is not offered."""
        note = f"Left out: {quoted(name)}, {reason}."
        if note not in self.notes and len(self.notes) < 20:
            self.notes.append(note)


#: Opens a file; its members are valid as long as the file is open.
Open = Callable[[Path], AbstractContextManager[Members]]


def look(path: Path, file_format: str, opened: Open) -> Found:
    """Return the signals among the arrays of a file."""
    with opened(path) as members:
        offered = list(_offered(members))
        rate = stated_rate(members)
        if not offered:
            left_out = " ".join(members.notes) or "It holds no array of numbers."
            raise reading_error(
                path,
                f"nothing in it can be played: {left_out.rstrip('.')}",
                "a list of real numbers",
                "Choose another file, or save the signal as a plain array.",
            )
        series = tuple(series for series, *_ in offered)
        if len(series) > limits.MOST_SERIES:
            members.notes.append(f"Left out: all after the first {limits.MOST_SERIES} signals.")
        return Found(
            format=file_format,
            series=series[: limits.MOST_SERIES],
            rate_hz=rate[1] if rate else None,
            rate_from=quoted(rate[0]) if rate else "",
            notes=tuple(members.notes),
        )


def blocks(path: Path, keys: Sequence[str], start: int, stop: int, opened: Open) -> Iterator[Block]:
    """Give samples of some signals among the arrays of a file."""
    with opened(path) as members:
        offered = {series.key: (series, member, axis) for series, member, axis in _offered(members)}
        chosen = []
        for key in keys:
            if key not in offered:
                raise unknown_series_error(path, key)
            chosen.append(offered[key])
        stop = min([stop, *(series.n_samples for series, *_ in chosen)])
        for first in range(start, stop, limits.BLOCK):
            end = min(first + limits.BLOCK, stop)
            parts = [_part(series, member, axis, first, end) for series, member, axis in chosen]
            yield np.stack(parts)


def _part(series: Series, member: Member, axis: int, start: int, end: int) -> np.ndarray:
    index: list[Any] = [0] * len(member.array.shape)
    index[axis] = slice(start, end)
    if len(index) == 2:
        index[1 - axis] = _column(series.key)
    part = np.asarray(member.array[tuple(index)])
    return part.astype(np.float64, copy=False)


def _column(key: str) -> int:
    return int(key.rpartition("[")[2].rstrip("]")) if key.endswith("]") else 0


def _offered(members: Members) -> Iterator[tuple[Series, Member, int]]:
    """Give each signal with its array and the axis along which time runs."""
    for member in members.members:
        shape, kind = tuple(int(n) for n in member.array.shape), np.dtype(member.array.dtype)
        if kind.kind not in _KINDS or kind.itemsize > 8:
            members.leave_out(member.name, f"it holds {printable(kind)}, not real numbers")
            continue
        if max(shape, default=0) < 2:
            continue  # a number, such as a rate
        if len(shape) > 2 or min(shape) == 0:
            size = "×".join(map(str, shape))
            members.leave_out(member.name, f"it is an array of {size}, not a list of signals")
            continue
        axis = int(np.argmax(shape))
        columns = shape[1 - axis] if len(shape) == 2 else 1
        if columns > limits.MOST_COLUMNS:
            members.leave_out(
                member.name,
                f"it has {columns} columns, expected at most {limits.MOST_COLUMNS}",
            )
            continue
        for column in range(columns):
            yield _series(member, shape, axis, column, columns), member, axis


def _series(
    member: Member, shape: tuple[int, ...], axis: int, column: int, n_columns: int
) -> Series:
    base = member.name.rpartition("/")[2]
    time_s = time_unit_s(base, member.unit) if n_columns == 1 else None
    return Series(
        key=member.name if n_columns == 1 else f"{member.name}[{column}]",
        name=printable(member.name if n_columns == 1 else f"{member.name}, column {column + 1}"),
        n_samples=shape[axis],
        dtype=str(np.dtype(member.array.dtype)),
        shape=shape,
        unit=unit_named(member.unit),
        rate_hz=member.rate_hz,
        is_time=time_s is not None,
        time_unit_s=time_s or 1.0,
    )


def stated_rate(members: Members) -> tuple[str, float] | None:
    """Return the number in a file that is named like a rate, and its name; None: there is none."""
    for member in members.members:
        shape = tuple(member.array.shape)
        if int(np.prod(shape)) != 1 or np.dtype(member.array.dtype).kind not in _KINDS:
            continue
        rate_hz = _rate_named(member.name.rpartition("/")[2], np.asarray(member.array[()]))
        if rate_hz is not None:
            return member.name, rate_hz
    return None


def _rate_named(name: str, value: np.ndarray) -> float | None:
    """Return the only number in an array as a rate in Hz; None if ``name`` is not that of one."""
    plain = re.sub(r"[^a-z]", "", name.lower())
    if not _RATE_NAMES.fullmatch(plain):
        return None
    rate_hz = float(value.item())
    return rate_hz if limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ else None


@contextmanager
def opened_npy(path: Path) -> Iterator[Members]:
    """Give the array of an NPY file; parts are read when they are needed."""
    # NumPy compares its header with the length of the file.
    array = np.load(path, mmap_mode="r", allow_pickle=False)
    yield Members([Member(name="the array", array=array)])


@contextmanager
def opened_npz(path: Path) -> Iterator[Members]:
    """Give the arrays of an NPZ file; each is unpacked when it is first read."""
    members = Members()
    with zipfile.ZipFile(path) as archive:
        for info in archive.infolist()[:_MOST_MEMBERS]:
            if info.is_dir() or not info.filename.endswith(".npy"):
                continue
            name = info.filename.removesuffix(".npy")
            if info.flag_bits & 1:
                members.leave_out(name, "it is encrypted")
                continue
            array = _PackedArray(archive, info)
            n_bytes = prod(array.shape) * array.dtype.itemsize
            if array.dtype.hasobject:
                members.leave_out(name, "it holds Python objects")
            elif _is_bomb(n_bytes, info.compress_size):
                members.leave_out(name, f"it would unpack to {n_bytes} bytes, which is too much")
            else:
                members.members.append(Member(name=name, array=array))
        yield members


class _PackedArray:
    """An array in an archive, which is unpacked when it is first read."""

    def __init__(self, archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> None:
        self._archive, self._info = archive, info
        with archive.open(info) as file:
            first = npy.read_magic(file) == (1, 0)
            read = npy.read_array_header_1_0 if first else npy.read_array_header_2_0
            self.shape, _, self.dtype = read(file)

    def __getitem__(self, index: Any) -> Any:
        return self._array[index]

    @cached_property
    def _array(self) -> np.ndarray:
        with self._archive.open(self._info) as file:
            array = npy.read_array(file, allow_pickle=False)
            file.read(1)  # at the end zipfile compares the checksum
        return np.asarray(array)


def _is_bomb(unpacked_bytes: int, packed_bytes: int) -> bool:
    suspicious = unpacked_bytes > max(limits.SUSPICIOUS_BYTES, limits.MOST_RATIO * packed_bytes)
    return unpacked_bytes > limits.MOST_BYTES or suspicious


@contextmanager
def opened_matlab(path: Path) -> Iterator[Members]:
    """Give the arrays of a MATLAB file before 7.3, also those in structures."""
    unpacked_bytes = sum(_ITEM_BYTES * prod(shape) for _, shape, _ in scipy.io.whosmat(path))
    if _is_bomb(unpacked_bytes, path.stat().st_size):
        raise reading_error(
            path,
            f"it would unpack to {unpacked_bytes} bytes",
            f"at most {limits.MOST_BYTES}, and {limits.MOST_RATIO} times its own size",
            "Save the part that you need, or save it with -v7.3.",
        )
    members = Members()
    for name, value in scipy.io.loadmat(path, simplify_cells=True).items():
        if not name.startswith("__"):
            _collect(name, value, members, 0)
    yield members


def _collect(name: str, value: Any, members: Members, depth: int) -> None:
    if depth >= limits.MOST_DEPTH:
        members.leave_out(name, f"it is more than {limits.MOST_DEPTH} structures deep")
    elif isinstance(value, Mapping):
        for inner, part in list(value.items())[:_MOST_MEMBERS]:
            _collect(f"{name}/{inner}", part, members, depth + 1)
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


@contextmanager
def opened_hdf5(path: Path) -> Iterator[Members]:
    """Give the datasets of an HDF5 file; parts are read when they are needed."""
    with files.File(path, "r", locking=False) as file:
        members = Members()
        _walk(file, "", members, _Walk(path.stat().st_size), 0)
        yield members


class _Walk:
    """What was visited in an HDF5 file."""

    def __init__(self, file_bytes: int) -> None:
        self.file_bytes = file_bytes
        self.visited: set[Any] = set()
        self.links = 0

    def is_new(self, thing: Any) -> bool:
        """Whether this is the first visit of a group or dataset: groups can hold themselves."""
        info = files.h5o.get_info(thing.id)
        address = (info.fileno, info.addr)
        if address in self.visited:
            return False
        self.visited.add(address)
        return True


def _walk(group: Any, prefix: str, members: Members, walk: _Walk, depth: int) -> None:
    for name in group:
        walk.links += 1
        if walk.links > _MOST_LINKS:
            members.leave_out(prefix or "/", f"it holds more than {_MOST_LINKS} things")
            return
        full = f"{prefix}{name}"
        if not prefix and name in _MATLAB_GROUPS:
            continue
        if not isinstance(group.get(name, getlink=True), files.HardLink):
            members.leave_out(full, "it is a link that leads elsewhere")
            continue
        thing = group[name]
        if not walk.is_new(thing):
            continue
        if isinstance(thing, files.Dataset):
            _add(thing, full, members, walk)
        elif isinstance(thing, files.Group):
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
    """Return why a dataset cannot be read; empty if it can."""
    if dataset.shape is None:
        return "it is empty"
    if dataset.external or dataset.is_virtual:
        return "it lies in another file"
    kind = dataset.dtype
    if kind.kind not in "iuf":
        return f"it holds {'text or objects' if kind.kind in 'OSU' else kind}, not real numbers"
    creation = dataset.id.get_create_plist()
    filters = [creation.get_filter(k)[0] for k in range(creation.get_nfilters())]
    if not _FILTERS.issuperset(filters):
        return "it is packed in a way that is not known here"
    if dataset.chunks and prod(dataset.chunks) * kind.itemsize > _MOST_CHUNK_BYTES:
        return f"its chunks are larger than {_MOST_CHUNK_BYTES} bytes"
    declared = prod(dataset.shape) * kind.itemsize
    most_bytes = max(limits.MOST_RATIO * file_bytes, limits.SUSPICIOUS_BYTES)
    if declared > most_bytes:
        return f"it declares {declared} bytes and the file has {file_bytes}"
    stored = dataset.id.get_storage_size()
    if (not stored and declared) or (not filters and stored < declared):
        return f"it declares {declared} bytes and holds {stored}"
    return ""


def _attributes(dataset: Any) -> tuple[str, float | None]:
    """Return the unit and the rate that attributes of a dataset state."""
    unit, rate_hz = "", None
    for name in list(dataset.attrs)[:100]:
        if dataset.attrs.get_id(name).get_storage_size() > 1024:
            continue
        value = dataset.attrs[name]
        if name.lower() in ("unit", "units"):
            text = value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
            unit = text[:40]
        elif np.size(value) == 1 and (number := np.asarray(value)).dtype.kind in _KINDS:
            rate_hz = _rate_named(name, number) or rate_hz
    return unit, rate_hz
