"""What is matched, by whom, and where it is kept."""

from dataclasses import replace
from pathlib import Path

from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLineEdit, QWidget

from skinsource.base.errors import InvalidInputError
from skinsource.base.published import MOST_PLACES
from skinsource.base.quoting import quoted
from skinsource.lab.matching import MOST_AMPLITUDE, Procedure
from skinsource.lab.playing.mix import HIGHEST_DB, LOWEST_DB
from skinsource.specs.fields import NumberSpec
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.page_button import page_button
from skinsource_gui.widgets.room.letter_width import LetterWidth
from skinsource_gui.widgets.tooltips import tooltip

_NUMBERS = {
    "reference_hz": NumberSpec(label="Reference", unit="Hz", minimum=1.0, maximum=600.0, step=1.0),
    "reference_place": NumberSpec(
        label="Reference place", minimum=1, maximum=MOST_PLACES, whole=True
    ),
    "amplitude": NumberSpec(
        label="Drive",
        minimum=0.001,
        maximum=MOST_AMPLITUDE,
        step=0.05,
        hint="Of the reference; at a gain of 0 dB an amplitude of 1 is full scale of the device",
    ),
    "gain_db": NumberSpec(
        label="Gain",
        unit="dB",
        minimum=LOWEST_DB,
        maximum=HIGHEST_DB,
        step=1.0,
        hint="How loud all of it is played; it stays the same for all matches",
    ),
    "seed": NumberSpec(
        label="Seed",
        minimum=0,
        maximum=2**31 - 1,
        whole=True,
        hint="Of the order and the starts, which differ for each person",
    ),
}
_FIRST = {"reference_hz": 100.0, "reference_place": 7, "amplitude": 0.25, "seed": 1}
_TEXTS = {
    "person": ("Person", "", "Letters and digits; a number will do"),
    "frequencies": ("Frequencies (Hz)", "50, 100, 200, 300", "Of the tests, with commas between"),
    "places": ("Places", "7, 12, 17", "Of the tests: input places, with commas between"),
}
_MOST = 200
_NUMBER_PX = 140


class SetupForm(QWidget):
    """Fields of a procedure, and the table that matches are added to.

    Parameters
    ----------
    table
        The table at first.
    gain_db
        How loud at first.
    drive_unit
        Unit of the drive of the reference, on the limb that is played.
    """

    def __init__(self, table: Path, gain_db: float, drive_unit: str) -> None:
        super().__init__()
        self._form = form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self._texts: dict[str, QLineEdit] = {}
        for name, (label, text, hint) in _TEXTS.items():
            field = self._texts[name] = QLineEdit(text)
            field.setToolTip(tooltip(label, hint))
            self._add(name, label, field)
        self._numbers: dict[str, NumberField] = {}
        for name, spec in _NUMBERS.items():
            if name == "amplitude":
                spec = replace(spec, unit=drive_unit)
            number = self._numbers[name] = NumberField(spec)
            number.set_value(gain_db if name == "gain_db" else _FIRST[name])
            LetterWidth(number, _NUMBER_PX, at_most=True)
            number.setToolTip(tooltip(spec.label, spec.hint))
            self._add(name, spec.label, number)
        self.table = QLineEdit(str(table))
        self.table.setToolTip(
            tooltip("Table", "CSV that matches are added to; what it holds is not asked again")
        )
        self.browse = page_button("matching_browse", "Choose…", "Choose the table")
        row = QHBoxLayout()
        row.addWidget(self.table, 1)
        row.addWidget(self.browse)
        form.addRow("Table", row)
        self.table.setObjectName("matching_table")
        self.table.setAccessibleName("Table")

    @property
    def gain_db(self) -> float:
        """How loud it is played."""
        return self._numbers["gain_db"].value_si

    @property
    def path(self) -> Path:
        """The table.

        Raises
        ------
        InvalidInputError
            There is none.
        """
        text = self.table.text().strip()
        if not text:
            raise InvalidInputError("no table is named; choose one, or rehearse")
        path = Path(text).expanduser()
        return path if path.suffix else path.with_suffix(".csv")

    def field(self, name: str) -> QLineEdit:
        """The widget of a row."""
        return self._texts.get(name) or self._numbers[name]

    def procedure(self, limb: str) -> Procedure:
        """What the fields say, for designs of ``limb``.

        Raises
        ------
        InvalidInputError
            A field holds what cannot be.
        """
        numbers = {name: field.value_si for name, field in self._numbers.items()}
        return Procedure(
            person=self._texts["person"].text().strip(),
            frequencies_hz=tuple(self._listed("frequencies")),
            places=tuple(_whole(one) for one in self._listed("places")),
            reference_hz=float(numbers["reference_hz"]),
            reference_place=int(numbers["reference_place"]),
            amplitude=float(numbers["amplitude"]),
            seed=int(numbers["seed"]),
            limb=limb,
        )

    def _listed(self, name: str) -> list[float]:
        text = self._texts[name].text()
        words = [one for one in text.replace(";", ",").split(",") if one.strip()]
        try:
            if len(words) > _MOST:
                raise ValueError
            return [float(one) for one in words]
        except ValueError:
            raise InvalidInputError(
                f"{_TEXTS[name][0].lower()} are {quoted(text)}, expected numbers with commas "
                "between"
            ) from None

    def _add(self, name: str, label: str, field: QLineEdit) -> None:
        field.setObjectName(f"matching_{name}")
        field.setAccessibleName(label)
        self._form.addRow(label, field)


def _whole(value: float) -> int:
    if not value.is_integer():
        raise InvalidInputError(f"places hold {value:g}, expected whole numbers")
    return int(value)
