"""The matching page: a person makes tests feel as strong as a reference.

The form asks for the procedure and the table of matches, a worker thread plays the pairs, and the
view shows which of both plays and takes the answers.
"""

from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, Qt, QTimer, Signal

from skinsource.actuators.rigs import Rig
from skinsource.base.conventions import MOST_LOCATIONS
from skinsource.base.errors import InvalidInputError, SkinSourceError, sentence
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design
from skinsource.lab.matching import MOST_AMPLITUDE, STEP_DB, MatchingRun, Presenter, Procedure
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Playing
from skinsource.lab.playing.stream import HIGHEST_DB, LOWEST_DB, Stream
from skinsource.limbs.locations import input_name
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import read_numbers
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.qt.buttons import page_button, page_label, progress_bar
from skinsource_gui.qt.fitting import fit_to_letters
from skinsource_gui.qt.keys import KEYS
from skinsource_gui.qt.layouts import add_row, form_of, in_column, in_row, named, tooltip
from skinsource_gui.qt.resources import number_named
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.state.playing import end_sound, sound_worker

#: Captions of the buttons, by the names of their gestures.
_BUTTONS = {
    "weaker": "Weaker  ↓",
    "stronger": "Stronger  ↑",
    "store": "Equally strong  ⏎",
    "play": "Play",
}
_SIDE_PX = 96


class RunView(QtWidgets.QWidget):
    """Shows reference and test and lights the one that plays.

    The level is not shown: it would bias the person.

    Attributes
    ----------
    lit
        ``"reference"``, ``"test"``, or "" where neither is lit.
    """

    #: ``"weaker"``, ``"stronger"``, ``"store"`` or ``"play"``.
    requested = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.lit = ""
        self.progress = page_label("matching_progress")
        self.bar = progress_bar("matching_bar", "Progress")
        self.bar.setFixedHeight(UNIT_PX)
        self.sides = {
            name: page_label(f"matching_{name}", centred=True) for name in ("reference", "test")
        }
        for side in self.sides.values():
            side.setMinimumHeight(_SIDE_PX)
        gestures = KEYS["matching"].gestures
        question = page_label(
            "matching_question",
            "Make the test as strong as the reference: arrow keys make it weaker or stronger, "
            f"{gestures['store'].shown} when both feel equally strong.",
        )
        self.note = page_label("matching_note")
        self.buttons = {
            name: page_button(f"matching_{name}", label, gestures[name].hint)
            for name, label in _BUTTONS.items()
        }
        for name, button in self.buttons.items():
            button.clicked.connect(lambda _=False, name=name: self.requested.emit(name))
        sides = in_row(*((side, 1) for side in self.sides.values()), gap_px=2 * UNIT_PX)
        buttons = self.buttons.items()
        row = in_row(*((button, 2 if name == "store" else 1) for name, button in buttons))
        parts = (self.progress, self.bar, question, (sides, 1), row, self.note)
        in_column(*parts, of=self, margins=0, gap_px=2 * UNIT_PX)
        self._shortcuts = [
            self._shortcut(name, key) for name in _BUTTONS for key in gestures[name].keys
        ]
        self.light("")

    def show_trial(self, done: int, of: int, reference: str, test: str) -> None:
        """Show how many matches are done, and what reference and test are."""
        self.bar.setRange(0, of)
        self.bar.setValue(done)
        left = of - done
        self.progress.setText(
            f"Match {done + 1} of {of}" if left else f"All {of} matches are made. Thank you."
        )
        self.sides["reference"].setText(f"Reference\n{reference}" if left else "")
        self.sides["test"].setText(f"Test\n{test}" if left else "")

    def show_playing(self, *, playing: bool, audible: bool, left: bool) -> None:
        """Enable what can be done now: what does not sound yet cannot be judged."""
        for name in ("weaker", "stronger", "store"):
            self.buttons[name].setEnabled(audible and left)
        self.buttons["play"].setEnabled(left)
        self.buttons["play"].setText("Stop" if playing else "Play")
        if not playing:
            self.light("")

    def show_note(self, text: str, *, problem: bool = False) -> None:
        """Show a note below the buttons."""
        set_tone(self.note, "error" if problem else "dim")
        self.note.setText(text)

    def light(self, which: str) -> None:
        """Light ``"reference"``, ``"test"`` or neither."""
        self.lit = which
        for name, side in self.sides.items():
            set_tone(side, "lit" if name == which else "unlit")

    def _shortcut(self, name: str, key: str) -> QtGui.QShortcut:
        shortcut = QtGui.QShortcut(QtGui.QKeySequence(key), self)
        shortcut.setContext(Qt.ShortcutContext.WindowShortcut)
        # Each press is one step: a key that is held would store match after match.
        shortcut.setAutoRepeat(name in ("weaker", "stronger"))
        shortcut.activated.connect(lambda: self._press(name))
        return shortcut

    def _press(self, name: str) -> None:
        if self.isVisible() and self.buttons[name].isEnabled():
            self.requested.emit(name)


