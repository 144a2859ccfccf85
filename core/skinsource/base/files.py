"""Files: messages about errors of the system, reading under limits, writing whole or not at all.

Whatever is written goes to a temporary file or folder first, which is then moved into place.
Unknown attributes of this module are those of h5py, which is imported at the first of them: that
takes tens of milliseconds, and neither the window nor a synthetic limb needs it.
"""

import errno
import importlib
import os
import platform
import re
import secrets
import shutil
import stat
import time
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import ModuleType
from typing import Any

from skinsource.base.errors import FileFormatError, StorageError, escaped, printable

# Four digits of the computer, eight of the process that writes, four at random.
_TEMPORARY_NAME = re.compile(r"\..+\.([0-9a-f]{4})([0-9a-f]{8})[0-9a-f]{4}\.part", re.DOTALL)
_COMPUTER = f"{zlib.crc32(platform.node().encode()) & 0xFFFF:04x}"
_A_DAY_S = 24 * 3600.0
# Clocks of file systems differ a little from those of processes.
_CLOCK_S = 5.0

_MOST_CHARACTERS = 400
_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
_FORBIDDEN = {errno.EACCES, errno.EPERM, errno.EROFS}
_ABSENT = {errno.ENOENT, errno.ENOTDIR}


def temporary_path(path: Path) -> Path:
    """Return a new path beside ``path``, whose name says that this process writes there."""
    return path.parent / f".{path.name}.{_COMPUTER}{os.getpid():08x}{secrets.token_hex(2)}.part"


def delete_abandoned(folder: Path, *, below: bool = False) -> None:
    """Delete the temporary files and folders of the user in ``folder`` that nobody writes any more.

    They are those of processes of this computer that have ended, and all that are older than a
    day.  What cannot be examined or deleted stays.

    Parameters
    ----------
    folder
        The folder.
    below
        Whether folders in it are searched too.
    """
    # Windows has no numbers of users.
    user = os.getuid() if hasattr(os, "getuid") else None
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            with suppress(OSError):
                name = _TEMPORARY_NAME.fullmatch(entry.name)
                is_folder = entry.is_dir(follow_symlinks=False)
                if name is None:
                    if below and is_folder:
                        delete_abandoned(Path(entry.path), below=True)
                    continue
                status = entry.stat(follow_symlinks=False)
                if user not in (None, status.st_uid) or not _is_abandoned(name, status.st_mtime):
                    continue
                if is_folder:
                    shutil.rmtree(entry.path, ignore_errors=True)
                elif stat.S_ISREG(status.st_mode):
                    Path(entry.path).unlink()


def _is_abandoned(name: re.Match[str], written_s: float) -> bool:
    if written_s < time.time() - _A_DAY_S:
        return True
    computer, pid = name[1], int(name[2], 16)
    if computer != _COMPUTER or pid == os.getpid():
        return False
    # Most programs never write where another one left something.
    psutil = importlib.import_module("psutil")
    try:
        # The system uses numbers of processes again.
        return bool(psutil.Process(pid).create_time() > written_s + _CLOCK_S)
    except psutil.NoSuchProcess:
        return True
    except psutil.Error:
        return False


def path_text(path: Path) -> str:
    """Return ``path`` as a printable text for a message, whatever its name holds."""
    text = str(path)
    if len(text) <= _MOST_CHARACTERS:
        return escaped(text)
    return f"{escaped(text[:_MOST_CHARACTERS])}…"


def reason_of(error: OSError | ValueError) -> str:
    """Return what the system says about the error."""
    if isinstance(error, OSError):
        return printable(error.strerror or str(error))
    return printable(error)  # a path with a NUL in it


def advice_on_writing(error: OSError | ValueError) -> str:
    """Return a sentence that says how writing can succeed."""
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


def _advice_on_reading(error: OSError | ValueError) -> str:
    """Return a sentence that says how reading can succeed."""
    code = error.errno if isinstance(error, OSError) else errno.EINVAL
    if code in _ABSENT:
        return "It was moved or deleted; look for it elsewhere."
    if code in _FORBIDDEN:
        return "Ask its owner for permission to read it."
    return "Check that it is a file and that you may read it."


