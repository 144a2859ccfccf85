"""The status bar: times of edits, what was computed, the error, running jobs, and notes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from PySide6.QtCore import QEvent, QObject, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QColor, QHelpEvent, QPainter, QPaintEvent, QPalette, QShowEvent
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QMenu,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QStatusBar,
    QToolButton,
    QToolTip,
    QWidget,
)

from skinsource.base.job import time_left_text
from skinsource.base.work import Work
from skinsource.design.comparing import match_text
from skinsource.design.design import Design, audible_inputs
from skinsource.design.view import View
from skinsource.engine.gains import TraceError
from skinsource.engine.transforms import BLOCK_FFT
from skinsource.limbs.limb import Limb
from skinsource_gui.qt.error_label import ErrorLabel, error_text
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.overlays import Staleness
from skinsource_gui.qt.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.qt.window_events import WindowEvents
from skinsource_gui.state.edit_times import EditTime, EditTimes, milliseconds, summary
from skinsource_gui.state.engine import Engine, Outcome, Purpose, Request
from skinsource_gui.state.job_runner import JobProgress, JobRunner

_IDLE_MS = 600


class Accuracy(QObject):
    """Has some samples of the shown traces computed again exactly when edits pause."""

    #: The `TraceError` of the traces on screen, or None while it is not known.
    checked = Signal(object)

    def __init__(self, engine: Engine, parent: QObject):
        super().__init__(parent)
        self._engine = engine
        self._shown: Request | None = None
        self._idle = QTimer(self, singleShot=True, interval=_IDLE_MS)
        self._idle.timeout.connect(self._check)
        engine.finished.connect(self._note)

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over the outcome that panels show, whose error is not known yet."""
        self.checked.emit(None)
        self._shown = outcome.request if "selected_traces" in outcome.request.wanted else None
        self._idle.start()

    def _check(self) -> None:
        # The engine evaluates this after all that is to be shown.
        if self._shown is not None:
            wanted = frozenset({"trace_error"})
            self._engine.request(replace(self._shown, wanted=wanted, purpose=Purpose.CHECK))

    def _note(self, outcome: Outcome) -> None:
        if self._shown is None or outcome.request.place != (self._shown.slot, Purpose.CHECK):
            return
        if outcome.values and outcome.request.given == self._shown.given:
            self.checked.emit(outcome.values["trace_error"])


#: Quantities that the status line needs beside those of the panels.
NEEDS = frozenset({"limb_data", "streamed"})
_IN_TIME = frozenset({"selected_traces", "selected_spectra", "selected_axis_spectra"})
#: The selected input, and all others together.
_PARTS = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Scope:
    """What was computed for the panels.

    Attributes
    ----------
    inputs, audible
        Inputs of the design, and those that are neither muted nor beside a solo one.
    channels
        Outputs times axes that were brought back to time; 0 where no panel shows them.
    all_channels
        Outputs times axes of the limb.
    has_map
        Whether the map was computed.
    streamed
        Whether the scene is too long to be transformed at once.
    work
        What it took.
    """

    inputs: int
    audible: int
    channels: int
    all_channels: int
    has_map: bool
    streamed: bool
    work: Work

    @property
    def method(self) -> str:
        """Precision and method."""
        return f"float64, overlap-save {BLOCK_FFT}" if self.streamed else "float64, spectra"

    @property
    def map_transforms(self) -> int:
        """Inverse transforms beyond those that the search and the channels can have needed."""
        others = self.work.search_transforms + _PARTS * self.channels
        return max(self.work.inverse_transforms - others, 0)

    def phrases(self) -> tuple[str, ...]:
        """Return texts for the status bar, from the longest to the shortest."""
        if not self.inputs:
            return ("No input yet", "No input")
        audible_text = audible_inputs_text(self.inputs, self.audible)
        long = " · long scene, summed piece by piece" if self.streamed else ""
        return (
            *([f"{audible_text} · up to date{long}"] if long else []),
            f"{audible_text} · up to date",
            audible_text,
        )

    def sentences(self) -> str:
        """Return all of it in sentences, one on a line."""
        silent = self.inputs - self.audible
        lines = [
            f"{self.audible} of {self.inputs} inputs are felt"
            + (f"; {silent} muted or silenced by solo cost nothing." if silent else "."),
            f"{self.channels} of {self.all_channels} channels were brought back to time: the "
            "selected outputs, on the chosen axes."
            if self.channels
            else "No channel was brought back to time: no traces or spectra are shown.",
            self._about_map(),
            self._about_work(),
            f"Precision and method: {self.method}.",
        ]
        return "\n".join(line for line in lines if line)

    def _about_map(self) -> str:
        if not self.has_map:
            return "The map is not shown and was not computed."
        if self.streamed:
            return f"The map is summed up block by block, over all {self.all_channels} channels."
        count = self.map_transforms
        word = "transform" if count == 1 else "transforms"
        return f"The map took {count} inverse {word}: its levels follow from spectra."

    def _about_work(self) -> str:
        work = self.work
        search = (
            f", {work.search_transforms} of them in search of exact maxima"
            if work.search_transforms
            else ""
        )
        return (
            f"New work: {work.forward_transforms} forward and {work.inverse_transforms} inverse "
            f"transforms{search}; {work.samples_drawn} samples drawn, "
            f"{work.bytes_read / 1e6:.1f} MB read."
        )


