"""Which process has something, and whether it still runs."""

import getpass
import os
import platform
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

import psutil

from skinsource.codec.json_text import dumped, loaded
from skinsource.errors import FileFormatError, SkinSourceError
from skinsource.files import read_bytes
from skinsource.quoting import printable

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
        found = psutil.Process(owner.pid)
        started_s = found.create_time()
        ended = found.status() == psutil.STATUS_ZOMBIE
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
        found = loaded(text)
        if isinstance(found, dict):
            host, user = found.get("host"), found.get("user")
            pid, started_s = found.get("pid"), found.get("started_s")
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