_NUMBERS = {
    "reference_hz": number_named("matching_reference_hz"),
    "reference_place": number_named("matching_reference_place", maximum=MOST_LOCATIONS),
    "amplitude": number_named("matching_amplitude", maximum=MOST_AMPLITUDE),
    "gain_db": number_named("matching_gain_db", minimum=LOWEST_DB, maximum=HIGHEST_DB),
    "seed": number_named("matching_seed"),
}
_FIRST = {"reference_hz": 100.0, "reference_place": 7, "amplitude": 0.25, "seed": 1}
_TEXTS = {
    "person": ("Person", "", "Letters and digits; a number will do"),
    "frequencies": ("Frequencies (Hz)", "50, 100, 200, 300", "Of the tests, with commas between"),
    "places": ("Places", "7, 12, 17", "Of the tests: input places, with commas between"),
}
_HZ = NumberSpec(label="Frequencies", unit="Hz", minimum=1.0, maximum=1000.0)
_PLACE = NumberSpec(label="Places", minimum=1, maximum=MOST_LOCATIONS, whole=True)
_LISTS = {
    "frequencies": ListSpec(label=_HZ.label, of=_HZ, most=200),
    "places": ListSpec(label=_PLACE.label, of=_PLACE, most=200),
}
_NUMBER_PX = 140


class SetupForm(QtWidgets.QWidget):
    """Asks for a procedure, and for the table that matches are added to.

    Parameters
    ----------
    table
        Initial path of the table.
    gain_db
        Initial gain.
    drive_unit
        Unit of the drive of the reference, on the limb that is played.
    """

    def __init__(self, table: Path, gain_db: float, drive_unit: str) -> None:
        super().__init__()
        self._form = form_of(self)
        self._texts: dict[str, QtWidgets.QLineEdit] = {}
        for name, (label, text, hint) in _TEXTS.items():
            field = self._texts[name] = QtWidgets.QLineEdit(text)
            add_row(self._form, f"matching_{name}", label, field, hint)
        self._numbers: dict[str, NumberField] = {}
        for name, spec in _NUMBERS.items():
            if name == "amplitude":
                spec = replace(spec, unit=drive_unit)
            number = self._numbers[name] = NumberField(spec)
            number.set_value(gain_db if name == "gain_db" else _FIRST[name])
            fit_to_letters(number, _NUMBER_PX, at_most=True)
            add_row(self._form, f"matching_{name}", spec.label, number, spec.hint)
        self.table = QtWidgets.QLineEdit(str(table))
        named(
            self.table,
            "matching_table",
            "Table",
            tooltip("Table", "CSV for the matches; matches that it holds are skipped"),
        )
        self.browse = page_button("matching_browse", "Choose…", "Choose the table")
        row = in_row((self.table, 1), self.browse)
        self._form.addRow("Table", row)

    @property
    def gain_db(self) -> float:
        """The gain of playback."""
        return self._numbers["gain_db"].value_si

    @property
    def path(self) -> Path:
        """The path of the table.

        Raises
        ------
        InvalidInputError
            No table is named.
        """
        text = self.table.text().strip()
        if not text:
            raise InvalidInputError("no table is named; choose one, or rehearse")
        path = Path(text).expanduser()
        return path if path.suffix else path.with_suffix(".csv")

    def field(self, name: str) -> QtWidgets.QLineEdit:
        """Return the widget of a row."""
        return self._texts.get(name) or self._numbers[name]

    def procedure(self, limb: str) -> Procedure:
        """Return the procedure in the fields, for designs of ``limb``.

        Raises
        ------
        InvalidInputError
            A field holds an invalid value.
        """
        numbers = {name: field.value_si for name, field in self._numbers.items()}
        return Procedure(
            person=self._texts["person"].text().strip(),
            frequencies_hz=self._numbers_in("frequencies"),
            places=tuple(map(int, self._numbers_in("places"))),
            reference_hz=float(numbers["reference_hz"]),
            reference_place=int(numbers["reference_place"]),
            amplitude=float(numbers["amplitude"]),
            seed=int(numbers["seed"]),
            limb=limb,
        )

    def _numbers_in(self, name: str) -> tuple[float, ...]:
        return read_numbers(self._texts[name].text(), _LISTS[name])


