"""What a sweep has measured so far, on disk: a kill loses nothing, and doubles nothing.

One line for each stimulus, with a checksum; a line that was cut or damaged does not count, and its
stimulus is measured again.
"""

import json
import math
import os
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

from skinsource.errors import FileFormatError, InvalidInputError, StorageError
from skinsource.files import is_there, named, read_bytes
from skinsource.files.reasons import advice_on_writing, reason_of
from skinsource.sweeps.measuring import Metrics

_MOST_BYTES = 2**32
_CHECKED = 16


class Journal:
    """Lines of a file, appended and flushed one by one.

    Parameters
    ----------
    path
        The file; it is made where it does not exist.
    digest
        Of the plan.  A file of another plan is refused.

    Attributes
    ----------
    rows
        What was measured: metrics by number of the stimulus; the sentence that says why where it
        could not be.

    Raises
    ------
    InvalidInputError
        The file belongs to another sweep.
    StorageError
        It cannot be read or written.
    """

    def __init__(self, path: Path, digest: str) -> None:
        self.path = path
        self.rows: dict[int, Metrics | str] = {}
        sound = self._read(digest) if is_there(path) else 0
        try:
            self._file = path.open("r+b" if is_there(path) else "w+b")
            # What was cut short goes, so that the next line begins a line.
            self._file.truncate(sound)
            self._file.seek(sound)
        except OSError as error:
            raise _unwritable(path, error) from error
        if not sound:
            self._write({"sweep": digest})

    def __enter__(self) -> "Journal":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def add(self, number: int, found: Metrics | str) -> None:
        """Keep what was found of a stimulus, from 1, on disk; a second time changes nothing."""
        if number in self.rows:
            return
        self.rows[number] = found
        if isinstance(found, str):
            self._write({"stimulus": number, "error": found})
        else:
            self._write({"stimulus": number, "metrics": _finite(found)})

    def close(self) -> None:
        """Close the file; it stays."""
        self._file.close()

    def _read(self, digest: str) -> int:
        """Take the sound lines; returns how many bytes they are."""
        sound = 0
        for line in _lines(read_bytes(self.path, most=_MOST_BYTES)):
            tree = _checked(line)
            if tree is None:
                break
            if not sound:
                self._refuse_another(tree, digest)
            else:
                self.rows[int(tree["stimulus"])] = _found_in(tree)
            sound += len(line)
        return sound

    def _refuse_another(self, tree: dict[str, Any], digest: str) -> None:
        if tree.get("sweep") != digest:
            raise InvalidInputError(
                f"{named(self.path)} belongs to another sweep. Choose another folder, or delete "
                "the file to begin anew."
            )

    def _write(self, tree: dict[str, Any]) -> None:
        text = json.dumps(tree, allow_nan=False, separators=(",", ":")).encode()
        try:
            self._file.write(_sum(text) + b" " + text + b"\n")
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise _unwritable(self.path, error) from error


def _lines(content: bytes) -> Iterator[bytes]:
    yield from content.splitlines(keepends=True)


def _sum(text: bytes) -> bytes:
    return sha256(text).hexdigest()[:_CHECKED].encode()


def _checked(line: bytes) -> dict[str, Any] | None:
    """What a line holds; None where it is cut or damaged."""
    if not line.endswith(b"\n") or line[:_CHECKED] != _sum(line[_CHECKED + 1 : -1]):
        return None
    found = json.loads(line[_CHECKED + 1 :])
    if not isinstance(found, dict):
        raise FileFormatError("a line of a sweep's journal holds something else")
    return found


def _finite(metrics: Metrics) -> dict[str, float | None]:
    return {name: value if math.isfinite(value) else None for name, value in metrics.items()}


def _found_in(tree: dict[str, Any]) -> Metrics | str:
    if "error" in tree:
        return str(tree["error"])
    return {
        name: math.nan if value is None else float(value) for name, value in tree["metrics"].items()
    }


def _unwritable(path: Path, error: OSError) -> StorageError:
    return StorageError(
        f"{named(path)}: cannot be written ({reason_of(error)}). {advice_on_writing(error)}"
    )
