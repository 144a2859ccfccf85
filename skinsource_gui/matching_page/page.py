"""The matching page."""

from pathlib import Path
from time import monotonic

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from skinsource.actuators.rigs import Rig
from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import sentence
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design
from skinsource.lab.matching import STEP_DB, MatchingRun
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Playing
from skinsource.limbs.locations import input_words
from skinsource_gui.matching_page.run_view import RunView
from skinsource_gui.matching_page.setup_form import SetupForm
from skinsource_gui.matching_page.sounding import Sounding
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.keys import KEYS
from skinsource_gui.widgets.page_button import page_button

_TABLE = "matches.csv"
_INTRODUCTION = (
    "A person feels a reference and a test in turn, again and again, and makes the test as strong "
    "as the reference. Each test is met from below and from above. Sweeps take the table: "
    'level = "matches.csv".'
)
_REHEARSAL = "Rehearsal: nothing is stored."
_STOPPED = f"Stopped. {KEYS['matching'].gestures['play'].shown} plays again."
_LOOK_MS = 40
# Esc that is pressed twice in a hurry stops, and does not close the page as well.
_HURRY_S = 1.0


class MatchingPage(QDialog):
    """Asks what is matched, then plays it and stores what the person says.

    Parameters
    ----------
    limb
        Limb of the designs that are played.
    folder
        Where the table lies at first.
    output, rig, gain_db
        What is played on, what is wired to it (None: not known), and how loud.
    """

    def __init__(
        self,
        limb: str,
        folder: Path,
        output: Output,
        rig: Rig | None,
        gain_db: float,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("matching_page")
        self.setWindowTitle("Matching")
        self.resize(680, 560)
        self._limb = limb
        self.run: MatchingRun | None = None
        unit = amplitude_unit(Design(limb=limb))
        self.form = SetupForm(folder / _TABLE, gain_db, unit)
        self.view = RunView()
        self.sounding = Sounding(output, rig, self)
        self._stopped_s = -_HURRY_S
        self._timer = QTimer(self, interval=_LOOK_MS)
        self._timer.timeout.connect(self._look)
        self._stack, self._problem = QStackedWidget(), QLabel()
        self._begin = page_button("matching_begin", "Begin", "Play, and store matches")
        self._rehearse = page_button(
            "matching_rehearse", "Rehearse", "The same, and nothing is stored"
        )
        self._close = page_button("matching_close", "Close", "What was stored stays")
        self._lay_out()
        self._connect()

    def done(self, result: int) -> None:
        """Stop at once, and close."""
        self._timer.stop()
        self.sounding.close()
        super().done(result)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and not self._may_close():
            return
        super().keyPressEvent(event)

    def _may_close(self) -> bool:
        """Whether Esc closes the page; while something is played it stops that at once."""
        if self.sounding.playing:
            self.sounding.stop_at_once()
            self._stopped_s = monotonic()
            return False
        return monotonic() - self._stopped_s >= _HURRY_S

    def _lay_out(self) -> None:
        setup = QWidget()
        rows = QVBoxLayout(setup)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(2 * UNIT_PX)
        about = QLabel(_INTRODUCTION)
        about.setWordWrap(True)
        self._problem.setObjectName("matching_problem")
        self._problem.setWordWrap(True)
        self._problem.setTextFormat(Qt.TextFormat.PlainText)
        set_tone(self._problem, "error")
        for part in (about, self.form, self._problem):
            rows.addWidget(part)
        rows.addStretch(1)
        self._stack.addWidget(setup)
        self._stack.addWidget(self.view)
        whole = QVBoxLayout(self)
        whole.addWidget(self._stack, 1)
        foot = QHBoxLayout()
        foot.addStretch(1)
        for button in (self._begin, self._rehearse, self._close):
            foot.addWidget(button)
        whole.addLayout(foot)

    def _connect(self) -> None:
        self._begin.clicked.connect(lambda: self._start(rehearsal=False))
        self._rehearse.clicked.connect(lambda: self._start(rehearsal=True))
        self._close.clicked.connect(self.reject)
        self.form.browse.clicked.connect(self._choose_table)
        self.view.wanted.connect(self._do)
        self.sounding.began.connect(self._show_began)
        self.sounding.ended.connect(self._show_ended)

    def _choose_table(self) -> None:
        name, _ = QFileDialog.getSaveFileName(
            self,
            "Table of matches",
            self.form.table.text(),
            "Tables of matches (*.csv)",
            options=QFileDialog.Option.DontConfirmOverwrite,
        )
        if name:
            self.form.table.setText(name)

    def _start(self, *, rehearsal: bool) -> None:
        try:
            path = None if rehearsal else self.form.path
            run = MatchingRun(self.form.procedure(self._limb), path)
        except SkinSourceError as error:
            self._problem.setText(sentence(str(error)))
            return
        self._problem.clear()
        self.run = run
        self._stack.setCurrentWidget(self.view)
        for button in (self._begin, self._rehearse):
            button.hide()
        self.view.setFocus()
        self.view.show_note(_REHEARSAL if rehearsal else f"Matches are added to {path}.")
        self._show_trial()
        self._play()

    def _do(self, what: str) -> None:
        if self.run is None:
            return
        if what == "play":
            self._stop() if self.sounding.playing else self._play()
        elif what == "store":
            self._store()
        elif self.run.step(STEP_DB if what == "stronger" else -STEP_DB):
            self._play()
        else:
            self.view.show_note("The test can be made no " + what + ".")

    def _store(self) -> None:
        run = self.run
        if run is None or run.trial is None:
            return
        try:
            run.store()
        except SkinSourceError as error:
            self._stop()
            self.view.show_note(sentence(str(error)), problem=True)
            return
        stored = _REHEARSAL if run.path is None else f"Stored in {run.path}."
        if run.trial is None:
            self.sounding.stop_at_once()
            self.view.show_note(stored)
        self._show_trial()
        if run.trial is not None:
            self.view.show_note(stored)
            self._play()

    def _play(self) -> None:
        if self.run is not None and self.run.trial is not None:
            try:
                self.sounding.play(self.run.design, self.form.gain_db)
            except SkinSourceError as error:
                self.view.show_note(sentence(str(error)), problem=True)
            self._show_playing()

    def _stop(self) -> None:
        self.sounding.stop_at_once()

    def _show_began(self, playing: Playing) -> None:
        run = self.run
        if playing.stream is None and run is not None and run.path is not None:
            # What nobody feels is no match.
            run.path = None
            self._show_trial()
        if playing.reason:
            words = f"Nothing is heard: {playing.reason} {_REHEARSAL}"
            self.view.show_note(words, problem=True)
        self._timer.start()
        self._show_playing()

    def _show_ended(self, why: str) -> None:
        self._timer.stop()
        self._show_playing()
        if self.run is not None and self.run.trial is not None:
            self.view.show_note(sentence(why) if why else _STOPPED, problem=bool(why))

    def _show_playing(self) -> None:
        left = self.run is not None and self.run.trial is not None
        felt = self.sounding.now is not None
        self.view.show_playing(playing=self.sounding.playing, felt=felt, left=left)

    def _show_trial(self) -> None:
        run = self.run
        if run is None:
            return
        procedure, trial = run.procedure, run.trial
        reference = _words(procedure.reference_hz, procedure.reference_place, self._limb)
        test = "" if trial is None else _words(trial.frequency_hz, trial.place, self._limb)
        self.view.show_trial(run.done, len(procedure), reference, test)
        self._show_playing()

    def _look(self) -> None:
        """Light what is felt now."""
        self.sounding.watch()
        now, run = self.sounding.now, self.run
        at_s = None if now is None or run is None else now.position_s()
        if at_s is None or run is None:
            return
        procedure = run.procedure
        second_s = procedure.duration_s + procedure.pause_s
        which, within_s = divmod(at_s, second_s)
        lit = within_s < procedure.duration_s
        self.view.light(("reference", "test")[int(which) % 2] if lit else "")


def _words(frequency_hz: float, place: int, limb: str) -> str:
    return f"{frequency_hz:g} Hz at place {place}, {input_words(place, limb).name}"
