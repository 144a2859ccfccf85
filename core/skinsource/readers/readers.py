"""Every format that a recording can be taken from."""

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

from skinsource.base.errors import StorageError
from skinsource.base.files import is_file, named
from skinsource.readers import arrays, audio, text
from skinsource.readers.reader import Block, Found, Reader

_HDF5 = b"\x89HDF\r\n\x1a\n"
_BEGINNING_BYTES = 4096


def _begins(*signatures: bytes) -> "partial[bool]":
    return partial(_begins_with, signatures)


def _begins_with(signatures: tuple[bytes, ...], beginning: bytes) -> bool:
    return beginning.startswith(signatures)


def _is_matlab_7_3(beginning: bytes) -> bool:
    return beginning[512:520] == _HDF5


def _is_hdf5(beginning: bytes) -> bool:
    return any(beginning[at : at + 8] == _HDF5 for at in (0, 512, 1024, 2048))


def _of_members(name: str, endings: tuple[str, ...], recognises, opened: arrays.Open) -> Reader:  # type: ignore[no-untyped-def]
    return Reader(
        name=name,
        endings=endings,
        recognises=recognises,
        look=partial(arrays.look, file_format=name, opened=opened),
        blocks=partial(arrays.blocks, opened=opened),
    )


def _of_sound(name: str, endings: tuple[str, ...], *signatures: bytes) -> Reader:
    return Reader(
        name=name,
        endings=endings,
        recognises=_begins(*signatures),
        look=audio.look,
        blocks=audio.blocks,
    )


#: In the order in which a file is tried; the last one takes what no other recognises.
READERS: tuple[Reader, ...] = (
    _of_sound("WAV", (".wav", ".wave", ".w64"), b"RIFF", b"RIFX", b"RF64", b"riff"),
    _of_sound("FLAC", (".flac",), b"fLaC"),
    _of_sound("AIFF", (".aif", ".aiff", ".aifc"), b"FORM"),
    _of_sound("OGG", (".ogg", ".oga", ".opus"), b"OggS"),
    _of_members("NPY", (".npy",), _begins(b"\x93NUMPY"), arrays.opened_npy),
    _of_members("NPZ", (".npz",), _begins(b"PK\x03\x04", b"PK\x05\x06"), arrays.opened_npz),
    _of_members("MATLAB 7.3", (".mat",), _is_matlab_7_3, arrays.opened_hdf5),
    _of_members("HDF5", (".h5", ".hdf5", ".hdf", ".nwb"), _is_hdf5, arrays.opened_hdf5),
    _of_members("MATLAB", (".mat",), _begins(b"MATLAB 5.0"), arrays.opened),
    Reader(
        name="text",
        endings=(".csv", ".tsv", ".txt", ".dat"),
        recognises=lambda _: True,
        look=text.look,
        blocks=text.blocks,
    ),
)


def endings() -> tuple[str, ...]:
    """Endings of all files that may be tried."""
    return tuple(dict.fromkeys(ending for reader in READERS for ending in reader.endings))


def reader_of(path: Path) -> Reader:
    """The reader of a file, by what it begins with; its ending says nothing.

    Raises
    ------
    StorageError
        The file cannot be read, or is none.
    """
    if not is_file(path):
        raise StorageError(f"{named(path)}: cannot be read (it is no file). Choose a file.")
    try:
        with path.open("rb") as file:
            beginning = file.read(_BEGINNING_BYTES)
    except OSError as error:
        raise StorageError(
            f"{named(path)}: cannot be read ({error.strerror or error}). Ask its owner for the "
            "right to read it."
        ) from error
    return next(reader for reader in READERS if reader.recognises(beginning))


def look(path: Path) -> Found:
    """Return what a file holds; see `Reader`."""
    return reader_of(path).look(path)


def blocks(path: Path, keys: Sequence[str], start: int, stop: int) -> Iterator[Block]:
    """Give samples of some of its signals; see `Reader`."""
    return reader_of(path).blocks(path, keys, start, stop)
