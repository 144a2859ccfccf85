"""The fields of an input."""

from dataclasses import replace

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication

from skinsource import edits
from skinsource.design import AMPLITUDE, ONSET, Input
from skinsource.edits.kinds import kind_name, kind_spec
from skinsource.fields import ChoiceSpec, specs_of
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.locations import INPUTS
from skinsource.waveforms import Waveform
from skinsource_gui.panels.inspector.field_grid import FieldGrid
from skinsource_gui.theme import LIGHT, Theme
from skinsource_gui.widgets.fields.field_cell import FieldCell, LabelledCell, WordsCell
from skinsource_gui.widgets.inputs.input_words import fixed_length_text

_PLACE = ChoiceSpec(
    label="Place",
    options=tuple((str(place.number), f"{place.number} · {place.name}") for place in INPUTS),
    hint="Where the actuator touches",
)


class InputFields(QObject):
    """Fields of an input in a grid: kind, the waveform's own, amplitude, onset, place.

    Attributes
    ----------
    grid
        Where they stand.
    kind, place
        Which tell by themselves what is chosen; all others by ``edited``.
    """

    #: Name of the field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._theme = LIGHT
        self._rate_hz = SAMPLE_RATE_HZ
        self._own: tuple[LabelledCell, ...] = ()
        self._built_for: type[Waveform] | None = None
        self.grid = FieldGrid()
        self.kind = FieldCell("kind", kind_spec())
        self.place = FieldCell("location", _PLACE)
        self._amplitude = FieldCell("amplitude", AMPLITUDE)
        self._onset = FieldCell("onset_s", ONSET)
        self._amplitude.edited.connect(self.edited)
        self._onset.edited.connect(self.edited)

    def show_input(self, one: Input, together: tuple[Input, ...], unit: str) -> None:
        """Show an input, and where those that are edited ``together`` differ.

        ``unit`` is that of the amplitude.
        """
        if type(one.waveform) is not self._built_for:
            self._build_own(one.waveform)
        self._amplitude.set_spec(replace(AMPLITUDE, unit=unit))
        for cell in self._fields():
            cell.set_value(_value(one, cell.name))
            cell.show_differs(len({_value(other, cell.name) for other in together} - {None}) > 1)

    def show_rate(self, sample_rate_hz: float) -> None:
        """Take over the rate of the limb, which says what frequencies can be played."""
        if self._rate_hz == sample_rate_hz:
            return
        self._rate_hz = sample_rate_hz
        specs = specs_of(self._built_for) if self._built_for else {}
        for cell in self._own:
            if isinstance(cell, FieldCell):
                cell.set_spec(specs[cell.name].at_rate(sample_rate_hz))

    def show_refused(self, one: Input, name: str, reason: str) -> None:
        """Show again what ``one`` has in this field, and why it stays so."""
        cell = next(cell for cell in self._fields() if cell.name == name)
        cell.set_value(_value(one, name))
        cell.show_reason(reason)

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        for cell in self._fields():
            cell.forget_typing()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        for cell in self._cells():
            cell.show_theme(theme)

    def _cells(self) -> tuple[LabelledCell, ...]:
        return (self.kind, *self._own, self._amplitude, self._onset, self.place)

    def _fields(self) -> list[FieldCell]:
        return [cell for cell in self._cells() if isinstance(cell, FieldCell)]

    def _build_own(self, waveform: Waveform) -> None:
        old, cells = self._own, []
        for name, spec in specs_of(waveform).items():
            cell = FieldCell(name, spec.at_rate(self._rate_hz))
            cell.edited.connect(self.edited)
            cells.append(cell)
        if fixed_length_text(waveform):
            cells.append(WordsCell("Duration", fixed_length_text(waveform)))
        self._own = tuple(cells)
        self._built_for = type(waveform)
        for cell in cells:
            cell.show_theme(self._theme)
        focused = QApplication.focusWidget()
        if focused is not None and any(cell.isAncestorOf(focused) for cell in old):
            self.kind.field.setFocus(Qt.FocusReason.OtherFocusReason)
        self.grid.show_cells(self._cells())
        for part in (widget for cell in old for widget in (cell.label, cell)):
            part.deleteLater()


def _value(one: Input, name: str) -> object:
    """What the cell of this name shows of an input; None where it has no such field."""
    if name == "kind":
        return kind_name(one.waveform)
    if name == "location":
        return str(one.location)
    return edits.value_of(one, name) if name in edits.fields_of(one) else None
