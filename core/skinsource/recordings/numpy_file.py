"""NPY and NPZ: the header is read first, and nothing is ever unpickled."""

import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from math import prod
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy

from skinsource.quoting import quoted
from skinsource.recordings import limits
from skinsource.recordings.members import Member, Members
from skinsource.recordings.reader import refusal

_MOST_MEMBERS = 4096
_AGAIN = "The file is damaged or incomplete; save it again with numpy.save."


@dataclass(frozen=True, slots=True)
class _Header:
    shape: tuple[int, ...]
    fortran_order: bool
    dtype: np.dtype[Any]

    @property
    def n_bytes(self) -> int:
        return prod(self.shape) * self.dtype.itemsize


@contextmanager
def opened_npy(path: Path) -> Iterator[Members]:
    """Give the array of an NPY file, which is read where it is needed."""
    with path.open("rb") as file:
        header = _header(path, file)
        offset = file.tell()
    there = path.stat().st_size - offset
    members = Members()
    if header.dtype.hasobject:
        members.leave_out("the array", "it holds Python objects")
    elif header.n_bytes > there:
        raise refusal(
            path,
            f"its header promises {header.n_bytes} bytes and {there} are there",
            "all of them",
            _AGAIN,
        )
    elif header.n_bytes:
        array = np.memmap(
            path,
            dtype=header.dtype,
            mode="r",
            offset=offset,
            shape=header.shape,
            order="F" if header.fortran_order else "C",
        )
        members.members.append(Member(name="the array", array=array))
    yield members


@contextmanager
def opened_npz(path: Path) -> Iterator[Members]:
    """Give the arrays of an NPZ file; each is unpacked when it is first read."""
    members = Members()
    with zipfile.ZipFile(path) as archive:
        infos = archive.infolist()
        if len(infos) > _MOST_MEMBERS:
            raise refusal(path, f"it holds {len(infos)} files", f"at most {_MOST_MEMBERS}", _AGAIN)
        for info in infos:
            if info.is_dir() or not info.filename.endswith(".npy"):
                continue
            name = info.filename.removesuffix(".npy")
            if info.flag_bits & 1:
                members.leave_out(name, "it is encrypted")
                continue
            with archive.open(info) as file:
                header = _header(path, file)
                start = file.tell()
            if header.dtype.hasobject:
                members.leave_out(name, "it holds Python objects")
                continue
            if start + header.n_bytes != info.file_size:
                raise refusal(
                    path,
                    f"the header of {quoted(name)} promises {header.n_bytes} bytes and "
                    f"{info.file_size - start} are there",
                    "all of them",
                    _AGAIN,
                )
            if _is_bomb(info, header):
                members.leave_out(
                    name, f"it would unpack to {header.n_bytes} bytes, which is too much"
                )
                continue
            members.members.append(Member(name=name, array=_Packed(path, archive, info, header)))
        yield members


class _Packed:
    """An array in an archive."""

    def __init__(
        self, path: Path, archive: zipfile.ZipFile, info: zipfile.ZipInfo, header: _Header
    ) -> None:
        self._path, self._archive, self._info, self._header = path, archive, info, header
        self.shape, self.dtype = header.shape, header.dtype

    def __getitem__(self, place: Any) -> Any:
        return self._whole[place]

    @cached_property
    def _whole(self) -> np.ndarray:
        header = self._header
        with self._archive.open(self._info) as file:
            _header(self._path, file)
            content = file.read(header.n_bytes)
            file.read(1)  # at its end the checksum is looked at
        if len(content) != header.n_bytes:
            raise refusal(self._path, "it ends too early", f"{header.n_bytes} bytes", _AGAIN)
        flat = np.frombuffer(content, header.dtype)
        return flat.reshape(header.shape, order="F" if header.fortran_order else "C")


def _is_bomb(info: zipfile.ZipInfo, header: _Header) -> bool:
    ratio = header.n_bytes / max(info.compress_size, 1)
    suspicious = header.n_bytes > limits.SUSPICIOUS_BYTES and ratio > limits.MOST_RATIO
    return header.n_bytes > limits.MOST_BYTES or suspicious


def _header(path: Path, file: IO[bytes]) -> _Header:
    version = npy.read_magic(file)
    read = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}.get(version)
    if read is None:
        raise refusal(
            path,
            f"its NPY version is {version[0]}.{version[1]}",
            "1.0 or 2.0",
            "Save it as a plain array with numpy.save.",
        )
    shape, fortran_order, dtype = read(file)
    if any(n < 0 for n in shape):
        raise refusal(path, f"its shape is {quoted(shape)}", "lengths of 0 or more", _AGAIN)
    return _Header(tuple(int(n) for n in shape), bool(fortran_order), dtype)
