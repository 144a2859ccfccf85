"""The line under the panels: what the last edit cost, what it computed, how wrong it can be."""

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QPalette, QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QStatusBar, QWidget

from skinsource.design.design import Design, audible_inputs
from skinsource.engine.gains import TraceError
from skinsource_gui.state.engine import Engine, Outcome
from skinsource_gui.status import computation_words
from skinsource_gui.status.computation_words import Scope, felt_words, scope_of
from skinsource_gui.status.error_label import ErrorLabel, error_words
from skinsource_gui.status.pause import PAUSE_MS
from skinsource_gui.status.sparkline import FRAME_S, Sparkline
from skinsource_gui.status.timing_label import TimingLabel
from skinsource_gui.theme import UNIT_PX, tabular
from skinsource_gui.widgets.fitting_label import FittingLabel
from skinsource_gui.widgets.lateness import Lateness

_OLDER = "The panels show the design before the last edits"


class StatusLine(QWidget):
    """Time, picture of the last times, what was computed, error; all in one row.

    Parameters
    ----------
    window
        The window whose painting is waited for.
    engine
        Whose results it is about.
    """

    #: Quantities that it asks for beside those of the panels.
    needs = computation_words.NEEDS
    #: Something that it tells is new; at most some times a second.
    changed = Signal()

    def __init__(self, window: QWidget, engine: Engine) -> None:
        super().__init__(window)
        self.setObjectName("status_line")
        self.timing = TimingLabel(window, engine)
        self.error = ErrorLabel()
        self.scope: Scope | None = None
        self._sparkline = Sparkline(self._about_times)
        self._work = FittingLabel()
        self._work.setObjectName("work")
        self._work.setAccessibleName("What was computed")
        self._work.setFont(tabular(self._work.font()))
        self._heard = ""
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._follow_lateness)
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._say)
        # Until something is edited there is no time to tell.
        self._times = QWidget()
        self._times.hide()
        times = QHBoxLayout(self._times)
        times.setContentsMargins(0, 0, UNIT_PX // 2, 0)
        times.setSpacing(UNIT_PX)
        times.addWidget(self.timing)
        times.addWidget(self._sparkline)
        row = QHBoxLayout(self)
        row.setContentsMargins(UNIT_PX, 0, 0, 0)
        # As wide as the blank after the dot that the error starts with.
        row.setSpacing(UNIT_PX // 2)
        row.addWidget(self._times)
        row.addWidget(self._work)
        row.addWidget(self.error)
        row.addStretch(1)
        for label in (self.timing, self._work):
            # Words of less weight, as those of the theme's status bar.
            label.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        self.timing.noted.connect(self._note_times)

    def show_design(self, design: Design) -> None:
        """Count the inputs of ``design``, where nothing is known of results."""
        count, heard = len(design.inputs), len(audible_inputs(design.inputs))
        self._heard = felt_words(count, heard) if count else "No input yet"
        if self.scope is None:
            self._say()

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over what the panels show now."""
        self.scope = scope_of(outcome)
        self.timing.show_outcome(outcome)
        self._say_soon()

    def show_no_outcome(self) -> None:
        """Forget the last results: there are none."""
        self.scope = None
        self.timing.show_no_outcome()
        self.error.show_error(None)
        self._say()

    def show_stale(self, stale: bool) -> None:
        """Say whether what is told is older than the design."""
        self._lateness.set_stale(stale)

    def show_error(self, error: TraceError | None) -> None:
        """Take over what is known of the error; None: nothing yet."""
        if error is not self.error.error:
            self.error.show_error(error)
            self._say_soon()

    def times_and_error(self) -> str:
        """Times of the latest edits, and the error of the traces, as a sentence or two."""
        times = self.timing.about_times() or "Nothing was edited yet."
        error = self.error.error
        known = "" if error is None else f" Traces that are shown: {error_words(error)}."
        return f"{times}{known}"

    def _note_times(self) -> None:
        self._times.setVisible(not self._lateness.late)
        self._sparkline.show_times(self.timing.times.seconds())

    def _about_times(self) -> str:
        times = self.timing.about_times() or "Nothing was edited yet."
        return f"{times}\nOne bar for each edit, the thin line is one frame ({FRAME_S * 1e3:g} ms)."

    def _follow_lateness(self, late: bool) -> None:
        # Time and error of the results before would be read as those of what is awaited.
        self._times.setVisible(not late and bool(self.timing.times.seconds()))
        self.error.setVisible(not late)
        self._say()

    def _say_soon(self) -> None:
        if not self._pause.isActive():
            self._say()
            self._pause.start()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        QTimer.singleShot(0, self, self._give_way)

    def _give_way(self) -> None:
        """Leave the bar to a message: Qt shows both when it lays the bar out anew."""
        bar = self.parent()
        if isinstance(bar, QStatusBar) and bar.currentMessage():
            self.hide()
            # As the bar itself hides it, so that it comes back with the end of the message.
            self.setAttribute(Qt.WidgetAttribute.WA_WState_ExplicitShowHide, False)

    def _say(self) -> None:
        scope = self.scope
        if scope is None:
            self._work.show_phrases((self._heard,))
            self._work.setToolTip("")
        elif self._lateness.late:
            self._work.show_phrases((f"{self._heard} · computing…", "computing…"))
            self._work.setToolTip(_OLDER)
        else:
            self._work.show_phrases(scope.phrases())
            self._work.setToolTip(scope.sentences())
        self.changed.emit()
