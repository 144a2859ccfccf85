"""Which process has something, and whether it still runs."""

import getpass
import os
import platform
import secrets
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from threading import RLock

import psutil

from skinsource.base.errors import FileFormatError, SkinSourceError, StorageError
from skinsource.base.files import advice_on_writing, named, read_bytes, reason_of
from skinsource.base.json_text import dumped, loaded
from skinsource.base.quoting import printable

#: Far above what one takes.
_MOST_BYTES = 2**14
# Clocks that are set while a process runs move what the system tells of its start.
_SAME_START_S = 5.0


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
        When it was started, in seconds of the epoch: numbers of processes are used again.
    """

    host: str
    user: str
    pid: int
    started_s: float

    @property
    def words(self) -> str:
        """For a message: "ana on lab-3, since 10:15"."""
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
    """The process that asks."""
    return _owner_of(os.getpid())


def still_runs(owner: Owner) -> bool | None:
    """Whether its process runs; None for one of another computer, which cannot be asked."""
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
    """What `read_owner` reads."""
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
        fields = loaded(text)
        if isinstance(fields, dict):
            host, user = fields.get("host"), fields.get("user")
            pid, started_s = fields.get("pid"), fields.get("started_s")
            if (
                isinstance(host, str)
                and isinstance(user, str)
                and type(pid) is int
                and pid > 0
                and isinstance(started_s, float)
                and 0.0 <= started_s < 2.0**40
            ):
                return Owner(host=host, user=user, pid=pid, started_s=started_s)
    return None


@cache
def _owner_of(pid: int) -> Owner:
    try:
        user = getpass.getuser()
    except (OSError, KeyError, ImportError):  # accounts without a name
        user = "somebody"
    started_s = float(psutil.Process(pid).create_time())
    return Owner(host=platform.node(), user=user, pid=pid, started_s=started_s)


# A file beside an open file that says who has it.
#
# Locks of the operating system do not hold on every network folder, and tell nobody's name.

# Whoever loses against a quicker one looks again; more than a few times is no accident.
_TRIES = 10
# Where files cannot be linked, one that is being written is empty for a moment.
_WRITTEN_AFTER_S = 5.0
_ASK_EVERY_S = 0.005
_UNKNOWN = Owner(host="an unknown computer", user="somebody", pid=1, started_s=0.0)
_DAMAGED = Owner(host="", user="", pid=0, started_s=0.0)
# A lock is the process's: its threads wait for each other here.
_IN_THIS_PROCESS = RLock()


class Lock:
    """The lock on one file.

    Parameters
    ----------
    file
        What is open; the lock lies beside it.
    """

    def __init__(self, file: Path) -> None:
        try:
            file = Path(os.path.realpath(file))
        except ValueError:  # no file can have this name
            file = file.absolute()
        self.file = file
        self.path = file.parent / f".{file.name}.lock"

    def owner(self) -> Owner | None:
        """Who has the file, as far as can be known; None: nobody that runs, or this process."""
        owner = self._found()
        if owner is None or owner.is_same(this_process()) or _is_over(owner):
            return None
        return owner

    def take(self, *, from_other: bool = False) -> Owner | None:
        """Have the file; returns who has it already, or None once it is ours.

        What an ended process of this computer left is taken over, and ``from_other`` what any
        process has.

        Raises
        ------
        StorageError
            No lock can be written there.
        """
        for _ in range(_TRIES):
            owner = self._found()
            if owner is not None:
                if owner.is_same(this_process()):
                    return None
                if not from_other and not _is_over(owner):
                    return owner
                self._remove(owner)
            if self._create():
                return None
        return self._found() or _UNKNOWN

    def release(self) -> None:
        """Give the file up, if this process has it."""
        owner = read_owner(self.path)
        if owner is not None and owner.is_same(this_process()):
            with suppress(OSError):
                self.path.unlink()

    @contextmanager
    def hold(self, wait_s: float = 30.0) -> Iterator[None]:
        """Have the file for a moment, after whoever has it now.

        Raises
        ------
        StorageError
            Somebody still has it after ``wait_s``, or no lock can be written there.
        """
        until_s = time.monotonic() + wait_s
        with _IN_THIS_PROCESS:
            while (owner := self.take()) is not None:
                if time.monotonic() >= until_s:
                    raise StorageError(
                        f"{named(self.file)}: cannot be changed while another process has it "
                        f"({owner.words}). Try again later; if that process has ended, delete "
                        f"{named(self.path)}."
                    )
                time.sleep(_ASK_EVERY_S)
            try:
                yield
            finally:
                self.release()

    def _found(self) -> Owner | None:
        owner = read_owner(self.path)
        if owner is not None:
            return owner
        try:
            age_s = time.time() - self.path.stat().st_mtime
        except (OSError, ValueError):
            return None
        # It names nobody: nobody ever finished writing it.
        return _UNKNOWN if age_s < _WRITTEN_AFTER_S else _DAMAGED

    def _create(self) -> bool:
        """Write the lock unless there is one; whether it was written."""
        beside = self.path.with_name(f"{self.path.name}.{secrets.token_hex(4)}.part")
        try:
            beside.write_bytes(to_bytes(this_process()))
            try:
                # With its content at once, or not at all.
                os.link(beside, self.path)
            except FileExistsError:
                return False
            except OSError:
                return self._create_empty_first()
            finally:
                beside.unlink(missing_ok=True)
        except (OSError, ValueError) as error:
            raise StorageError(
                f"{named(self.path)}: cannot be written ({reason_of(error)}). "
                f"{advice_on_writing(error)}"
            ) from error
        return True

    def _create_empty_first(self) -> bool:
        try:
            handle = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        except FileExistsError:
            return False
        with os.fdopen(handle, "wb") as file:
            file.write(to_bytes(this_process()))
        return True

    def _remove(self, judged: Owner) -> None:
        """Take away the lock of ``judged``, and of nobody who was quicker."""
        aside = self.path.with_name(f"{self.path.name}.{secrets.token_hex(4)}.part")
        with suppress(OSError):
            self.path.rename(aside)
            now = read_owner(aside)
            if now is not None and now != judged:
                with suppress(OSError):
                    os.link(aside, self.path)
            aside.unlink()


def _is_over(owner: Owner) -> bool:
    return owner is _DAMAGED or still_runs(owner) is False
