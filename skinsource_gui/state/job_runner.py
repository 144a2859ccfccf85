"""Long jobs, one after another, away from the GUI thread."""

from collections import deque
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from threading import Event
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.base.errors import Stopped
from skinsource.base.job import Job, Progress, Stop, seconds_left

# What changes faster cannot be seen.
_BETWEEN_PROGRESS_S = 0.05


@dataclass(frozen=True, slots=True)
class JobProgress:
    """How far a job is.

    Attributes
    ----------
    done, total
        Pieces of work; a total of 0 while that is not known.
    text
        What is being done.
    elapsed_s
        How long the job has run.
    """

    done: int = 0
    total: int = 0
    text: str = ""
    elapsed_s: float = 0.0

    @property
    def seconds_left(self) -> float | None:
        """How long it will still take; None while that cannot be said."""
        return seconds_left(self.done, self.total, self.elapsed_s)


class JobRunner(QObject):
    """Carries out jobs in the order in which they came."""

    #: A job begins once this returns.
    starting = Signal()
    #: Another job is being carried out, or none, or more of them wait.
    changed = Signal()
    #: The job, and its `JobProgress`.
    progressed = Signal(object, object)
    #: The job that is finished, and its result.
    done = Signal(object, object)
    #: The job that was cancelled: nothing is left of it.
    cancelled = Signal(object)
    #: The job that failed, and the error.
    failed = Signal(object, object)
    _told = Signal(object, object)  # from the worker thread, as are those below
    _stopping = Signal(object)
    _landed = Signal(object, object, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._waiting: deque[Job[Any]] = deque()
        self._running: Job[Any] | None = None
        self._stop, self._closed = Event(), False
        # No thread before there is something to do.
        self._worker: ThreadPoolExecutor | None = None
        self.current: Job[Any] | None = None
        queued = Qt.ConnectionType.QueuedConnection
        self._told.connect(self._tell, queued)
        self._stopping.connect(self._note_stopping, queued)
        self._landed.connect(self._land, queued)

    @property
    def busy(self) -> bool:
        """Whether a job is being carried out, or cleared away, or waits."""
        return self._running is not None

    @property
    def unfinished(self) -> tuple[Job[Any], ...]:
        """The job that is being carried out, if any, and those that wait; none once closed."""
        if self._closed:
            return ()
        return (*([self.current] if self.current else []), *self._waiting)

    def add(self, job: Job[Any]) -> None:
        """Carry out ``job`` when those before it are done."""
        self._waiting.append(job)
        if self._running is None:
            self._start_next()
        else:
            self.changed.emit()

    def cancel(self, job: Job[Any] | None = None) -> None:
        """Stop ``job``, or the one that is being carried out; the next one begins."""
        if job is None or job is self.current:
            self._stop.set()
        elif job in self._waiting:
            self._waiting.remove(job)
            self.changed.emit()
            self.cancelled.emit(job)

    def close(self) -> None:
        """Forget all jobs, stop the present one, and wait until nothing is left of it."""
        self._waiting.clear()
        self._stop.set()
        # What the thread says at its end is heard only once events are looked at again.
        self._closed = True
        if self._worker is not None:
            self._worker.shutdown(wait=True)

    def _start_next(self) -> None:
        self._running = self.current = self._waiting.popleft() if self._waiting else None
        if self._running is not None:
            self.starting.emit()
            # An event of its own: the thread may still look at that of the job before.
            self._stop = Event()
            if self._worker is None:
                self._worker = ThreadPoolExecutor(1, thread_name_prefix="skinsource-job")
            self._worker.submit(self._work, self._running, self._stop)
        self.changed.emit()

    def _work(self, job: Job[Any], stop: Event) -> None:
        result, error = None, None
        try:
            result = job.run(self._progress_of(job), self._stop_of(job, stop))
        except Exception as fault:  # noqa: BLE001  shown to the user by whoever listens
            error = fault
        self._landed.emit(job, result, error)

    def _progress_of(self, job: Job[Any]) -> Progress:
        start_s, last_s = perf_counter(), 0.0

        def tell(done: int, total: int, text: str) -> None:
            nonlocal last_s
            now_s = perf_counter()
            if now_s - last_s >= _BETWEEN_PROGRESS_S:
                last_s = now_s
                self._told.emit(job, JobProgress(done, total, text, now_s - start_s))

        return tell

    def _stop_of(self, job: Job[Any], stop: Event) -> Stop:
        told = False

        def should_stop() -> bool:
            nonlocal told
            if stop.is_set() and not told:
                # From here on nothing is written.  To clear away what was may take longer than
                # the user should have to wait.
                told = True
                self._stopping.emit(job)
            return told

        return should_stop

    def _tell(self, job: Job[Any], progress: JobProgress) -> None:
        if job is self.current:
            self.progressed.emit(job, progress)

    def _note_stopping(self, job: Job[Any]) -> None:
        if job is self.current:
            self.current = None
            self.changed.emit()
            self.cancelled.emit(job)

    def _land(self, job: Job[Any], result: object, error: Exception | None) -> None:
        was_cancelled = self.current is not job
        self._start_next()
        if was_cancelled:
            return
        if error is None:
            self.done.emit(job, result)
        elif isinstance(error, Stopped):
            self.cancelled.emit(job)
        else:
            self.failed.emit(job, error)