_DEVICE_LOST = (
    "The device stopped responding: it may have been unplugged. Connect it, close this page, press "
    "Refresh under Output, and come back: stored matches stay."
)


class LatestDesignPlayer(QObject):
    """Plays the latest of the designs that it gets, in a thread of its own, until it is stopped.

    Parameters
    ----------
    output, rig
        The device, and the rig that is wired to it; None: not known.

    Attributes
    ----------
    playing
        Whether it plays, or is about to.
    now
        The present playback; None: nothing is played.
    """

    #: A design begins to play; the `Playing`.
    began = Signal(object)
    #: Nothing is played any more, and why; "": it was stopped here.
    ended = Signal(str)
    _finished = Signal(object)  # from the thread of the device

    def __init__(self, output: Output, rig: Rig | None, parent: QObject) -> None:
        super().__init__(parent)
        self._thread = sound_worker(self)
        self._presenter = Presenter(output, self._finished.emit, rig)
        self._finished.connect(self._note_finished, Qt.ConnectionType.QueuedConnection)
        self._queued: tuple[Design, float] | None = None
        self._starting = self._closed = self.playing = False
        self.now: Playing | None = None

    def play(self, design: Design, gain_db: float) -> None:
        """Play ``design`` in place of what plays now."""
        self.playing = True
        self._queued = design, gain_db
        self._start_queued()

    def stop_at_once(self) -> None:
        """Be silent within a millisecond."""
        was_playing = self.playing
        self._reset()
        self._presenter.stop_at_once()
        if was_playing:
            self.ended.emit("")

    def close(self) -> None:
        """Release the device for good."""
        self._reset()
        self._closed = True
        self._presenter.stop_at_once()
        end_sound(self._thread, self._presenter.close)

    def watch(self) -> None:
        """Check whether the device was lost: no signal tells it."""
        if self.now is not None and self.now.over:
            self._reset()
            self._presenter.stop_at_once()
            self.ended.emit(_DEVICE_LOST)

    def _reset(self) -> None:
        self.playing, self._queued, self.now = False, None, None

    def _start_queued(self) -> None:
        if self._starting or self._queued is None or self._closed:
            return
        self._starting = True
        queued, self._queued = self._queued, None
        self._thread.run(partial(self._presenter.present, *queued), self._note_started)

    def _note_started(self, playback: Playing | None, error: Exception | None) -> None:
        self._starting = False
        if not self.playing:
            # It was stopped before it began.
            self._presenter.stop_at_once()
        elif playback is None:
            self._reset()
            self.ended.emit(str(error))
        else:
            self.now = playback
            self.began.emit(playback)
            stream = playback.stream
            # What was too loud at once ended before its end could be noted.
            if stream is not None and stream.queue.ending is not None:
                self._note_finished(stream)
        self._start_queued()

    def _note_finished(self, stream: Stream) -> None:
        if stream.closed or self.now is None or self.now.stream is not stream:
            return
        self._reset()
        ending = stream.queue.ending
        self.ended.emit(_DEVICE_LOST if ending is None else ending.sentence)


