"""The present design on several limbs, predicted while somebody looks."""

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
    name_of,
    other_than,
    reference,
    shown,
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
    Engine,
    Outcome,
    Purpose,
    Request,
    Slot,
    key_of_levels,
    on_limb,
    reason_of,
    sources_of_levels,
    too_large,
)
from skinsource_gui.state.panel import Panel, PanelRegistry


class OnLimbs(QObject):
    """Has the engine predict the design on each limb that is wanted, in slots of their own.

    Of the limb in the window its results are taken where they hold what is wanted.

    Parameters
    ----------
    document, engine
        Whose design, and who predicts.
    panels
        Those that name limbs are told of them, while they are visible.
    """

    def __init__(self, document: Document, engine: Engine, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        self._asked: dict[str, Request] = {}
        self._found: dict[str, Outcome] = {}

    def begin(self) -> None:
        """Follow the document, after those who show it in the window."""
        self._document.changed.connect(self._follow)
        self._engine.finished.connect(self._note)
        self._engine.rested.connect(self._ask)
        self._panels.each(lambda panel: panel.visibility_changed.connect(self._follow))

    def forget_problems(self) -> None:
        """Try again what could not be predicted: limbs came or went."""
        for limb in [name for name, outcome in self._found.items() if outcome.values is None]:
            del self._found[limb]
            self._asked.pop(limb, None)

    def _follow(self) -> None:
        wanted = self._wanted()
        for limb in self._asked.keys() - wanted.keys():
            del self._asked[limb]
            self._engine.release(_slot(limb))
        for limb in self._found.keys() - wanted.keys():
            del self._found[limb]
        if wanted:
            self._ask()
            self._tell()

    def _looking(self) -> list[Panel]:
        return [panel for panel in self._panels if panel.isVisible() and panel.needs_on_limbs]

    def _wanted(self) -> dict[str, frozenset[str]]:
        """What is wanted on each limb."""
        wanted: dict[str, frozenset[str]] = {}
        for panel in self._looking():
            for limb, needs in panel.needs_on_limbs.items():
                wanted[limb] = wanted.get(limb, frozenset({UNPLAYABLE})) | needs
        return wanted

    def _ask(self) -> None:
        """Ask for what is not known of the present design."""
        for limb, needs in self._wanted().items():
            on_limb_ = self._asked_of(limb)
            if isinstance(on_limb_, str):
                continue
            sources = self._sources(on_limb_)
            if self._is_known(limb, needs, sources):
                continue
            if limb == self._document.design.limb and self._engine.busy:
                continue  # the window is about to show it
            request = Request(needs, sources, slot=_slot(limb))
            if self._asked.get(limb) != request:
                self._asked[limb] = request
                self._engine.request(request)

    def _asked_of(self, limb: str) -> tuple[Design, View] | str:
        """The design on a limb and how it is looked at there; or why there is no such thing."""
        asked = on_limb(self._document.design, self._document.view, limb)
        return asked if isinstance(asked, str) else too_large(limb) or asked

    def _sources(self, asked: tuple[Design, View]) -> dict[str, Any]:
        """What evaluation starts from; as loud as the design is shown in the window."""
        document = self._document
        return sources_of_levels(*asked, match_gain=document.seen.match_gain(document.design))

    def _is_known(self, limb: str, needs: frozenset[str], sources: dict[str, Any]) -> bool:
        outcome = self._found.get(limb)
        if outcome is None or key_of_levels(outcome.request.given) != key_of_levels(sources):
            return False
        return outcome.values is None or needs <= outcome.values.keys()

    def _note(self, outcome: Outcome) -> None:
        request = outcome.request
        limb = request.given["limb"]
        needs = self._wanted().get(limb)
        if needs is None:
            return
        of_window = request.place == (FIRST_SLOT, Purpose.SHOW)
        known = set() if outcome.values is None else outcome.values.keys()
        if request.slot != _slot(limb) and not (of_window and needs <= known):
            return
        self._found[limb] = outcome
        self._tell()

    def _tell(self) -> None:
        wanted = self._wanted()
        compared = {limb: self._compared(limb, needs) for limb, needs in wanted.items()}
        for panel in self._looking():
            panel.show_on_limbs([compared[limb] for limb in panel.needs_on_limbs])

    def _compared(self, limb: str, needs: frozenset[str]) -> Compared:
        asked = self._asked_of(limb)
        if isinstance(asked, str):
            # It has the name, so that one sees of which limb this is said.
            named = replace(self._document.design, limb=limb, limb_digest="")
            return Compared(snapshot=Snapshot(design=named), problem=asked)
        snapshot = Snapshot(design=asked[0])
        outcome = self._found.get(limb)
        if outcome is None or not (outcome.values is None or needs <= outcome.values.keys()):
            return Compared(snapshot=snapshot, axes=asked[1].axes)
        stale = not self._is_known(limb, needs, self._sources(asked))
        problem = "" if outcome.values is not None or stale else reason_of(outcome.error)
        return Compared(
            snapshot=snapshot,
            values=outcome.values,
            problem=problem,
            axes=asked[1].axes,
            late=stale,
        )


def _slot(limb: str) -> Slot:
    return Slot(f"limb {limb}")


# A snapshot that is shown as loud as another one stays so.


class StayingMatched(QObject):
    """Has the snapshot in the window shown anew where what its gain follows from has changed.

    Parameters
    ----------
    document
        Whose snapshots; also the parent.
    show
        Shows a number, as loud as the others.
    """

    def __init__(self, document: Document, show: Callable[[int], None]) -> None:
        super().__init__(document)
        self._document, self._show = document, show
        self._seen = self._follows_from()
        document.settled.connect(self._follow)
        # What is opened is shown with the gain that it was left with.
        document.jumped.connect(self._look)

    def _follows_from(self) -> tuple[Any, ...]:
        view = self._document.view
        designs = {snapshot.number: snapshot.design for snapshot in view.snapshots}
        return view.levels_matched, view.axes, view.method, view.span, designs

    def _look(self) -> None:
        self._seen = self._follows_from()

    def _follow(self) -> None:
        before, self._seen = self._seen, self._follows_from()
        view = self._document.view
        if before == self._seen or not view.levels_matched:
            return
        held = shown(view.snapshots, self._document.design)
        just_switched_on = not before[0]
        # What was stored and not shown since is as it was edited.
        if held is not None and (just_switched_on or held.gain != 1.0):
            self._show(held.number)


# Snapshots of the design: stored, shown in turn, and predicted side by side.

_LEVELS = frozenset({"output_levels_db", UNPLAYABLE})
_AS_STORED = "Edit > Match levels of snapshots, switched off, shows it as stored"
# Number under which the results of the window are remembered.
_PRESENT = -1


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """What was predicted, or why it could not be.

    ``key`` is what levels depend on, ``outputs`` are those of which it has traces.
    """

    key: tuple[Any, ...]
    outputs: tuple[int, ...]
    found: Mapping[str, Any] | str

    @property
    def values(self) -> Mapping[str, Any] | None:
        return None if isinstance(self.found, str) else self.found

    @property
    def problem(self) -> str:
        return self.found if isinstance(self.found, str) else ""

    def holds(self, wanted: frozenset[str]) -> bool:
        """Whether nothing of ``wanted`` is missing."""
        return isinstance(self.found, str) or wanted <= self.found.keys()


class Comparison(QObject):
    """Has the engine predict each snapshot in a slot of its own, while somebody wants to know.

    Parameters
    ----------
    document, engine
        Whose snapshots, and who predicts; the document is also the parent.
    panels
        Of which those that compare are told.
    """

    #: What was done, in a few words.
    done = Signal(str)

    def __init__(self, document: Document, engine: Engine, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        self._on_limbs = OnLimbs(document, engine, panels)
        self._asked: dict[int, Request] = {}
        self._known: dict[int, _Known] = {}
        self._then: Callable[[], None] | None = None
        # However often one goes to and fro, the history has one step, or none once all is as it
        # was before.
        self._going = new_gesture()

    def begin(self) -> None:
        """Follow the document, after those who show it in the window: they ask for that."""
        self._document.changed.connect(self._follow)
        self._on_limbs.begin()
        self._engine.finished.connect(self._note)
        self._engine.rested.connect(self._ask)
        self._panels.each(lambda panel: panel.visibility_changed.connect(self._follow))
        self._panels.each(lambda panel: panel.snapshot_wanted.connect(self.show))
        StayingMatched(self._document, self.show)

    def store(self, number: str) -> None:
        """Keep the present design under a number."""
        document = self._document
        steps = document.undo_stack.index()
        document.apply(edits.store_snapshot(document.design, document.view, int(number)))
        replaced = " in place of another, which Undo brings back"
        replacement = replaced if document.undo_stack.index() > steps else ""
        other = other_than(document.view.snapshots, document.design)
        ways = "change the design, and X goes to and fro"
        if other is not None:
            ways = f"X shows {name_of(other.number)}, and this again"
        self.done.emit(f"Stored snapshot {number}{replacement}; {ways}")

    def forget_problems(self) -> None:
        """Try again what could not be predicted: limbs came or went."""
        for number in [n for n, known in self._known.items() if known.problem]:
            del self._known[number]
            self._asked.pop(number, None)
        self._on_limbs.forget_problems()

    def toggle(self) -> None:
        """Show the other one of the last two that were shown."""
        document = self._document
        other = other_than(document.view.snapshots, document.design)
        if other is None:
            document.apply(Refusal(sentence=why_no_comparison(document.view.snapshots)))
        else:
            self.show(other.number)

    def show(self, number: int) -> None:
        """Put a snapshot in place of the design, as loud as the others where that is wanted."""
        document = self._document
        before = document.design, document.view
        if not document.view.levels_matched:
            outcome = edits.show_snapshot(*before, number)
            document.apply(outcome, self._going)
            if isinstance(outcome, Edit):
                self.done.emit(_shown_words(number, document))
            return

        def show_matched() -> None:
            if (document.design, document.view.snapshots) == (before[0], before[1].snapshots):
                gain = self._gain(number)
                outcome = edits.show_snapshot(document.design, document.view, number, gain)
                document.apply(outcome, self._going)
                matched = match_text(gain)
                if isinstance(outcome, Edit) and matched:
                    self.done.emit(f"{_named(number)} is shown {matched}. {_AS_STORED}")
                elif isinstance(outcome, Edit) and outcome.design != before[0]:
                    self.done.emit(_shown_words(number, document))

        self._then = show_matched
        self._ask()

    def _together(self) -> tuple[Snapshot, ...]:
        """All snapshots, and the present design as what is edited if it is none of them."""
        return with_edited(self._document.view.snapshots, self._document.design)

    def _follow(self) -> None:
        if not (self._visible() or self._then or self._asked):
            return  # what is gone is forgotten once somebody looks again
        numbers = {snapshot.number for snapshot in self._together()}
        for number in self._known.keys() - numbers - {_PRESENT}:
            del self._known[number]
        wanted = numbers if self._visible() or self._then else set()
        for number in self._asked.keys() - wanted:
            del self._asked[number]
            self._engine.release(_comparison_slot(number))
        if wanted:
            self._ask()
            self._tell()

    def _visible(self) -> list[Panel]:
        """Panels that want to know of snapshots now."""
        return [
            snapshot
            for snapshot in self._panels
            if snapshot.isVisible() and snapshot.needs_of_snapshots
        ]

    def _ask(self) -> None:
        """Have predicted what is not known yet; do what waits for it, once nothing is unknown."""
        if not (self._then or self._visible()):
            return
        wanted = _LEVELS.union(*(panel.needs_of_snapshots for panel in self._visible()))
        complete = True
        for snapshot in self._together():
            if self._found(snapshot, wanted) is not None:
                continue
            view = self._document.view
            sources = sources_of_levels(
                snapshot.design, view, with_outputs=bool(wanted & OF_OUTPUTS)
            )
            if refused := too_large(snapshot.design.limb):
                self._known[snapshot.number] = _known(sources, refused)
                continue
            complete = False
            if snapshot.design is self._document.design and self._engine.busy:
                continue  # the window is about to show it
            request = Request(wanted, sources, slot=_comparison_slot(snapshot.number))
            if self._asked.get(snapshot.number) != request:
                self._asked[snapshot.number] = request
                self._engine.request(request)
        if complete and self._then is not None:
            then, self._then = self._then, None
            then()

    def _found(self, snapshot: Snapshot, wanted: frozenset[str]) -> _Known | None:
        """What is known of a snapshot as it was stored, whoever asked for it."""
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
        number = next((n for n, pending in self._asked.items() if pending is request), None)
        if request.place == (FIRST_SLOT, Purpose.SHOW) and outcome.values is not None:
            number = _PRESENT
        if number is None:
            return
        result = reason_of(outcome.error) if outcome.values is None else outcome.values
        self._known[number] = _known(request.given, result)
        self._ask()
        self._tell()

    def _tell(self) -> None:
        for panel in self._visible():
            panel.show_snapshots(self._compared(_LEVELS | panel.needs_of_snapshots))

    def _compared(self, wanted: frozenset[str]) -> tuple[Compared, ...]:
        """Every snapshot; with values where all that is ``wanted`` is known."""
        compared = []
        matched = self._document.seen.levels_matched
        for snapshot in sorted(self._together(), key=lambda snapshot: snapshot.number):
            known = self._found(snapshot, wanted)
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
        """Factor with which a snapshot is as loud as the one that others are matched to."""
        snapshots = self._together()
        this = next((snapshot for snapshot in snapshots if snapshot.number == number), None)
        own_db, other_db = (self._loudest_db(snapshot) for snapshot in (this, reference(snapshots)))
        return 1.0 if own_db is None or other_db is None else matching_gain(own_db, other_db)

    def _loudest_db(self, snapshot: Snapshot | None) -> float | None:
        known = None if snapshot is None else self._found(snapshot, _LEVELS)
        return (
            None
            if known is None or known.values is None
            else loudest_db(known.values["output_levels_db"])
        )


def _shown_words(number: int, document: Document) -> str:
    """What is seen now, and the way back: words about what was seen before would be wrong."""
    text = f"{_named(number)} is shown"
    other = other_than(document.view.snapshots, document.design)
    return text if other is None else f"{text}; X shows {name_of(other.number)}"


def _named(number: int) -> str:
    name = name_of(number)
    return f"{name[:1].upper()}{name[1:]}"


def _known(sources: Mapping[str, Any], result: Mapping[str, Any] | str) -> _Known:
    return _Known(key_of_levels(sources), sources["outputs"], result)


def _comparison_slot(number: int) -> Slot:
    return Slot(f"snapshot {number}")


# Has designs judged while somebody waits for it: what is taken out of the studio carries it.

_WANTED = frozenset({"limb_data", "validity"})
_OTHERS = Slot("judged beside")


class Judging:
    """Judges the design in the window, and others beside it.

    Parameters
    ----------
    engine
        Who evaluates.  What it knows of the design in the window is not computed again.
    """

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def judge(self, label: str, sources: Mapping[str, Any], *, present: bool) -> Judged:
        """Wait until what follows from ``given`` is judged; a reason why it cannot be ends it too.

        Parameters
        ----------
        label
            What it is called.
        given
            What evaluation starts from.
        present
            Whether that is what the window shows.
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
        """What became of a request; None where the engine ends before."""
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
