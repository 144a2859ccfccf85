"""What a limb is called, how it was measured, and which file says what."""

from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QWidget,
)

from skinsource.design.labels import AXES
from skinsource.limbs.own_limbs import NAME_RULE
from skinsource.specs.fields import ChoiceSpec, NumberSpec
from skinsource_gui.theme import set_tone
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.name_line import NameLine
from skinsource_gui.widgets.page_button import page_button
from skinsource_gui.widgets.tooltips import tooltip

_AXES = ChoiceSpec(
    label="Axes",
    options=tuple((word.name, word.title) for word in AXES),
    hint="Along which each output measures, in the order of the file; z is normal to the skin",
)
_STARTING_AXES = "z"
_HIGHEST_RATE_HZ = 768_000.0


def _end_of_band(label: str, hint: str) -> NumberSpec:
    return NumberSpec(
        label=label, unit="Hz", minimum=0.0, maximum=_HIGHEST_RATE_HZ / 2.0, hint=hint
    )


_NUMBERS = {
    "sample_rate_hz": NumberSpec(label="Rate", unit="Hz", minimum=100.0, maximum=_HIGHEST_RATE_HZ),
    "hand_length_mm": NumberSpec(
        label="Hand length",
        unit="m",
        minimum=0.02,
        maximum=2.0,
        hint="From the tip of the middle finger to the middle of the wrist",
    ),
    "pre_trigger_delay_s": NumberSpec(
        label="Delay",
        unit="s",
        minimum=0.0,
        maximum=10.0,
        hint="How late the responses are",
    ),
    "lowest_hz": _end_of_band("Holds from", "Lowest frequency at which the responses hold"),
    "highest_hz": _end_of_band(
        "Holds up to", "Highest frequency at which the responses hold; 0: not known"
    ),
}
_BAND = ("lowest_hz", "highest_hz")
# A length is in metres here, as all that fields hold.
_METRES = 1e-3
_STARTS = {"sample_rate_hz": 4000.0, "hand_length_mm": 0.18}
_FILES = {
    "responses": ("Responses", "HDF5 as in docs/limbs.md, or an array: NPY, NPZ, MATLAB, HDF5"),
    "outline": ("Outline", "SVG, or CSV of x and y; without one a hull is drawn"),
    "inputs": ("Inputs", "CSV of x, y and name, or click them on a photograph"),
    "outputs": ("Outputs", "CSV of x, y and name, or click them on a photograph"),
    "photograph": ("Photograph", "A picture on which places are clicked"),
}

# What a file in the layout fills, and what is in it.
_Field = QLineEdit | NumberField | ChoiceField | QCheckBox
_Value = str | float | bool


def _value_of(field: _Field) -> _Value:
    if isinstance(field, QCheckBox):
        return field.isChecked()
    if isinstance(field, NumberField):
        return field.value_si
    return field.value if isinstance(field, ChoiceField) else field.text()


