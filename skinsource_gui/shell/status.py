"""The status bar: what is shown, running jobs, and notes; times and error are kept too."""

import math
from collections import deque
from collections.abc import Container, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal

from skinsource.base.job import time_left_text
from skinsource.design.comparing import match_text, stored_name
from skinsource.design.design import Design, View, audible_inputs
from skinsource.design.panel_settings import settings_of
from skinsource.engine.gains import TraceError
from skinsource_gui.panels.skin.settings import (
    LEVELS,
    MAGNITUDE,
    PEOPLE,
    RMS,
    SENSATION,
    SKIN,
    SkinSettings,
    Z,
)
from skinsource_gui.qt.buttons import menu_of, page_button, progress_bar
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.layouts import Policy, in_row, named, show_tooltip
from skinsource_gui.qt.overlays import Overlay, Staleness
from skinsource_gui.qt.theme import UNIT_PX, current_theme, set_tone, tabular
from skinsource_gui.qt.windows import WindowEvents
from skinsource_gui.state.conductor import UNPLAYABLE
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


def error_text(error: TraceError) -> str:
    """Return a short text of estimate and bound."""
    return f"error ≈ {rounded_up(error.estimate)}, at most {rounded_up(error.bound)}"


def rounded_up(error: float) -> str:
    """Return ``error`` rounded up to one digit, so that it never looks smaller than it is."""
    # No error in float64 is smaller than one rounding.
    error = max(error, float(np.finfo(np.float64).eps))
    exponent = math.floor(math.log10(error))
    digit = math.ceil(error / 10.0**exponent - 1e-9)
    return f"{digit}e{exponent}" if digit < 10 else f"1e{exponent + 1}"


#: Edits that are remembered.
MOST_EDITS = 100
_MS = 1e3
_A_SECOND_MS = 1000.0


def summary(seconds: tuple[float, ...]) -> str:
    """Return a sentence on several times; "" where there are none."""
    if not seconds:
        return ""
    count = "Last edit" if len(seconds) == 1 else f"Last {len(seconds)} edits"
    return (
        f"{count}: median {milliseconds(float(np.median(seconds)))}, 95 % within "
        f"{milliseconds(most_within(seconds))}, slowest {milliseconds(max(seconds))}."
    )


