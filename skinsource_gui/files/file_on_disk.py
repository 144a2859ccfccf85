"""What the open file holds on disk, as far as this studio knows."""

from hashlib import sha256
from pathlib import Path
from typing import Literal

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import read_bytes
from skinsource.specs.image import MAX_IMAGE_BYTES

State = Literal["same", "changed", "gone"]


class FileOnDisk:
    """Remembers what a file held when it was last read or written here."""

    def __init__(self) -> None:
        self._path: Path | None = None
        self._stamp: tuple[int, ...] | None = None
        self._digest = b""

    def note(self, path: Path | None) -> None:
        """Remember what ``path`` holds now; None: no file."""
        self._path = path
        self._stamp = _stamp(path) if path else None
        self._digest = _digest(path) if path else b""

    def state(self) -> State:
        """Whether the file still holds what it held."""
        if self._path is None:
            return "same"
        stamp = _stamp(self._path)
        if stamp == self._stamp:
            return "same" if stamp else "gone"
        if stamp is None:
            return "gone"
        # Backups and sync programs touch files without changing them.
        if _digest(self._path) != self._digest:
            return "changed"
        self._stamp = stamp
        return "same"


def _stamp(path: Path) -> tuple[int, ...] | None:
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_ino, found.st_size, found.st_mtime_ns


def _digest(path: Path) -> bytes:
    try:
        return sha256(read_bytes(path, most=MAX_IMAGE_BYTES)).digest()
    except SkinSourceError:
        return b""
