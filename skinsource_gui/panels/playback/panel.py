"""The playback panel: device, channel map, levels and delay of this machine."""

from dataclasses import replace
from typing import Any, ClassVar

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, QSize, Qt, Signal

from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.lab.playing.devices import (
    LEAST_SHIFT_HZ,
    LONGEST_LATENCY_S,
    MOST_OUTPUTS,
    MOST_SHIFT_HZ,
    SHORTEST_LATENCY_S,
    Output,
)
from skinsource.limbs.locations import LocationNames, input_name
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.rig_field import RigField
from skinsource_gui.qt.buttons import page_label, tool_button
from skinsource_gui.qt.fitting import LetterWidth, SteadyArea
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.labels import FittingLabel, LevelMeter
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX, tabular
from skinsource_gui.qt.tooltips import show_tooltip
from skinsource_gui.state.panel import Panel
from skinsource_gui.state.playing import Played

_NUMBER_PX = 88
_SYSTEM = "What the system plays on"
_BETWEEN = "\n"
_LATENCY = NumberSpec(
    label="Delay asked for",
    unit="s",
    minimum=SHORTEST_LATENCY_S,
    maximum=LONGEST_LATENCY_S,
    step=0.001,
    hint="The shorter, the sooner an edit is felt, and the sooner the device runs out of samples",
)
_SHIFT = NumberSpec(
    label="Shift",
    unit="Hz",
    minimum=LEAST_SHIFT_HZ,
    maximum=MOST_SHIFT_HZ,
    step=10.0,
    hint="How many hertz higher everything sounds",
)


