"""How long the last edit took until it was seen."""

from time import perf_counter

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import QLabel, QWidget

from skinsource_gui.state.engine import Engine, Outcome
from skinsource_gui.status.edit_times import EditTime, EditTimes, milliseconds, summary
from skinsource_gui.status.pause import PAUSE_MS
from skinsource_gui.theme import tabular

_WIDEST = "8888 ms"


class TimingLabel(QLabel):
    """Says how long the last edit took from the user's hand to the screen.

    Parameters
    ----------
    window
        The window whose painting is waited for.
    engine
        Results are taken to be in the window's thread when it has finished.
    """

    #: An edit was painted: the times are new.
    noted = Signal()

    def __init__(self, window: QWidget, engine: Engine) -> None:
        super().__init__(window)
        self.setObjectName("timing")
        self.setAccessibleName("Time from edit to screen")
        self.setFont(tabular(self.font()))
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.times = EditTimes()
        self.last: EditTime | None = None
        self._window = window
        self._arrived: tuple[Outcome, float] | None = None
        self._delivered: tuple[Outcome, float] | None = None
        self._is_first = True
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._say)
        self._fit()
        window.installEventFilter(self)
        engine.finished.connect(self._note_arrival)

    def show_outcome(self, outcome: Outcome) -> None:
        """Wait until results, which the panels have by now, are painted."""
        # What nobody sees is painted when the window comes back: no time of an edit.
        if self._window.isVisible() and not self._window.isMinimized():
            known = self._arrived is not None and self._arrived[0] is outcome
            arrived_s = self._arrived[1] if known and self._arrived else perf_counter()
            self._delivered = outcome, arrived_s

    def show_no_outcome(self) -> None:
        """Forget the last time: there are no results."""
        self._delivered, self.last = None, None
        self._say()

    def about_times(self) -> str:
        """Words about the last edits."""
        return summary(self.times.seconds())

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.UpdateRequest and self._delivered is not None:
            # The window is painted while it handles this event.
            QTimer.singleShot(0, self._note_painted)
        return super().eventFilter(watched, event)

    def _note_arrival(self, outcome: Outcome) -> None:
        self._arrived = outcome, perf_counter()

    def _note_painted(self) -> None:
        delivered, self._delivered = self._delivered, None
        if delivered is None:
            return
        outcome, arrived_s = delivered
        now_s = perf_counter()
        self.last = EditTime(
            compute_s=outcome.compute_s,
            draw_s=now_s - arrived_s,
            total_s=now_s - outcome.request.since_s,
        )
        if self._is_first:
            # The first picture follows no edit: how long it took says nothing about edits.
            self._is_first, self.last = False, None
            return
        self.times.note(self.last.total_s)
        self.noted.emit()
        if not self._pause.isActive():
            self._say()
            self._pause.start()

    def _say(self) -> None:
        words = "" if self.last is None else milliseconds(self.last.total_s)
        if words != self.text():
            self.setText(words)
            self._fit()
        sentence = "" if self.last is None else self.last.sentence()
        self.setToolTip(f"{sentence}\n{self.about_times()}".strip())

    def _fit(self) -> None:
        """Stay of one size: else the whole window is laid out anew for each time that is said."""
        metrics = self.fontMetrics()
        words = max(map(metrics.horizontalAdvance, (_WIDEST, self.text())))
        self.setFixedSize(words, metrics.height())
