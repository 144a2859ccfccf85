"""Panel of playback: device, channel map, levels, delay."""

from dataclasses import replace
from typing import ClassVar

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QStyle,
    QVBoxLayout,
    QWidget,
)

from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.lab.playing.devices import Output
from skinsource_gui.panel import Panel
from skinsource_gui.panels.playback.device_fields import DeviceFields
from skinsource_gui.panels.playback.output_row import OutputRow
from skinsource_gui.played import Played
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.keys import shortcut_text
from skinsource_gui.widgets.room.steady_area import SteadyArea

_NO_INPUTS = "No place is in use: click one on the hand."
_NOT_WIRED = "The rig wires no place that is in use."
_METER_COLUMN = 2
_LEAST = QSize(300, 160)


class PlaybackPanel(Panel):
    """What this machine plays on; what is chosen here belongs to the machine, not to the design."""

    title: ClassVar[str] = "Playback"
    name: ClassVar[str] = "playback"
    reads_down = True

    #: The `Output` that shall be played on.
    output_wanted = Signal(object)
    #: The rig file that shall be played for, `Path`, or None.
    rig_wanted = Signal(object)
    #: Devices shall be looked for.
    devices_wanted = Signal()
    #: The output that shall play a tone.
    tone_wanted = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._played, self._unit = Played(), "m/s²"
        self._in_volts = False
        self._limb = ""
        self._content = content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX)
        column.setSpacing(UNIT_PX)
        self.problem = QLabel()
        self.problem.setObjectName("playback_problem")
        set_tone(self.problem, "error")
        self.words = QLabel()
        self.words.setObjectName("playback_words")
        set_tone(self.words, "dim")
        for label in (self.problem, self.words):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        device = QGridLayout()
        device.setColumnStretch(1, 1)
        device.setHorizontalSpacing(UNIT_PX)
        self.fields = DeviceFields(device)
        self.fields.output_wanted.connect(self.output_wanted)
        self.fields.devices_wanted.connect(self.devices_wanted)
        self.fields.rig_wanted.connect(self.rig_wanted)
        self._rows: list[OutputRow] = []
        self._table = QGridLayout()
        self._table.setColumnStretch(_METER_COLUMN, 1)
        self._table.setHorizontalSpacing(UNIT_PX)
        column.addWidget(self.problem)
        column.addLayout(device)
        column.addLayout(self._table)
        column.addWidget(self.words)
        column.addStretch(1)
        area = SteadyArea()
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidget(content)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(area)
        self.setFocusProxy(self.fields.device)
        self.show_played(self._played)

    def sizeHint(self) -> QSize:
        return QSize(440, 380)

    def minimumSizeHint(self) -> QSize:
        # Fields scroll down, never sideways.
        bar = self.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
        return QSize(self._content.minimumSizeHint().width() + bar, 0).expandedTo(_LEAST)

    def show_state(self, design: Design, view: View) -> None:
        self._unit = amplitude_unit(design)
        self._in_volts = design.actuated is not None
        if design.limb != self._limb:
            # The same places, but other names.
            self._limb = design.limb
            self._make_rows(dict(self._played.wired))
            self.show_played(self._played)

    def show_played(self, played: Played) -> None:
        """Take over what is played, on what, and how loud; called while it is visible."""
        self._played = played
        self.problem.setText(played.missing)
        self.problem.setVisible(bool(played.missing))
        self.fields.show_played(played)
        wired = dict(played.wired)
        if [row.place for row in self._rows] != list(wired):
            self._make_rows(wired)
        for row in self._rows:
            row.show_output(wired[row.place])
            row.show_played(played)
            row.output.setEnabled(not played.output.stand_in and not played.rig_title)
        self._say(played)

    def _make_rows(self, wired: dict[int, int]) -> None:
        for row in self._rows:
            for widget in row.widgets:
                self._table.removeWidget(widget)
                widget.deleteLater()
        self._rows = [
            OutputRow(self._table, number, place, output, self._limb)
            for number, (place, output) in enumerate(wired.items())
        ]
        for row in self._rows:
            row.output_wanted.connect(self._wire)
            row.tone_wanted.connect(self.tone_wanted)

    def _meaning(self, played: Played) -> str:
        """What a gain of 0 dB is, and whether that is calibrated."""
        if not played.rig_title or played.output.stand_in:
            return (
                f"At a gain of 0 dB an amplitude of 1{_gap(self._unit)} is full scale. "
                "Uncalibrated: what reaches the skin depends on amplifier and actuator."
            )
        known = f"{played.calibration[:1].upper()}{played.calibration[1:]}."
        if self._in_volts:
            return f"At a gain of 0 dB the actuators get the volts of the design. {known}"
        return f"At a gain of 0 dB an amplitude of 1{_gap(self._unit)} is full scale. {known}"

    def _wire(self, place: int, output: int) -> None:
        """Give a place an output; the place that had it takes the other's."""
        before = dict(self._played.wired)
        pairs = {**dict(self._played.output.outputs), **before}
        other = next((one for one, number in pairs.items() if number == output), None)
        if other is not None and other != place:
            pairs[other] = pairs[place]
        pairs[place] = output
        self.output_wanted.emit(_wired(self._played.output, pairs))

    def _say(self, played: Played) -> None:
        says = []
        if not played.wired:
            says.append(_NOT_WIRED if played.rig_title else _NO_INPUTS)
        if played.output.stand_in:
            says.append(
                f"All frequencies sound {played.output.shift_hz:g} Hz higher than they are felt."
            )
        says.append(self._meaning(played))
        if played.delay is not None:
            says.append(f"{played.delay.words}.")
        if played.levels is not None:
            says.append(
                "The device never ran out of samples."
                if not played.underruns
                else f"The device ran out of samples {played.underruns} times: ask for a longer "
                "delay."
            )
        elif not played.missing and not played.playing:
            says.append(f"Press {shortcut_text('play')} to play.")
        text = "\n".join(says)
        if text != self.words.text():
            self.words.setText(text)


def _gap(unit: str) -> str:
    return f" {unit}" if unit != "×" else ""


def _wired(output: Output, pairs: dict[int, int]) -> Output:
    return replace(output, outputs=tuple(sorted(pairs.items())))
