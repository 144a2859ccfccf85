"""Rig, device, gain, channel map and levels."""

from dataclasses import replace
from functools import partial
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, Qt, Signal

from skinsource.lab.playing.devices import (
    LEAST_SHIFT_HZ,
    LONGEST_LATENCY_S,
    MOST_OUTPUTS,
    MOST_SHIFT_HZ,
    SHORTEST_LATENCY_S,
    Output,
)
from skinsource.lab.playing.stream import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource.limbs.locations import input_name
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, Spec, SwitchSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid, LabelledCell
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.rig_field import RigField
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.fitting import fit_to_letters
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.layouts import in_column, in_row, show_tooltip
from skinsource_gui.qt.theme import UNIT_PX, set_tone, tabular
from skinsource_gui.state.playing import Played

_NUMBER_PX, _OUTPUT_NUMBER_PX, _METER_PX = 88, 56, 8
_SYSTEM = "System default"
_BETWEEN = "\n"
_DELAY = NumberSpec(
    label="Latency",
    unit="s",
    minimum=SHORTEST_LATENCY_S,
    maximum=LONGEST_LATENCY_S,
    step=0.001,
    hint="Shorter: edits are felt sooner, but playback may drop out",
)
_GAIN = NumberSpec(
    label="Gain",
    unit="dB",
    minimum=LOWEST_DB,
    maximum=HIGHEST_DB,
    step=1.0,
    hint=f"How strongly it is played; each session starts at {START_DB:g} dB",
)
_SHIFT = NumberSpec(
    label="Shift",
    unit="Hz",
    minimum=LEAST_SHIFT_HZ,
    maximum=MOST_SHIFT_HZ,
    step=10.0,
    hint="Hertz that are added to all frequencies",
)
_EARS = SwitchSpec(
    label="Audible preview",
    hint="Without actuators: all channels in stereo, with frequencies shifted up",
)
# By the fields of `Output`.
_OTHERS: tuple[tuple[str, Spec], ...] = (
    ("sample_rate_hz", ChoiceSpec(label="Sample rate", options=())),
    ("latency_s", _DELAY),
    ("stand_in", _EARS),
    ("shift_hz", _SHIFT),
)


