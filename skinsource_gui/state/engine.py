"""Evaluation away from the GUI thread: the engine of a window.

Requests name quantities and sources. Each design that is predicted beside the others has a slot,
and of each slot and purpose only the newest request waits.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import partial
from threading import Event
from time import perf_counter
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QObject, QTimer, Signal

from skinsource.base.errors import Stopped, counted
from skinsource.base.work import Work
from skinsource.design import edits
from skinsource.design.comparing import at_frequency
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Refusal
from skinsource.engine.graph import Graph
from skinsource.engine.quantities import sources
from skinsource.limbs.limb import LIVE_INPUTS, LIVE_OUTPUTS
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource_gui.state.worker import Worker

#: An evaluation that has taken longer is abandoned for a newer one: it is no step of a drag.
_ABANDONED_AFTER_S = 0.5
#: Arrays that are latest results of all slots but the first: of slots that were asked for longer
#: ago only those are kept that do not depend on what the inputs play.
_BESIDE_BYTES = 48 * 2**20
_ALWAYS_KEPT = ("limb_data", "driven_limb", "surface")


class Purpose(IntEnum):
    """Purpose of a request, in the order in which waiting requests are evaluated."""

    SHOW = 0
    CHECK = 1
    JUDGE = 2
    EXPORT = 3


#: Requests about what is shown; they are of no use once something else is shown.
_ABOUT_WHAT_IS_SHOWN = (Purpose.CHECK, Purpose.JUDGE)


#: Names one of the designs that are predicted side by side; each has a graph of its own.
Slot = str
#: The design in the window.
FIRST_SLOT = "A"


@dataclass(frozen=True, slots=True)
class Request:
    """The quantities that are wanted, and the sources that are given.

    ``since_s`` is the time of the edit by `time.perf_counter`.
    """

    wanted: frozenset[str]
    given: Mapping[str, Any]
    since_s: float = field(default_factory=perf_counter, compare=False)
    purpose: Purpose = Purpose.SHOW
    slot: Slot = FIRST_SLOT

    @property
    def place(self) -> tuple[Slot, Purpose]:
        """The key under which it waits: a newer request of the same key replaces it."""
        return self.slot, self.purpose


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a request: its values, or the error that prevented them.

    ``compute_s`` is the time the evaluation took, ``work`` its counts.
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
    newer one of its place, or put back when a more urgent one comes.  A request to check or judge
    what is no longer shown is dropped.

    Parameters
    ----------
    new_graph
        Makes the graph of a slot, when it is first asked for something.
    parent
        As in Qt.
    """

    finished = Signal(object)  # Outcome, in the GUI thread
    rested = Signal()  # nothing is evaluated and nothing waits

    def __init__(self, new_graph: Callable[[], Graph], parent: QObject | None = None):
        super().__init__(parent)
        self._new_graph = new_graph
        self._graphs: dict[Slot, Graph] = {}
        self._plan: Graph | None = None
        self._upstream: dict[frozenset[str], frozenset[str]] = {}
        self._superseded = Event()
        self._started_s = 0.0
        self._running: Request | None = None
        self._newest: Request | None = None
        self._waiting: dict[tuple[Slot, Purpose], Request] = {}
        # The last request of each slot to show something.
        self._to_show: dict[Slot, Request] = {}
        self._worker = Worker("skinsource-engine", self)
        # Of the running request.
        self._future: Future[Any] | None = None

    @property
    def busy(self) -> bool:
        """Whether a request is being evaluated or waits."""
        return self._running is not None

    def upstream_of(self, quantities: frozenset[str]) -> frozenset[str]:
        """Return the names of all that ``quantities`` depend on, computed or given."""
        if quantities not in self._upstream:
            # The graphs of the slots belong to the worker; this graph computes nothing.
            self._plan = self._plan or self._new_graph()
            self._upstream[quantities] = self._plan.upstream_of(quantities)
        return self._upstream[quantities]

    def request(self, request: Request) -> None:
        """Evaluate ``request`` as soon as possible, unless a newer one takes its place."""
        if self._worker.closed:
            return
        self._newest = request
        if request.purpose is Purpose.SHOW:
            self._to_show[request.slot] = request
        if self._running is None:
            self._start(request)
            return
        # The new request takes the turn of the old one, so that no slot waits for ever.
        self._waiting[request.place] = request
        running = self._running
        if request.place == running.place or request.purpose < running.purpose:
            self._superseded.set()

    def release(self, slot: Slot) -> None:
        """Forget what was computed for ``slot``, and what waits for it."""
        for key in [key for key in self._waiting if key[0] == slot]:
            del self._waiting[key]
        self._to_show.pop(slot, None)
        self._worker.run(partial(self._graphs.pop, slot, None))

    def wait(self, longest_s: float) -> None:
        """Sleep until the newest request is evaluated, if nothing else has to be before.

        `finished` is emitted before this returns, so that all parts are painted with the results:
        scenes of graphics views are painted as soon as the event loop runs, each for itself.
        """
        if self._future is not None and self._running is self._newest:
            self._worker.wait(self._future, longest_s)

    def close(self) -> None:
        """Stop at the next rule and wait for the worker to end; its result is dropped."""
        self._waiting.clear()
        self._worker.close()
        self._running = self._future = None
        self.rested.emit()

    def _start(self, request: Request) -> None:
        self._running = request
        self._superseded.clear()
        self._future = self._worker.run(partial(self._outcome_of, request), self._receive)

    def _outcome_of(self, request: Request) -> Outcome:
        self._started_s = start = perf_counter()
        try:
            graph = self._graphs.pop(request.slot, None) or self._new_graph()
            self._graphs[request.slot] = graph  # the latest last
            values = graph.evaluate(request.wanted, request.given, self._should_stop)
            self._forget_beside()
        except Stopped:
            raise
        except Exception as error:  # noqa: BLE001  shown to the user by whoever listens
            return Outcome(request, error=error, compute_s=perf_counter() - start)
        took_s = perf_counter() - start
        return Outcome(request, values, compute_s=took_s, work=replace(graph.work))

    def _forget_beside(self) -> None:
        held_bytes = 0
        for slot, graph in reversed(self._graphs.items()):
            held_bytes += graph.held_bytes if slot != FIRST_SLOT else 0
            if slot != FIRST_SLOT and held_bytes > _BESIDE_BYTES:
                graph.keep_only(_ALWAYS_KEPT)

    def _should_stop(self) -> bool:
        if self._worker.closed:
            return True
        return self._superseded.is_set() and perf_counter() - self._started_s > _ABANDONED_AFTER_S

    def _receive(self, outcome: Outcome | None, stopped: Exception | None) -> None:
        ended, self._running, self._future = self._running, None, None
        if outcome is None and ended is not None:
            # Abandoned: it waits again, unless a newer request has its place.
            self._waiting.setdefault(ended.place, ended)
        self._waiting = {
            key: request for key, request in self._waiting.items() if not self._is_outdated(request)
        }
        if self._waiting:
            first = min(self._waiting, key=lambda key: key[1])
            self._start(self._waiting.pop(first))
        if outcome is not None:
            self.finished.emit(outcome)
        if not self.busy:
            self.rested.emit()

    def _is_outdated(self, request: Request) -> bool:
        shown = self._to_show.get(request.slot)
        about = request.purpose in _ABOUT_WHAT_IS_SHOWN
        return about and shown is not None and shown.given != request.given


