"""The readers of all formats of recordings, and the choice of one by the content of a file."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from skinsource.base.conventions import Floats
from skinsource.base.errors import StorageError
from skinsource.base.files import is_file, path_text, storage_errors_of
from skinsource.readers import arrays, audio, text
from skinsource.readers.reader import Block, Found, Overview, Reader

_HDF5 = b"\x89HDF\r\n\x1a\n"
_BEGINNING_BYTES = 4096


def _begins(*signatures: bytes) -> Callable[[bytes], bool]:
    return lambda beginning: beginning.startswith(signatures)


def _is_hdf5(beginning: bytes) -> bool:
    return any(beginning[at : at + 8] == _HDF5 for at in (0, 512, 1024, 2048))


def _array_reader(
    name: str, endings: tuple[str, ...], recognises: Callable[[bytes], bool], opened: arrays.Open
) -> Reader:
    look = partial(arrays.look, file_format=name, opened=opened)
    return Reader(name, endings, recognises, look, partial(arrays.blocks, opened=opened))


def _sound_reader(name: str, endings: tuple[str, ...], *signatures: bytes) -> Reader:
    return Reader(name, endings, _begins(*signatures), audio.look, audio.blocks)


# A file goes to the first one that recognises it; the last one takes all other files.
_READERS: tuple[Reader, ...] = (
    _sound_reader("WAV", (".wav", ".wave", ".w64"), b"RIFF", b"RIFX", b"RF64", b"riff"),
    _sound_reader("FLAC", (".flac",), b"fLaC"),
    _sound_reader("AIFF", (".aif", ".aiff", ".aifc"), b"FORM"),
    _sound_reader("OGG", (".ogg", ".oga", ".opus"), b"OggS"),
    _array_reader("NPY", (".npy",), _begins(b"\x93NUMPY"), arrays.opened_npy),
    _array_reader("NPZ", (".npz",), _begins(b"PK\x03\x04", b"PK\x05\x06"), arrays.opened_npz),
    _array_reader(
        "MATLAB 7.3", (".mat",), lambda begin: begin[512:520] == _HDF5, arrays.opened_hdf5
    ),
    _array_reader("HDF5", (".h5", ".hdf5", ".hdf", ".nwb"), _is_hdf5, arrays.opened_hdf5),
    _array_reader("MATLAB", (".mat",), _begins(b"MATLAB 5.0"), arrays.opened_matlab),
    Reader("text", (".csv", ".tsv", ".txt", ".dat"), lambda _: True, text.look, text.blocks),
)


def endings() -> tuple[str, ...]:
    """Return the endings of the names of all files that can be read."""
    return tuple(dict.fromkeys(ending for reader in _READERS for ending in reader.endings))


def reader_of(path: Path) -> Reader:
    """Return the reader of a file, by its first bytes; the ending of its name does not matter.

    Raises
    ------
    StorageError
        The file cannot be read, or is no regular file.
    """
    if not is_file(path):
        raise StorageError(f"{path_text(path)}: cannot be read (it is not a file). Choose a file.")
    advice = "Ask its owner for permission to read it."
    with storage_errors_of(path, reading=advice), path.open("rb") as file:
        beginning = file.read(_BEGINNING_BYTES)
    return next(reader for reader in _READERS if reader.recognises(beginning))


def look(path: Path) -> Found:
    """Return what a file holds; see `Reader`."""
    return reader_of(path).look(path)


def look_tree(path: Path) -> dict[str, Any]:
    """Return what a file holds as a tree for JSON."""
    return asdict(look(path))


def blocks(path: Path, keys: Sequence[str], start: int, end: int) -> Iterator[Block]:
    """Give samples ``start`` to ``end`` of some of its signals; see `Reader`."""
    return reader_of(path).blocks(path, keys, start, end)


def overview(path: Path, key: str, n_samples: int, columns: int) -> Iterator[Floats]:
    """Give the extremes of stretches of a signal, (2, columns), as far as they are known."""
    extremes = Overview(n_samples, columns)
    for block in blocks(path, [key], 0, n_samples):
        extremes.add(block)
        yield extremes.extremes
