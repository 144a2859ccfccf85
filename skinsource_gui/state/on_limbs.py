"""The present design on several limbs, predicted while somebody looks."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject

from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.compared import Compared
from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.state.conductor import UNPLAYABLE
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import FIRST_SLOT, Engine, Outcome, Purpose, Request, Slot
from skinsource_gui.state.predicting import (
    key_of_levels,
    on_limb,
    reason_of,
    sources_of_levels,
    too_large,
)


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

    def __init__(self, document: Document, engine: Engine, panels: MadePanels) -> None:
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
        for limb in [one for one, found in self._found.items() if found.values is None]:
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
            asked = self._asked_of(limb)
            if isinstance(asked, str):
                continue
            given = self._sources(asked)
            if self._is_known(limb, needs, given):
                continue
            if limb == self._document.design.limb and self._engine.busy:
                continue  # the window is about to show it
            request = Request(needs, given, slot=_slot(limb))
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

    def _is_known(self, limb: str, needs: frozenset[str], given: dict[str, Any]) -> bool:
        found = self._found.get(limb)
        if found is None or key_of_levels(found.request.given) != key_of_levels(given):
            return False
        return found.values is None or needs <= found.values.keys()

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
        found = self._found.get(limb)
        if found is None or not (found.values is None or needs <= found.values.keys()):
            return Compared(snapshot=snapshot, axes=asked[1].axes)
        late = not self._is_known(limb, needs, self._sources(asked))
        problem = "" if found.values is not None or late else reason_of(found.error)
        return Compared(
            snapshot=snapshot,
            values=found.values,
            problem=problem,
            axes=asked[1].axes,
            late=late,
        )


def _slot(limb: str) -> Slot:
    return Slot(f"limb {limb}")