class FirstPaintEngine(Engine):
    """Begins when its window has been painted once.

    The first evaluation imports most of scipy and opens the limb: half a second in which the
    window would have to share Python's lock with the worker, just when it is painted first.

    Parameters
    ----------
    new_graph
        Makes the graph of a slot.
    window
        What is painted first; also the parent.
    """

    def __init__(self, new_graph: Callable[[], Graph], window: QtWidgets.QWidget) -> None:
        super().__init__(new_graph, window)
        self._painted = False
        self._first: dict[tuple[Slot, Purpose], Request] = {}
        window.installEventFilter(self)

    @property
    def busy(self) -> bool:
        """Whether a request is being evaluated or waits."""
        return bool(self._first) or super().busy

    def request(self, request: Request) -> None:
        """Evaluate ``request`` as soon as possible, unless a newer one arrives first."""
        if self._painted:
            super().request(request)
        else:
            self._first[request.place] = request

    def close(self) -> None:
        """Stop at the next rule and wait for the worker to end."""
        # Later requests are ignored by the closed engine.
        self._painted = True
        self._first.clear()
        super().close()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Paint:
            watched.removeEventFilter(self)
            # All of the window is painted before the next event is looked at.
            QTimer.singleShot(0, self._begin)
        return super().eventFilter(watched, event)

    def _begin(self) -> None:
        self._painted = True
        first, self._first = self._first, {}
        for request in first.values():
            self.request(request)


