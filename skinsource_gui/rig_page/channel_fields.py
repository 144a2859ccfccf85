"""The fields of one channel of a rig, and of its limits."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from skinsource.actuators.catalog import names, profile, shape_names
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import RigChannel
from skinsource.base.errors import InvalidInputError
from skinsource.limbs.locations import input_words
from skinsource.specs.fields import ChoiceSpec, NumberSpec, OptionalSpec, Spec, specs_of
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.field_grid import FieldGrid
from skinsource_gui.widgets.page_button import page_button

_LIMIT = "limit "
_OWN = (
    "place", "actuator", "device", "output", "full_scale_v", "amplifier_gain", "polarity",
    "delay_s", "measured_on",
)  # fmt: skip


class ChannelFields(QObject):
    """Cells for a channel; 0 stands for what is not known.

    Attributes
    ----------
    widget
        Where they stand.
    measured, measure, from_file, forget
        What is known of the response, and the buttons that measure it, take it from a file, or
        forget it.
    """

    #: The new `RigChannel`.
    edited = Signal(object)
    #: Why a value was not taken.
    refused = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._channel: RigChannel | None = None
        specs = {name: spec for name, spec in specs_of(RigChannel).items() if name in _OWN}
        specs["actuator"] = _actuators()
        limits = {f"{_LIMIT}{name}": spec for name, spec in specs_of(Limits).items()}
        self._cells = {name: _cell(name, spec) for name, spec in {**specs, **limits}.items()}
        for cell in self._cells.values():
            cell.edited.connect(self._edit)
        self.measured = QLabel()
        self.measured.setObjectName("rig_measured")
        self.measured.setWordWrap(True)
        self.from_file = page_button(
            "rig_from_file",
            "Response from a file…",
            "A table with frequency_hz, gain and phase, or sound with the voltage of a sweep and "
            "what the accelerometer said",
        )
        self.measure = page_button(
            "rig_measure",
            "Measure…",
            "Play a sweep on this output, and record an accelerometer on an input of the device",
        )
        self.forget = page_button("rig_forget", "Forget the response", "As if it was not measured")
        self.widget = self._laid_out()

    def cell(self, name: str) -> FieldCell:
        """The cell of a field of the channel, or of ``"limit "`` and one of its limits."""
        return self._cells[name]

    def show_channel(self, channel: RigChannel | None) -> None:
        """Show these values; None: there is no channel."""
        self._channel = channel
        self.widget.setEnabled(channel is not None)
        # Without one, what the first would begin with.
        channel = channel or RigChannel(place=1, output=1)
        for name, cell in self._cells.items():
            cell.set_value(_shown(_value(channel, name)))
        points = () if channel.measured is None else channel.measured.points
        self.measured.setText(
            f"Response: {len(points)} points, {points[0][0]:.4g} to {points[-1][0]:.4g} Hz"
            if points
            else "Response: not measured, so m/s² are not known"
        )
        self.forget.setEnabled(bool(points))

    def _laid_out(self) -> QWidget:
        found = QWidget()
        column = QVBoxLayout(found)
        column.setContentsMargins(0, 0, UNIT_PX, 0)
        own, limits = FieldGrid(), FieldGrid()
        own.show_cells([self._cells[name] for name in _OWN])
        limits.show_cells([cell for name, cell in self._cells.items() if name.startswith(_LIMIT)])
        heading = QLabel("Limits at the actuator; 0: not known")
        parts = (own, self.measured, self.measure, self.from_file, self.forget, heading, limits)
        for part in parts:
            column.addWidget(part)
        column.addStretch(1)
        return found

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        channel = self._channel
        if channel is None:
            return
        try:
            if name.startswith(_LIMIT):
                field = name.removeprefix(_LIMIT)
                limits = replace(channel.limits, **{field: value or None})
                after = replace(channel, limits=limits)
            else:
                optional = isinstance(specs_of(RigChannel)[name], OptionalSpec)
                changed: dict[str, Any] = {name: (value or None) if optional else value}
                after = replace(channel, **changed)
        except InvalidInputError as error:
            self.show_channel(channel)
            self.refused.emit(str(error))
            return
        if after != channel:
            self.edited.emit(after)


def title_of(channel: RigChannel, limb: str) -> str:
    """Words for a channel in a list; places are called what the limb calls them."""
    return f"{channel.place} · {input_words(channel.place, limb).name}, output {channel.output}"


def _cell(name: str, spec: Spec) -> FieldCell:
    of = spec.of if isinstance(spec, OptionalSpec) else spec
    if isinstance(spec, OptionalSpec) and isinstance(of, NumberSpec):
        hint = f"{spec.hint}; 0: not known"
        of = replace(of, label=spec.label, minimum=0.0, logarithmic=False, hint=hint)
    return FieldCell(name, of)


def _actuators() -> ChoiceSpec:
    listed = tuple((name, profile(name).title) for name in (*names(), *shape_names()))
    return ChoiceSpec(
        label="Actuator",
        options=(("", "Not listed"), *listed),
        hint="What the library knows of it: its limits, and how it moves where it was not measured",
    )


def _value(channel: RigChannel, name: str) -> Any:
    if name.startswith(_LIMIT):
        return getattr(channel.limits, name.removeprefix(_LIMIT))
    return getattr(channel, name)


def _shown(value: Any) -> Any:
    return 0.0 if value is None else value
