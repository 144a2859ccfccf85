"""Frequencies in equal steps or factors, instead of one by one."""

from PySide6.QtWidgets import QDialog, QDialogButtonBox, QFormLayout, QLabel, QWidget

from skinsource.design.waveforms import frequency_sweep
from skinsource.specs.fields import ChoiceSpec, ListSpec, NumberSpec
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.fields.typed_numbers import number_of, numbers_text

_SPACING = ChoiceSpec(
    label="Spacing",
    options=(("logarithmic", "Equal factors"), ("linear", "Equal steps")),
    hint="From each frequency to the next",
)
_ORDER = ChoiceSpec(
    label="Order",
    options=(("up", "Rising (contracts)"), ("down", "Falling (expands)")),
    hint="Low frequencies reach farther on the skin",
)
_MOST_SHOWN = 12


class SweepDialog(QDialog):
    """Asks for the ends of a sweep, how many frequencies, how spaced, and in which order."""

    def __init__(self, values: tuple[float, ...], spec: ListSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self._spec = spec
        self.setObjectName("sweep_dialog")
        self.setWindowTitle("Frequencies of a sweep")
        count = NumberSpec(
            label="Count", minimum=max(spec.fewest, 1), maximum=spec.most, whole=True
        )
        self.low = self._number("low_hz", number_of(spec), min(values, default=50.0))
        self.high = self._number("high_hz", number_of(spec), max(values, default=400.0))
        self.count = self._number("count", count, len(values) or 5)
        self.spacing = self._choice("spacing", _SPACING, "logarithmic")
        falls = len(values) > 1 and values[0] > values[-1]
        self.order = self._choice("order", _ORDER, "down" if falls else "up")
        self._list = QLabel()
        self._list.setObjectName("sweep_list")
        self._list.setWordWrap(True)
        self._list.setMinimumWidth(260)
        buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form = QFormLayout(self)
        rows = {
            "From": self.low,
            "To": self.high,
            "Count": self.count,
            "Spacing": self.spacing,
            "Order": self.order,
        }
        for words, field in rows.items():
            form.addRow(words, field)
        form.addRow(self._list)
        form.addRow(buttons)
        self._show_list()

    @property
    def values(self) -> tuple[float, ...]:
        """The frequencies, in Hz."""
        low, high = sorted((self.low.value_si, self.high.value_si))
        return frequency_sweep(
            low,
            high,
            round(self.count.value_si),
            "linear" if self.spacing.value == "linear" else "logarithmic",
            "down" if self.order.value == "down" else "up",
        )

    def _number(self, name: str, spec: NumberSpec, value: float) -> NumberField:
        field = NumberField(spec, self)
        field.setObjectName(f"{name}_sweep")
        field.setAccessibleName({"low_hz": "From", "high_hz": "To"}.get(name, spec.label))
        field.set_value(value)
        field.edited.connect(self._show_list)
        return field

    def _choice(self, name: str, spec: ChoiceSpec, value: str) -> ChoiceField:
        field = ChoiceField(spec, self)
        field.setObjectName(f"{name}_sweep")
        field.set_value(value)
        field.chosen.connect(self._show_list)
        return field

    def _show_list(self, *_: object) -> None:
        values = tuple(float(f"{one:.5g}") for one in self.values)
        more = f" … ({len(values)})" if len(values) > _MOST_SHOWN else ""
        self._list.setText(f"{numbers_text(values[:_MOST_SHOWN], self._spec)}{more} Hz")
