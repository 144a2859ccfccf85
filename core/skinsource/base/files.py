"""Temporary files of writers that were killed."""

import errno
import importlib
import os
import re
import secrets
import shutil
import stat
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import ModuleType
from typing import Any

from skinsource.base.errors import FileFormatError, StorageError
from skinsource.base.quoting import escaped, printable

_NAME = re.compile(r"\..+\.[0-9a-f]{8}\.part", re.DOTALL)
_A_DAY_S = 24 * 3600.0


def temporary_name(path: Path) -> Path:
    """Return a new name beside ``path`` for what shall replace it."""
    return path.parent / f".{path.name}.{secrets.token_hex(4)}.part"


def sweep(folder: Path) -> None:
    """Delete one's own temporary files in ``folder`` that nobody has written to for a day.

    What cannot be looked at or deleted stays: the writing that follows is what matters.
    """
    now = time.time()
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if _NAME.fullmatch(entry.name):
                with suppress(OSError):
                    about = entry.stat(follow_symlinks=False)
                    if stat.S_ISREG(about.st_mode) and is_stale_temporary(entry.name, about, now):
                        Path(entry.path).unlink()


def is_stale_temporary(name: str, about: os.stat_result, now_s: float) -> bool:
    """Whether something is one's own temporary one, and nobody has written to it for a day."""
    owner = getattr(os, "getuid", lambda: about.st_uid)()
    own = _NAME.fullmatch(name) is not None and about.st_uid == owner
    return own and about.st_mtime < now_s - _A_DAY_S


# What to do about a file that the system refuses, in one sentence.

_MOST_CHARACTERS = 400
_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
_FORBIDDEN = {errno.EACCES, errno.EPERM, errno.EROFS}
_ABSENT = {errno.ENOENT, errno.ENOTDIR}


def named(path: Path) -> str:
    """Return ``path`` for a message: whatever its name holds, it can be printed."""
    text = str(path)
    whole = len(text) <= _MOST_CHARACTERS
    return escaped(text) if whole else f"{escaped(text[:_MOST_CHARACTERS])}…"


def reason_of(error: OSError | ValueError) -> str:
    """What the system says."""
    if isinstance(error, OSError):
        return printable(error.strerror or str(error))
    return printable(error)  # a path with a NUL in it


def advice_on_writing(error: OSError | ValueError) -> str:
    """What lets the next attempt succeed."""
    code = error.errno if isinstance(error, OSError) else errno.EINVAL
    if code in _FULL:
        return "Free some space or choose another disk, then try again."
    if code in _FORBIDDEN:
        return "Choose a folder you may write to, then try again."
    if code in _ABSENT:
        return "Choose a folder that exists, then try again."
    if code == errno.ENAMETOOLONG:
        return "Choose a shorter name, then try again."
    if code in (errno.EINVAL, errno.ELOOP, errno.EISDIR):
        return "Choose another name, then try again."
    return "Check the disk or choose another one, then try again."


def advice_on_reading(error: OSError | ValueError) -> str:
    """What may help."""
    code = error.errno if isinstance(error, OSError) else errno.EINVAL
    if code in _ABSENT:
        return "It was moved or deleted; look for it elsewhere."
    if code in _FORBIDDEN:
        return "Ask its owner for the right to read it."
    return "Check that it is a file and that you may read it."


# Reading that ends: only from regular files, and only so much.


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


# Files are written whole or not at all.


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
        mode = _writing_mode_of(target)
        sweep(target.parent)
        temporary = temporary_name(target)
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


def _writing_mode_of(path: Path) -> int | None:
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


# Folders are filled whole or not at all.


@contextmanager
def replacing_folder(path: Path, mark: str, kept: str = "") -> Iterator[Path]:
    """Give a temporary folder beside ``path`` to fill; move it into place at the end.

    All files in it are flushed to disk before the move.  On any error it is deleted, and what
    stood at ``path`` stands there still.  While a folder that stood there is replaced, there is
    none for a moment; never half of one.  What killed writers left long ago is deleted.

    Parameters
    ----------
    path
        The folder.
    mark
        Name of a file that shows that a folder was written by the same writer: others are not
        replaced, unless they are empty.
    kept
        Pattern of names, such as ``log*.csv``, of what was written into the folder since by
        others: it goes over into the new one.

    Raises
    ------
    StorageError
        Something else stands at ``path``, the parent cannot be written, or the disk is full.
    """
    _refuse_foreign(path, mark)
    with explained(path):
        _sweep(path.parent)
        temporary = temporary_name(path)
        temporary.mkdir()
    try:
        with explained(path):
            yield temporary
            for entry in path.glob(kept) if kept else ():
                if entry.is_file() and not (temporary / entry.name).exists():
                    shutil.copy2(entry, temporary / entry.name)
            for entry in sorted(temporary.rglob("*"), reverse=True):
                if entry.is_dir():
                    flush_folder(entry)
                else:
                    flush_file(entry)
            flush_folder(temporary)
            _refuse_foreign(path, mark)
            if path.exists():
                old = temporary_name(path)
                path.replace(old)
                temporary.replace(path)
                shutil.rmtree(old, ignore_errors=True)
            else:
                temporary.replace(path)
            flush_folder(path.parent)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _refuse_foreign(path: Path, mark: str) -> None:
    with explained(path):
        if not path.exists() and not path.is_symlink():
            return
        ours = path.is_dir() and not path.is_symlink()
        if ours and ((path / mark).is_file() or not any(path.iterdir())):
            return
    raise StorageError(
        f"{named(path)}: something else stands there, and it is not replaced. Choose another name, "
        "or move it away first."
    )


def _sweep(folder: Path) -> None:
    """Delete one's own temporary folders that nobody has written to for a day."""
    now = time.time()
    with suppress(OSError):
        for entry in folder.iterdir():
            with suppress(OSError):
                about = entry.lstat()
                if stat.S_ISDIR(about.st_mode) and is_stale_temporary(entry.name, about, now):
                    shutil.rmtree(entry, ignore_errors=True)


# HDF5, imported when the first file is touched.
#
# h5py takes tens of milliseconds to import, and neither the studio's window nor a synthetic limb
# needs it.  scipy has no module like this one: ``import scipy`` imports its parts at first use.


def __getattr__(name: str) -> Any:
    if name.startswith("__"):  # what Python asks of every module is not h5py's
        raise AttributeError(name)
    return getattr(_h5py(), name)


def own_member(group: Any, name: str, kind: type) -> Any:
    """Member of a group that lies in this very file and is of ``kind``; None where none is."""
    # A link could lead into any other file.
    is_here = isinstance(group.get(name, getlink=True), _h5py().HardLink)
    member = group[name] if is_here else None
    return member if isinstance(member, kind) else None


def _h5py() -> ModuleType:
    return importlib.import_module("h5py")