def most_within(seconds: tuple[float, ...]) -> float:
    """Return the time within which 95 % of ``seconds`` are, one of those that occurred."""
    return sorted(seconds)[-(-95 * len(seconds) // 100) - 1]


def milliseconds(seconds: float) -> str:
    """Return a text such as ``0.4 ms``, ``12 ms`` or ``1.3 s``."""
    shown = seconds * _MS
    if shown >= _A_SECOND_MS:
        return f"{seconds:.1f} s"
    return f"{shown:.0f} ms" if shown >= 9.95 else f"{shown:.1f} ms"


class EditClock(QObject):
    """Notes how long each edit takes from the user's hand to the screen.

    Parameters
    ----------
    window
        The window whose painting is waited for; also the parent.
    """

    #: An edit was painted: there is another time.
    noted = Signal()

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self.times_s: deque[float] = deque(maxlen=MOST_EDITS)
        self._window = window
        self._delivered: Outcome | None = None
        self._is_first = True
        WindowEvents.follow(window, self._note_painting, QEvent.Type.UpdateRequest)

    def show_outcome(self, outcome: Outcome) -> None:
        """Wait until results, which the panels have by now, are painted."""
        # A hidden window is painted when it comes back: that is no time of an edit.
        if self._window.isVisible() and not self._window.isMinimized():
            self._delivered = outcome

    def show_no_outcome(self) -> None:
        """Wait no longer: there are no results."""
        self._delivered = None

    def _note_painting(self, _event: QEvent) -> None:
        if self._delivered is not None:
            # The window is painted while it handles this event.
            QTimer.singleShot(0, self, self._note_painted)

    def _note_painted(self) -> None:
        outcome, self._delivered = self._delivered, None
        if outcome is None:
            return
        if self._is_first:
            # The first picture follows no edit, so its time is not counted.
            self._is_first = False
        else:
            self.times_s.append(perf_counter() - outcome.request.since_s)
            self.noted.emit()


#: What the map shows, by the quantity of its settings.
_PREDICTED = {
    LEVELS: "acceleration",
    PEOPLE: "acceleration, mean of people",
    SENSATION: "sensation level",
    Z: "acceleration along z",
    MAGNITUDE: "magnitude of acceleration",
    RMS: "acceleration, sliding RMS",
}
#: Texts that change faster cannot be read, ms.
PAUSE_MS = 250
_OLDER = "The panels show the design before the last edits"


def shown_text(design: Design, view: View, unplayable: Container[int] = ()) -> str:
    """Return what the skin map shows, and how many inputs play where some do not.

    ``unplayable``: ids of those that cannot.
    """
    predicted = f"Predicted {_PREDICTED[settings_of(view, SKIN, SkinSettings).quantity]}"
    through = " through actuators" if design.actuated else ""
    inputs = len(design.inputs)
    played = sum(track.id not in unplayable for track in audible_inputs(design.inputs))
    if not inputs:
        return "No input yet"
    playing = "" if played == inputs else f" · {played} of {inputs} inputs play"
    return f"{predicted}{through}, back of the hand{playing}"


class StatusLine(FittingLabel):
    """Says what the skin shows, and whether that is up to date.

    A message of the status bar is shown in its place as long as there is one.

    Parameters
    ----------
    window
        The window whose painting is waited for.
    """

    #: Its text, the times or the error have changed; at most some times a second.
    changed = Signal()

    def __init__(self, window: QtWidgets.QMainWindow) -> None:
        super().__init__(window)
        named(self, "status_line", "State of the results")
        self.setSizePolicy(Policy.Preferred, Policy.Fixed)
        self.setContentsMargins(UNIT_PX, 0, 0, 0)
        self.setFont(tabular(self.font()))
        set_tone(self, "dim")
        self.clock = EditClock(window)
        self.error: TraceError | None = None
        self._stored, self._shown, self._has_results, self._message = "", "", False, ""
        self._state, self._unplayable = (Design(limb=""), View()), set[int]()
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._show_text)
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._show_text)
        self.clock.noted.connect(self._show_text_soon)
        window.statusBar().messageChanged.connect(self._show_message)

    def show_state(self, design: Design, view: View) -> None:
        """Take over what is shown, and of which snapshot."""
        self._state = design, view
        stored = stored_name(view.snapshots, design)
        self._stored = f"{stored.capitalize()} is shown" if stored else ""
        self._say_shown()

    def show_outcome(self, outcome: Outcome) -> None:
        """Take over what the panels show now."""
        self._has_results = True
        self._unplayable = {track.id for track in (outcome.values or {}).get(UNPLAYABLE, ())}
        self.clock.show_outcome(outcome)
        self._say_shown()

    def show_no_outcome(self) -> None:
        """Forget the last results: there are none."""
        self._has_results, self.error = False, None
        self.clock.show_no_outcome()
        self._show_text()

    def show_stale(self, stale: bool) -> None:
        """Take over whether the results are older than the design."""
        self._staleness.set_stale(stale)

    def show_error(self, error: TraceError | None) -> None:
        """Take over the error of the traces; None: not known yet."""
        if error is not self.error:
            self.error = error
            self._show_text_soon()

    def times_and_error(self) -> str:
        """Times of the latest edits, and the error of the traces, as a sentence or two."""
        times = summary(tuple(self.clock.times_s)) or "No edit yet."
        known = "" if self.error is None else f" Traces that are shown: {error_text(self.error)}."
        return f"{times}{known}"

    def _say_shown(self) -> None:
        text = shown_text(*self._state, self._unplayable)
        self._shown = " · ".join(filter(None, (self._stored, text)))
        self._show_text_soon()

    def _show_message(self, message: str) -> None:
        self._message = message
        self._show_text()

    def _show_text_soon(self) -> None:
        if not self._pause.isActive():
            self._show_text()
            self._pause.start()

    def _show_text(self) -> None:
        tone = "" if self._stored else "dim"
        stale = self._has_results and self._staleness.is_stale
        phrases: tuple[str, ...] = (self._shown, self._stored or self._shown)
        if self._message:
            phrases, tone = (self._message,), ""
        elif stale:
            phrases = (f"{self._shown} · computing…", "computing…")
        self.show_phrases(phrases)
        set_tone(self, tone)
        self.setToolTip(_OLDER if stale else self._message)
        self.changed.emit()


