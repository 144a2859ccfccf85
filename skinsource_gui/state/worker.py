"""Work away from the GUI thread."""

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import suppress
from functools import partial
from threading import Event, Lock
from typing import Any, NamedTuple

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.base.errors import SkinSourceError, Stopped

#: Runs in the thread; may raise `Stopped` once the worker is closed, or a newer task waits.
Work = Callable[[], Any]
#: Is called in the GUI thread with the result, or with None and the error.
Then = Callable[[Any, Exception | None], object]


class _Task(NamedTuple):
    work: Work
    then: Then | None
    again: bool


class Worker(QObject):
    """Runs functions one after another in a thread; what they return arrives in the GUI thread.

    Nothing arrives any more once it is closed.

    Parameters
    ----------
    name
        Of the thread, which is made for the first function.
    parent
        As in Qt.
    """

    _arrived = Signal()  # from the thread

    def __init__(self, name: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._name = name
        self._pool: ThreadPoolExecutor | None = None
        self._unfinished = 0
        self._closed = Event()
        # Tasks of which only the newest of each key is run.
        self._newest: dict[str, _Task] = {}
        self._outbox: deque[Callable[[], object]] = deque()
        self._lock, self._awaited = Lock(), False
        self._arrived.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a task runs, waits, or has not arrived."""
        return self._unfinished > 0 and not self.closed

    @property
    def used(self) -> bool:
        """Whether anything was run, so that there is a thread."""
        return self._pool is not None

    @property
    def closed(self) -> bool:
        """Whether it was closed; a running task should stop then."""
        return self._closed.is_set()

    def is_outdated(self, key: str) -> bool:
        """Return whether a newer task of this key waits, or the worker was closed."""
        return self.closed or key in self._newest

    def run(self, work: Work, then: Then | None = None) -> "Future[Any]":
        """Run ``work`` after all that was given before, then call ``then``."""
        return self._submit(partial(self._call, _Task(work, then, again=False)))

    def run_newest(
        self, key: str, work: Work, then: Then | None = None, *, again: bool = False
    ) -> None:
        """Run ``work`` in place of what waits with the same key, then call ``then``.

        If it raises `Stopped` it is run ``again`` after what waits, unless newer work has its key.
        """
        with self._lock:
            waits = key in self._newest
            self._newest[key] = _Task(work, then, again)
        if not waits:
            self._submit(partial(self._call_newest, key))

    def tell(self, call: Callable[..., object], *arguments: object) -> None:
        """Call a function in the GUI thread; for tasks that have something to say meanwhile."""
        self._send(partial(call, *arguments))

    def wait(self, future: "Future[Any]", longest_s: float) -> None:
        """Sleep until a task is done; what has arrived then is delivered before this returns."""
        with self._lock:
            self._awaited = True
        with suppress(TimeoutError):
            future.result(longest_s)
        with self._lock:
            self._awaited = False
        self._deliver()

    def close(
        self, last: Work | None = None, *, finish: bool = False, longest_s: float | None = None
    ) -> None:
        """Deliver nothing more, and wait until the running task has ended.

        Parameters
        ----------
        last
            Is run at the end, if the thread was used and its tasks are to ``finish``.
        finish
            Whether what waits is run before; else it is dropped.
        longest_s
            After that the thread is left to itself, if it is to finish; None: it is waited for.
        """
        if self.closed:
            return
        self._closed.set()
        if self._pool is None:
            return
        if finish:
            ended = wait([self._pool.submit(last or (lambda: None))], longest_s).done
            self._pool.shutdown(wait=bool(ended))
        else:
            self._pool.shutdown(wait=True, cancel_futures=True)

    def _submit(self, call: Callable[[], Any]) -> "Future[Any]":
        if self.closed:
            cancelled = Future[Any]()
            cancelled.cancel()
            return cancelled
        self._unfinished += 1
        if self._pool is None:
            self._pool = ThreadPoolExecutor(1, thread_name_prefix=self._name)
        return self._pool.submit(call)

    def _call(self, task: _Task, key: str = "") -> Any:
        result, fault = None, None
        try:
            result = task.work()
        except Exception as error:  # noqa: BLE001  whoever gave the task is told
            # Where it stopped matters to nobody, and would keep what was computed until then.
            fault = error.with_traceback(None) if isinstance(error, Stopped) else error
        if task.again and isinstance(fault, Stopped):
            self._send(partial(self._run_again, key, task))
        else:
            self._send(partial(self._finish, task.then, result, fault))
        return result

    def _call_newest(self, key: str) -> None:
        with self._lock:
            task = self._newest.pop(key)
        self._call(task, key)

    def _run_again(self, key: str, task: _Task) -> None:
        self._unfinished -= 1
        if key not in self._newest:
            self.run_newest(key, task.work, task.then, again=True)

    def _finish(self, then: Then | None, result: Any, fault: Exception | None) -> None:
        self._unfinished -= 1
        if then is not None:
            then(result, fault)

    def _send(self, call: Callable[[], object]) -> None:
        with self._lock:
            self._outbox.append(call)
            # With a waiting caller no event is sent: this might be deleted before it arrives.
            silent = self._awaited or self.closed
        if not silent:
            self._arrived.emit()

    def _deliver(self) -> None:
        try:
            while self._outbox and not self.closed:
                self._outbox.popleft()()
        finally:
            if self._outbox and not self.closed:
                # One of them failed; the others still arrive.
                self._arrived.emit()


def fault_text(error: Exception | None) -> str:
    """Return why a task has no result, as a text for the user."""
    if isinstance(error, SkinSourceError):
        return str(error)
    return f"The studio made a mistake: {type(error).__name__}: {error}. Please report this."
