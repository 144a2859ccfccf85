"""Has it judged, when there is time for it, what the present prediction is not good for."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, QPoint, QTimer
from PySide6.QtWidgets import QStatusBar

from skinsource.design import edits
from skinsource.perception.validity import Finding
from skinsource_gui.made_panels import MadePanels
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import FIRST_SLOT, Engine, Outcome, Purpose, Request
from skinsource_gui.state.predicting import sources_shown, too_large
from skinsource_gui.status.validity_card import ValidityCard
from skinsource_gui.status.validity_lamps import ValidityLamps

_IDLE_MS = 400
_WANTED = frozenset({"validity"})


class Validity(QObject):
    """Lights the lamps once edits pause; while they are hidden nothing is computed for them.

    Parameters
    ----------
    document, engine
        Whose design, and who evaluates.
    panels
        Of these the skin map hatches what is mostly noise.
    status_bar
        Where the lamps stand.

    Attributes
    ----------
    lamps
        The lamps.
    """

    def __init__(
        self,
        document: Document,
        engine: Engine,
        panels: MadePanels,
        status_bar: QStatusBar,
    ) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        self._noisy: tuple[int, ...] = ()
        panels.each(lambda panel: panel.show_noisy(self._noisy))
        self._shown: Request | None = None
        # What the lamps were lit from; None: they are not.
        self._judged: Mapping[str, Any] | None = None
        self.lamps = ValidityLamps()
        status_bar.addPermanentWidget(self.lamps)
        self._idle = QTimer(self, singleShot=True, interval=_IDLE_MS)
        self._idle.timeout.connect(self._judge)
        engine.finished.connect(self._note)
        document.changed.connect(self._follow)
        self.lamps.chosen.connect(self._explain)

    def _follow(self) -> None:
        """Say whether what is lit would be judged from something else now."""
        if self._judged is None:
            return
        now = sources_shown(self._document.design, self._document.view)
        names = self._engine.upstream_of(_WANTED) & now.keys()
        self.lamps.set_stale(any(self._judged[name] != now[name] for name in names))

    def _note(self, outcome: Outcome) -> None:
        request = outcome.request
        if request.place == (FIRST_SLOT, Purpose.SHOW):
            judged = outcome.values is not None and not too_large(request.given["limb"])
            self._shown = request if judged else None
            if self._shown is None:
                self._tell(None)
            else:
                self._idle.start()
        elif request.place == (FIRST_SLOT, Purpose.JUDGE) and self._is_shown(request):
            self._tell(outcome)

    def _is_shown(self, request: Request) -> bool:
        return self._shown is not None and request.given == self._shown.given

    def _judge(self) -> None:
        if self._shown is not None and self.lamps.isVisible():
            self._engine.request(replace(self._shown, wanted=_WANTED, purpose=Purpose.JUDGE))

    def _tell(self, outcome: Outcome | None) -> None:
        found = () if outcome is None or outcome.values is None else outcome.values["validity"]
        self.lamps.show_findings(found)
        self._judged = None if outcome is None else outcome.request.given
        # There may have been edits since.
        self._follow()
        self._noisy = next((one.outputs for one in found if one.name == "noise"), ())
        for panel in self._panels:
            panel.show_noisy(self._noisy)

    def _explain(self, name: str, place: QPoint) -> None:
        card = ValidityCard(self.lamps.findings, name, self.lamps)
        card.mend_wanted.connect(self._mend)
        card.open_above(place)

    def _mend(self, finding: Finding) -> None:
        self._document.apply(edits.mend(self._document.design, self._document.view, finding))
