"""Rig, device, gain, channel map and levels."""

from dataclasses import replace
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, QSize, Qt, Signal

from skinsource.lab.playing.devices import (
    LEAST_SHIFT_HZ,
    LONGEST_LATENCY_S,
    MOST_OUTPUTS,
    MOST_SHIFT_HZ,
    SHORTEST_LATENCY_S,
    Output,
)
from skinsource.lab.playing.mix import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource.limbs.locations import LocationNames, input_name
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.rig_field import RigField
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.fitting import LetterWidth
from skinsource_gui.qt.labels import FittingLabel, LevelMeter
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX, tabular
from skinsource_gui.qt.tooltips import show_tooltip
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
GAIN = NumberSpec(
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
    hint="How many hertz higher everything sounds",
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
    devices_requested = Signal()
    #: The chosen rig file, `Path`, or None.
    rig_requested = Signal(object)
    #: The new gain, dB.
    gain_requested = Signal(float)

    def __init__(self) -> None:
        super().__init__()
        self._output = Output()
        self._played: tuple[object, ...] = ()
        self.rig = RigField()
        self.rig.rig_chosen.connect(self.rig_requested)
        self.edit_rig = tool_button(None, "edit_rig", "Edit…", "Places, outputs, volts and limits")
        self.device = ChoiceField(ChoiceSpec(label="Device", options=(("", _SYSTEM),)))
        self.device.edited.connect(self._choose_device)
        self.rescan = tool_button(
            None, "look_for_devices", "Look again", "Look for new devices; ends what is played"
        )
        self.rescan.clicked.connect(self.devices_requested)
        self.gain = NumberField(GAIN, widest_unit=GAIN.unit)
        self.gain.edited.connect(lambda gain_db, _: self.gain_requested.emit(gain_db))
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
            None, "stand_in", "Play for the ears", stand_in_hint, checkable=True
        )
        self.stand_in.clicked.connect(lambda on: self._want(stand_in=on))
        self.shift = NumberField(_SHIFT)
        self.shift.setToolTip(_SHIFT.hint)
        self.shift.edited.connect(lambda shift_hz, _: self._want(shift_hz=shift_hz))
        for widget, name in (
            (self.device, "device"),
            (self.rig, "rig"),
            (self.gain, "gain"),
            (self.rate, "sample_rate"),
            (self.latency, "latency"),
            (self.shift, "shift"),
        ):
            widget.setObjectName(f"{name}_field")
            widget.setAccessibleName(name.replace("_", " ").capitalize())
        for field in (self.gain, self.latency, self.shift):
            LetterWidth(field, _NUMBER_PX)
        self.main = _form(
            ("Rig", in_row((self.rig, 1), self.edit_rig)),
            ("Device", self.device),
            ("Gain", in_row(self.gain, None)),
        )
        self.details = _form(
            ("Devices", in_row(self.rescan, None)),
            ("Sample rate", self.rate),
            ("Delay", in_row(self.latency, None)),
            ("Ears", in_row(self.stand_in, None)),
            ("Shift", in_row(self.shift, None)),
        )

    def show_played(self, played: Played, rig_title: str | None) -> None:
        """Take over the chosen output, what can be chosen, and the rig of the design."""
        self.gain.set_value(played.gain_db)
        shown = played.output, played.devices, played.rates_hz, rig_title
        if shown == self._played:
            return
        self._played, self._output = shown, played.output
        options = [("", _SYSTEM)]
        options += [(_key(device.name, device.host_api), device.title) for device in played.devices]
        _fill(self.device, options, _key_of(played))
        rates = sorted({*played.rates_hz, played.output.sample_rate_hz})
        rate_options = [(str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in rates]
        _fill(self.rate, rate_options, str(played.output.sample_rate_hz))
        self.rig.show_rig(rig_title)
        self.latency.set_value(played.output.latency_s)
        self.shift.set_value(played.output.shift_hz)
        self.shift.setEnabled(played.output.stand_in)
        self.stand_in.setChecked(played.output.stand_in)

    def _choose_device(self, key: str, _gesture: int | None) -> None:
        name, _, host_api = key.partition(_BETWEEN)
        self._want(device=name, host_api=host_api)

    def _want(self, **changes: Any) -> None:
        self.output_requested.emit(replace(self._output, **changes))


def _form(*rows: tuple[str, QtWidgets.QWidget | QtWidgets.QLayout]) -> QtWidgets.QWidget:
    """Return rows of a label and a field."""
    widget = QtWidgets.QWidget()
    form = QtWidgets.QFormLayout(widget)
    form.setContentsMargins(0, 0, 0, 0)
    for label, field in rows:
        form.addRow(label, field)
    return widget


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
        self.tone = tool_button(None, f"tone_of_{place}", "Tone")
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

    def unfold(self, unfolded: bool) -> None:
        """Show output and test tone as well, or the level alone."""
        for widget in (self.output, self.tone):
            widget.setVisible(unfolded)

    def show_output(self, output: int) -> None:
        """Show another output."""
        self.output.set_value(float(output))
        self.tone.setAccessibleName(f"Test tone on output {output}, place {self.place}")

    def show_played(self, played: Played) -> None:
        """Show how loud its output is, and whether a tone can be heard on it."""
        self._offer_tone("" if played.actuators != "off" else "Arm the actuators first")
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


_METER_COLUMN = 2


class OutputRows(QtWidgets.QWidget):
    """A row for each place of the design: its level, and unfolded its output and a test tone."""

    #: The `Output` with other outputs for places.
    output_requested = Signal(object)
    #: The output that is to play a tone.
    tone_requested = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("output_rows")
        self._played, self._limb, self._unfolded = Played(), "", False
        self.rows: list[OutputRow] = []
        self._table = QtWidgets.QGridLayout(self)
        self._table.setContentsMargins(0, 0, 0, 0)
        self._table.setColumnStretch(_METER_COLUMN, 1)
        self._table.setHorizontalSpacing(UNIT_PX)

    def show_limb(self, limb: str) -> None:
        """Name the places as a limb does."""
        if limb != self._limb:
            self._limb = limb
            self._make_rows(dict(self._played.wired))

    def unfold(self, unfolded: bool) -> None:
        """Show outputs and test tones as well, or levels alone."""
        self._unfolded = unfolded
        for row in self.rows:
            row.unfold(unfolded)

    def show_played(self, played: Played) -> None:
        """Take over what is played and how loud."""
        self._played, wired = played, dict(played.wired)
        if [row.place for row in self.rows] != list(wired):
            self._make_rows(wired)
        for row in self.rows:
            row.show_output(wired[row.place])
            row.show_played(played)
            row.output.setEnabled(not played.output.stand_in and not played.rig_title)

    def _make_rows(self, wired: dict[int, int]) -> None:
        for row in self.rows:
            for widget in row.widgets:
                self._table.removeWidget(widget)
                widget.deleteLater()
        self.rows = [
            OutputRow(self._table, number, place, output, self._limb)
            for number, (place, output) in enumerate(wired.items())
        ]
        for row in self.rows:
            row.unfold(self._unfolded)
            row.output_requested.connect(self._wire)
            row.tone_requested.connect(self.tone_requested)

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
