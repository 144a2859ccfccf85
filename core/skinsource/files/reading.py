"""Reading that ends: only from regular files, and only so much."""

import os
import stat
from pathlib import Path

from skinsource.errors import FileFormatError, StorageError
from skinsource.files.reasons import advice_on_reading, named, reason_of


def read_bytes(path: Path, *, most: int) -> bytes:
    """Return what the file holds.

    Pipes and devices are refused unread: they may never answer, or never end.

    Raises
    ------
    StorageError
        The file cannot be read, or is none.
    FileFormatError
        It holds more than ``most`` bytes.
    """
    try:
        with open(path, "rb", opener=_open_at_once) as file:
            about = os.fstat(file.fileno())
            if not stat.S_ISREG(about.st_mode):
                raise StorageError(
                    f"{named(path)}: cannot be read (it is no regular file). Choose a file."
                )
            # It may grow while it is read.
            content = b"" if about.st_size > most else file.read(about.st_size + 1)
    except (OSError, ValueError) as error:
        raise StorageError(
            f"{named(path)}: cannot be read ({reason_of(error)}). {advice_on_reading(error)}"
        ) from error
    if about.st_size > most or len(content) > most:
        raise FileFormatError(
            f"{named(Path(path.name))}: {about.st_size} bytes are too large for it, expected at "
            f"most {most}."
        )
    return content


def is_there(path: Path) -> bool:
    """Whether something stands at ``path``, as far as one may look."""
    try:
        return os.path.lexists(path)
    except (OSError, ValueError):
        return False


def is_file(path: Path) -> bool:
    """Whether ``path`` is a regular file, or a link to one.

    Raises
    ------
    StorageError
        That cannot be found out: the folder may not be searched, or no name can be that long.
    """
    return stat.S_ISREG(_mode_of(path))


def is_folder(path: Path) -> bool:
    """Whether ``path`` is a folder, or a link to one; raises what `is_file` raises."""
    return stat.S_ISDIR(_mode_of(path))


def _mode_of(path: Path) -> int:
    try:
        return path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return 0
    except (OSError, ValueError) as error:
        raise StorageError(
            f"{named(path)}: cannot be looked at ({reason_of(error)}). {advice_on_reading(error)}"
        ) from error


def _open_at_once(path: str, flags: int) -> int:
    # Opening a pipe does not wait for whoever writes to it.
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
