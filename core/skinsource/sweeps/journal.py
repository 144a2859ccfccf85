"""What a sweep has measured so far, on disk: a kill loses nothing, and doubles nothing.

One line for each stimulus, with a checksum; a line that was cut or damaged does not count, and its
stimulus is measured again.  The first line names the plan.
"""

import json
import math
import os
from hashlib import sha256
from itertools import count
from pathlib import Path
from typing import Any

from skinsource.errors import InvalidInputError, StorageError
from skinsource.files import is_there, named, read_bytes
from skinsource.files.reasons import advice_on_writing, reason_of
from skinsource.sweeps.measuring import Metrics

_MOST_BYTES = 2**32
_CHECKED = 16
# First lines of two plans differ in nearly all of their 80 digits.
_MOST_DAMAGED = 8


class Journal:
    """Lines of a file, appended and flushed one by one.

    Parameters
    ----------
    path
        The file; it is made where it does not exist.  What is no journal is renamed.
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
        first = _line({"sweep": digest})
        content = read_bytes(path, most=_MOST_BYTES) if is_there(path) else b""
        try:
            if first.startswith(content):
                content = b""
            elif not _is_nearly(content[: len(first)], first):
                _refuse_another_sweep(path, content)
                _set_aside(path)
                content = b""
            # What was cut short goes, so that the next line begins a line.
            sound = max(len(first), content.rfind(b"\n") + 1) if content else 0
            self._read(content[len(first) : sound])
            self._file = path.open("r+b" if is_there(path) else "w+b")
            self._file.truncate(sound)
            self._file.seek(sound)
        except OSError as error:
            raise _unwritable(path, error) from error
        if not content:
            self._write(first)

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
            self._write(_line({"stimulus": number, "error": found}))
        else:
            self._write(_line({"stimulus": number, "metrics": _finite(found)}))

    def close(self) -> None:
        """Close the file; it stays."""
        self._file.close()

    def _read(self, content: bytes) -> None:
        for line in content.split(b"\n"):
            tree = _checked(line)
            if tree is not None:
                self.rows[int(tree["stimulus"])] = _found_in(tree)

    def _write(self, line: bytes) -> None:
        try:
            self._file.write(line)
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise _unwritable(self.path, error) from error


def _line(tree: dict[str, Any]) -> bytes:
    text = json.dumps(tree, allow_nan=False, separators=(",", ":")).encode()
    return _sum(text) + b" " + text + b"\n"


def _sum(text: bytes) -> bytes:
    return sha256(text).hexdigest()[:_CHECKED].encode()


def _checked(line: bytes) -> dict[str, Any] | None:
    """What a line holds; None where it is damaged."""
    text = line[_CHECKED + 1 :]
    if line[:_CHECKED] != _sum(text):
        return None
    tree: dict[str, Any] = json.loads(text)
    return tree


def _is_nearly(line: bytes, expected: bytes) -> bool:
    """Whether ``line`` is ``expected``, perhaps with a few damaged bytes."""
    damaged = sum(a != b for a, b in zip(line, expected, strict=False))
    return len(line) == len(expected) and damaged <= _MOST_DAMAGED


def _refuse_another_sweep(path: Path, content: bytes) -> None:
    if _checked(content.partition(b"\n")[0]) is not None:
        raise InvalidInputError(
            f"{named(path)} belongs to another sweep. Choose another folder, or delete the file to "
            "begin anew."
        )


def _set_aside(path: Path) -> None:
    """Rename ``path`` to a name that is free."""
    names = (path.with_stem(f"{path.stem} set aside {number}") for number in count(1))
    path.rename(next(name for name in names if not is_there(name)))


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