#: What a design is predicted with beside the others: the name of a limb, or a frequency, Hz.
Beside = str | float
#: The quantities that take long on a large limb, with all that depends on them.
FROM_THE_LIMB = frozenset({"driven_limb", "surface"})
#: Quantities of the selected outputs, of those that designs beside the one of the window need.
OF_OUTPUTS = frozenset({"axis_traces", "shown_outputs"})
#: What levels depend on.
_DEPENDS_ON = (
    "limb",
    "limb_digest",
    "limb_mirrored",
    "inputs",
    "scaling",
    "actuation",
    "match_gain",
    "axes",
    "method",
    "span",
)


def sources_shown(design: Design, view: View) -> dict[str, Any]:
    """Return the sources of the design in the window, as loud as it is shown.

    Here and in `sources_of_levels` an input that cannot be played is left out, and named by
    ``unplayable_inputs``: the others are still seen.
    """
    return sources(design, view, match_gain=view.match_gain(design), leave_out_unplayable=True)


def sources_of_levels(
    design: Design, view: View, *, match_gain: float = 1.0, with_outputs: bool = False
) -> dict[str, Any]:
    """Return the sources of evaluation, with the part of the view that levels depend on.

    A limb that has not been measured along the axes of the view is evaluated along those it has.
    ``match_gain``: see `skinsource.engine.quantities.sources`.  ``with_outputs``: the selected
    outputs are among the sources, as traces need them.
    """
    axes = axes_on(design.limb, view.axes)
    levels_view = View(axes=axes, method=view.method, span=view.span, selected_inputs=())
    if with_outputs:
        levels_view = replace(levels_view, outputs=view.outputs)
    return sources(design, levels_view, match_gain=match_gain, leave_out_unplayable=True)


def on_limb(design: Design, view: View, limb: Beside) -> tuple[Design, View] | str:
    """Return the design on a limb and the view there, or why there are none.

    In place of a limb there may be a frequency, Hz: then it is the design at that frequency.
    """
    if isinstance(limb, float):
        return at_frequency(design, limb), view
    if limb == design.limb:
        return design, view
    edit = edits.change_limb(design, view, limb)
    return edit.sentence if isinstance(edit, Refusal) else (edit.design, edit.view)


def key_of_levels(given: Mapping[str, Any]) -> tuple[Any, ...]:
    """Return the sources that levels depend on: equal keys have equal levels."""
    return tuple(given[name] for name in _DEPENDS_ON)


def too_large(limb: str) -> str:
    """Return why a limb is too large to be computed at each edit; "" where it is not."""
    facts = facts_of(limb)
    if facts.live:
        return ""
    return (
        f"{facts.title} has {counted(facts.n_inputs, 'place')} and "
        f"{counted(facts.n_outputs, 'output')}, and live results are possible up to {LIVE_INPUTS} "
        f"and {LIVE_OUTPUTS}. File > Export and sweeps compute it."
    )
