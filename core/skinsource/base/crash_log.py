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
# So begins a fault in a log; warnings and errors that somebody dealt with are none.
_FAULTS = "Fatal Python error", "Windows fatal exception", "Traceback"
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
        self._log: _Log | None = None
        self._had_handler = False
        self._hooks = sys.excepthook, threading.excepthook

    def open(self) -> None:
        """Start to log errors of this process; do nothing where no log can be written."""
        try:
            make_folder(self.path.parent)
            self._log = _Log(self.path)
        except (SkinSourceError, OSError):
            return
        self._log.stream.write(
            f"SkinSource studio {__version__}, Python {platform.python_version()}, "
            f"{platform.platform()}\n"
            f"{to_bytes(this_process()).decode()}\n{time.strftime('%Y-%m-%d %H:%M:%S')}\n"
        )
        self._log.flush()
        self._had_handler = faulthandler.is_enabled()
        faulthandler.enable(self._log.stream)
        self._hooks = sys.excepthook, threading.excepthook
        sys.excepthook = self._log_exception
        threading.excepthook = self._log_thread_exception
        logging.getLogger().addHandler(self._log)
        for old in _logs(self.path.parent)[MOST_LOGS:]:
            with suppress(OSError):
                old.unlink()

    def close(self) -> None:
        """Note that the process ends as it should, and stop logging."""
        log, self._log = self._log, None
        if log is None:
            return
        logging.getLogger().removeHandler(log)
        sys.excepthook, threading.excepthook = self._hooks
        faulthandler.disable()
        if self._had_handler:
            faulthandler.enable()
        log.stream.write(f"{_ENDED}\n")
        log.stream.close()
        if not log.used:
            with suppress(OSError):
                self.path.unlink()

    def _log_exception(
        self, kind: type[BaseException], error: BaseException, where: TracebackType | None
    ) -> None:
        if not issubclass(kind, KeyboardInterrupt):
            logging.getLogger(__name__).critical("", exc_info=(kind, error, where))
        self._hooks[0](kind, error, where)

    def _log_thread_exception(self, arguments: threading.ExceptHookArgs) -> None:
        if arguments.exc_value is not None:
            logging.getLogger(__name__).critical("", exc_info=arguments.exc_value)
        self._hooks[1](arguments)


class _Log(logging.StreamHandler[TextIO]):
    """Writes warnings and errors up to `MOST_BYTES`; ``used`` says whether there were any."""

    def __init__(self, path: Path) -> None:
        super().__init__(path.open("a", encoding="utf-8"))
        self.used = False
        self.setLevel(logging.WARNING)
        self.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))

    def emit(self, record: logging.LogRecord) -> None:
        self.used = True
        if self.stream.tell() < MOST_BYTES:
            super().emit(record)


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
    faults = any(line.startswith(_FAULTS) for line in logged)
    if not faults or logged[-1] in (_ENDED, _OFFERED):
        return False
    owner = owner_of(lines[1].encode())
    return owner is None or still_runs(owner) is False


def _logs(folder: Path) -> list[Path]:
    # Their names begin with the time of their start.
    return sorted(folder.glob(f"{_PREFIX}*{_SUFFIX}"), reverse=True)
