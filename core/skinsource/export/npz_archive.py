"""Archives of arrays that ``numpy.load`` reads, written piece by piece."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO, BinaryIO
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from skinsource.arrays import Floats

# The date that stands for none: an archive tells of its content, not of when it was made.
_NO_DATE = (1980, 1, 1, 0, 0, 0)


class GrowingArray:
    """A float64 array that grows along time, its last axis.

    It is stored column by column ("Fortran order"): samples of one time lie together, so that it
    can be written time by time and is read as (..., n_times) all the same.
    """

    def __init__(self, member: IO[bytes], shape: tuple[int, ...]) -> None:
        self._member, self._shape = member, shape
        self.n_times = 0
        npy.write_array_header_2_0(member, {"descr": "<f8", "fortran_order": True, "shape": shape})

    def add(self, block: Floats) -> None:
        """Write the samples that follow, (..., n)."""
        self._member.write(np.ascontiguousarray(block.T, dtype="<f8").data)
        self.n_times += block.shape[-1]

    def finish(self) -> None:
        """Raise `ValueError` unless all times were written."""
        if self.n_times != self._shape[-1]:
            raise ValueError(f"{self.n_times} times were written, expected {self._shape[-1]}")


class NpzArchive:
    """An archive that is being written: neither packed nor dated.

    Parameters
    ----------
    file
        Where to; it stays open.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._zip = ZipFile(file, "w", ZIP_STORED, allowZip64=True)

    def __enter__(self) -> "NpzArchive":
        return self

    def __exit__(self, *_: object) -> None:
        self._zip.close()

    def put(self, name: str, array: NDArray[np.generic]) -> None:
        """Write a whole array."""
        with self._member(name) as member:
            npy.write_array(member, array, version=(2, 0), allow_pickle=False)

    @contextmanager
    def growing(self, name: str, shape: tuple[int, ...]) -> Iterator[GrowingArray]:
        """Give an array of ``shape`` to write time by time."""
        with self._member(name) as member:
            array = GrowingArray(member, shape)
            yield array
            array.finish()

    def _member(self, name: str) -> IO[bytes]:
        return self._zip.open(ZipInfo(f"{name}.npy", _NO_DATE), "w", force_zip64=True)
