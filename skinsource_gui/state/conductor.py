"""Keeps the visible panels in step with the document."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.design import edits
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import (
    FIRST_SLOT,
    FROM_THE_LIMB,
    Engine,
    Outcome,
    Purpose,
    Request,
    reason_of,
    sources_shown,
    too_large,
)
from skinsource_gui.state.panel import Panel, PanelRegistry

#: Inputs that results are without: panels are told of them, whatever else they need.
UNPLAYABLE = "unplayable_inputs"
#: An edit waits so long for its results, a frame of most screens: the worker is quicker when it
#: has the interpreter to itself, and both are painted together.
WAIT_FOR_RESULTS_S = 0.016


class Conductor(QObject):
    """Tells visible panels the state, asks the engine for what they need, and hands it to them.

    Those that are hidden are told nothing: they take over all of it when they come into sight.

    Parameters
    ----------
    document, engine, panels
        Whose design, who evaluates, and who draws.
    also
        Quantities that come with whatever panels need.
    """

    #: The reason, when what is wanted cannot be computed.
    failed = Signal(str)
    #: The `Outcome` that the panels now show.
    delivered = Signal(object)
    #: Whether what the panels show is older than the design.
    stale = Signal(bool)

    def __init__(
        self,
        document: Document,
        engine: Engine,
        panels: PanelRegistry,
        also: frozenset[str] = frozenset(),
    ):
        super().__init__(document)
        self._document, self._engine, self._panels = document, engine, panels
        self._also = also
        self._asked: Request | None = None
        self._awaited = False
        self._shown: dict[Panel, tuple[Any, ...]] = {}
        # What they needed, and the values it was computed from.
        self._answered: dict[Panel, tuple[frozenset[str], Mapping[str, Any]]] = {}
        # Panels whose next results have nothing to do with what they show.
        self._anew: set[Panel] = set()
        # Those whose needs take too long on the limb of the document.
        self._refused: list[Panel] = []
        # Those that know the present state.
        self._told: set[Panel] = set()
        document.jumped.connect(self._begin_anew)
        document.changed.connect(self._follow)
        document.settled.connect(self._wait_for_results)
        document.playhead_moved.connect(self._follow_playhead)
        engine.finished.connect(self._deliver)
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.visibility_changed.connect(partial(self._note_visibility, panel))
        self._tell(panel)

    def _tell(self, panel: Panel) -> None:
        self._told.add(panel)
        panel.show_state(self._document.design, self._document.seen)

    def _note_visibility(self, panel: Panel) -> None:
        if panel.isVisible() and panel not in self._told:
            self._tell(panel)
        self._ask()

    def _follow(self) -> None:
        since_s = perf_counter()
        for panel in self._panels:
            if panel.isVisibleTo(panel.window()):
                self._tell(panel)
            else:
                self._told.discard(panel)
        self._ask(since_s)

    def _wait_for_results(self) -> None:
        """Let results that are quick be there before anything is painted."""
        awaited, self._awaited = self._awaited, False
        if awaited:
            self._engine.wait(WAIT_FOR_RESULTS_S)

    def _follow_playhead(self) -> None:
        for panel in self._panels:
            if panel.isVisible():
                panel.show_playhead(self._document.seen)
            else:
                self._told.discard(panel)

    def _begin_anew(self) -> None:
        self._anew.update(self._panels)

    def _ask(self, since_s: float | None = None) -> None:
        """Ask for what is not known yet."""
        visible = [panel for panel in self._panels if panel.isVisible()]
        for panel in self._panels:
            if panel not in visible:
                self._shown.pop(panel, None)
        if not any(panel.needs for panel in visible):
            return
        visible = self._without_refused(visible)
        given = sources_shown(self._document.design, self._document.seen)
        wanted = self._also.union(*(panel.needs for panel in visible))
        if not wanted:
            return
        request = Request(
            wanted | {UNPLAYABLE}, given, perf_counter() if since_s is None else since_s
        )
        behind = any(panel.needs and panel not in self._shown for panel in visible)
        if self._asked == request and not behind:
            return
        self._asked = request
        for panel in visible:
            if panel.needs:
                panel.show_stale(self._is_stale(panel))
        self.stale.emit(True)
        self._engine.request(request)
        self._awaited = True

    def _without_refused(self, visible: list[Panel]) -> list[Panel]:
        """Those that can be shown what they need; the others are told why not."""
        reason = too_large(self._document.design.limb)
        self._refused = [
            panel
            for panel in visible
            if reason and FROM_THE_LIMB & self._engine.upstream_of(panel.needs)
        ]
        self._explain(self._refused, reason)
        return [panel for panel in visible if panel not in self._refused]

    def _is_stale(self, panel: Panel) -> bool:
        """Whether what a panel shows would be computed from something else now."""
        if self._asked is None or panel not in self._answered:
            return True
        needs, then = self._answered[panel]
        now = self._asked.given
        return needs != panel.needs or any(
            then[name] != now[name] for name in self._engine.upstream_of(needs) & now.keys()
        )

    def _deliver(self, outcome: Outcome) -> None:
        if outcome.request.place != (FIRST_SLOT, Purpose.SHOW):
            return
        visible = [panel for panel in self._panels if panel.isVisible() and panel.needs]
        visible = [panel for panel in visible if panel not in self._refused]
        for panel in visible:
            panel.show_unplayable(outcome.values[UNPLAYABLE] if outcome.values else ())
        if outcome.values is None:
            reason = _reason(outcome.error)
            self._explain(visible, reason)
            self.failed.emit(reason)
            self.stale.emit(outcome.request is not self._asked)
            return
        faults = [
            fault
            for panel in visible
            if panel.needs <= outcome.values.keys()
            and (fault := self._show_or_explain(panel, outcome, outcome.values)) is not None
        ]
        self.delivered.emit(outcome)
        self.stale.emit(outcome.request is not self._asked)
        for fault in faults:
            # The others show theirs; whoever looks for mistakes hears of this one.
            raise fault

    def _show_or_explain(
        self, panel: Panel, outcome: Outcome, values: Mapping[str, Any]
    ) -> Exception | None:
        """Let a panel show its results; where it makes a mistake it says so, until the next."""
        fault: Exception | None = None
        try:
            self._show(panel, values)
        except Exception as error:  # noqa: BLE001  it would be stale for good
            fault = error
            self._shown.pop(panel, None)
            panel.show_problem(f"This panel cannot show it. {_reason(error)}")
        self._answered[panel] = panel.needs, outcome.request.given
        if outcome.request is self._asked:
            self._anew.discard(panel)
        stale = fault is None and self._is_stale(panel)
        panel.show_stale(stale)
        if stale:
            panel.show_newer()
        return fault

    def _show(self, panel: Panel, values: Mapping[str, Any]) -> None:
        # What has not changed is not drawn again.
        held = tuple(values[name] for name in sorted(panel.needs))
        before = self._shown.get(panel, ())
        if len(held) != len(before) or any(a is not b for a, b in zip(held, before, strict=True)):
            if panel in self._anew:
                panel.begin_anew()
            panel.show_results(values)
            self._shown[panel] = held

    def _explain(self, visible: list[Panel], reason: str) -> None:
        for panel in visible:
            self._shown.pop(panel, None)
            self._answered.pop(panel, None)
            panel.show_problem(reason)
            panel.show_stale(False)


def _reason(error: Exception | None) -> str:
    reason = reason_of(error)
    if isinstance(error, SkinSourceError):
        return reason
    return f"{reason}. Undo the last edit, or choose something else; please report this."


# What panels want of the document.


class PanelController(QObject):
    """Has the document do what panels want, and tells each where another one points.

    Parameters
    ----------
    document
        Whose design is edited; also the parent.
    panels
        Those who want something.
    """

    def __init__(self, document: Document, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._panels = document, panels
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.edited.connect(self._apply)
        panel.view_changed.connect(self._look)
        panel.playhead_wanted.connect(self._put_playhead)
        panel.input_pointed_at.connect(self._point_at)

    def _apply(self, outcome: Edit | Refusal, gesture: int | None) -> None:
        if isinstance(outcome, Edit):
            outcome = replace(outcome, view=self._with_playhead(outcome.view))
        self._document.apply(outcome, gesture)

    def _look(self, view: View) -> None:
        self._document.look(self._with_playhead(view))

    def _put_playhead(self, time_s: float) -> None:
        outcome = edits.move_playhead(self._document.design, self._document.view, time_s)
        self._document.apply(outcome)

    def _point_at(self, input_id: int | None) -> None:
        for panel in self._panels:
            if panel is not self.sender():
                panel.show_pointed_input(input_id)

    def _with_playhead(self, view: View) -> View:
        # While it moves, most panels know where it was, not where it is.
        playhead_s = self._document.view.playhead_s
        return view if view.playhead_s == playhead_s else replace(view, playhead_s=playhead_s)
