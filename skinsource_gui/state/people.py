"""The present design on the limbs of all people, predicted while somebody looks."""

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QObject

from skinsource.comparing import Snapshot
from skinsource.errors import SkinSourceError
from skinsource.limb import LIMB_NAMES
from skinsource.quantities import sources
from skinsource.view import View
from skinsource_gui.compared import Compared
from skinsource_gui.panel import Panel
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine, Outcome, Request, Slot


class People(QObject):
    """Has the engine predict the design on each limb of its kind, in slots of their own.

    Parameters
    ----------
    document, engine
        Whose design, and who predicts.
    panels
        Those with `needs_of_people` are told, while they are visible.
    """

    def __init__(self, document: Document, engine: Engine, panels: Sequence[Panel]) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = [panel for panel in panels if panel.needs_of_people]
        self._asked: dict[str, Request] = {}
        self._found: dict[str, tuple[Request, Outcome]] = {}

    def begin(self) -> None:
        """Follow the document, after those who show it in the window."""
        self._document.changed.connect(self.follow)
        self._engine.finished.connect(self._note)
        for panel in self._panels:
            panel.visibility_changed.connect(self.follow)

    def follow(self) -> None:
        """Ask for what is not known of the present design, if somebody looks."""
        visible = [panel for panel in self._panels if panel.isVisible()]
        if not visible:
            for limb in self._asked:
                self._engine.release(_slot(limb))
            self._asked.clear()
            self._found.clear()
            return
        wanted = frozenset().union(*(panel.needs_of_people for panel in visible))
        for limb in self._limbs():
            request = Request(wanted, self._given(limb), slot=_slot(limb))
            if self._asked.get(limb) != request:
                self._asked[limb] = request
                self._engine.request(request)
        self._tell(visible)

    def _limbs(self) -> tuple[str, ...]:
        """Limbs of the kind of the present one."""
        kind = self._document.design.limb.partition("-")[0]
        return tuple(name for name in LIMB_NAMES if name.partition("-")[0] == kind)

    def _given(self, limb: str) -> dict[str, object]:
        view = self._document.view
        # Of the view only what levels depend on: the rest changes while one looks around.
        seen = View(axes=view.axes, method=view.method, span=view.span, selected_inputs=())
        return sources(replace(self._document.design, limb=limb), seen)

    def _note(self, outcome: Outcome) -> None:
        limb = next((n for n, asked in self._asked.items() if asked is outcome.request), None)
        if limb is not None:
            self._found[limb] = (outcome.request, outcome)
            self._tell([panel for panel in self._panels if panel.isVisible()])

    def _tell(self, visible: Sequence[Panel]) -> None:
        compared = tuple(self._compared(limb) for limb in self._limbs())
        for panel in visible:
            panel.show_snapshots(compared)

    def _compared(self, limb: str) -> Compared:
        snapshot = Snapshot(design=replace(self._document.design, limb=limb))
        request, outcome = self._found.get(limb, (None, None))
        if outcome is None or request is not self._asked.get(limb):
            return Compared(snapshot=snapshot, on_limb=True)
        error = outcome.error
        problem = (
            str(error)
            if isinstance(error, SkinSourceError)
            else ""
            if error is None
            else (f"The studio made a mistake: {type(error).__name__}: {error}")
        )
        return Compared(snapshot=snapshot, values=outcome.values, problem=problem, on_limb=True)


def _slot(limb: str) -> Slot:
    return Slot(f"limb {limb}")