class LimbForm(QObject):
    """The fields at the left of the page.

    Attributes
    ----------
    widget
        Where they stand.
    """

    #: Something else was typed or chosen.
    changed = Signal()
    #: A file is wanted for this: "responses", "outline", "inputs", "outputs", "photograph".
    file_wanted = Signal(str)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.widget = QWidget(parent)
        self._rows = QFormLayout(self.widget)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self._chosen: dict[str, QLabel] = {}
        lines: list[QLineEdit] = [NameLine() for _ in range(4)]
        self.name, self.title, self.note, self.order = lines
        self.axes = ChoiceField(_AXES)
        self.axes.set_value(_STARTING_AXES)
        self.numbers = {name: NumberField(spec) for name, spec in _NUMBERS.items()}
        # What a file said, by its field: it goes with that file, unless it was changed since.
        self._said: dict[_Field, _Value] = {}
        self.left, self.mirrored = QCheckBox("Left hand"), QCheckBox("Show mirrored")
        self.synthetic = QCheckBox("Computed, not measured")
        self.mirrored.setToolTip(tooltip("Show mirrored", "A left hand as a right one"))
        self._lay_out()

    def show_file(self, what: str, words: str) -> None:
        """Say which file was chosen."""
        self._chosen[what].setText(words)

    def show_header(self, header: dict[str, Any]) -> None:
        """Take over what a file in the layout says; all of it can still be changed."""
        for field, key in ((self.name, "name"), (self.title, "title"), (self.note, "note")):
            field.setText(str(header[key]))
        self.axes.set_value(str(header["axes"]))
        said = {**header, **dict(zip(_BAND, header["band_hz"] or (0.0, 0.0), strict=True))}
        for name, field in self.numbers.items():
            field.set_value(float(said[name]) * (_METRES if name == "hand_length_mm" else 1.0))
        self.left.setChecked(header["hand"] == "left")
        self.synthetic.setChecked(bool(header["synthetic"]))
        self._said = {field: _value_of(field) for field in self._filled()}

    def show_plain(self, in_layout: bool, path: Path) -> None:
        """Ask for what an array does not say."""
        self._rows.setRowVisible(self.order, not in_layout)
        if in_layout:
            return
        self._forget_file()
        if not self.name.text():
            stem = "".join(one if one.isalnum() else "-" for one in path.stem.lower())
            self.name.setText(stem.strip("-0123456789")[:40])
            self._said[self.name] = self.name.text()

    def _filled(self) -> tuple[_Field, ...]:
        """What a file in the layout fills."""
        lines = self.name, self.title, self.note
        return *lines, self.axes, *self.numbers.values(), self.left, self.synthetic

    def _forget_file(self) -> None:
        unchanged = {field for field in self._said if _value_of(field) == self._said[field]}
        for line in (self.name, self.title, self.note):
            if line in unchanged:
                line.clear()
        if self.axes in unchanged:
            self.axes.set_value(_STARTING_AXES)
        for name, number in self.numbers.items():
            if number in unchanged:
                number.set_value(_STARTS.get(name, 0.0))
        for box in (self.left, self.synthetic):
            if box in unchanged:
                box.setChecked(False)
        self._said = {}

    def values(self) -> dict[str, Any]:
        """Fields of `skinsource.limbs.own_limbs.OwnLimb` as they are typed."""
        numbers = {name: field.value_si for name, field in self.numbers.items()}
        numbers["hand_length_mm"] /= _METRES
        lowest_hz, highest_hz = (numbers.pop(name) for name in _BAND)
        return {
            "name": self.name.text().strip(),
            "title": self.title.text().strip(),
            "note": self.note.text().strip(),
            "axes": self.axes.value,
            "left": self.left.isChecked(),
            "mirrored": self.mirrored.isChecked(),
            "synthetic": self.synthetic.isChecked(),
            "band_hz": (lowest_hz, highest_hz) if highest_hz > 0.0 else None,
            **numbers,
        }

    def _lay_out(self) -> None:
        self._add_file("responses")
        for label, field, hint in (
            ("Name", self.name, f"What designs call it: {NAME_RULE}"),
            ("Title", self.title, "What the window calls it; the name, if there is none"),
            ("Note", self.note, "What users should know of it"),
            ("Order", self.order, "Dimensions of the array: i input, o output, a axis, t tap"),
        ):
            field.setObjectName(f"limb_{label.lower()}")
            field.setAccessibleName(label)
            field.setToolTip(tooltip(label, hint))
            field.textChanged.connect(self.changed)
            self._rows.addRow(label, field)
        self.order.setPlaceholderText("ioat")
        self.axes.chosen.connect(self.changed)
        self._rows.addRow("Axes", self.axes)
        self.synthetic.setToolTip(
            tooltip("Computed", "Pictures and files say that it is synthetic")
        )
        self.synthetic.setAccessibleName("Responses are computed, not measured")
        self.synthetic.toggled.connect(self.changed)
        self._rows.addRow("Origin", self.synthetic)
        for name, field in self.numbers.items():
            field.setObjectName(f"limb_{name}")
            field.set_value(_STARTS.get(name, 0.0))
            field.edited.connect(self._take_number(field))
            self._rows.addRow(_NUMBERS[name].label, field)
        hands = QHBoxLayout()
        for box in (self.left, self.mirrored):
            box.toggled.connect(self.changed)
            hands.addWidget(box)
        hands.addStretch(1)
        self._rows.addRow("Hand", hands)
        for what in ("outline", "inputs", "outputs", "photograph"):
            self._add_file(what)

    def _take_number(self, field: NumberField) -> Any:
        def take(value: float, gesture: object) -> None:
            del gesture
            field.set_value(value)
            self.changed.emit()

        return take

    def _add_file(self, what: str) -> None:
        words, hint = _FILES[what]
        button: QPushButton = page_button(f"choose_{what}", "Choose…", hint)
        button.setAccessibleName(f"Choose {words.lower()}")
        button.clicked.connect(lambda: self.file_wanted.emit(what))
        chosen = QLabel("none")
        chosen.setObjectName(f"chosen_{what}")
        set_tone(chosen, "dim")
        self._chosen[what] = chosen
        row = QHBoxLayout()
        row.addWidget(button)
        row.addWidget(chosen, 1)
        self._rows.addRow(words, row)
