"""Whether the arrays of a MATLAB v7.3 file are all there: each piece once, in its place.

Such files are HDF5 of the oldest kind, whose indices nothing checks.  Where one bit of an index has
flipped, HDF5 gives zeros for the piece that it no longer finds, without a word.
"""

import itertools
import math
import zlib
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from skinsource.errors import DatasetError
from skinsource.files import hdf5

if TYPE_CHECKING:
    import h5py

# Numbers of HDF5's filters.
_DEFLATE, _SHUFFLE = 1, 2

WHAT_TO_DO = "The download may be cut short; run 'skinsource dataset fetch' again."


class _Span(NamedTuple):
    """Where some values lie in the file."""

    first_byte: int
    size_bytes: int
    name: str


def refuse_scattered(path: Path) -> None:
    """Refuse a MATLAB v7.3 file in which a piece of an array is missing, misplaced or shared.

    Other files pass: those of MATLAB v7 check themselves.

    Raises
    ------
    DatasetError
        Says which array and piece.
    Exception
        Whatever HDF5 raises at a damaged file.
    """
    if not hdf5.is_hdf5(path):
        return
    spans: list[_Span] = []

    def look_at(_: str, part: Any) -> None:
        if isinstance(part, hdf5.Dataset):
            spans.extend(_spans_of(part, path))

    with hdf5.File(path, "r", locking="best-effort") as file:
        file.visititems(look_at)
    for one, other in pairwise(sorted(spans)):
        if one.first_byte + one.size_bytes > other.first_byte:
            raise _damaged(path, f"{one.name} and {other.name} lie in the same place")


def _spans_of(dataset: "h5py.Dataset", path: Path) -> list[_Span]:
    """Where the values of an array lie; none where they lie in the header, which is read whole."""
    name = str(dataset.name)
    kind = dataset.id.get_type()
    # What is neither a number nor a text has parts, which are numbers in files that MATLAB wrote.
    is_number = kind.get_class() in (hdf5.h5t.INTEGER, hdf5.h5t.FLOAT)
    if is_number and not kind.equal(hdf5.h5t.py_create(dataset.dtype)):
        raise _damaged(path, f"{name} holds numbers of an unknown kind")
    how = dataset.id.get_create_plist()
    layout = how.get_layout()
    if layout == hdf5.h5d.COMPACT or not dataset.size:
        return []
    if layout == hdf5.h5d.CHUNKED:
        return _chunks_of(dataset, path)
    if layout != hdf5.h5d.CONTIGUOUS or how.get_external_count():
        raise _damaged(path, f"{name} lies in other files")
    first_byte, size_bytes = dataset.id.get_offset(), dataset.id.get_storage_size()
    if first_byte is None or size_bytes != dataset.size * kind.get_size():
        raise _damaged(path, f"{name} is not there, or not as a whole")
    return [_Span(first_byte, size_bytes, name)]


def _chunks_of(dataset: "h5py.Dataset", path: Path) -> list[_Span]:
    name, shape, chunk = str(dataset.name), dataset.shape, dataset.chunks
    assert chunk is not None  # noqa: S101, its layout says so
    how = dataset.id.get_create_plist()
    filters = tuple(how.get_filter(k)[0] for k in range(how.get_nfilters()))
    if filters not in ((), (_DEFLATE,), (_SHUFFLE, _DEFLATE)):
        raise _damaged(path, f"{name} is packed in an unknown way")
    size_bytes = math.prod(chunk) * dataset.dtype.itemsize
    expected = math.prod(-(-length // step) for length, step in zip(shape, chunk, strict=True))
    found = dataset.id.get_num_chunks()
    if found != expected:
        raise _damaged(path, f"{name} has {found} pieces, expected {expected}")
    spans = []
    for k in range(found):
        piece = dataset.id.get_chunk_info(k)
        spans.append(_Span(piece.byte_offset, piece.size, f"{name}, piece {k + 1}"))
    starts = (range(0, length, step) for length, step in zip(shape, chunk, strict=True))
    for place in itertools.product(*starts):
        # The index is asked as it is when the array is read.  A list of its entries says less: it
        # leaves out parts of them.
        if _unpacked_bytes(_piece_at(dataset, place), filters) != size_bytes:
            raise _damaged(path, f"the piece of {name} at {place} is missing or damaged")
    return spans


def _piece_at(dataset: "h5py.Dataset", place: tuple[int, ...]) -> bytes:
    """Bytes of a piece as they lie in the file; none where it is missing, or packed otherwise."""
    try:
        mask, packed = dataset.id.read_direct_chunk(place)
    except (OSError, RuntimeError):
        return b""
    return b"" if mask else packed


def _unpacked_bytes(packed: bytes, filters: tuple[int, ...]) -> int:
    """Length of the values in a piece; -1 where they are damaged."""
    if not filters:
        return len(packed)
    try:
        return len(zlib.decompress(packed))
    except zlib.error:
        return -1


def _damaged(path: Path, what: str) -> DatasetError:
    return DatasetError(f"{path.name}: is damaged: {what}. {WHAT_TO_DO}")
