"""Exports, one after another, away from the GUI thread."""

from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from time import perf_counter
from typing import Protocol

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.design import Design
from skinsource.errors import Stopped
from skinsource.job import Progress, Stop
from skinsource.view import View

# What changes faster cannot be seen.
_BETWEEN_PROGRESS_S = 0.05


class Write(Protocol):
    """A function of `skinsource.export`."""

    def __call__(
        self,
        path: Path,
        design: Design,
        view: View,
        *,
        progress: Progress,
        stop: Stop,
        largest_error: float,
    ) -> None:
        """Compute and write."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOrder:
    """What is to be exported, as it was when the user asked for it.

    Attributes
    ----------
    write
        Computes and writes the file.
    path
        The file.
    design, view
        What is exported.
    largest_error
        Estimated error above which nothing is written.
    """

    write: Write
    path: Path
    design: Design
    view: View
    largest_error: float


class ExportJobs(QObject):
    """Carries out orders in the order in which they came."""

    #: Another order is being carried out, or none, or more of them wait.
    changed = Signal()
    #: Done, total, what is being done.  A total of 0 while that is not known.
    progressed = Signal(int, int, str)
    #: The order whose file was written.
    written = Signal(object)
    #: The order that was cancelled: nothing was, or will be, written.
    cancelled = Signal(object)
    #: The order that failed, and the error.
    failed = Signal(object, object)
    _told = Signal(object, int, int, str)  # from the worker thread, as are those below
    _stopping = Signal(object)
    _landed = Signal(object, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._waiting: deque[ExportOrder] = deque()
        self._running: ExportOrder | None = None
        self._stop = Event()
        # No thread before there is something to export.
        self._worker: ThreadPoolExecutor | None = None
        self.current: ExportOrder | None = None
        queued = Qt.ConnectionType.QueuedConnection
        self._told.connect(self._tell, queued)
        self._stopping.connect(self._note_stopping, queued)
        self._landed.connect(self._land, queued)

    @property
    def busy(self) -> bool:
        """Whether an order is being carried out, or cleared away, or waits."""
        return self._running is not None

    @property
    def unfinished(self) -> tuple[ExportOrder, ...]:
        """The order that is being carried out, if any, and those that wait."""
        return (*([self.current] if self.current else []), *self._waiting)

    def add(self, order: ExportOrder) -> None:
        """Carry out ``order`` when those before it are done."""
        self._waiting.append(order)
        if self._running is None:
            self._start_next()
        else:
            self.changed.emit()

    def cancel(self) -> None:
        """Stop the order that is being carried out; the next one begins."""
        self._stop.set()

    def close(self) -> None:
        """Forget all orders, stop the present one, and wait until nothing is left of it."""
        self._waiting.clear()
        self._stop.set()
        if self._worker is not None:
            self._worker.shutdown(wait=True)

    def _start_next(self) -> None:
        self._running = self.current = self._waiting.popleft() if self._waiting else None
        if self._running is not None:
            # An event of its own: the thread may still look at that of the order before.
            self._stop = Event()
            if self._worker is None:
                self._worker = ThreadPoolExecutor(1, thread_name_prefix="skinsource-export")
            self._worker.submit(self._work, self._running, self._stop)
        self.changed.emit()

    def _work(self, order: ExportOrder, stop: Event) -> None:
        error: Exception | None = None
        try:
            order.write(
                order.path,
                order.design,
                order.view,
                progress=self._progress_of(order),
                stop=self._stop_of(order, stop),
                largest_error=order.largest_error,
            )
        except Exception as fault:  # noqa: BLE001  shown to the user by whoever listens
            error = fault
        self._landed.emit(order, error)

    def _progress_of(self, order: ExportOrder) -> Progress:
        last_s = 0.0

        def tell(done: int, total: int, text: str) -> None:
            nonlocal last_s
            now_s = perf_counter()
            if now_s - last_s >= _BETWEEN_PROGRESS_S:
                last_s = now_s
                self._told.emit(order, done, total, text)

        return tell

    def _stop_of(self, order: ExportOrder, stop: Event) -> Callable[[], bool]:
        told = False

        def should_stop() -> bool:
            nonlocal told
            if stop.is_set() and not told:
                # From here on nothing is written.  To clear away what was may take longer than
                # the user should have to wait.
                told = True
                self._stopping.emit(order)
            return told

        return should_stop

    def _tell(self, order: ExportOrder, done: int, total: int, text: str) -> None:
        if order is self.current:
            self.progressed.emit(done, total, text)

    def _note_stopping(self, order: ExportOrder) -> None:
        if order is self.current:
            self.current = None
            self.changed.emit()
            self.cancelled.emit(order)

    def _land(self, order: ExportOrder, error: Exception | None) -> None:
        was_cancelled = self.current is not order
        self._start_next()
        if was_cancelled:
            return
        if error is None:
            self.written.emit(order)
        elif isinstance(error, Stopped):
            self.cancelled.emit(order)
        else:
            self.failed.emit(order, error)
