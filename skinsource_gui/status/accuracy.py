"""Checks what is on screen, when there is time for it."""

from dataclasses import replace

from PySide6.QtCore import QObject, QTimer, Signal

from skinsource_gui.state.engine import Engine, Outcome, Purpose, Request

_IDLE_MS = 600


class Accuracy(QObject):
    """Has some samples of the shown traces computed again, exactly, once edits pause."""

    #: The `TraceError` of what is on screen, or None while nobody knows it.
    checked = Signal(object)

    def __init__(self, engine: Engine, parent: QObject):
        super().__init__(parent)
        self._engine = engine
        self._shown: Request | None = None
        self._idle = QTimer(self, singleShot=True, interval=_IDLE_MS)
        self._idle.timeout.connect(self._check)
        engine.finished.connect(self._note)

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over what the panels show now; its error is not known yet."""
        self.checked.emit(None)
        self._shown = outcome.request if "selected_traces" in outcome.request.wanted else None
        self._idle.start()

    def _check(self) -> None:
        # It waits until there is nothing to show.
        if self._shown is not None:
            wanted = frozenset({"trace_error"})
            self._engine.request(replace(self._shown, wanted=wanted, purpose=Purpose.CHECK))

    def _note(self, outcome: Outcome) -> None:
        if self._shown is None or outcome.request.place != (self._shown.slot, Purpose.CHECK):
            return
        if outcome.values and outcome.request.given == self._shown.given:
            self.checked.emit(outcome.values["trace_error"])
