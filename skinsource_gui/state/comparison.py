"""Predictions beside the one of the window: of snapshots, and of the design on other limbs.

Each has a slot of the engine of its own, and is computed only while a visible panel needs it.
`Judging` waits for the validity of designs that are exported.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QEventLoop, QObject, Signal

from skinsource.design import edits
from skinsource.design.comparing import (
    loudest_db,
    match_text,
    matching_gain,
    other_snapshot,
    snapshot_name,
    why_no_comparison,
    with_edited,
)
from skinsource.design.design import Snapshot, View, shown_snapshot
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.perception.validity import Judged
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.fields.grid import forget_typing
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

_LEVELS = frozenset({"output_levels_db", UNPLAYABLE})
_AS_STORED = "Switch off Edit > Match levels of snapshots to show it as stored"


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """A prediction, or why there is none.

    ``key`` is what levels depend on, ``outputs`` are those of which there are traces.
    """

    key: tuple[Any, ...]
    outputs: tuple[int, ...]
    values: Mapping[str, Any] | None
    problem: str

    def holds(self, wanted: frozenset[str]) -> bool:
        """Return whether nothing of ``wanted`` is missing."""
        return self.values is None or wanted <= self.values.keys()


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """A design beside that of the window, the view on it, and the gain with which it is predicted.

    ``compared`` has no values; it has a problem where nothing is predicted.
    """

    slot: Slot
    compared: Compared
    view: View
    match_gain: float = 1.0

    def sources(self, needs: frozenset[str]) -> dict[str, Any]:
        """Return the sources of evaluation."""
        return sources_of_levels(
            self.compared.snapshot.design,
            self.view,
            match_gain=self.match_gain,
            with_outputs=bool(needs & OF_OUTPUTS),
        )


class Comparison(QObject):
    """Stores and shows snapshots, and has the engine predict what panels compare.

    That are snapshots, and the design on other limbs or at other frequencies.  Results of the
    window are used where they hold all that is needed.
    """

    #: What was done, as a short text.
    done = Signal(str)

    def __init__(self, document: Document, engine: Engine, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        # What visible panels need of each snapshot, and of each limb, as of the last change.
        self._needs: dict[Panel, tuple[frozenset[str], Mapping[Beside, frozenset[str]]]] = {}
        # Of each slot the request that is under way or answered; None: its answer is held no more.
        self._requests: dict[Slot, Request | None] = {}
        self._known: dict[Slot, _Known] = {}
        self._when_complete: Callable[[], None] | None = None
        # Showing snapshots in turn is one step of the history, or none where all is as before.
        self._showing = new_gesture()
        self._gains_follow: tuple[Any, ...] = ()
        self._note_gains()

    def begin(self) -> None:
        """Follow the document, after the conductor of the window, which requests its results."""
        self._document.changed.connect(self._follow)
        self._engine.finished.connect(self._note)
        self._engine.rested.connect(self._ask)
        self._panels.each(lambda panel: panel.visibility_changed.connect(self._follow))
        self._panels.each(lambda panel: panel.snapshot_requested.connect(self.show))
        self._document.settled.connect(self._stay_matched)
        # An opened design is shown with the gain that it was saved with.
        self._document.jumped.connect(self._note_gains)

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
            hint = f"X shows {snapshot_name(other.number)}, View > Compare side by side all"
        self.done.emit(f"Stored snapshot {number}{replacement}; {hint}")

    def forget_problems(self) -> None:
        """Try failed predictions again: limbs came or went."""
        for slot in [slot for slot, known in self._known.items() if known.problem]:
            del self._known[slot]
            self._requests.pop(slot, None)

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
        before, matched = (document.design, document.view.snapshots), document.view.levels_matched

        def show_known() -> None:
            if (document.design, document.view.snapshots) != before:
                return
            forget_typing(*self._panels)
            gain = self._gain(number) if matched else 1.0
            outcome = edits.show_snapshot(document.design, document.view, number, gain)
            document.apply(outcome, self._showing)
            name, by = snapshot_name(number).capitalize(), match_text(gain)
            if isinstance(outcome, Edit) and by:
                self.done.emit(f"{name} is shown {by}. {_AS_STORED}")
            elif isinstance(outcome, Edit) and not (matched and outcome.design == before[0]):
                self.done.emit(_shown_text(number, document))

        if matched:
            self._when_complete = show_known
            self._ask()
        else:
            show_known()

    def _of_snapshots(self) -> list[_Side]:
        """Return all snapshots, and the present design where it is none of them."""
        # The working design comes last.
        view = self._document.view
        snapshots = with_edited(view.snapshots, self._document.design)
        order = sorted(snapshots, key=lambda each: each.number or math.inf)
        return [
            _Side(
                f"snapshot {each.number}",
                Compared(snapshot=each, problem=too_large(each.design.limb)),
                view,
            )
            for each in order
        ]

    def _of_matching(self) -> list[_Side]:
        """Return all snapshots, with levels that do not depend on how long they are silent."""
        return [
            replace(side, slot=f"match {side.slot}", view=replace(side.view, span="loudest"))
            for side in self._of_snapshots()
        ]

    def _on_limb(self, limb: Beside) -> _Side:
        """Return the design on a limb, as loud as it is shown in the window."""
        document, slot = self._document, f"limb {limb}"
        design = document.design
        asked = on_limb(design, document.view, limb)
        if isinstance(asked, str):
            # With the name of the limb, to show which limb has the problem.
            named = Snapshot(design=replace(design, limb=str(limb), limb_digest=""))
            return _Side(slot, Compared(snapshot=named, problem=asked), document.view)
        moved, view = asked
        compared = Compared(
            snapshot=Snapshot(design=moved), problem=too_large(moved.limb), axes=view.axes
        )
        return _Side(slot, compared, view, document.shown_view.match_gain(design))

    def _follow(self) -> None:
        visible = [panel for panel in self._panels if panel.compares and panel.isVisible()]
        needed = {panel: (panel.needs_of_snapshots, panel.needs_on_limbs) for panel in visible}
        self._needs = {panel: needs for panel, needs in needed.items() if any(needs)}
        if not (self._needs or self._when_complete or self._requests):
            return  # removed snapshots are forgotten once a panel compares again
        wanted = {side.slot for side, _ in self._wanted()}
        stored = self._of_snapshots() + self._of_matching()
        kept = {side.slot for side in stored} | wanted | {FIRST_SLOT}
        for slot in self._known.keys() - kept:
            del self._known[slot]
        for slot in self._requests.keys() - wanted:
            del self._requests[slot]
            self._engine.release(slot)
        if wanted:
            self._ask()
            self._tell()

    def _wanted(self) -> Iterator[tuple[_Side, frozenset[str]]]:
        """Yield what is to be predicted, and what of it."""
        of_snapshots = frozenset().union(*(needs for needs, _ in self._needs.values()))
        if of_snapshots:
            for side in self._of_snapshots():
                yield side, _LEVELS | of_snapshots
        if self._when_complete or (of_snapshots and self._document.view.levels_matched):
            for side in self._of_matching():
                yield side, _LEVELS
        on_limbs: dict[Beside, frozenset[str]] = {}
        for _, needed in self._needs.values():
            for limb, needs in needed.items():
                on_limbs[limb] = on_limbs.get(limb, frozenset({UNPLAYABLE})) | needs
        for limb, needs in on_limbs.items():
            yield self._on_limb(limb), needs

    def _ask(self) -> None:
        """Request what is not known yet; once all is known, call what waits for it."""
        complete = True
        for side, needs in self._wanted():
            if side.compared.problem or self._lookup(side, needs) is not None:
                continue
            complete = False
            if side.compared.snapshot.design is self._document.design and self._engine.busy:
                continue  # the window is about to show it
            request = Request(needs, side.sources(needs), slot=side.slot)
            if self._requests.get(side.slot) != request:
                self._requests[side.slot] = request
                self._engine.request(request)
        if complete and self._when_complete is not None:
            then, self._when_complete = self._when_complete, None
            then()

    def _lookup(self, side: _Side, needs: frozenset[str]) -> _Known | None:
        """Return what is known of a design as it is now; None where something is missing."""
        key = key_of_levels(side.sources(needs))
        outputs = side.view.outputs if needs & OF_OUTPUTS else None
        for slot in (side.slot, *self._known):
            known = self._known.get(slot)
            if known is None or known.key != key or outputs not in (None, known.outputs):
                continue
            if known.holds(needs):
                self._known[side.slot] = known
                if slot != side.slot and side.slot in self._requests:
                    self._requests[side.slot] = None
                return known
        return None

    def _note(self, outcome: Outcome) -> None:
        request = outcome.request
        of_window = request.place == (FIRST_SLOT, Purpose.SHOW) and outcome.values is not None
        if not (of_window or request.slot in self._requests):
            return
        given, problem = request.given, "" if outcome.values else fault_text(outcome.error)
        known = _Known(key_of_levels(given), given["outputs"], outcome.values, problem)
        self._known[request.slot] = known
        self._ask()
        self._tell()

    def _tell(self) -> None:
        matched = self._document.shown_view.levels_matched
        for panel, (of_snapshots, on_limbs) in self._needs.items():
            if of_snapshots:
                gain = self._gain if matched else lambda _number: 1.0
                panel.show_snapshots(
                    [
                        replace(
                            self._filled(side, _LEVELS | of_snapshots),
                            gain=gain(side.compared.snapshot.number),
                        )
                        for side in self._of_snapshots()
                    ]
                )
            if on_limbs:
                sides = ((self._on_limb(limb), needs) for limb, needs in on_limbs.items())
                panel.show_on_limbs([self._filled(*each, or_before=True) for each in sides])

    def _filled(self, side: _Side, needs: frozenset[str], *, or_before: bool = False) -> Compared:
        """Return a design with what is known of it, ``or_before``: or was before a change."""
        if side.compared.problem:
            return side.compared
        known = self._lookup(side, needs)
        shown = known or (self._known.get(side.slot) if or_before else None)
        if shown is None or not shown.holds(needs):
            return side.compared
        return replace(
            side.compared,
            values=shown.values,
            problem=known.problem if known else "",
            is_stale=known is None,
        )

    def _note_gains(self) -> None:
        """Note all that the gains of snapshots follow from."""
        view = self._document.view
        designs = {snapshot.number: snapshot.design for snapshot in view.snapshots}
        self._gains_follow = view.levels_matched, view.axes, view.method, designs

    def _stay_matched(self) -> None:
        """Show the snapshot in the window anew where its gain has changed."""
        before, view = self._gains_follow, self._document.view
        self._note_gains()
        if before == self._gains_follow or not view.levels_matched:
            return
        stored = shown_snapshot(view.snapshots, self._document.design)
        just_switched_on = not before[0]
        # A snapshot that was not shown since it was stored has no gain.
        if stored is not None and (just_switched_on or stored.gain != 1.0):
            self.show(stored.number)

    def _gain(self, number: int) -> float:
        """Return the factor with which a snapshot is as loud as that of the lowest number."""
        sides = {side.compared.snapshot.number: side for side in self._of_matching()}
        own_db = self._loudest_db(sides.get(number))
        other_db = self._loudest_db(sides.get(min(sides)))
        return 1.0 if own_db is None or other_db is None else matching_gain(own_db, other_db)

    def _loudest_db(self, side: _Side | None) -> float | None:
        # During an edit the levels from before it count.
        known = side and (self._lookup(side, _LEVELS) or self._known.get(side.slot))
        values = known.values if known else None
        return None if values is None else loudest_db(values["output_levels_db"])


def _shown_text(number: int, document: Document) -> str:
    """Return the text on which snapshot is shown now, and on the way back."""
    text = f"{snapshot_name(number).capitalize()} is shown"
    other = other_snapshot(document.view.snapshots, document.design)
    return text if other is None else f"{text}; X shows {snapshot_name(other.number)}"


_WANTED = frozenset({"limb_data", "validity"})
_OTHERS = "judged beside"


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