def audible_inputs_text(inputs: int, audible: int) -> str:
    """Return the text on how many inputs there are, and how many are felt."""
    text = "input" if inputs == 1 else "inputs"
    return f"{inputs} {text}" if audible == inputs else f"{audible} of {inputs} {text} felt"


def scope_of(outcome: Outcome) -> Scope:
    """Return what ``outcome`` has computed."""
    given, wanted = outcome.request.given, outcome.request.wanted
    values = outcome.values or {}
    limb: Limb = values["limb_data"]
    shows_channels = bool(wanted & _IN_TIME)
    return Scope(
        inputs=len(given["inputs"]),
        audible=len(audible_inputs(given["inputs"])),
        channels=len(given["outputs"]) * len(given["axes"]) if shows_channels else 0,
        all_channels=limb.n_outputs * limb.n_axes,
        has_map="output_levels_db" in wanted,
        streamed=values["streamed"],
        work=outcome.work,
    )


#: Numbers that change faster cannot be read, ms.
PAUSE_MS = 250


#: One frame of most screens.
FRAME_S = 0.016
#: What the full height means; slower ones are cut, and have the colour of a warning anyway.
_TOP_S = 2.0 * FRAME_S
_SIZE = QSize(100, 16)


class Sparkline(QWidget):
    """One bar for each time, newest at the right, and a thin line at one frame.

    Parameters
    ----------
    about
        Returns the text that describes the times.
    """

    def __init__(self, about: Callable[[], str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("sparkline")
        self.setAccessibleName("Times of the last edits")
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._about = about
        self._times_s: Sequence[float] = ()
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._paint_again)
        self._waits = False

    def sizeHint(self) -> QSize:
        return _SIZE

    def show_times(self, times_s: Sequence[float]) -> None:
        """Take over times, oldest first; painted at most four times a second."""
        self._times_s = times_s
        self._waits = True
        if not self._pause.isActive():
            self._paint_again()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), self._about(), self)
            return True
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = current_theme()
        painter = QPainter(self)
        width, height = self.width(), self.height()
        shown = self._times_s[-width:]
        slow: list[QRect] = []
        quick: list[QRect] = []
        for column, time_s in enumerate(shown, start=width - len(shown)):
            bar = round(height * min(time_s / _TOP_S, 1.0))
            bars = slow if time_s > FRAME_S else quick
            bars.append(QRect(column, height - bar, 1, bar))
        painter.setPen(Qt.PenStyle.NoPen)
        for bars, colour in ((slow, theme.warning), (quick, theme.accent)):
            painter.setBrush(QColor(colour))
            painter.drawRects(bars)
        at = round(height * (1.0 - FRAME_S / _TOP_S))
        painter.fillRect(0, at, width, 1, QColor(theme.dim))
        painter.fillRect(0, height - 1, width, 1, QColor(theme.border))
        painter.end()

    def _paint_again(self) -> None:
        # Once more after the last time, then rest.
        if self._waits:
            self._waits = False
            self.setAccessibleDescription(self._about())
            self.update()
            self._pause.start()


_WIDEST = "8888 ms"


