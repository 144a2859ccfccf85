"""Keeps the visible panels in step with the document, and the document with what panels want."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.design import edits
from skinsource.design.design import View
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.signal_path import UnplayableInput
from skinsource_gui.fields.grid import forget_typing
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import (
    FIRST_SLOT,
    FROM_THE_LIMB,
    Engine,
    Outcome,
    Purpose,
    Request,
    sources_shown,
    too_large,
)
from skinsource_gui.state.panel import Panel, PanelRegistry
from skinsource_gui.state.worker import fault_text

#: Inputs that results are without: panels are told of them, whatever else they need.
UNPLAYABLE = "unplayable_inputs"
#: An edit waits so long for its results, a frame of most screens: the worker is quicker when it
#: has the interpreter to itself, and both are painted together.
WAIT_FOR_RESULTS_S = 0.016


class Conductor(QObject):
    """Shows visible panels the state, and requests and delivers the results that they need.

    Hidden panels are shown nothing until they come into sight.
    """

    #: Why the results cannot be computed.
    failed = Signal(str)
    #: The `Outcome` that the panels now show.
    delivered = Signal(object)
    #: Whether what the panels show is older than the design.
    stale = Signal(bool)

    def __init__(self, document: Document, engine: Engine, panels: PanelRegistry):
        super().__init__(document)
        self._document, self._engine, self._panels = document, engine, panels
        self._request: Request | None = None
        self._awaited = False
        self._shown: dict[Panel, tuple[Any, ...]] = {}
        # The needs of each panel, and the sources of its results.
        self._delivered_to: dict[Panel, tuple[frozenset[str], Mapping[str, Any]]] = {}
        # Panels whose next results do not continue what they show.
        self._restarting: set[Panel] = set()
        # What the visible panels need, as of the last change; those left out whose needs take too
        # long on the limb of the document.
        self._needs: dict[Panel, frozenset[str]] = {}
        self._unplayable: dict[Panel, tuple[UnplayableInput, ...]] = {}
        # Panels that know the present state.
        self._informed: set[Panel] = set()
        document.jumped.connect(self._note_jump)
        document.changed.connect(self._follow)
        document.refused.connect(self._follow)
        document.settled.connect(self._wait_for_results)
        document.playhead_moved.connect(self._follow_playhead)
        engine.finished.connect(self._deliver)
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.visibility_changed.connect(partial(self._note_visibility, panel))
        self._tell(panel)

    def _tell(self, panel: Panel) -> None:
        self._informed.add(panel)
        panel.show_state(self._document.design, self._document.shown_view)

    def _note_visibility(self, panel: Panel) -> None:
        if panel.isVisible() and panel not in self._informed:
            self._tell(panel)
        self._request_results()

    def _follow(self) -> None:
        since_s = perf_counter()
        informed = {panel for panel in self._panels if panel.isVisibleTo(panel.window())}
        self._informed = informed
        design, view = self._document.design, self._document.shown_view
        for panel in self._panels:
            if panel in informed:
                panel.show_state(design, view)
            if self._informed is not informed:
                # What was being typed in this panel is a later state: all know that one.
                return
        self._request_results(since_s)

    def _wait_for_results(self) -> None:
        """Wait a moment for quick results, so that they are painted with the edit."""
        awaited, self._awaited = self._awaited, False
        if awaited:
            self._engine.wait(WAIT_FOR_RESULTS_S)

    def _follow_playhead(self) -> None:
        for panel in self._panels:
            if panel.isVisible():
                panel.show_playhead(self._document.shown_view)
            else:
                self._informed.discard(panel)

    def _note_jump(self) -> None:
        self._restarting.update(self._panels)
        forget_typing(*self._panels)
        # Steps of the history jump too.
        if not self._document.undo_stack.count():
            for panel in self._panels:
                panel.start_over()

    def _request_results(self, since_s: float | None = None) -> None:
        """Request the results that are not known yet."""
        needs = {panel: panel.needs for panel in self._panels if panel.isVisible()}
        for panel in self._shown.keys() - needs.keys():
            del self._shown[panel]
        self._needs = {panel: names for panel, names in needs.items() if names}
        if not self._needs:
            return
        document = self._document
        self._leave_out_too_large(document.design.limb)
        wanted = frozenset().union(*self._needs.values())
        if not wanted:
            return
        request = Request(
            wanted | {UNPLAYABLE},
            sources_shown(document.design, document.shown_view),
            perf_counter() if since_s is None else since_s,
        )
        # A panel that needs something else than before is shown it even where it is known.
        shown = all(
            panel in self._shown and self._delivered_to.get(panel, ((), {}))[0] == needs
            for panel, needs in self._needs.items()
        )
        if self._request == request and shown:
            return
        self._request = request
        for panel in self._needs:
            panel.show_stale(self._is_stale(panel))
        self.stale.emit(True)
        self._engine.request(request)
        self._awaited = True

    def _leave_out_too_large(self, limb: str) -> None:
        """Leave out the panels whose needs cannot be computed; they show why not."""
        reason = too_large(limb)
        if reason:
            left_out = [
                panel
                for panel, needs in self._needs.items()
                if FROM_THE_LIMB & self._engine.upstream_of(needs)
            ]
            self._explain(left_out, reason)
            for panel in left_out:
                del self._needs[panel]

    def _is_stale(self, panel: Panel) -> bool:
        """Return whether the results of a panel would have other sources now."""
        if self._request is None or panel not in self._delivered_to:
            return True
        needs, then = self._delivered_to[panel]
        now = self._request.given
        return needs != self._needs.get(panel) or any(
            then[name] != now[name] for name in self._engine.upstream_of(needs) & now.keys()
        )

    def _deliver(self, outcome: Outcome) -> None:
        if outcome.request.place != (FIRST_SLOT, Purpose.SHOW):
            return
        newest = outcome.request is self._request
        unplayable = outcome.values[UNPLAYABLE] if outcome.values else ()
        for panel in self._needs:
            if self._unplayable.get(panel) != unplayable:
                self._unplayable[panel] = unplayable
                panel.show_unplayable(unplayable)
        if outcome.values is None:
            reason = fault_text(outcome.error)
            self._explain(self._needs, reason)
            self.failed.emit(reason)
            self.stale.emit(not newest)
            return
        faults = [
            fault
            for panel, needs in self._needs.items()
            if needs <= outcome.values.keys()
            and (fault := self._show_or_explain(panel, needs, outcome, outcome.values)) is not None
        ]
        self.delivered.emit(outcome)
        self.stale.emit(not newest)
        for fault in faults:
            # The other panels show their results; the fault is still reported.
            raise fault

    def _show_or_explain(
        self, panel: Panel, needs: frozenset[str], outcome: Outcome, values: Mapping[str, Any]
    ) -> Exception | None:
        """Have a panel show its results; after an exception it shows that, and returns it."""
        fault: Exception | None = None
        try:
            self._show(panel, needs, values)
        except Exception as error:  # noqa: BLE001  it would be stale for good
            fault = error
            self._shown.pop(panel, None)
            panel.show_problem(f"This panel cannot show it. {fault_text(error)}")
        self._delivered_to[panel] = needs, outcome.request.given
        if outcome.request is self._request:
            self._restarting.discard(panel)
            stale = False
        else:
            stale = fault is None and self._is_stale(panel)
        panel.show_stale(stale)
        if stale:
            panel.show_newer()
        return fault

    def _show(self, panel: Panel, needs: frozenset[str], values: Mapping[str, Any]) -> None:
        # Results that have not changed are not drawn again.
        results = tuple(values[name] for name in sorted(needs))
        before = self._shown.get(panel, ())
        if len(results) != len(before) or any(
            a is not b for a, b in zip(results, before, strict=True)
        ):
            if panel in self._restarting:
                panel.reset_range()
            panel.show_results(values)
            self._shown[panel] = results

    def _explain(self, visible: Iterable[Panel], reason: str) -> None:
        for panel in visible:
            self._shown.pop(panel, None)
            self._delivered_to.pop(panel, None)
            panel.show_problem(reason)
            panel.show_stale(False)


class PanelController(QObject):
    """Applies the edits of panels to the document, and shows panels where another one points."""

    def __init__(self, document: Document, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document, self._panels = document, panels
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.edited.connect(self._apply)
        panel.view_changed.connect(self._look)
        panel.playhead_requested.connect(self._put_playhead)
        panel.input_pointed_at.connect(self._point_at)
        panel.place_pointed_at.connect(self._point_at_place)

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

    def _point_at_place(self, at: tuple[float, float] | None) -> None:
        for panel in self._panels:
            if panel is not self.sender():
                panel.show_pointed_place(at)

    def _with_playhead(self, view: View) -> View:
        # While it moves, most panels have a view with an older playhead.
        playhead_s = self._document.view.playhead_s
        return view if view.playhead_s == playhead_s else replace(view, playhead_s=playhead_s)