def read_bytes(path: Path, *, most: int) -> bytes:
    """Return the content of a regular file.

    Pipes and devices are not read: they may never answer, or never end.

    Raises
    ------
    StorageError
        The file cannot be read, or is no regular file.
    FileFormatError
        It holds more than ``most`` bytes.
    """
    try:
        with open(Path(path), "rb", opener=_open_at_once) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise StorageError(
                    f"{path_text(path)}: cannot be read (it is not a regular file). Choose a file."
                )
            # It may grow while it is read.
            content = b"" if status.st_size > most else file.read(status.st_size + 1)
    except (OSError, ValueError) as error:
        raise StorageError(
            f"{path_text(path)}: cannot be read ({reason_of(error)}). {_advice_on_reading(error)}"
        ) from error
    if status.st_size > most or len(content) > most:
        raise FileFormatError(
            f"{path_text(Path(path.name))}: {status.st_size} bytes are too large for it, expected "
            f"at most {most}."
        )
    return content


def path_exists(path: Path) -> bool:
    """Whether something exists at ``path``; False too where the user may not find out."""
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
            f"{path_text(path)}: cannot be accessed ({reason_of(error)}). "
            f"{_advice_on_reading(error)}"
        ) from error


def _open_at_once(path: str, flags: int) -> int:
    # Opening a pipe then does not wait for its writer.
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


