"""A log of errors, which outlives a crash.

Each studio writes its own log.  Its first lines name the program and the process; an error adds
where the program was; the last line says that the program ended as it should.
"""

import faulthandler
import logging
import platform
import sys
import threading
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import TextIO

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import make_folder, read_bytes
from skinsource.base.lock import owner_of, still_runs, this_process, to_bytes
from skinsource.version import __version__

#: Below the folder of the user's data.
FOLDER = "logs"
MOST_LOGS = 5
#: Most bytes of one log: errors that repeat for ever do not fill the disk.
MOST_BYTES = 2**20

_HEAD_LINES = 3
_ENDED = "The studio ended as it should."
_OFFERED = "This log was offered to the user."
_PREFIX, _SUFFIX = "studio-", ".log"


class CrashLog:
    """The log of this process.

    Parameters
    ----------
    folder
        The user's data folder; logs lie below it.
    """

    def __init__(self, folder: Path) -> None:
        started = time.strftime("%Y%m%d-%H%M%S")
        name = f"{_PREFIX}{started}-{this_process().pid}{_SUFFIX}"
        self.path = folder / FOLDER / name
        self._file: TextIO | None = None
        self._written = 0
        self._had_handler = False
        self._hooks: tuple[Callable[..., object], Callable[..., object]] | None = None
        self._handler: logging.Handler | None = None

    def open(self) -> None:
        """Start to log errors of this process; do nothing where no log can be written."""
        try:
            make_folder(self.path.parent)
            self._file = self.path.open("a", encoding="utf-8", buffering=1)
        except (SkinSourceError, OSError):
            return
        self._file.write(
            f"SkinSource studio {__version__}, Python {platform.python_version()}, "
            f"{platform.platform()}\n"
            f"{to_bytes(this_process()).decode()}\n{time.strftime('%Y-%m-%d %H:%M:%S')}\n"
        )
        self._had_handler = faulthandler.is_enabled()
        faulthandler.enable(self._file)
        self._hooks = sys.excepthook, threading.excepthook
        sys.excepthook = self._log_exception
        threading.excepthook = self._log_thread_exception
        self._handler = _Handler(self._write)
        logging.getLogger().addHandler(self._handler)
        for old in _logs(self.path.parent)[MOST_LOGS:]:
            with suppress(OSError):
                old.unlink()

    def close(self) -> None:
        """Note that the process ends as it should, and stop logging."""
        file, self._file = self._file, None
        if file is None or self._hooks is None or self._handler is None:
            return
        logging.getLogger().removeHandler(self._handler)
        sys.excepthook, threading.excepthook = self._hooks
        faulthandler.disable()
        if self._had_handler:
            faulthandler.enable()
        file.write(f"{_ENDED}\n")
        file.close()
        if not self._written:
            with suppress(OSError):
                self.path.unlink()

    def _write(self, text: str) -> None:
        if self._file is None or self._written > MOST_BYTES:
            return
        self._written += len(text)
        with suppress(OSError):
            self._file.write(text)

    def _log_exception(
        self, kind: type[BaseException], error: BaseException, where: TracebackType | None
    ) -> None:
        if not issubclass(kind, KeyboardInterrupt):
            self._write_fault("".join(traceback.format_exception(kind, error, where)))
        if self._hooks is not None:
            self._hooks[0](kind, error, where)

    def _log_thread_exception(self, arguments: threading.ExceptHookArgs) -> None:
        if arguments.exc_value is not None:
            self._write_fault("".join(traceback.format_exception(arguments.exc_value)))
        if self._hooks is not None:
            self._hooks[1](arguments)

    def _write_fault(self, text: str) -> None:
        self._write(f"{time.strftime('%H:%M:%S')} {text}")


class _Handler(logging.Handler):
    """Passes warnings and errors to the log."""

    def __init__(self, write: Callable[[str], None]) -> None:
        super().__init__(logging.WARNING)
        self.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
        self._write_line = write

    def emit(self, record: logging.LogRecord) -> None:
        self._write_line(f"{self.format(record)}\n")


def crashed_logs(folder: Path) -> tuple[Path, ...]:
    """Return the logs of studios that crashed and wrote why, the newest first.

    Parameters
    ----------
    folder
        The user's data folder.
    """
    return tuple(path for path in _logs(folder / FOLDER) if _has_crash(path))


def note_offered(log: Path) -> None:
    """Mark ``log`` as offered to the user; it stays until newer logs take its place."""
    with suppress(OSError), log.open("a", encoding="utf-8") as file:
        file.write(f"\n{_OFFERED}\n")


def _has_crash(path: Path) -> bool:
    try:
        lines = read_bytes(path, most=2 * MOST_BYTES).decode(errors="replace").splitlines()
    except SkinSourceError:
        return False
    logged = [line for line in lines[_HEAD_LINES:] if line.strip()]
    if not logged or logged[-1] in (_ENDED, _OFFERED):
        return False
    owner = owner_of(lines[1].encode())
    return owner is None or still_runs(owner) is False


def _logs(folder: Path) -> list[Path]:
    # Their names begin with the time of their start.
    return sorted(folder.glob(f"{_PREFIX}*{_SUFFIX}"), reverse=True)
