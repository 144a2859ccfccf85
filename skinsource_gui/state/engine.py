"""Evaluates quantities away from the GUI thread."""

from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from enum import IntEnum
from threading import Event, Lock
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.base.errors import Stopped
from skinsource.base.work import Work
from skinsource.engine.graph import Graph

#: One that has taken longer gives way to a newer one: it is no part of a drag that wants to see
#: each step.
_ABANDONED_AFTER_S = 0.5


class Purpose(IntEnum):
    """What a request is for; of those that wait, the first of these goes first."""

    SHOW = 0
    CHECK = 1
    JUDGE = 2
    EXPORT = 3


#: What is asked about what is shown, and asked again about what is shown after that.
_ABOUT_WHAT_IS_SHOWN = (Purpose.CHECK, Purpose.JUDGE)


@dataclass(frozen=True, slots=True)
class Slot:
    """One of several designs that are looked at side by side; each has a graph of its own."""

    name: str


#: The design in the window.
FIRST_SLOT = Slot("A")


@dataclass(frozen=True, slots=True)
class Request:
    """The quantities that are wanted, and the values to start from.

    ``since_s`` is when the user wanted something else than before, by `time.perf_counter`;
    ``purpose`` tells what it is for, ``slot`` which of the designs side by side it is about.
    """

    wanted: frozenset[str]
    given: Mapping[str, Any]
    since_s: float = field(default_factory=perf_counter, compare=False)
    purpose: Purpose = Purpose.SHOW
    slot: Slot = FIRST_SLOT

    @property
    def place(self) -> tuple[Slot, Purpose]:
        """Where it waits: of those that want the same place, the newest takes it."""
        return self.slot, self.purpose


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
    """Evaluates one request at a time; of each slot and purpose the newest waits.

    A running evaluation is allowed to finish, so that a long drag shows a steady stream of results
    instead of none until the mouse stops; only one that has taken long already is abandoned for a
    newer one of its place, or put back for one that goes before it.  To check or judge what is no
    longer shown is of no use, and would be computed in place of what is: such a request is dropped.

    Parameters
    ----------
    new_graph
        Makes the graph of a slot, when it is first asked for something.
    parent
        As in Qt.
    """

    finished = Signal(object)  # Outcome, in the GUI thread
    rested = Signal()  # nothing is evaluated and nothing waits
    _landed = Signal()  # from the worker thread

    def __init__(self, new_graph: Callable[[], Graph], parent: QObject | None = None):
        super().__init__(parent)
        self._new_graph = new_graph
        self._graphs: dict[Slot, Graph] = {}
        self._plan: Graph | None = None
        self._upstream: dict[frozenset[str], frozenset[str]] = {}
        self._closing = Event()
        self._superseded = Event()
        self._done = Event()
        self._started_s = 0.0
        self._running: Request | None = None
        self._newest: Request | None = None
        self._waiting: dict[tuple[Slot, Purpose], Request] = {}
        # What each slot was asked last to show.
        self._to_show: dict[Slot, Request] = {}
        # Of evaluations that have ended and are not told yet; None: abandoned.
        self._ended: deque[Outcome | None] = deque()
        self._lock, self._awaited = Lock(), False
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="skinsource-engine")
        self._landed.connect(self._land, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a request is being evaluated or waits."""
        return self._running is not None

    def upstream_of(self, quantities: frozenset[str]) -> frozenset[str]:
        """Names of all that ``quantities`` depend on, computed or given."""
        if quantities not in self._upstream:
            # Those of the slots belong to the worker; this one computes nothing.
            self._plan = self._plan or self._new_graph()
            self._upstream[quantities] = self._plan.upstream_of(quantities)
        return self._upstream[quantities]

    def request(self, request: Request) -> None:
        """Evaluate ``request`` as soon as possible, unless a newer one takes its place."""
        if self._closing.is_set():
            return
        self._newest = request
        if request.purpose is Purpose.SHOW:
            self._to_show[request.slot] = request
        if self._running is None:
            self._start(request)
            return
        # One that is replaced hands on its turn: no slot waits for ever.
        self._waiting[request.place] = request
        running = self._running
        if request.place == running.place or request.purpose < running.purpose:
            self._superseded.set()

    def release(self, slot: Slot) -> None:
        """Forget what was computed for ``slot``, and what waits for it."""
        for place in [place for place in self._waiting if place[0] == slot]:
            del self._waiting[place]
        self._to_show.pop(slot, None)
        if not self._closing.is_set():
            self._worker.submit(self._graphs.pop, slot, None)

    def wait(self, longest_s: float) -> None:
        """Sleep until the newest request is evaluated, if nothing else has to be before.

        Its results are told by `finished` before this returns: scenes of graphics views have
        themselves painted as soon as the event loop runs, each for itself.
        """
        if self._running is None or self._running is not self._newest:
            return
        with self._lock:
            self._awaited = True
        self._done.wait(longest_s)
        with self._lock:
            self._awaited = False
        self._land()

    def close(self) -> None:
        """Stop at the next rule and wait for the worker to end; what it had is told to nobody."""
        self._waiting.clear()
        self._closing.set()
        self._worker.shutdown(wait=True)
        self._running = None
        self.rested.emit()

    def _start(self, request: Request) -> None:
        self._running = request
        self._superseded.clear()
        self._done.clear()
        self._worker.submit(self._work, request)

    def _work(self, request: Request) -> None:
        self._started_s = start = perf_counter()
        try:
            graph = self._graphs.get(request.slot)
            if graph is None:
                graph = self._graphs[request.slot] = self._new_graph()
            values = graph.evaluate(request.wanted, request.given, self._should_stop)
        except Stopped:
            outcome = None
        except Exception as error:  # noqa: BLE001  shown to the user by whoever listens
            outcome = Outcome(request, error=error, compute_s=perf_counter() - start)
        else:
            took_s = perf_counter() - start
            outcome = Outcome(request, values, compute_s=took_s, work=replace(graph.work))
        with self._lock:
            self._ended.append(outcome)
            # To tell who looks for himself would leave an event to an engine that may be gone.
            alone = not self._awaited
        self._done.set()
        if alone:
            self._landed.emit()

    def _should_stop(self) -> bool:
        if self._closing.is_set():
            return True
        return self._superseded.is_set() and perf_counter() - self._started_s > _ABANDONED_AFTER_S

    def _land(self) -> None:
        if self._closing.is_set() or not self._ended:
            # Who would show it may be gone; or it was shown to one who waited.
            return
        outcome = self._ended.popleft()
        ended, self._running = self._running, None
        if outcome is None and ended is not None:
            # Abandoned: it goes on later, unless a newer one has its place.
            self._waiting.setdefault(ended.place, ended)
        self._waiting = {
            place: one for place, one in self._waiting.items() if not self._is_outdated(one)
        }
        if self._waiting:
            first = min(self._waiting, key=lambda place: place[1])
            self._start(self._waiting.pop(first))
        if outcome is not None:
            self.finished.emit(outcome)
        if not self.busy:
            self.rested.emit()

    def _is_outdated(self, request: Request) -> bool:
        shown = self._to_show.get(request.slot)
        about = request.purpose in _ABOUT_WHAT_IS_SHOWN
        return about and shown is not None and shown.given != request.given