@contextmanager
def replacing(path: Path, *, private: bool = False) -> Iterator[Path]:
    """Give a temporary path beside ``path`` to write to; move it into place at the end.

    The temporary file is flushed to disk before the move.  On any error it is deleted, and the
    old file stays.  Where ``path`` is a link, its target is replaced and the link stays.  The new
    file has the permissions of the old one, or those that new files usually have; a ``private`` one
    is for the user alone.  What killed writers left in the folder is deleted, see
    `delete_abandoned`.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    with storage_errors_of(path):
        target = _link_target(path)
        mode = 0o600 if private else _permissions_of(target)
        delete_abandoned(target.parent)
        temporary = temporary_path(target)
        # The operating system lowers 0o666 as the user has set it.  A file that replaces another
        # one is for the user alone until it gets the permissions of that one.
        first_mode = 0o666 if mode is None else 0o600
        os.close(os.open(temporary, os.O_RDWR | os.O_CREAT | os.O_EXCL, first_mode))
    try:
        with storage_errors_of(path):
            yield temporary
            _flush_file(temporary)
            if mode is not None:
                temporary.chmod(mode)
            temporary.replace(target)
            _flush_folder(target.parent)
    finally:
        if temporary.exists():
            # Windows deletes no file that is read-only.
            with suppress(OSError):
                temporary.chmod(0o600)
            temporary.unlink(missing_ok=True)


def write_bytes(path: Path, content: bytes, *, private: bool = False) -> None:
    """Write ``content`` to ``path``, whole or not at all; ``private``: for the user alone."""
    with replacing(path, private=private) as temporary:
        temporary.write_bytes(content)


#: A file or a folder.
FilePath = str | os.PathLike[str]


def make_folder(path: Path) -> None:
    """Create ``path`` and its parents; raise `StorageError` where that is not possible."""
    with storage_errors_of(path):
        path.mkdir(parents=True, exist_ok=True)


def check_free_space(path: Path, n_bytes: int, what: str, advice: str) -> None:
    """Raise `StorageError` where ``n_bytes`` are not free in the folder of ``path``."""
    free_bytes = shutil.disk_usage(path.resolve().parent).free
    if free_bytes < n_bytes:
        raise StorageError(
            f"{path_text(path)}: {what} takes {n_bytes / 1e9:.2f} GB, and {free_bytes / 1e9:.2f} "
            f"GB are free there. {advice}"
        )


@contextmanager
def storage_errors_of(path: Path, *, reading: str = "") -> Iterator[None]:
    """Turn errors of the system into a `StorageError` that names ``path``.

    ``reading`` is the advice where the file is read; empty: it is written.
    """
    try:
        if "\0" in str(path):
            raise _BadPath("its name holds a character of value zero")
        yield
    except (OSError, _BadPath) as error:
        what, advice = "read" if reading else "written", reading or advice_on_writing(error)
        raise StorageError(
            f"{path_text(path)}: cannot be {what} ({reason_of(error)}). {advice}"
        ) from error


class _BadPath(ValueError):
    """No file can have this path."""


def _link_target(path: Path) -> Path:
    if not path.is_symlink():
        return path
    target = Path(os.path.realpath(path))
    if target.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return target


def _permissions_of(path: Path) -> int | None:
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return None
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        # The new file would take its place: with the right to do so, that of /dev/null too.
        raise _BadPath("it is a device or a pipe, not a file")
    return stat.S_IMODE(mode)


def _flush_file(path: Path) -> None:
    """Send the content of a file to the disk."""
    handle = os.open(path, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _flush_folder(path: Path) -> None:
    """Send the names in a folder to the disk, where the system can."""
    # Windows cannot open folders, and some file systems cannot flush them.
    with suppress(OSError):
        handle = os.open(path, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


@contextmanager
def replacing_folder(path: Path, mark: str, kept: str = "") -> Iterator[Path]:
    """Give a temporary folder beside ``path`` to fill; move it into place at the end.

    All files in it are flushed to disk before the move.  On any error it is deleted, and the old
    folder stays.  While the old folder is replaced, there is none for a moment, but never half of
    one.  What killed writers left beside it is deleted, see `delete_abandoned`.

    Parameters
    ----------
    path
        The folder.
    mark
        Name of a file that shows that the same writer made a folder: others are not replaced,
        unless they are empty.
    kept
        Pattern of names, such as ``log*.csv``, of files that others wrote into the old folder:
        they are copied into the new one.

    Raises
    ------
    StorageError
        Something else exists at ``path``, the parent cannot be written, or the disk is full.
    """
    _check_own_folder(path, mark)
    with storage_errors_of(path):
        delete_abandoned(path.parent)
        temporary = temporary_path(path)
        temporary.mkdir()
    try:
        with storage_errors_of(path):
            yield temporary
            for entry in path.glob(kept) if kept else ():
                if entry.is_file() and not (temporary / entry.name).exists():
                    shutil.copy2(entry, temporary / entry.name)
            for entry in sorted(temporary.rglob("*"), reverse=True):
                if entry.is_dir():
                    _flush_folder(entry)
                else:
                    _flush_file(entry)
            _flush_folder(temporary)
            _check_own_folder(path, mark)
            if path.exists():
                old = temporary_path(path)
                path.replace(old)
                temporary.replace(path)
                shutil.rmtree(old, ignore_errors=True)
            else:
                temporary.replace(path)
            _flush_folder(path.parent)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _check_own_folder(path: Path, mark: str) -> None:
    with storage_errors_of(path):
        if not path.exists() and not path.is_symlink():
            return
        ours = path.is_dir() and not path.is_symlink()
        if ours and ((path / mark).is_file() or not any(path.iterdir())):
            return
    raise StorageError(
        f"{path_text(path)}: something else has this name and is not replaced. Choose another "
        "name, or move it away first."
    )


def __getattr__(name: str) -> Any:
    if name.startswith("__"):  # Python asks every module for these
        raise AttributeError(name)
    return getattr(_h5py(), name)


def own_member(group: Any, name: str, kind: type) -> Any:
    """Return a member of an HDF5 group; None if another file holds it or it is no ``kind``."""
    # A link could lead into any other file.
    is_here = isinstance(group.get(name, getlink=True), _h5py().HardLink)
    member = group[name] if is_here else None
    return member if isinstance(member, kind) else None


def _h5py() -> ModuleType:
    return importlib.import_module("h5py")