_TABLE = "matches.csv"
_INTRODUCTION = (
    "A person feels a reference and a test in turn, and adjusts the test until both feel equally "
    "strong (method of adjustment, ascending and descending series). Sweeps use the table: "
    'level = "matches.csv".'
)
_REHEARSAL = "Rehearsal: nothing is stored."
_STOPPED = f"Stopped. {KEYS['matching'].gestures['play'].shown} plays again."
_POLL_MS = 40
# A second Esc within this time after the one that stopped playback does not close the page.
_HURRY_S = 1.0


class MatchingPage(ToolPage):
    """Asks for a procedure, then plays it and stores the answers of the person.

    Parameters
    ----------
    limb
        Limb of the designs that are played.
    folder
        Initial folder of the table.
    output, rig, gain_db
        The device, the rig that is wired to it (None: not known), and the initial gain.
    """

    def __init__(
        self,
        limb: str,
        folder: Path,
        output: Output,
        rig: Rig | None,
        gain_db: float,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "matching_page", "Matching", (680, 560))
        self._limb = limb
        self.run: MatchingRun | None = None
        unit = amplitude_unit(Design(limb=limb))
        self.form = SetupForm(folder / _TABLE, gain_db, unit)
        self.view = RunView()
        self.player = LatestDesignPlayer(output, rig, self)
        self._stopped_s = -_HURRY_S
        self._timer = QTimer(self, interval=_POLL_MS)
        self._timer.timeout.connect(self._poll)
        self._stack = QtWidgets.QStackedWidget()
        self._arm = self.add_arm("matching_arm", self._show_armed)
        self._begin = self.add_button(
            "matching_begin",
            "Begin",
            "Play and store matches",
            partial(self._start, rehearsal=False),
        )
        self._rehearse = self.add_button(
            "matching_rehearse",
            "Rehearse",
            "The same, without storing",
            partial(self._start, rehearsal=True),
        )
        self._close = self.add_button("matching_close", "Close", "Stored matches stay", self.reject)
        setup = QtWidgets.QWidget()
        about = page_label("matching_about", _INTRODUCTION)
        in_column(about, self.form, self.message, None, of=setup, margins=0, gap_px=2 * UNIT_PX)
        self._stack.addWidget(setup)
        self._stack.addWidget(self.view)
        foot = in_row(self._arm, None, self._begin, self._rehearse, self._close)
        in_column((self._stack, 1), foot, of=self)
        self.form.browse.clicked.connect(self._choose_table)
        self.view.requested.connect(self._act)
        self.player.began.connect(self._show_began)
        self.player.ended.connect(self._show_ended)
        self._show_armed(False)

    def done(self, result: int) -> None:
        """Stop playback at once, and close the page."""
        self._timer.stop()
        self.player.close()
        super().done(result)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and not self._may_close():
            return
        super().keyPressEvent(event)

    def _may_close(self) -> bool:
        """Return whether Esc closes the page; during playback it stops that at once instead."""
        if self.player.playing:
            self.player.stop_at_once()
            self._stopped_s = monotonic()
            return False
        return monotonic() - self._stopped_s >= _HURRY_S

    def _choose_table(self) -> None:
        name, _ = QtWidgets.QFileDialog.getSaveFileName(
            self,
            "Table of matches",
            self.form.table.text(),
            "Tables of matches (*.csv)",
            options=QtWidgets.QFileDialog.Option.DontConfirmOverwrite,
        )
        if name:
            self.form.table.setText(name)

    def _start(self, *, rehearsal: bool) -> None:
        try:
            path = None if rehearsal else self.form.path
            run = MatchingRun(self.form.procedure(self._limb), path)
        except SkinSourceError as error:
            self.complain(str(error))
            return
        self.message.clear()
        self.run = run
        self._stack.setCurrentWidget(self.view)
        for button in (self._begin, self._rehearse):
            button.hide()
        self.view.setFocus()
        self.view.show_note(_REHEARSAL if rehearsal else f"Matches are added to {path}.")
        self._show_trial()
        self._play()

    def _show_armed(self, armed: bool) -> None:
        for button in (self._begin, self._rehearse):
            button.setEnabled(armed)
        if not armed:
            self.player.stop_at_once()

    def _act(self, action: str) -> None:
        if self.run is None:
            return
        if action == "play":
            self.player.stop_at_once() if self.player.playing else self._play()
        elif action == "store":
            self._store()
        elif self.run.step(STEP_DB if action == "stronger" else -STEP_DB):
            self._play()
        else:
            self.view.show_note(f"The test cannot be made {action}.")

    def _store(self) -> None:
        run = self.run
        if run is None or run.trial is None:
            return
        try:
            run.store()
        except SkinSourceError as error:
            self.player.stop_at_once()
            self.view.show_note(sentence(str(error)), problem=True)
            return
        stored = _REHEARSAL if run.path is None else f"Stored in {run.path}."
        if run.trial is None:
            self.player.stop_at_once()
            self.view.show_note(stored)
        self._show_trial()
        if run.trial is not None:
            self.view.show_note(stored)
            self._play()

    def _play(self) -> None:
        if not self._arm.isChecked():
            self.view.show_note("Nothing is sent to the actuators. Arm them first.", problem=True)
        elif self.run is not None and self.run.trial is not None:
            try:
                self.player.play(self.run.design, self.form.gain_db)
            except SkinSourceError as error:
                self.view.show_note(sentence(str(error)), problem=True)
            self._show_playing()

    def _show_began(self, playback: Playing) -> None:
        run = self.run
        if playback.stream is None and run is not None and run.path is not None:
            # Nothing reaches the skin, so the answers are no matches.
            run.path = None
            self._show_trial()
        if playback.reason:
            self.view.show_note(f"Nothing is heard: {playback.reason} {_REHEARSAL}", problem=True)
        self._timer.start()
        self._show_playing()

    def _show_ended(self, why: str) -> None:
        self._timer.stop()
        self._show_playing()
        if self.run is not None and self.run.trial is not None:
            self.view.show_note(sentence(why) if why else _STOPPED, problem=bool(why))

    def _show_playing(self) -> None:
        left = self.run is not None and self.run.trial is not None
        audible = self.player.now is not None
        self.view.show_playing(playing=self.player.playing, audible=audible, left=left)

    def _show_trial(self) -> None:
        run = self.run
        if run is None:
            return
        procedure, trial = run.procedure, run.trial
        reference = _stimulus_text(procedure.reference_hz, procedure.reference_place, self._limb)
        test = "" if trial is None else _stimulus_text(trial.frequency_hz, trial.place, self._limb)
        self.view.show_trial(run.done, len(procedure), reference, test)
        self._show_playing()

    def _poll(self) -> None:
        """Light what plays now."""
        self.player.watch()
        now, run = self.player.now, self.run
        at_s = None if now is None or run is None else now.position_s()
        if at_s is None or run is None:
            return
        procedure = run.procedure
        period_s = procedure.duration_s + procedure.pause_s
        which, within_s = divmod(at_s, period_s)
        lit = within_s < procedure.duration_s
        self.view.light(("reference", "test")[int(which) % 2] if lit else "")


def _stimulus_text(frequency_hz: float, place: int, limb: str) -> str:
    return f"{frequency_hz:g} Hz at place {place}, {input_name(place, limb).name}"
