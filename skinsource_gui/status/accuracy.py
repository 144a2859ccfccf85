"""Checks what is on screen, when there is time for it."""

from PySide6.QtCore import QObject, QTimer, Signal

from skinsource_gui.state.engine import Engine, Outcome, Request

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
        if self._engine.busy:
            self._idle.start()
        elif self._shown is not None:
            wanted = frozenset({"trace_error"})
            self._engine.request(Request(wanted, self._shown.given, purpose="check"))

    def _note(self, outcome: Outcome) -> None:
        is_mine = outcome.request.purpose == "check" and self._shown is not None
        if is_mine and outcome.values and outcome.request.given == self._shown.given:
            self.checked.emit(outcome.values["trace_error"])
