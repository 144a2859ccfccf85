"""Predictions beside the one of the window: of snapshots, and of the design on other limbs.

Each has a slot of the engine of its own, and is computed only while a visible panel needs it.
`Judging` waits for the validity of designs that are exported.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QEventLoop, QObject, Signal

from skinsource.design import edits
from skinsource.design.comparing import (
    Snapshot,
    loudest_db,
    match_text,
    matching_gain,
    other_snapshot,
    reference_snapshot,
    shown_snapshot,
    snapshot_name,
    why_no_comparison,
    with_edited,
)
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource.perception.validity import Judged
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.state.compared import Compared
from skinsource_gui.state.conductor import UNPLAYABLE
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import (
    FIRST_SLOT,
    OF_OUTPUTS,
    Beside,
    Engine,
    Outcome,
    Purpose,
    Request,
    Slot,
    key_of_levels,
    on_limb,
    sources_of_levels,
    too_large,
)
from skinsource_gui.state.panel import Panel, PanelRegistry
from skinsource_gui.state.worker import fault_text


class OnLimbs(QObject):
    """Has the engine predict the design on each limb, or at each frequency, that panels need.

    For the limb of the window its own results are used, where they hold all that is needed.
    """

    def __init__(self, document: Document, engine: Engine, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        # What visible panels need, as of the last change: of each limb, and all of them together.
        self._needs: dict[Panel, Mapping[Beside, frozenset[str]]] = {}
        self._wanted: dict[Beside, frozenset[str]] = {}
        self._requests: dict[Beside, Request] = {}
        self._outcomes: dict[Beside, Outcome] = {}

    def begin(self) -> None:
        """Follow the document, after the conductor of the window does."""
        self._document.changed.connect(self._follow)
        self._engine.finished.connect(self._note)
        self._engine.rested.connect(self._ask)
        self._panels.each(lambda panel: panel.visibility_changed.connect(self._follow))

    def forget_problems(self) -> None:
        """Try failed predictions again: limbs came or went."""
        for limb in [name for name, outcome in self._outcomes.items() if outcome.values is None]:
            del self._outcomes[limb]
            self._requests.pop(limb, None)

    def _follow(self) -> None:
        visible = [panel for panel in self._panels if panel.compares and panel.isVisible()]
        needed = {panel: panel.needs_on_limbs for panel in visible}
        self._needs = {panel: on_limbs for panel, on_limbs in needed.items() if on_limbs}
        wanted: dict[Beside, frozenset[str]] = {}
        for on_limbs in self._needs.values():
            for limb, needs in on_limbs.items():
                wanted[limb] = wanted.get(limb, frozenset({UNPLAYABLE})) | needs
        self._wanted = wanted
        for limb in self._requests.keys() - wanted.keys():
            del self._requests[limb]
            self._engine.release(_slot(limb))
        for limb in self._outcomes.keys() - wanted.keys():
            del self._outcomes[limb]
        if wanted:
            self._ask()
            self._tell()

    def _ask(self) -> None:
        """Request the quantities that are not known of the present design."""
        for limb, needs in self._wanted.items():
            located = self._on_limb(limb)
            if isinstance(located, str):
                continue
            sources = self._sources(located)
            if self._is_known(limb, needs, sources):
                continue
            if limb == self._document.design.limb and self._engine.busy:
                continue  # the window is about to show it
            request = Request(needs, sources, slot=_slot(limb))
            if self._requests.get(limb) != request:
                self._requests[limb] = request
                self._engine.request(request)

    def _on_limb(self, limb: Beside) -> tuple[Design, View] | str:
        """Return the design and the view on a limb, or why there are none."""
        asked = on_limb(self._document.design, self._document.view, limb)
        return asked if isinstance(asked, str) else too_large(asked[0].limb) or asked

    def _sources(self, asked: tuple[Design, View]) -> dict[str, Any]:
        """Return the sources of evaluation, as loud as the design is shown in the window."""
        document = self._document
        return sources_of_levels(*asked, match_gain=document.shown_view.match_gain(document.design))

    def _is_known(self, limb: Beside, needs: frozenset[str], sources: dict[str, Any]) -> bool:
        outcome = self._outcomes.get(limb)
        if outcome is None or key_of_levels(outcome.request.given) != key_of_levels(sources):
            return False
        return outcome.values is None or needs <= outcome.values.keys()

    def _note(self, outcome: Outcome) -> None:
        request = outcome.request
        here: Beside = request.given["limb"]
        limb = next((each for each in self._wanted if request.slot == _slot(each)), here)
        needs = self._wanted.get(limb)
        if needs is None:
            return
        of_window = request.place == (FIRST_SLOT, Purpose.SHOW)
        known = set() if outcome.values is None else outcome.values.keys()
        if request.slot != _slot(limb) and not (of_window and needs <= known):
            return
        self._outcomes[limb] = outcome
        self._tell()

    def _tell(self) -> None:
        compared = {limb: self._compared(limb, needs) for limb, needs in self._wanted.items()}
        for panel, on_limbs in self._needs.items():
            panel.show_on_limbs([compared[limb] for limb in on_limbs])

    def _compared(self, limb: Beside, needs: frozenset[str]) -> Compared:
        asked = self._on_limb(limb)
        if isinstance(asked, str):
            # With the name of the limb, to show which limb has the problem.
            named = replace(self._document.design, limb=str(limb), limb_digest="")
            return Compared(snapshot=Snapshot(design=named), problem=asked)
        snapshot = Snapshot(design=asked[0])
        outcome = self._outcomes.get(limb)
        if outcome is None or not (outcome.values is None or needs <= outcome.values.keys()):
            return Compared(snapshot=snapshot, axes=asked[1].axes)
        stale = not self._is_known(limb, needs, self._sources(asked))
        problem = "" if outcome.values is not None or stale else fault_text(outcome.error)
        return Compared(
            snapshot=snapshot,
            values=outcome.values,
            problem=problem,
            axes=asked[1].axes,
            is_stale=stale,
        )


def _slot(limb: Beside) -> Slot:
    return Slot(f"limb {limb}")


class StayingMatched(QObject):
    """Shows the snapshot in the window anew where its gain has changed.

    Parameters
    ----------
    document
        The document with the snapshots; also the parent.
    show
        Shows the snapshot of a number, as loud as the others.
    """

    def __init__(self, document: Document, show: Callable[[int], None]) -> None:
        super().__init__(document)
        self._document, self._show = document, show
        self._last = self._gain_sources()
        document.settled.connect(self._follow)
        # An opened design is shown with the gain that it was saved with.
        document.jumped.connect(self._note_jump)

    def _gain_sources(self) -> tuple[Any, ...]:
        view = self._document.view
        designs = {snapshot.number: snapshot.design for snapshot in view.snapshots}
        return view.levels_matched, view.axes, view.method, view.span, designs

    def _note_jump(self) -> None:
        self._last = self._gain_sources()

    def _follow(self) -> None:
        before, self._last = self._last, self._gain_sources()
        view = self._document.view
        if before == self._last or not view.levels_matched:
            return
        stored = shown_snapshot(view.snapshots, self._document.design)
        just_switched_on = not before[0]
        # A snapshot that was not shown since it was stored has no gain.
        if stored is not None and (just_switched_on or stored.gain != 1.0):
            self._show(stored.number)


_LEVELS = frozenset({"output_levels_db", UNPLAYABLE})
_AS_STORED = "Switch off Edit > Match levels of snapshots to show it as stored"
# The number of the results of the window.
_PRESENT = -1


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """A prediction, or why there is none.

    ``key`` is what levels depend on, ``outputs`` are those of which there are traces.
    """

    key: tuple[Any, ...]
    outputs: tuple[int, ...]
    result: Mapping[str, Any] | str

    @property
    def values(self) -> Mapping[str, Any] | None:
        return None if isinstance(self.result, str) else self.result

    @property
    def problem(self) -> str:
        return self.result if isinstance(self.result, str) else ""

    def holds(self, wanted: frozenset[str]) -> bool:
        """Return whether nothing of ``wanted`` is missing."""
        return isinstance(self.result, str) or wanted <= self.result.keys()


class Comparison(QObject):
    """Stores and shows snapshots, and has the engine predict them while panels compare them."""

    #: What was done, as a short text.
    done = Signal(str)

    def __init__(self, document: Document, engine: Engine, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        # What visible panels need of each snapshot, as of the last change.
        self._needs: dict[Panel, frozenset[str]] = {}
        self._on_limbs = OnLimbs(document, engine, panels)
        self._requests: dict[int, Request] = {}
        self._known: dict[int, _Known] = {}
        self._when_complete: Callable[[], None] | None = None
        # Showing snapshots in turn is one step of the history, or none where all is as before.
        self._showing = new_gesture()

    def begin(self) -> None:
        """Follow the document, after the conductor of the window, which requests its results."""
        self._document.changed.connect(self._follow)
        self._on_limbs.begin()
        self._engine.finished.connect(self._note)
        self._engine.rested.connect(self._ask)
        self._panels.each(lambda panel: panel.visibility_changed.connect(self._follow))
        self._panels.each(lambda panel: panel.snapshot_requested.connect(self.show))
        StayingMatched(self._document, self.show)

    def store(self, number: str) -> None:
        """Store the present design under a number."""
        document = self._document
        steps = document.undo_stack.index()
        document.apply(edits.store_snapshot(document.design, document.view, int(number)))
        replaced = " in place of another, which Undo brings back"
        replacement = replaced if document.undo_stack.index() > steps else ""
        other = other_snapshot(document.view.snapshots, document.design)
        hint = "change the design, then X switches"
        if other is not None:
            hint = f"X shows {snapshot_name(other.number)}, then this again"
        self.done.emit(f"Stored snapshot {number}{replacement}; {hint}")

    def forget_problems(self) -> None:
        """Try failed predictions again: limbs came or went."""
        for number in [n for n, known in self._known.items() if known.problem]:
            del self._known[number]
            self._requests.pop(number, None)
        self._on_limbs.forget_problems()

    def toggle(self) -> None:
        """Show the other one of the last two snapshots that were shown."""
        document = self._document
        other = other_snapshot(document.view.snapshots, document.design)
        if other is None:
            document.apply(Refusal(sentence=why_no_comparison(document.view.snapshots)))
        else:
            self.show(other.number)

    def recall(self, number: str) -> None:
        """Show the snapshot with a number."""
        self.show(int(number))

    def show(self, number: int) -> None:
        """Put a snapshot in place of the design, as loud as the others where that is wanted."""
        document = self._document
        before = document.design, document.view
        if not document.view.levels_matched:
            outcome = edits.show_snapshot(*before, number)
            document.apply(outcome, self._showing)
            if isinstance(outcome, Edit):
                self.done.emit(_shown_text(number, document))
            return

        def show_matched() -> None:
            if (document.design, document.view.snapshots) == (before[0], before[1].snapshots):
                gain = self._gain(number)
                outcome = edits.show_snapshot(document.design, document.view, number, gain)
                document.apply(outcome, self._showing)
                matched = match_text(gain)
                if isinstance(outcome, Edit) and matched:
                    self.done.emit(f"{_named(number)} is shown {matched}. {_AS_STORED}")
                elif isinstance(outcome, Edit) and outcome.design != before[0]:
                    self.done.emit(_shown_text(number, document))

        self._when_complete = show_matched
        self._ask()

    def _snapshots(self) -> tuple[Snapshot, ...]:
        """Return all snapshots, and the present design where it is none of them."""
        return with_edited(self._document.view.snapshots, self._document.design)

    def _follow(self) -> None:
        visible = [panel for panel in self._panels if panel.compares and panel.isVisible()]
        needed = {panel: panel.needs_of_snapshots for panel in visible}
        self._needs = {panel: needs for panel, needs in needed.items() if needs}
        if not (self._needs or self._when_complete or self._requests):
            return  # removed snapshots are forgotten once a panel compares again
        numbers = {snapshot.number for snapshot in self._snapshots()}
        for number in self._known.keys() - numbers - {_PRESENT}:
            del self._known[number]
        wanted = numbers if self._needs or self._when_complete else set()
        for number in self._requests.keys() - wanted:
            del self._requests[number]
            self._engine.release(_comparison_slot(number))
        if wanted:
            self._ask()
            self._tell()

    def _ask(self) -> None:
        """Request what is not known yet; once all is known, call what waits for it."""
        if not (self._when_complete or self._needs):
            return
        wanted = _LEVELS.union(*self._needs.values())
        complete = True
        for snapshot in self._snapshots():
            if self._lookup(snapshot, wanted) is not None:
                continue
            view = self._document.view
            sources = sources_of_levels(
                snapshot.design, view, with_outputs=bool(wanted & OF_OUTPUTS)
            )
            if problem_text := too_large(snapshot.design.limb):
                self._known[snapshot.number] = _known(sources, problem_text)
                continue
            complete = False
            if snapshot.design is self._document.design and self._engine.busy:
                continue  # the window is about to show it
            request = Request(wanted, sources, slot=_comparison_slot(snapshot.number))
            if self._requests.get(snapshot.number) != request:
                self._requests[snapshot.number] = request
                self._engine.request(request)
        if complete and self._when_complete is not None:
            then, self._when_complete = self._when_complete, None
            then()

    def _lookup(self, snapshot: Snapshot, wanted: frozenset[str]) -> _Known | None:
        """Return what is known of a snapshot as it was stored; None where something is missing."""
        view = self._document.view
        key = key_of_levels(sources_of_levels(snapshot.design, view))
        outputs = view.outputs if wanted & OF_OUTPUTS else None
        for number in (snapshot.number, *self._known):
            known = self._known.get(number)
            if known is None or known.key != key or outputs not in (None, known.outputs):
                continue
            if known.holds(wanted):
                self._known[snapshot.number] = known
                return known
        return None

    def _note(self, outcome: Outcome) -> None:
        request = outcome.request
        number = next((n for n, pending in self._requests.items() if pending is request), None)
        if request.place == (FIRST_SLOT, Purpose.SHOW) and outcome.values is not None:
            number = _PRESENT
        if number is None:
            return
        result = fault_text(outcome.error) if outcome.values is None else outcome.values
        self._known[number] = _known(request.given, result)
        self._ask()
        self._tell()

    def _tell(self) -> None:
        for panel, needs in self._needs.items():
            panel.show_snapshots(self._compared(_LEVELS | needs))

    def _compared(self, wanted: frozenset[str]) -> tuple[Compared, ...]:
        """Return every snapshot, with values where all that is ``wanted`` is known."""
        compared = []
        matched = self._document.shown_view.levels_matched
        for snapshot in sorted(self._snapshots(), key=lambda snapshot: snapshot.number):
            known = self._lookup(snapshot, wanted)
            compared.append(
                Compared(
                    snapshot=snapshot,
                    values=known.values if known else None,
                    problem=known.problem if known else "",
                    gain=self._gain(snapshot.number) if matched else 1.0,
                )
            )
        return tuple(compared)

    def _gain(self, number: int) -> float:
        """Return the factor with which a snapshot is as loud as the reference."""
        snapshots = self._snapshots()
        this = next((snapshot for snapshot in snapshots if snapshot.number == number), None)
        own_db, other_db = (
            self._loudest_db(snapshot) for snapshot in (this, reference_snapshot(snapshots))
        )
        return 1.0 if own_db is None or other_db is None else matching_gain(own_db, other_db)

    def _loudest_db(self, snapshot: Snapshot | None) -> float | None:
        known = None if snapshot is None else self._lookup(snapshot, _LEVELS)
        return (
            None
            if known is None or known.values is None
            else loudest_db(known.values["output_levels_db"])
        )


def _shown_text(number: int, document: Document) -> str:
    """Return the text on which snapshot is shown now, and on the way back."""
    text = f"{_named(number)} is shown"
    other = other_snapshot(document.view.snapshots, document.design)
    return text if other is None else f"{text}; X shows {snapshot_name(other.number)}"


def _named(number: int) -> str:
    name = snapshot_name(number)
    return f"{name[:1].upper()}{name[1:]}"


def _known(sources: Mapping[str, Any], result: Mapping[str, Any] | str) -> _Known:
    return _Known(key_of_levels(sources), sources["outputs"], result)


def _comparison_slot(number: int) -> Slot:
    return Slot(f"snapshot {number}")


_WANTED = frozenset({"limb_data", "validity"})
_OTHERS = Slot("judged beside")


class Judging:
    """Waits until designs are judged; what is known of the design in the window is used again."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def judge(self, label: str, sources: Mapping[str, Any], *, present: bool) -> Judged:
        """Wait until a design is judged, and return the findings; none where it has no prediction.

        Parameters
        ----------
        label
            Name of the design.
        sources
            The sources of evaluation.
        present
            Whether this is the design in the window.
        """
        slot = FIRST_SLOT if present else _OTHERS
        request = Request(_WANTED, sources, purpose=Purpose.EXPORT, slot=slot)
        outcome = self._outcome(request)
        if not present:
            self._engine.release(slot)
        values = None if outcome is None else outcome.values
        if values is None:
            return Judged(label=label)
        return Judged(label=label, note=values["limb_data"].note, findings=values["validity"])

    def _outcome(self, request: Request) -> Outcome | None:
        """Return the outcome of a request; None where the engine was closed before."""
        loop, outcomes = QEventLoop(), list[Outcome]()

        def note(outcome: Outcome) -> None:
            if outcome.request is request:
                outcomes.append(outcome)
                loop.quit()

        self._engine.finished.connect(note)
        self._engine.rested.connect(loop.quit)
        self._engine.request(request)
        while not outcomes and self._engine.busy:
            loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
        self._engine.finished.disconnect(note)
        self._engine.rested.disconnect(loop.quit)
        return outcomes[0] if outcomes else None
