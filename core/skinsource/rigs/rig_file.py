"""A rig as a file: JSON text that can be written by hand, and is checked when it is read."""

import os
from pathlib import Path

from skinsource import codec
from skinsource.codec.json_text import MAX_TEXT_BYTES
from skinsource.codec.plain_text import from_plain_text, to_plain_text
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.fields import Address
from skinsource.files import named, read_bytes, write_bytes
from skinsource.quoting import sentence
from skinsource.rigs.rig import Rig

FORMAT, VERSION = "skinsource rig", 1
SUFFIX = ".skinrig"


def save_rig(path: str | os.PathLike[str], rig: Rig) -> None:
    """Write a rig, whole or not at all.

    Parameters
    ----------
    path
        The file; it usually ends in ``.skinrig``.  What stands there is replaced.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        It holds so much that it could not be read again.
    """
    write_bytes(Path(path), to_plain_text(codec.encode(rig), FORMAT, VERSION).encode())


def open_rig(path: str | os.PathLike[str]) -> Rig:
    """Read a rig file.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It holds no rig, or what no rig can be: the message says where.
    """
    place = Path(path)
    try:
        tree = from_plain_text(read_bytes(place, most=MAX_TEXT_BYTES + 1), FORMAT, VERSION)
        found: Rig = codec.decode(tree, (Rig,), Address())
    except (FileFormatError, InvalidInputError) as error:
        words = str(error).removeprefix(f"{named(Path(place.name))}: ")
        raise FileFormatError(f"{named(Path(place.name))}: {sentence(words)}") from error
    return found