class DeviceFields(QObject):
    """Fields of rig, device and gain, and what is folded of them.

    Attributes
    ----------
    main, details
        The fields that are always in sight, and the others.
    """

    #: The chosen `Output`.
    output_requested = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self._output = Output()
        self._played: tuple[object, ...] = ()
        self.rig = RigField()
        self.edit_rig = tool_button(None, "edit_rig", "Edit…", "Places, outputs, volts and limits")
        self.device = ChoiceField(ChoiceSpec(label="Device", options=(("", _SYSTEM),)))
        self.device.edited.connect(self._choose_device)
        self.rescan = tool_button(
            None, "look_for_devices", "Refresh", "Look for new devices; this stops playback"
        )
        self.gain = NumberField(_GAIN, widest_unit=_GAIN.unit)
        fit_to_letters(self.gain, _NUMBER_PX)
        self.cells = {name: FieldCell(name, spec, edited=self._edit) for name, spec in _OTHERS}
        grid = FieldGrid()
        grid.show_cells(list(self.cells.values()))
        self.main = FieldGrid()
        # As high as its rows, in a low panel too.
        policy = QtWidgets.QSizePolicy.Policy
        self.main.setSizePolicy(policy.Preferred, policy.Fixed)
        rig = _cell("Rig", self.rig, self.edit_rig)
        self.main.show_cells([rig, _cell("Device", self.device), _cell("Gain", self.gain)])
        self.details = QtWidgets.QWidget()
        in_column(grid, of=self.details, margins=0)

    def show_played(self, played: Played, rig_title: str | None) -> None:
        """Take over the chosen output, what can be chosen, and the rig of the design."""
        self.gain.set_value(played.gain_db)
        shown = played.output, played.devices, played.rates_hz, rig_title
        if shown == self._played:
            return
        self._played, self._output = shown, played.output
        devices = [(_key(each.name, each.host_api), each.title) for each in played.devices]
        _fill(self.device, [("", _SYSTEM), *devices], _key_of(played))
        rates = sorted({*played.rates_hz, played.output.sample_rate_hz})
        rate_options = [(str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in rates]
        rate: Any = self.cells["sample_rate_hz"].field
        _fill(rate, rate_options, str(played.output.sample_rate_hz))
        self.rig.show_rig(rig_title)
        for name in ("latency_s", "stand_in", "shift_hz"):
            self.cells[name].set_value(getattr(played.output, name))
        self.cells["shift_hz"].setEnabled(played.output.stand_in)

    def _choose_device(self, key: str, _gesture: int | None) -> None:
        name, _, host_api = key.partition(_BETWEEN)
        self.output_requested.emit(replace(self._output, device=name, host_api=host_api))

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        changed: dict[str, Any] = {name: int(value) if name == "sample_rate_hz" else value}
        self.output_requested.emit(replace(self._output, **changed))


def _cell(title: str, field: QtWidgets.QWidget, *buttons: QtWidgets.QWidget) -> LabelledCell:
    """Return a field and perhaps a button; a list takes the room that is left."""
    cell, wide = LabelledCell(title), isinstance(field, ChoiceField)
    field.setObjectName(f"{title.lower()}_field")
    cell.label.setBuddy(field)
    cell.stack.addLayout(in_row((field, int(wide)), *buttons, *([] if wide else [None])))
    return cell


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


_WIDEST_LEVEL = "\u2212100.0 dBFS"
_SILENT_DB = -200.0
# Ends of the bar of RMS, and the peak above which it is amber, dB of full scale.
_METER_DB, _NEAR_DB = (-60, 0), -3.0


class OutputRow:
    """One place of the design: its level, and unfolded the output that drives it and a test tone.

    Attributes
    ----------
    widgets
        From left to right.
    """

    def __init__(self, place: int, limb: str) -> None:
        names = input_name(place, limb)
        self.place = place
        title = FittingLabel()
        title.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        title.show_phrases((f"{place} · {names.name}", f"{place} · {names.short_name}", f"{place}"))
        title.setToolTip(names.name)
        self.meter, self.level = QtWidgets.QProgressBar(), QtWidgets.QLabel()
        self.meter.setRange(*_METER_DB)
        self.meter.setTextVisible(False)
        self.meter.setFixedHeight(_METER_PX)
        self.level.setFont(tabular(self.level.font()))
        self.level.setObjectName(f"level_of_{place}")
        spec = NumberSpec(
            label=f"Output of place {place}", minimum=1, maximum=MOST_OUTPUTS, whole=True
        )
        self.output = NumberField(spec, widest_unit="")
        self.output.setObjectName(f"output_of_{place}")
        self.output.setAccessibleName(spec.label)
        self.output.setToolTip("Output of the device that its actuator is wired to")
        fit_to_letters(self.output, _OUTPUT_NUMBER_PX)
        self.tone = tool_button(None, f"tone_of_{place}", "Tone")
        self.widgets: tuple[QtWidgets.QWidget, ...] = (
            title,
            self.meter,
            self.level,
            self.output,
            self.tone,
        )

    def show_played(self, output: int, played: Played) -> None:
        """Show its output, how loud that is, and whether a tone can be played on it."""
        self.output.set_value(float(output))
        self.output.setEnabled(not played.output.stand_in and not played.rig_title)
        off = played.actuators == "off"
        self.tone.setEnabled(not off)
        self.tone.setAccessibleName(f"Test tone on output {output}, place {self.place}")
        tone = f"0.6 s of 100 Hz on output {output} alone, to find its actuator"
        show_tooltip(self.tone, "Arm the actuators first" if off else tone)
        levels, text = played.levels, ""
        rms_db = peak_db = _SILENT_DB
        if levels is not None and output <= levels.rms_db.size:
            rms_db, peak_db = float(levels.rms_db[output - 1]), float(levels.peak_db[output - 1])
            highest_db = float(levels.highest_db[output - 1])
            text = "silent" if highest_db <= _SILENT_DB else f"{highest_db:z.1f} dBFS"
        self.meter.setValue(round(max(rms_db, _METER_DB[0])))
        set_tone(self.meter, "warning" if peak_db > _NEAR_DB else "")
        self.level.setText(text.replace("-", "\u2212"))
        # Room for any level while there is one: otherwise rows would jump.
        room_px = self.level.fontMetrics().horizontalAdvance(_WIDEST_LEVEL) if levels else 0
        self.level.setMinimumWidth(room_px)


class OutputRows(QtWidgets.QWidget):
    """A row for each place of the design."""

    #: The `Output` with other outputs for places.
    output_requested = Signal(object)
    #: The output that is to play a tone.
    tone_requested = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self._played, self._limb, self._unfolded = Played(), "", False
        self.rows: list[OutputRow] = []
        self._table = QtWidgets.QGridLayout(self)
        self._table.setContentsMargins(0, 0, 0, 0)
        self._table.setColumnStretch(1, 1)
        self._table.setHorizontalSpacing(UNIT_PX)

    def show_limb(self, limb: str) -> None:
        """Name the places as a limb does."""
        if limb != self._limb:
            self._limb = limb
            self._make_rows()

    def unfold(self, unfolded: bool) -> None:
        """Show outputs and test tones as well, or levels alone."""
        self._unfolded = unfolded
        for row in self.rows:
            row.output.setVisible(unfolded)
            row.tone.setVisible(unfolded)

    def show_played(self, played: Played) -> None:
        """Take over what is played and how loud."""
        self._played, wired = played, dict(played.wired)
        if [row.place for row in self.rows] != list(wired):
            self._make_rows()
        for row in self.rows:
            row.show_played(wired[row.place], played)

    def _make_rows(self) -> None:
        for row in self.rows:
            for widget in row.widgets:
                self._table.removeWidget(widget)
                widget.deleteLater()
        self.rows = [OutputRow(place, self._limb) for place, _ in self._played.wired]
        for number, row in enumerate(self.rows):
            for column, widget in enumerate(row.widgets):
                self._table.addWidget(widget, number, column)
            row.output.edited.connect(partial(self._wire, row.place))
            row.tone.clicked.connect(partial(self._play_tone, row))
        self.unfold(self._unfolded)

    def _play_tone(self, row: OutputRow) -> None:
        self.tone_requested.emit(round(row.output.value_si))

    def _wire(self, place: int, output: float, _gesture: int | None) -> None:
        """Give a place an output; the place that had it gets the other's."""
        pairs = {**dict(self._played.output.outputs), **dict(self._played.wired)}
        number = round(output)
        other = next((mapped for mapped, taken in pairs.items() if taken == number), None)
        if other is not None:
            pairs[other] = pairs[place]
        pairs[place] = number
        outputs = tuple(sorted(pairs.items()))
        self.output_requested.emit(replace(self._played.output, outputs=outputs))