class TimingLabel(QLabel):
    """Says how long the last edit took from the user's hand to the screen.

    Parameters
    ----------
    window
        The window whose painting is waited for.
    engine
        Its `finished` signal is the time at which results arrive.
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
        self._pause.timeout.connect(self._show_text)
        self._fit()
        WindowEvents.follow(window, self._note_painting, QEvent.Type.UpdateRequest)
        engine.finished.connect(self._note_arrival)

    def show_outcome(self, outcome: Outcome) -> None:
        """Wait until results, which the panels have by now, are painted."""
        # A hidden window is painted when it comes back: that is no time of an edit.
        if self._window.isVisible() and not self._window.isMinimized():
            known = self._arrived is not None and self._arrived[0] is outcome
            arrived_s = self._arrived[1] if known and self._arrived else perf_counter()
            self._delivered = outcome, arrived_s

    def show_no_outcome(self) -> None:
        """Forget the last time: there are no results."""
        self._delivered, self.last = None, None
        self._show_text()

    def about_times(self) -> str:
        """Return a text about the times of the last edits."""
        return summary(self.times.seconds())

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def _note_painting(self, event: QEvent) -> None:
        del event
        if self._delivered is not None:
            # The window is painted while it handles this event.
            QTimer.singleShot(0, self._note_painted)

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
            # The first picture follows no edit, so its time is not counted.
            self._is_first, self.last = False, None
            return
        self.times.note(self.last.total_s)
        self.noted.emit()
        if not self._pause.isActive():
            self._show_text()
            self._pause.start()

    def _show_text(self) -> None:
        text = "" if self.last is None else milliseconds(self.last.total_s)
        if text != self.text():
            self.setText(text)
            self._fit()
        sentence = "" if self.last is None else self.last.sentence()
        self.setToolTip(f"{sentence}\n{self.about_times()}".strip())

    def _fit(self) -> None:
        """Keep one size: else the whole window is laid out anew for each time."""
        metrics = self.fontMetrics()
        width = max(map(metrics.horizontalAdvance, (_WIDEST, self.text())))
        self.setFixedSize(width, metrics.height())


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

    #: Quantities that it needs beside those of the panels.
    needs = NEEDS
    #: Its text has changed; at most some times a second.
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
        self._audible = ""
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._follow_staleness)
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._show_text)
        # Before the first edit there is no time to show.
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
        count, audible = len(design.inputs), len(audible_inputs(design.inputs))
        self._audible = audible_inputs_text(count, audible) if count else "No input yet"
        if self.scope is None:
            self._show_text()

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over what the panels show now."""
        self.scope = scope_of(outcome)
        self.timing.show_outcome(outcome)
        self._show_text_soon()

    def show_no_outcome(self) -> None:
        """Forget the last results: there are none."""
        self.scope = None
        self.timing.show_no_outcome()
        self.error.show_error(None)
        self._show_text()

    def show_stale(self, stale: bool) -> None:
        """Take over whether the results are older than the design."""
        self._staleness.set_stale(stale)

    def show_error(self, error: TraceError | None) -> None:
        """Take over the error; None: not known yet."""
        if error is not self.error.error:
            self.error.show_error(error)
            self._show_text_soon()

    def times_and_error(self) -> str:
        """Times of the latest edits, and the error of the traces, as a sentence or two."""
        times = self.timing.about_times() or "Nothing was edited yet."
        error = self.error.error
        known = "" if error is None else f" Traces that are shown: {error_text(error)}."
        return f"{times}{known}"

    def _note_times(self) -> None:
        self._times.setVisible(not self._staleness.is_stale)
        self._sparkline.show_times(self.timing.times.seconds())

    def _about_times(self) -> str:
        times = self.timing.about_times() or "Nothing was edited yet."
        return f"{times}\nOne bar for each edit, the thin line is one frame ({FRAME_S * 1e3:g} ms)."

    def _follow_staleness(self, stale: bool) -> None:
        # Time and error of the old results would be read as those of the new ones.
        self._times.setVisible(not stale and bool(self.timing.times.seconds()))
        self.error.setVisible(not stale)
        self._show_text()

    def _show_text_soon(self) -> None:
        if not self._pause.isActive():
            self._show_text()
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

    def _show_text(self) -> None:
        scope = self.scope
        if scope is None:
            self._work.show_phrases((self._audible,))
            self._work.setToolTip("")
        elif self._staleness.is_stale:
            self._work.show_phrases((f"{self._audible} · computing…", "computing…"))
            self._work.setToolTip(_OLDER)
        else:
            self._work.show_phrases(scope.phrases())
            self._work.setToolTip(scope.sentences())
        self.changed.emit()


_WORDS = "Preparing the sound…"
_HINT = "It is brought to the rate of the device from beginning to end, and plays then"


