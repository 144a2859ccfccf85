"""Evaluates quantities away from the GUI thread."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from threading import Event
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.errors import Stopped
from skinsource.graph import Graph
from skinsource.work import Work

#: An evaluation of this length is not part of a drag that wants to see each step.
_PATIENCE_S = 0.5


@dataclass(frozen=True, slots=True)
class Request:
    """The quantities that are wanted, and the values to start from.

    ``since_s`` is when the user wanted something else than before, by `time.perf_counter`;
    ``purpose`` tells whose request it is.
    """

    wanted: frozenset[str]
    given: Mapping[str, Any]
    since_s: float = field(default_factory=perf_counter, compare=False)
    purpose: str = "show"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a request: its values, or the error that prevented them.

    ``compute_s`` is the time the evaluation took, ``work`` what it did.
    """

    request: Request
    values: Mapping[str, Any] | None = None
    error: Exception | None = None
    compute_s: float = 0.0
    work: Work = field(default_factory=Work)


class Engine(QObject):
    """Evaluates one request at a time; of those that wait, only the newest is kept.

    A running evaluation is allowed to finish, so that a long drag shows a steady stream of
    results instead of none until the mouse stops; only one that has taken long already is
    abandoned for a newer request.
    """

    finished = Signal(object)  # Outcome, in the GUI thread
    _landed = Signal(object)  # Outcome or None, from the worker thread

    def __init__(self, graph: Graph, parent: QObject | None = None):
        super().__init__(parent)
        self._graph = graph
        self._closing = Event()
        self._superseded = Event()
        self._done = Event()
        self._started_s = 0.0
        self._busy = False
        self._waiting: Request | None = None
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="skinsource-engine")
        self._landed.connect(self._on_landed, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a request is being evaluated or waits."""
        return self._busy

    def request(self, request: Request) -> None:
        """Evaluate ``request`` as soon as possible, unless a newer one arrives first."""
        if self._closing.is_set():
            return
        if self._busy:
            self._waiting = request
            self._superseded.set()
        else:
            self._busy = True
            self._superseded.clear()
            self._done.clear()
            self._worker.submit(self._work, request)

    def wait(self, longest_s: float) -> None:
        """Sleep until the newest request is evaluated, if nothing else has to be before.

        Results are told by `finished` as ever, once the event loop runs again; it tells them
        before it paints.
        """
        if self._busy and self._waiting is None:
            self._done.wait(longest_s)

    def close(self) -> None:
        """Stop at the next rule and wait for the worker to end."""
        self._waiting = None
        self._closing.set()
        self._worker.shutdown(wait=True)

    def _work(self, request: Request) -> None:
        self._started_s = start = perf_counter()
        try:
            values = self._graph.evaluate(request.wanted, request.given, self._should_stop)
        except Stopped:
            outcome = None
        except Exception as error:  # noqa: BLE001  shown to the user by whoever listens
            outcome = Outcome(request, error=error, compute_s=perf_counter() - start)
        else:
            took_s = perf_counter() - start
            outcome = Outcome(request, values, compute_s=took_s, work=replace(self._graph.work))
        self._landed.emit(outcome)
        self._done.set()

    def _should_stop(self) -> bool:
        if self._closing.is_set():
            return True
        return self._superseded.is_set() and perf_counter() - self._started_s > _PATIENCE_S

    def _on_landed(self, outcome: Outcome | None) -> None:
        self._busy = False
        waiting, self._waiting = self._waiting, None
        if waiting is not None:
            self.request(waiting)
        if outcome is not None:
            self.finished.emit(outcome)
