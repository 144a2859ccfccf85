"""The lock that this studio has on the file that is open."""

from pathlib import Path

from skinsource.base.errors import StorageError
from skinsource.base.lock import Lock, Owner, still_runs


class HeldFile:
    """Takes and gives up locks on files.

    Where no lock can be written, as in a folder that is read-only, a file is opened without.
    """

    def __init__(self) -> None:
        self._locks: dict[Path, Lock] = {}

    def take(self, path: Path, *, from_other: bool = False) -> Owner | None:
        """Have ``path``, beside what is held already; returns who has it, or None."""
        lock = Lock(path)
        try:
            other = lock.take(from_other=from_other)
        except StorageError:
            return None
        if other is None:
            self._locks[lock.file] = lock
        return other

    def keep_only(self, path: Path | None) -> None:
        """Give up all but ``path``; None: all."""
        # A link and what it leads to have one lock.
        kept = None if path is None else Lock(path).file
        for held in [held for held in self._locks if held != kept]:
            self._locks.pop(held).release()


def who_has(path: Path, other: Owner) -> str:
    """Words such as "tap.skinsource is open in another studio (ana on lab-3, since 10:15)"."""
    return f"{path.name} is open in another studio ({other.words})"


def may_have_ended(other: Owner) -> bool:
    """Whether nobody can say here that ``other`` still runs."""
    return still_runs(other) is None