class PreparingNote(QWidget):
    """A text and Cancel, shown while the sound of a long design is prepared."""

    cancel_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("preparing_sound")
        label = QLabel(_WORDS)
        label.setToolTip(_HINT)
        self._cancel = QPushButton("Cancel")
        self._cancel.setObjectName("cancel_preparing")
        self._cancel.setToolTip(f"Do not play ({shortcut_text('play')})")
        self._cancel.setAccessibleName("Cancel preparing the sound")
        self._cancel.setAutoDefault(False)
        self._cancel.clicked.connect(self.cancel_requested)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(UNIT_PX, 0, 0, 0)
        row.setSpacing(UNIT_PX)
        row.addWidget(label)
        row.addWidget(self._cancel)
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._follow)
        self.hide()

    def show_preparing(self, preparing: bool) -> None:
        """Take over whether the sound is being prepared; shown after a while."""
        self._staleness.set_stale(preparing)

    def _follow(self, stale: bool) -> None:
        # The keyboard goes back to where work is done.
        if not stale and self._cancel.hasFocus():
            self.window().setFocus()
        self.setVisible(stale)


_ABOUT = (
    "What is shown and played has this gain; the design, its file and all exports have the "
    "amplitudes that were stored. Click to keep it, or to see the design as stored."
)


class MatchNote(QToolButton):
    """The gain of a matched snapshot; its menu keeps or removes it.  Hidden where there is none.

    Parameters
    ----------
    actions
        The actions of its menu.
    parent
        As in Qt.
    """

    def __init__(self, actions: Sequence[QAction], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("match_note")
        self.setAutoRaise(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        menu.addActions(list(actions))
        self.setMenu(menu)
        self.hide()

    def show_state(self, design: Design, view: View) -> None:
        """Show the gain with which ``design`` is shown."""
        gain = view.match_gain(design)
        text = match_text(gain)
        if text != self.accessibleName():
            self.setText(text)
            self.setAccessibleName(text)
            self.setToolTip(f"{text}. {_ABOUT}" if text else "")
        self.setVisible(bool(text))


_BAR_PX, _NAME_PX = 96, 200
_STEPS = 1000


class JobBar(QWidget):
    """The running job: title, progress, time left, and Cancel; hidden while no job runs."""

    def __init__(self, runner: JobRunner, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("job")
        self._runner = runner
        self._name = QLabel()
        self._name.setObjectName("job_name")
        self._name.setAccessibleName("What is being done")
        self._percent = QLabel()
        self._percent.setObjectName("job_percent")
        self._percent.setFont(tabular(self.font()))
        self._percent.setMinimumWidth(self._percent.fontMetrics().horizontalAdvance("100 %"))
        self._percent.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._bar = QProgressBar()
        self._bar.setObjectName("job_progress")
        self._bar.setAccessibleName("Progress")
        self._bar.setTextVisible(False)
        self._bar.setFixedSize(_BAR_PX, UNIT_PX)
        self._cancel = QPushButton("Cancel")
        self._cancel.setObjectName("cancel_running_job")
        self._cancel.setToolTip("Stop this; nothing half done is left")
        self._cancel.setAccessibleName("Cancel what is being done")
        self._cancel.setAutoDefault(False)
        self._cancel.clicked.connect(self._stop)
        # It does not grow where the status bar has room to spare.
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(UNIT_PX, 0, 0, 0)
        row.setSpacing(UNIT_PX)
        for widget in (self._name, self._bar, self._percent, self._cancel):
            row.addWidget(widget)
        self._shown: object = None
        runner.changed.connect(self._show_job)
        runner.progressed.connect(self._show_progress)
        self.hide()

    def _stop(self) -> None:
        self._runner.cancel()

    def _show_job(self) -> None:
        job, waiting = self._runner.current, max(len(self._runner.unfinished) - 1, 0)
        if job is not self._shown:
            self._show_progress(job, JobProgress(text="Computing"))
        self._shown = job
        title = "" if job is None else job.title
        elided = self._name.fontMetrics().elidedText(title, Qt.TextElideMode.ElideMiddle, _NAME_PX)
        self._name.setText(f"{elided} (+{waiting})" if waiting else elided)
        self._name.setToolTip(f"{title}\n{waiting} more to come" if waiting else title)
        # The keyboard goes back to where work is done.
        if job is None and self._cancel.hasFocus():
            self.window().setFocus()
        self.setVisible(job is not None)

    def _show_progress(self, _job: object, progress: JobProgress) -> None:
        total = progress.total
        self._bar.setRange(0, _STEPS if total else 0)
        self._bar.setValue(_STEPS * progress.done // total if total else 0)
        # Without a total, a bar that only moves looks full.
        self._bar.setVisible(bool(total))
        left = time_left_text(progress.seconds_left)
        percent = f"{100 * progress.done // total} %" if total else f"{progress.text.lower()}…"
        self._percent.setText(f"{percent} · {left}" if left else percent)
        self._bar.setToolTip(progress.text)