class DeviceFields(QObject):
    """Rows of a grid with the fields of the device: labels on the left, fields on the right."""

    #: The chosen `Output`.
    output_requested = Signal(object)
    devices_requested = Signal()
    #: The chosen rig file, `Path`, or None.
    rig_requested = Signal(object)

    def __init__(self, grid: QtWidgets.QGridLayout) -> None:
        super().__init__()
        self._output = Output()
        self._played: tuple[object, ...] = ()
        self.device = ChoiceField(ChoiceSpec(label="Device", options=(("", _SYSTEM),)))
        self.device.edited.connect(self._choose_device)
        rescan_hint = "Look for devices that were connected since; ends what is played"
        self.rescan = tool_button(None, "look_for_devices", "Look again", rescan_hint)
        self.rescan.clicked.connect(self.devices_requested)
        self.rate = ChoiceField(ChoiceSpec(label="Sample rate", options=()))
        self.rate.edited.connect(lambda rate, _: self._want(sample_rate_hz=int(rate)))
        self.latency = NumberField(_LATENCY)
        self.latency.setToolTip(_LATENCY.hint)
        self.latency.edited.connect(lambda latency_s, _: self._want(latency_s=latency_s))
        stand_in_hint = (
            "For people without actuators: all channels, from left to right in their order, with "
            "all frequencies shifted up by as many hertz"
        )
        self.stand_in = tool_button(
            None, "stand_in", "Stand-in for the ears", stand_in_hint, checkable=True
        )
        self.stand_in.clicked.connect(lambda on: self._want(stand_in=on))
        self.shift = NumberField(_SHIFT)
        self.shift.setToolTip(_SHIFT.hint)
        self.shift.edited.connect(lambda shift_hz, _: self._want(shift_hz=shift_hz))
        self.rig = RigField()
        self.rig.rig_chosen.connect(self.rig_requested)
        for widget, name in (
            (self.device, "device"),
            (self.rig, "rig"),
            (self.rate, "sample_rate"),
            (self.latency, "latency"),
            (self.shift, "shift"),
        ):
            widget.setObjectName(f"{name}_field")
            widget.setAccessibleName(name.replace("_", " ").capitalize())
        for field in (self.latency, self.shift):
            LetterWidth(field, _NUMBER_PX)
        delay = _row(self.latency, self.rescan)
        rows: tuple[tuple[str, QtWidgets.QWidget], ...] = (
            ("Device", self.device),
            ("Sample rate", self.rate),
            ("Delay asked for", delay),
            ("Rig", self.rig),
        )
        for row, (label, part) in enumerate(rows):
            grid.addWidget(QtWidgets.QLabel(label), row, 0)
            grid.addWidget(part, row, 1)
        # In a column of the grid this text would take the room of the fields.
        grid.addWidget(_row(self.stand_in, QtWidgets.QLabel("shift"), self.shift), 4, 0, 1, 2)

    def show_played(self, played: Played) -> None:
        """Take over the chosen output and what can be chosen."""
        shown = played.output, played.devices, played.rates_hz, played.rig_title
        if shown == self._played:
            return
        self._played, self._output = shown, played.output
        options = [("", _SYSTEM)]
        options += [(_key(device.name, device.host_api), device.title) for device in played.devices]
        _fill(self.device, options, _key_of(played))
        rates = sorted({*played.rates_hz, played.output.sample_rate_hz})
        rate_options = [(str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in rates]
        _fill(self.rate, rate_options, str(played.output.sample_rate_hz))
        self.rig.show_rig(played.rig_title or None)
        self.latency.set_value(played.output.latency_s)
        self.shift.set_value(played.output.shift_hz)
        self.shift.setEnabled(played.output.stand_in)
        self.stand_in.setChecked(played.output.stand_in)

    def _choose_device(self, key: str, _gesture: int | None) -> None:
        name, _, host_api = key.partition(_BETWEEN)
        self._want(device=name, host_api=host_api)

    def _want(self, **changes: Any) -> None:
        self.output_requested.emit(replace(self._output, **changes))


def _row(*parts: QtWidgets.QWidget) -> QtWidgets.QWidget:
    """Return widgets beside each other, as wide as they prefer."""
    row = QtWidgets.QWidget()
    in_row(*parts, None, of=row, margins=0)
    return row


def _key(name: str, host_api: str) -> str:
    return f"{name}{_BETWEEN}{host_api}" if name else ""


def _key_of(played: Played) -> str:
    """Return the key of the chosen device; without a host API, of the first device of its name."""
    output = played.output
    for device in played.devices:
        if device.name == output.device and output.host_api in ("", device.host_api):
            return _key(device.name, device.host_api)
    return _key(output.device, output.host_api)


def _fill(field: ChoiceField, options: list[tuple[str, str]], chosen: str) -> None:
    """Offer other choices."""
    field.set_options(options)
    field.set_value(chosen)


_METER_PX, _LEAST_METER_PX, _OUTPUT_NUMBER_PX = 8, 48, 56
_WIDEST_LEVEL = "\u2212100.0 dBFS"
_SILENT_DB = -200.0


class OutputRow(QObject):
    """One place of the design in a row of a grid: its output, its level, and a test tone.

    Parameters
    ----------
    grid, row
        Where its widgets are added.
    place, output
        Input place, and the output, from 1, that drives its actuator.
    """

    #: The place, and the output that shall drive it.
    output_requested = Signal(int, int)
    #: The output that shall play a tone.
    tone_requested = Signal(int)

    def __init__(
        self, grid: QtWidgets.QGridLayout, row: int, place: int, output: int, limb: str
    ) -> None:
        super().__init__()
        names = input_name(place, limb)
        self.place = place
        self.title = _Title(place, names)
        spec = NumberSpec(
            label=f"Output of place {place}", minimum=1, maximum=MOST_OUTPUTS, whole=True
        )
        self.output = NumberField(spec, widest_unit="")
        self.output.setObjectName(f"output_of_{place}")
        self.output.setAccessibleName(spec.label)
        self.output.setToolTip("Number of the output of the device that its actuator is wired to")
        LetterWidth(self.output, _OUTPUT_NUMBER_PX)
        self.output.edited.connect(self._choose)
        self.meter = LevelMeter()
        self.meter.setFixedHeight(_METER_PX)
        self.level = QtWidgets.QLabel()
        self.level.setFont(tabular(self.level.font()))
        self.level.setObjectName(f"level_of_{place}")
        self.level.hide()
        self.loudness = _Loudness(self.meter, self.level)
        self.tone = tool_button(None, f"tone_of_{place}", "Test tone")
        self.tone.clicked.connect(self._request_tone)
        for column, widget in enumerate(self.widgets):
            grid.addWidget(widget, row, column)
        self.show_output(output)

    @property
    def widgets(
        self,
    ) -> tuple[QtWidgets.QLabel, NumberField, QtWidgets.QWidget, QtWidgets.QToolButton]:
        """The widgets from left to right."""
        return self.title, self.output, self.loudness, self.tone

    def show_output(self, output: int) -> None:
        """Show another output."""
        self.output.set_value(float(output))
        self.tone.setAccessibleName(f"Test tone on output {output}, place {self.place}")

    def show_played(self, played: Played) -> None:
        """Show how loud its output is, and whether a tone can be heard on it."""
        self._offer_tone(played.missing)
        index = round(self.output.value_si) - 1
        levels = played.levels
        if levels is None or index >= levels.rms_db.size:
            self.meter.show_level(_SILENT_DB, _SILENT_DB)
            self._show_level_text("")
            return
        self.meter.show_level(float(levels.rms_db[index]), float(levels.peak_db[index]))
        highest_db = float(levels.highest_db[index])
        self._show_level_text(
            "silent"
            if highest_db <= _SILENT_DB
            else f"{highest_db:z.1f} dBFS".replace("-", "\u2212")
        )

    def _choose(self, output: float, _gesture: int | None) -> None:
        self.output_requested.emit(self.place, round(output))

    def _show_level_text(self, text: str) -> None:
        # Without a text the bar is centred.
        self.level.setText(text)
        self.level.setVisible(bool(text))

    def _offer_tone(self, missing: str) -> None:
        self.tone.setEnabled(not missing)
        show_tooltip(
            self.tone,
            missing
            or f"0.6 s of 100 Hz on output {round(self.output.value_si)} alone, at the gain above, "
            f"to find the actuator of place {self.place}",
        )

    def _request_tone(self) -> None:
        self.tone_requested.emit(round(self.output.value_si))


class _Title(FittingLabel):
    """Number and name of a place; the name is shortened where other widgets need the room."""

    def __init__(self, place: int, names: LocationNames) -> None:
        super().__init__()
        self._least = f"{place} · …"
        self.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.show_phrases((f"{place} · {names.name}", f"{place} · {names.short_name}"))
        self.setToolTip(names.name)

    def minimumSizeHint(self) -> QSize:
        least = self.fontMetrics().horizontalAdvance(self._least) + 4
        return QSize(least, super().minimumSizeHint().height())


class _Loudness(QtWidgets.QWidget):
    """A level bar with its number below: beside it a narrow panel would have no room."""

    def __init__(self, meter: LevelMeter, level: QtWidgets.QLabel) -> None:
        super().__init__()
        self._level = level
        in_column(meter, level, of=self, margins=0, gap_px=2)

    def minimumSizeHint(self) -> QSize:
        # This room is also kept in silence; otherwise rows would widen and cut other widgets.
        room_px = self._level.fontMetrics().horizontalAdvance(_WIDEST_LEVEL)
        return QSize(max(room_px, _LEAST_METER_PX), super().minimumSizeHint().height())


_NO_INPUTS = "No place is in use: click one on the hand."
_NOT_WIRED = "The rig wires no place that is in use."
_METER_COLUMN = 2
_LEAST = QSize(300, 160)


class PlaybackPanel(Panel):
    """Settings of playback on this machine; they do not belong to the design."""

    title: ClassVar[str] = "Playback"
    name: ClassVar[str] = "playback"
    reads_down = True

    #: The `Output` that shall be played on.
    output_requested = Signal(object)
    #: The rig file that shall be played for, `Path`, or None.
    rig_requested = Signal(object)
    #: The devices shall be listed again.
    devices_requested = Signal()
    #: The output that shall play a tone.
    tone_requested = Signal(int)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._played, self._unit = Played(), "m/s²"
        self._in_volts = False
        self._limb = ""
        self._content = content = QtWidgets.QWidget()
        self.problem = page_label("playback_problem", tone="error")
        self.text = page_label("playback_words", tone="dim")
        for label in (self.problem, self.text):
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        device = QtWidgets.QGridLayout()
        device.setColumnStretch(1, 1)
        device.setHorizontalSpacing(UNIT_PX)
        self.fields = DeviceFields(device)
        self.fields.output_requested.connect(self.output_requested)
        self.fields.devices_requested.connect(self.devices_requested)
        self.fields.rig_requested.connect(self.rig_requested)
        self._rows: list[OutputRow] = []
        self._table = QtWidgets.QGridLayout()
        self._table.setColumnStretch(_METER_COLUMN, 1)
        self._table.setHorizontalSpacing(UNIT_PX)
        parts = (self.problem, device, self._table, self.text, None)
        margins = (UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX)
        in_column(*parts, of=content, margins=margins, gap_px=UNIT_PX)
        area = SteadyArea()
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
        area.setWidget(content)
        in_column(area, of=self, margins=0)
        self.setFocusProxy(self.fields.device)
        self.show_played(self._played)

    def sizeHint(self) -> QSize:
        return QSize(440, 380)

    def minimumSizeHint(self) -> QSize:
        # Fields scroll down, never sideways.
        bar = self.style().pixelMetric(QtWidgets.QStyle.PixelMetric.PM_ScrollBarExtent)
        return QSize(self._content.minimumSizeHint().width() + bar, 0).expandedTo(_LEAST)

    def show_state(self, design: Design, view: View) -> None:
        self._unit = amplitude_unit(design)
        self._in_volts = design.actuated is not None
        if design.limb != self._limb:
            # The places are the same, but have other names.
            self._limb = design.limb
            self._make_rows(dict(self._played.wired))
            self.show_played(self._played)

    def show_played(self, played: Played) -> None:
        """Take over what is played and how loud; called while the panel is visible."""
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
        self._show_text(played)

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
            row.output_requested.connect(self._wire)
            row.tone_requested.connect(self.tone_requested)

    def _meaning(self, played: Played) -> str:
        """Return what a gain of 0 dB means, and whether it is calibrated."""
        if not played.rig_title or played.output.stand_in:
            return (
                f"At a gain of 0 dB an amplitude of 1{_gap(self._unit)} is full scale. "
                "Uncalibrated: what reaches the skin depends on amplifier and actuator."
            )
        calibration = f"{played.calibration[:1].upper()}{played.calibration[1:]}."
        if self._in_volts:
            return f"At a gain of 0 dB the actuators get the volts of the design. {calibration}"
        return f"At a gain of 0 dB an amplitude of 1{_gap(self._unit)} is full scale. {calibration}"

    def _wire(self, place: int, output: int) -> None:
        """Give a place an output; the place that had it gets the other's."""
        before = dict(self._played.wired)
        pairs = {**dict(self._played.output.outputs), **before}
        other = next(
            (mapped_place for mapped_place, number in pairs.items() if number == output), None
        )
        if other is not None and other != place:
            pairs[other] = pairs[place]
        pairs[place] = output
        outputs = tuple(sorted(pairs.items()))
        self.output_requested.emit(replace(self._played.output, outputs=outputs))

    def _show_text(self, played: Played) -> None:
        sentences = []
        if not played.wired:
            sentences.append(_NOT_WIRED if played.rig_title else _NO_INPUTS)
        if played.output.stand_in:
            sentences.append(
                f"All frequencies sound {played.output.shift_hz:g} Hz higher than they are felt."
            )
        sentences.append(self._meaning(played))
        if played.delay is not None:
            sentences.append(f"{played.delay.text}.")
        if played.levels is not None:
            sentences.append(
                "The device never ran out of samples."
                if not played.underruns
                else f"The device ran out of samples {played.underruns} times: ask for a longer "
                "delay."
            )
        elif not played.missing and not played.playing:
            sentences.append(f"Press {shortcut_text('play')} to play.")
        text = "\n".join(sentences)
        if text != self.text.text():
            self.text.setText(text)


def _gap(unit: str) -> str:
    return f" {unit}" if unit != "×" else ""
