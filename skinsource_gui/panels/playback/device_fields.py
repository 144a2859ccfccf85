"""Fields of the device: which, at which rate, how late."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, QSignalBlocker, Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QToolButton, QWidget

from skinsource.lab.playing.devices import (
    LEAST_SHIFT_HZ,
    LONGEST_LATENCY_S,
    MOST_SHIFT_HZ,
    SHORTEST_LATENCY_S,
    Output,
)
from skinsource.specs.fields import ChoiceSpec, NumberSpec
from skinsource_gui.played import Played
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.rig_field import RigField
from skinsource_gui.widgets.room.letter_width import LetterWidth

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
    """Rows of a grid: words on the left, fields on the right."""

    #: The `Output` that is wanted.
    output_wanted = Signal(object)
    devices_wanted = Signal()
    #: The rig file that is wanted, `Path`, or None.
    rig_wanted = Signal(object)

    def __init__(self, grid: QGridLayout) -> None:
        super().__init__()
        self._output = Output()
        self._shown: tuple[object, ...] = ()
        self.device = ChoiceField(ChoiceSpec(label="Device", options=(("", _SYSTEM),)))
        self.device.chosen.connect(self._choose_device)
        self.look = QToolButton()
        self.look.setText("Look again")
        self.look.setObjectName("look_for_devices")
        self.look.setToolTip("Look for devices that were connected since; ends what is played")
        self.look.clicked.connect(self.devices_wanted)
        self.rate = ChoiceField(ChoiceSpec(label="Sample rate", options=()))
        self.rate.chosen.connect(self._choose_rate)
        self.latency = NumberField(_LATENCY)
        self.latency.setToolTip(_LATENCY.hint)
        self.latency.edited.connect(self._choose_latency)
        self.stand_in = QToolButton()
        self.stand_in.setText("Stand-in for the ears")
        self.stand_in.setCheckable(True)
        self.stand_in.setObjectName("stand_in")
        self.stand_in.setToolTip(
            "For people without actuators: all channels, from left to right in their order, with "
            "all frequencies shifted up by as many hertz"
        )
        self.stand_in.clicked.connect(self._choose_stand_in)
        self.shift = NumberField(_SHIFT)
        self.shift.setToolTip(_SHIFT.hint)
        self.shift.edited.connect(self._choose_shift)
        self.rig = RigField()
        self.rig.wanted.connect(self.rig_wanted)
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
        delay = _row(self.latency, self.look)
        rows: tuple[tuple[str, QWidget], ...] = (
            ("Device", self.device),
            ("Sample rate", self.rate),
            ("Delay asked for", delay),
            ("Rig", self.rig),
        )
        for row, (words, part) in enumerate(rows):
            grid.addWidget(QLabel(words), row, 0)
            grid.addWidget(part, row, 1)
        # A column of the grid would be as wide as these words: fields would have what is left.
        grid.addWidget(_row(self.stand_in, QLabel("shift"), self.shift), 4, 0, 1, 2)

    def show_played(self, played: Played) -> None:
        """Take over what is chosen, and what can be."""
        shown = played.output, played.devices, played.rates_hz, played.rig_title
        if shown == self._shown:
            return
        self._shown, self._output = shown, played.output
        options = [("", _SYSTEM)]
        options += [(_key(one.name, one.host_api), one.title) for one in played.devices]
        _fill(self.device, options, _key_of(played))
        rates = sorted({*played.rates_hz, played.output.sample_rate_hz})
        words = [(str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in rates]
        _fill(self.rate, words, str(played.output.sample_rate_hz))
        self.rig.show_rig(played.rig_title or None)
        self.latency.set_value(played.output.latency_s)
        self.shift.set_value(played.output.shift_hz)
        self.shift.setEnabled(played.output.stand_in)
        self.stand_in.setChecked(played.output.stand_in)

    def _choose_device(self, key: str, _gesture: int | None) -> None:
        name, _, host_api = key.partition(_BETWEEN)
        self._want(device=name, host_api=host_api)

    def _choose_rate(self, rate: str, _gesture: int | None) -> None:
        self._want(sample_rate_hz=int(rate))

    def _choose_latency(self, latency_s: float, _gesture: int | None) -> None:
        self._want(latency_s=latency_s)

    def _choose_stand_in(self, on: bool) -> None:
        self._want(stand_in=on)

    def _choose_shift(self, shift_hz: float, _gesture: int | None) -> None:
        self._want(shift_hz=shift_hz)

    def _want(self, **changes: Any) -> None:
        self.output_wanted.emit(replace(self._output, **changes))


def _row(*parts: QWidget) -> QWidget:
    """Widgets beside each other, as wide as they like to be."""
    row = QWidget()
    layout = QHBoxLayout(row)
    layout.setContentsMargins(0, 0, 0, 0)
    for part in parts:
        layout.addWidget(part)
    layout.addStretch(1)
    return row


def _key(name: str, host_api: str) -> str:
    return f"{name}{_BETWEEN}{host_api}" if name else ""


def _key_of(played: Played) -> str:
    """That of the chosen device; where no system of it was chosen, of the first of its name."""
    output = played.output
    for one in played.devices:
        if one.name == output.device and output.host_api in ("", one.host_api):
            return _key(one.name, one.host_api)
    return _key(output.device, output.host_api)


def _fill(field: ChoiceField, options: list[tuple[str, str]], chosen: str) -> None:
    """Offer other choices."""
    with QSignalBlocker(field):
        field.clear()
        for option, words in options:
            field.addItem(words, option)
        field.set_value(chosen)
