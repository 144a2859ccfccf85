"""Files are written whole or not at all."""

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from skinsource.errors import StorageError
from skinsource.files.leftovers import sweep, temporary_beside
from skinsource.files.reasons import advice_on_writing, named, reason_of


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside ``path`` to write to; move it into place at the end.

    The temporary file is flushed to disk before the move.  On any error it is deleted, and
    what stood at ``path`` stands there still.  Where ``path`` is a link, what it leads to is
    replaced and the link stays.  A file that is replaced hands down its permissions; a new one
    has those that new files usually have.  What killed writers left in the folder long ago is
    deleted.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    with explained(path):
        target = _link_followed(path)
        mode = _mode_of(target)
        sweep(target.parent)
        temporary = temporary_beside(target)
        _create(temporary, private=mode is not None)
    try:
        with explained(path):
            yield temporary
            flush_file(temporary)
            if mode is not None:
                temporary.chmod(mode)
            temporary.replace(target)
            flush_folder(target.parent)
    finally:
        _discard(temporary)


def write_bytes(path: Path, content: bytes) -> None:
    """Write ``content`` to ``path``, whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_bytes(content)


def make_folder(path: Path) -> None:
    """Create ``path`` and its parents; say in one sentence why that is not possible."""
    with explained(path):
        path.mkdir(parents=True, exist_ok=True)


@contextmanager
def explained(path: Path) -> Iterator[None]:
    """Turn what the system refuses into a `StorageError` that names ``path``."""
    try:
        if "\0" in str(path):
            raise _BadPath("its name holds a character of value zero")
        yield
    except (OSError, _BadPath) as error:
        raise StorageError(
            f"{named(path)}: cannot be written ({reason_of(error)}). {advice_on_writing(error)}"
        ) from error


class _BadPath(ValueError):
    """No file can have this path."""


def _link_followed(path: Path) -> Path:
    if not path.is_symlink():
        return path
    target = Path(os.path.realpath(path))
    if target.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return target


def _mode_of(path: Path) -> int | None:
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return None
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        # A file would take its place: for who may, that of /dev/null too.
        raise _BadPath("a device or a pipe stands there, no file")
    return stat.S_IMODE(mode)


def _create(path: Path, *, private: bool) -> None:
    # Of 0o666 the operating system takes away what the user wants taken away.  What replaces
    # another file is for the user's eyes alone until it has that file's permissions.
    mode = 0o600 if private else 0o666
    os.close(os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, mode))


def _discard(temporary: Path) -> None:
    if temporary.exists():
        # Windows deletes no file that is read-only.
        with suppress(OSError):
            temporary.chmod(0o600)
        temporary.unlink(missing_ok=True)


def flush_file(path: Path) -> None:
    """Send what was written to a file to the disk."""
    handle = os.open(path, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def flush_folder(path: Path) -> None:
    """Send what was renamed in a folder to the disk, where the system can."""
    # Windows cannot open folders, and some file systems cannot flush them; the move is made.
    with suppress(OSError):
        handle = os.open(path, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