_ABOUT = (
    "Display and playback have this gain; the design and all exports have the stored amplitudes. "
    "Click to apply it, or to see the design as stored."
)


_FRAME_PX = 3


class MatchFrame(Overlay):
    """A coloured frame round a window that shows other levels than those of its design."""

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self.setObjectName("match_frame")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        inner = self.rect().adjusted(_FRAME_PX, _FRAME_PX, -_FRAME_PX, -_FRAME_PX)
        self.setMask(QtGui.QRegion(self.rect()) - QtGui.QRegion(inner))
        super().resizeEvent(event)

    def paintEvent(self, _event: QtGui.QPaintEvent) -> None:
        QtGui.QPainter(self).fillRect(self.rect(), QtGui.QColor(current_theme().warning))


class MatchNote(QtWidgets.QToolButton):
    """The gain of a matched snapshot; its menu keeps or removes it.  Hidden where there is none.

    A frame round the window is shown with it.

    Parameters
    ----------
    actions
        The actions of its menu.
    """

    def __init__(self, actions: Sequence[QtGui.QAction]) -> None:
        super().__init__()
        self.setObjectName("match_note")
        self.setAutoRaise(True)
        menu_of(self).addActions(list(actions))
        self._frame: MatchFrame | None = None
        self.hide()

    def show_state(self, design: Design, view: View) -> None:
        """Show the gain with which ``design`` is shown."""
        gain = view.match_gain(design)
        text = match_text(gain)
        self.setText(text)
        self.setAccessibleName(text)
        show_tooltip(self, f"{text}. {_ABOUT}" if text else "")
        self.setVisible(bool(text))
        if bool(text) == (self._frame is not None):
            return
        if self._frame is not None:
            self._frame.take_away()
        self._frame = MatchFrame(self.window()) if text else None


_BAR_PX, _NAME_PX = 96, 200
_STEPS = 1000


class JobBar(QtWidgets.QWidget):
    """The running job: title, progress, time left, and Cancel; hidden while no job runs."""

    def __init__(self, runner: JobRunner) -> None:
        super().__init__()
        self.setObjectName("job")
        self._runner = runner
        self._name = named(QtWidgets.QLabel(), "job_name", "Running task")
        self._percent = named(QtWidgets.QLabel(), "job_percent")
        self._percent.setFont(tabular(self.font()))
        self._percent.setMinimumWidth(self._percent.fontMetrics().horizontalAdvance("100 %"))
        self._percent.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._bar = progress_bar("job_progress", "Progress")
        self._bar.setFixedSize(_BAR_PX, UNIT_PX)
        hint = "Stop this task, and clean up"
        self._cancel = page_button("cancel_running_job", "Cancel", hint)
        self._cancel.setAccessibleName("Cancel task")
        self._cancel.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._cancel.clicked.connect(lambda: runner.cancel())
        # It does not grow where the status bar has room to spare.
        self.setSizePolicy(Policy.Fixed, Policy.Fixed)
        parts = self._name, self._bar, self._percent, self._cancel
        in_row(*parts, of=self, margins=(UNIT_PX, 0, 0, 0), gap_px=UNIT_PX)
        self._shown: object = None
        runner.changed.connect(self._show_job)
        runner.progressed.connect(self._show_progress)
        self.hide()

    def _show_job(self) -> None:
        job, waiting = self._runner.current, max(len(self._runner.unfinished) - 1, 0)
        if job is not self._shown:
            self._show_progress(job, JobProgress(text="Computing"))
        self._shown = job
        title = "" if job is None else job.title
        elided = self._name.fontMetrics().elidedText(title, Qt.TextElideMode.ElideMiddle, _NAME_PX)
        self._name.setText(f"{elided} (+{waiting})" if waiting else elided)
        self._name.setToolTip(f"{title}\n{waiting} more" if waiting else title)
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
