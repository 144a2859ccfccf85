"""Reads one foreign file for a page: away from the GUI thread, and only what is wanted last."""

from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from threading import Event, Lock
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.errors import SkinSourceError, Stopped
from skinsource.job import Job, Progress, Stop, stop_if
from skinsource.recordings import Found, ImportChoice, Series, Taken
from skinsource.recordings.importing import RawPart, read_for, read_part
from skinsource.recordings.reading_process import ReadingProcess

# What takes longer is given up for what is wanted meanwhile.
_PATIENCE_S = 0.5
_BETWEEN_PROGRESS_S = 0.05
# Stretches of the picture of all.
_COLUMNS = 600


class ReadingWorker(QObject):
    """Looks at a file, and takes parts of it; what need not be read again is not.

    Parameters
    ----------
    path
        The file.
    to_hz
        The rate of what is taken.
    """

    #: `Found`.
    looked = Signal(object)
    #: `RawPart`: what was read for the choice that is being worked on.
    read = Signal(object)
    #: `ImportChoice`, and its `Taken`.
    taken = Signal(object, object)
    #: Key of a series, and the least and largest of each stretch of it, (2, columns).
    surveyed = Signal(str, object)
    #: `ImportChoice`, or None while the file is looked at; a sentence.
    failed = Signal(object, str)
    #: Samples read, and of how many.
    progressed = Signal(int, int)
    _told = Signal(object, object)  # from the worker thread: a signal and its arguments

    def __init__(self, path: Path, to_hz: float, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._path, self._to_hz = path, to_hz
        self._process = ReadingProcess()
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="skinsource-import")
        self._lock = Lock()
        self._wanted: ImportChoice | None = None
        self._survey: Series | None = None
        self._working = False
        self._closed = Event()
        self._found: Found | None = None
        self._raw: RawPart | None = None
        self._told.connect(self._tell, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether something is wanted that is not there yet."""
        with self._lock:
            return self._working

    def look(self) -> None:
        """Find out what the file holds."""
        self._working = True
        self._pool.submit(self._look)

    def take(self, choice: ImportChoice) -> None:
        """Take what ``choice`` means, instead of whatever was wanted before."""
        with self._lock:
            self._wanted = choice
            if self._working:
                return
            self._working = True
        self._pool.submit(self._work)

    def survey(self, series: Series) -> None:
        """Look at all of a series, once nothing else is wanted."""
        with self._lock:
            self._survey = series
            if self._working:
                return
            self._working = True
        self._pool.submit(self._work)

    def close(self) -> None:
        """Give up what is being done, and wait until it has ended."""
        self._closed.set()
        self._pool.shutdown(wait=True)
        self._process.close()

    def _tell(self, signal: Any, arguments: tuple[Any, ...]) -> None:
        if not self._closed.is_set():
            signal.emit(*arguments)

    def _look(self) -> None:
        try:
            found = self._process.look(self._path, stop=self._closed.is_set)
            self._found = found
            self._told.emit(self.looked, (found,))
        except Stopped:
            return
        except Exception as error:  # noqa: BLE001  shown to the user
            self._told.emit(self.failed, (None, _sentence(error)))
        self._work()

    def _work(self) -> None:
        """Take what is wanted until nothing is."""
        while True:
            with self._lock:
                choice, self._wanted = self._wanted, None
                survey = self._survey
                if (choice or survey) is None or self._closed.is_set() or self._found is None:
                    self._working = False
                    return
            if choice is None:
                self._look_at_all(survey)
                continue
            try:
                job = Job(f"Importing {self._path.name}", partial(self._take, choice))
                result = job.run(self._progress(), self._stop())
                self._told.emit(self.taken, (choice, result))
            except Stopped:
                continue
            except Exception as error:  # noqa: BLE001  shown to the user
                self._told.emit(self.failed, (choice, _sentence(error)))

    def _look_at_all(self, series: Any) -> None:
        try:
            extremes = self._process.overview(
                self._path, series.key, series.n_samples, _COLUMNS, stop=self._is_wanted
            )
        except Stopped:
            return  # later, unless it is closed
        except SkinSourceError:
            extremes = None  # what is wrong is said about the part
        with self._lock:
            if self._survey is series:
                self._survey = None
        if extremes is not None:
            self._told.emit(self.surveyed, (series.key, extremes))

    def _is_wanted(self) -> bool:
        return self._closed.is_set() or self._wanted is not None

    def _take(self, choice: ImportChoice, *, progress: Progress, stop: Stop) -> Taken:
        assert self._found is not None  # noqa: S101  nothing is taken before it is known
        if self._raw is None or self._raw.read_for != read_for(choice):
            self._raw = None
            self._raw = read_part(
                self._path,
                self._found,
                choice,
                process=self._process,
                progress=progress,
                stop=stop,
            )
        self._told.emit(self.read, (self._raw,))
        stop_if(stop)
        return self._raw.taken(choice, self._to_hz)

    def _stop(self) -> Stop:
        until_s = monotonic() + _PATIENCE_S

        def stop() -> bool:
            late = self._wanted is not None and monotonic() > until_s
            return self._closed.is_set() or late

        return stop

    def _progress(self) -> Progress:
        last_s = 0.0

        def tell(done: int, total: int, _: str) -> None:
            nonlocal last_s
            if monotonic() - last_s >= _BETWEEN_PROGRESS_S:
                last_s = monotonic()
                self._told.emit(self.progressed, (done, total))

        return tell


def _sentence(error: Exception) -> str:
    if isinstance(error, SkinSourceError):
        return str(error)
    return f"The studio made a mistake ({type(error).__name__}: {error}). Please report this."
