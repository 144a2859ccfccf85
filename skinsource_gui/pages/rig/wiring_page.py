"""The page that checks the wiring: each channel buzzes, moves a sensor, and is timed by a cable."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt

from skinsource.actuators.rigs import RigChannel, save_rig, wired_channel
from skinsource.base.errors import SkinSourceError, Stopped
from skinsource.design import edits
from skinsource.lab.playing.session import Session
from skinsource.lab.rig_measuring.loopback import Loopback, loopback
from skinsource.lab.rig_measuring.measurement import ChannelMeasurement
from skinsource.lab.rig_measuring.wiring import (
    ChannelCheck,
    WiringCheck,
    save_wiring_check,
    wiring_check,
)
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.pages.rig.page import MeasurePage
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import ask_to_save
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing import Player, end_sound, sound_worker

_COLUMNS = ("Output", "Place", "Felt at", "Polarity", "Gain at 100 Hz", "Delay", "Jitter")
_PAGES = "Page (*.pdf *.svg *.png);;Table (*.json)"
_INTRODUCTION = (
    "Arm the actuators, then buzz each output and say where it is felt. A sensor tells polarity "
    "and gain. A cable from an output into an input tells delay and jitter; a second cable, from "
    "the first output, compares channels exactly."
)
_WHICH = "Which place?"
_MESSAGE_LINES = 4
_INPUT = NumberSpec(label="Input", minimum=1, maximum=128, whole=True, hint="Input of the cable")
_REFERENCE = NumberSpec(
    label="Reference input",
    minimum=0,
    maximum=128,
    whole=True,
    hint="Input of a cable from the first output; 0: none",
)


class WiringPage(ToolPage):
    """Checks the rig of this machine, channel by channel.

    Parameters
    ----------
    document
        Its limb names the places; its rig follows where the rig is corrected.
    player
        Has the rig, the device and the gain.

    Attributes
    ----------
    check
        What was found so far.
    """

    def __init__(self, document: Document, player: Player, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, "wiring_page", "Check wiring", (860, 560))
        self._document, self._player, self._settings = document, player, player.settings
        self._thread, self._stop = sound_worker(self), Event()
        self._session = Session(lambda _: None)
        self._running = False
        # Outputs that buzzed: of others nobody can say where they are felt.
        self._buzzed: set[int] = set()
        self._settings.look_for_rig()
        # To look for devices ends playback, and frees the sound card.
        self._settings.look()
        self.rig = self._settings.rig
        self.check: WiringCheck | None = None
        self._saved: WiringCheck | None = None
        self.table = named(QtWidgets.QTableWidget(), "wiring_table", "Channels")
        self.table.setColumnCount(len(_COLUMNS))
        self.table.setHorizontalHeaderLabels(_COLUMNS)
        self.table.setSelectionBehavior(QtWidgets.QTableWidget.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QtWidgets.QTableWidget.SelectionMode.SingleSelection)
        self.table.setEditTriggers(QtWidgets.QTableWidget.EditTrigger.NoEditTriggers)
        self.table.verticalHeader().hide()
        self.table.horizontalHeader().setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.Stretch)
        limb = document.design.limb
        places = range(1, facts_of(limb).n_inputs + 1)
        options = tuple(
            (f"{place}", f"{place} · {input_name(place, limb).name}") for place in places
        )
        self.place = ChoiceField(ChoiceSpec(label=_WHICH, options=options))
        self.place.setObjectName("wiring_place")
        self.source, self.reference = (
            _number("wiring_input", _INPUT),
            _number("wiring_reference", _REFERENCE),
        )
        self.source.set_value(1.0)
        self.arm = self.add_arm("wiring_arm", self._arm)
        add = self.add_button
        self.buzz = add("wiring_buzz", "Buzz", "0.6 s of 100 Hz on this output", self._buzz)
        self.felt = add("wiring_here", "Felt here", "Note it, and go to the next", self._note)
        self.sense = add("wiring_sense", "Sensor…", "Polarity and gain by a sensor", self._sense)
        self.loop = add("wiring_loop", "Loopback", "Clicks through the cable", self._loop)
        self.stop = add("wiring_stop", "Stop", "Fall silent at once", self._halt)
        self.correct = add(
            "wiring_correct", "Correct the rig", "Save found places and polarities", self._correct
        )
        self.save = add("wiring_save", "Save page…", "For the wall, or as a table", self._save)
        close = add("wiring_close", "Close", "", self.reject)
        felt = in_row(self.buzz, QtWidgets.QLabel(_WHICH), (self.place, 1), self.felt)
        cables = in_row(
            self.sense,
            QtWidgets.QLabel(_INPUT.label),
            self.source,
            QtWidgets.QLabel(_REFERENCE.label),
            self.reference,
            self.loop,
            None,
        )
        ends = in_row(self.arm, self.stop, None, self.correct, self.save, close)
        about = page_label("wiring_about", _INTRODUCTION)
        # Buttons stay where they are while sentences come.
        self.message.setMinimumHeight(_MESSAGE_LINES * self.message.fontMetrics().lineSpacing())
        self.message.setAlignment(Qt.AlignmentFlag.AlignTop)
        in_column(about, (self.table, 1), felt, cables, self.message, ends, of=self, gap_px=UNIT_PX)
        self.table.itemSelectionChanged.connect(self._show_place)
        self._settings.changed.connect(self._follow_devices)
        if self.rig is None:
            self.complain("No rig is chosen. Choose one under Output, or make one (Play > Rig).")
        else:
            self._begin()
        self._show_state()

    def done(self, result: int) -> None:
        """Fall silent, and close the page, after a question where answers are not saved."""
        question = "What was found is not saved. Save it?"
        if self.check != self._saved and not ask_to_save(
            self, "Check wiring", question, self._save
        ):
            return
        self._stop.set()
        end_sound(self._thread, self._session.close)
        super().done(result)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._running:
            self._halt()
        else:
            super().keyPressEvent(event)

    @property
    def channel(self) -> ChannelCheck | None:
        """The channel of the selected row."""
        row = self.table.currentRow()
        return None if self.check is None or row < 0 else self.check.channels[row]

    def _begin(self) -> None:
        """Show a check of which nothing is known yet."""
        if self.rig is not None:
            self._take(partial(wiring_check, self.rig))
            self._saved = self.check
            self._buzzed.clear()
            self.table.selectRow(0)
            self.say("Nothing is checked yet.")

    def _follow_devices(self) -> None:
        self._arm(self.arm.isChecked())

    def _arm(self, on: bool) -> None:
        if on and self._settings.searched and not self._settings.devices:
            self.arm.setChecked(False)
            self.complain(self._settings.missing)
        self._show_state()

    def _take(self, step: Callable[[], WiringCheck]) -> None:
        """Show what is known after a step."""
        try:
            self.check = step()
        except SkinSourceError as error:
            self.complain(str(error))
            return
        row = self.table.currentRow()
        self.table.setRowCount(len(self.check.channels))
        for number, channel in enumerate(self.check.channels):
            for column, text in enumerate(channel.cells):
                self.table.setItem(number, column, QtWidgets.QTableWidgetItem(text))
        self.table.selectRow(max(row, 0))
        said = self.check.sentences
        self.say(" ".join(said) if said else "Nothing differs from the rig so far.")
        self._show_state()

    def _show_place(self) -> None:
        if self.channel is not None:
            felt = self.channel.reported_place or self.channel.place
            self.place.set_value(f"{felt}")
        self._show_state()

    def _buzz(self) -> None:
        channel, output = self.channel, self._settings.output
        if channel is None:
            return
        tone = partial(
            self._session.tone, channel.output, output, self._player.gain.gain_db, self.rig
        )
        self.say(f"Output {channel.output} buzzes. {_WHICH}")
        self._thread.run(tone, partial(self._note_buzz, channel.output))

    def _note_buzz(self, output: int, _: Any, error: Exception | None) -> None:
        if error is not None:
            self.complain(str(error))
        else:
            self._buzzed.add(output)
            self._show_state()

    def _note(self) -> None:
        if self.check is None or self.channel is None:
            return
        row = self.table.currentRow()
        self._take(partial(self.check.felt, self.channel.output, int(self.place.currentData())))
        self.table.selectRow(min(row + 1, self.table.rowCount() - 1))
        self.buzz.setFocus()

    def _sense(self) -> None:
        if self._wired is None:
            return
        page = MeasurePage(self._wired, self._settings, self)
        page.measured.connect(self._sensed)
        page.open()

    @property
    def _wired(self) -> RigChannel | None:
        channel = self.channel
        return (
            None if self.rig is None or channel is None else wired_channel(self.rig, channel.place)
        )

    def _sensed(self, measurement: ChannelMeasurement) -> None:
        if self.check is not None and self.channel is not None:
            self._take(partial(self.check.measured, self.channel.output, measurement))

    def _loop(self) -> None:
        if self.check is None or self.channel is None:
            return
        output, first = self.channel.output, self.check.channels[0].output
        reference = round(self.reference.value_si)
        against = first if reference and output != first else None
        self._stop.clear()
        self._running = True
        self.say(f"Clicks on output {output}…")
        self._show_state()
        work = partial(
            loopback,
            output,
            round(self.source.value_si),
            self._settings.output,
            reference=None if against is None else (against, reference),
            stop=self._stop.is_set,
        )
        self._thread.run(work, partial(self._looped, output, against))

    def _looped(
        self, output: int, against: int | None, found: Loopback | None, error: Exception | None
    ) -> None:
        self._running = False
        if found is not None and self.check is not None:
            self._take(partial(self.check.looped, output, found, against))
        else:
            self.complain("Stopped." if isinstance(error, Stopped) else str(error))
        self._show_state()

    def _halt(self) -> None:
        self._stop.set()
        self._thread.run(self._session.close)

    def _correct(self) -> None:
        path = self._settings.rig_path
        if self.check is None or self.rig is None or path is None:
            return
        try:
            rig = self.check.corrected(self.rig)
            save_rig(path, rig)
        except SkinSourceError as error:
            self.complain(str(error))
            return
        self.rig = rig
        if self._settings.choose_rig(path):
            design, view = self._document.design, self._document.view
            self._document.apply(edits.choose_rig(design, view, rig))
        self._buzzed.clear()
        self._take(partial(self.check.opened, rig))
        self._saved = wiring_check(rig)
        self.say(f"Saved {path.name}. Check it once more.")

    def _save(self) -> bool:
        """Save the check; return whether that was done."""
        path, check = self.ask_save("Save the check", _PAGES, Path("wiring.pdf")), self.check
        if path is None or check is None:
            return False

        def write() -> None:
            save_wiring_check(check, path if path.suffix else path.with_suffix(".pdf"))
            self._saved = check

        self.save_as(path, write, self._settings.preferences)
        return self._saved == check

    def _show_state(self) -> None:
        known, armed = self.check is not None, self.arm.isChecked() and not self._running
        for button in (self.buzz, self.loop):
            button.setEnabled(known and armed)
        for button in (self.sense, self.save):
            button.setEnabled(known and not self._running)
        self.felt.setEnabled(self.channel is not None and self.channel.output in self._buzzed)
        self.correct.setEnabled(self.check is not None and self.check.wrong)


def _number(name: str, spec: NumberSpec) -> NumberField:
    field = NumberField(spec, widest_unit="")
    field.setObjectName(name)
    field.setAccessibleName(spec.label)
    field.setToolTip(spec.hint)
    return field
