"""Which process has something, and locks of files that say so.

A lock is a file beside the locked one that names the process.  Locks of the operating system do
not hold on every network folder, and tell nobody's name.
"""

import getpass
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from threading import RLock

import psutil

from skinsource.base.errors import FileFormatError, SkinSourceError, StorageError, printable
from skinsource.base.files import path_text, read_bytes, storage_errors_of, temporary_path
from skinsource.base.json_text import dumped, loaded

# The content of a lock is far shorter.
_MOST_BYTES = 2**14
# Setting the clock while a process runs moves the time of its start.
_SAME_START_S = 5.0
# How often a lock is tried again after another process was quicker.
_TRIES = 10
# A lock is empty for a moment while it is written.
_WRITTEN_AFTER_S = 5.0
_ASK_EVERY_S = 0.005
# Threads of one process wait for each other here: a lock belongs to the process.
_IN_THIS_PROCESS = RLock()


@dataclass(frozen=True, slots=True)
class Owner:
    """A process.

    Attributes
    ----------
    host, user
        Name of its computer, and who runs it.
    pid
        Number of the process there.
    started_s
        When it was started, in seconds of the epoch: the system uses numbers of processes again.
    """

    host: str
    user: str
    pid: int
    started_s: float

    @property
    def description(self) -> str:
        """Text for a message: "ana on lab-3, since 10:15"."""
        start = time.localtime(self.started_s)
        same_day = start[:3] == time.localtime()[:3]
        when = time.strftime("%H:%M" if same_day else "%d %b %Y, %H:%M", start)
        return f"{printable(self.user)} on {printable(self.host)}, since {when}"

    def is_same(self, other: "Owner") -> bool:
        """Whether both are one process."""
        return (self.host, self.pid) == (other.host, other.pid) and (
            abs(self.started_s - other.started_s) <= _SAME_START_S
        )


def this_process() -> Owner:
    """Return the process that runs this."""
    return _own_process(os.getpid())


def still_runs(owner: Owner) -> bool | None:
    """Whether its process runs; None where it belongs to another computer."""
    if owner.host != platform.node():
        return None
    try:
        process = psutil.Process(owner.pid)
        started_s = process.create_time()
        ended = process.status() == psutil.STATUS_ZOMBIE
    except (psutil.NoSuchProcess, ValueError, OverflowError):
        return False
    except psutil.AccessDenied:
        return True
    return not ended and abs(started_s - owner.started_s) <= _SAME_START_S


def to_bytes(owner: Owner) -> bytes:
    """Return the content of a file for `read_owner`."""
    return dumped(asdict(owner))


def read_owner(path: Path) -> Owner | None:
    """Return the process that a file names; None where there is no file, or it names none."""
    try:
        return owner_of(read_bytes(path, most=_MOST_BYTES))
    except SkinSourceError:
        return None


def owner_of(text: bytes) -> Owner | None:
    """Return the process that ``text`` names; None where it names none."""
    with suppress(FileFormatError):
        match loaded(text):
            case {
                "host": str(host),
                "user": str(user),
                "pid": int(pid),
                "started_s": float(started_s),
            } if pid > 0 and 0.0 <= started_s < 2.0**40:
                return Owner(host=host, user=user, pid=pid, started_s=started_s)
    return None


@cache
def _own_process(pid: int) -> Owner:
    try:
        user = getpass.getuser()
    except (OSError, KeyError, ImportError):  # accounts without a name
        user = "somebody"
    started_s = float(psutil.Process(pid).create_time())
    return Owner(host=platform.node(), user=user, pid=pid, started_s=started_s)


_UNKNOWN = Owner(host="an unknown computer", user="somebody", pid=1, started_s=0.0)
_DAMAGED = Owner(host="", user="", pid=0, started_s=0.0)


class Lock:
    """The lock on one file.

    Parameters
    ----------
    file
        The file to lock; the lock is a file beside it.
    """

    def __init__(self, file: Path) -> None:
        try:
            file = Path(os.path.realpath(file))
        except ValueError:  # no file can have this name
            file = file.absolute()
        self.file = file
        self.path = file.parent / f".{file.name}.lock"

    def take(self, *, from_other: bool = False) -> Owner | None:
        """Lock the file for this process; return the process that has it, None on success.

        The lock of a process of this computer that has ended is taken over; with ``from_other``
        that of any process.

        Raises
        ------
        StorageError
            No lock can be written there.
        """
        for _ in range(_TRIES):
            owner = self._recorded_owner()
            if owner is not None:
                if owner.is_same(this_process()):
                    return None
                if not from_other and owner is _UNKNOWN:
                    time.sleep(_ASK_EVERY_S)  # it is being written, most likely
                    continue
                if not from_other and not _has_ended(owner):
                    return owner
                self._remove(owner)
            if self._create():
                return None
        return self._recorded_owner() or _UNKNOWN

    def release(self) -> None:
        """Unlock the file if this process has it."""
        owner = read_owner(self.path)
        if owner is not None and owner.is_same(this_process()):
            with suppress(OSError):
                self.path.unlink()

    @contextmanager
    def hold(self, wait_s: float = 30.0) -> Iterator[None]:
        """Lock the file for a block, after the process that has it now.

        Raises
        ------
        StorageError
            A process still has it after ``wait_s``, or no lock can be written there.
        """
        until_s = time.monotonic() + wait_s
        with _IN_THIS_PROCESS:
            while (owner := self.take()) is not None:
                if time.monotonic() >= until_s:
                    raise StorageError(
                        f"{path_text(self.file)}: cannot be changed while another process uses it "
                        f"({owner.description}). Try again later; if that process has ended, "
                        f"delete {path_text(self.path)}."
                    )
                time.sleep(_ASK_EVERY_S)
            try:
                yield
            finally:
                self.release()

    def _recorded_owner(self) -> Owner | None:
        owner = read_owner(self.path)
        if owner is not None:
            return owner
        try:
            age_s = time.time() - self.path.stat().st_mtime
        except (OSError, ValueError):
            return None
        # It names no process: its writing was never finished.
        return _UNKNOWN if age_s < _WRITTEN_AFTER_S else _DAMAGED

    def _create(self) -> bool:
        """Write the lock unless there is one; return whether it was written."""
        with storage_errors_of(self.path):
            try:
                handle = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            except FileExistsError:
                return False
            with os.fdopen(handle, "wb") as file:
                file.write(to_bytes(this_process()))
        return True

    def _remove(self, ended: Owner) -> None:
        """Delete the lock of ``ended``, but not that of a process which was quicker."""
        moved = temporary_path(self.path)
        with suppress(OSError):
            self.path.rename(moved)
            owner = read_owner(moved)
            if owner is not None and owner != ended:
                with suppress(OSError):
                    os.link(moved, self.path)
            moved.unlink()


def _has_ended(owner: Owner) -> bool:
    return owner is _DAMAGED or still_runs(owner) is False
