"""The fields of a measurement: the sensor, where it is wired, and the sweep."""

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import InvalidInputError
from skinsource.lab.rig_measuring import InputDevice, MeasuringSetup
from skinsource.specs.fields import ChoiceSpec, specs_of
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.field_grid import FieldGrid

_DEVICE = "input_device"
_SAME = ("", "The one played on, if it has inputs")


class MeasureFields(QObject):
    """Cells for a `MeasuringSetup`.

    Attributes
    ----------
    grid
        Where they stand.
    setup
        What they say.
    """

    #: Why a value was not taken.
    refused = Signal(str)
    #: `setup` is another one.
    changed = Signal()

    def __init__(self, setup: MeasuringSetup, parent: QObject) -> None:
        super().__init__(parent)
        self.setup = setup
        self.grid = FieldGrid()
        self._cells = {name: self._cell(name, spec) for name, spec in specs_of(setup).items()}
        self._cells[_DEVICE] = self._devices(())
        self._show()

    def cell(self, name: str) -> FieldCell:
        """The cell of a field."""
        return self._cells[name]

    def show_inputs(self, found: Sequence[InputDevice]) -> None:
        """Offer these devices to record from."""
        old = self._cells[_DEVICE]
        self._cells[_DEVICE] = self._devices(found)
        self._show()
        old.label.deleteLater()
        old.deleteLater()

    def _cell(self, name: str, spec: Any) -> FieldCell:
        found = FieldCell(name, spec)
        found.edited.connect(self._edit)
        return found

    def _devices(self, found: Sequence[InputDevice]) -> FieldCell:
        titles = dict.fromkeys(one.title for one in found)
        chosen = self.setup.input_device
        if chosen:
            # One that is not there now may come back.
            titles.setdefault(chosen)
        options = (_SAME, *((title, title) for title in titles))
        return self._cell(_DEVICE, ChoiceSpec(label="Input device", options=options))

    def _show(self) -> None:
        self.grid.show_cells(list(self._cells.values()))
        for name, cell in self._cells.items():
            cell.set_value(getattr(self.setup, name))

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        try:
            self.setup = replace(self.setup, **{name: value})
        except InvalidInputError as error:
            self.refused.emit(str(error))
            self._cells[name].set_value(getattr(self.setup, name))
        else:
            self.changed.emit()


def setup_text(setup: MeasuringSetup) -> str:
    """Write down what was said of the sensor and the sweep."""
    return json.dumps(asdict(setup))


def setup_of(text: str) -> MeasuringSetup:
    """Read what `setup_text` wrote; the usual one where that is something else."""
    try:
        return MeasuringSetup(**json.loads(text))
    except (ValueError, TypeError, RecursionError):
        # Nothing is kept yet, or by another version of the studio.
        return MeasuringSetup()
