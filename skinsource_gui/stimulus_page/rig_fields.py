"""Which rig a stimulus is exported for, and through which equaliser."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.equalising import Equaliser, RegularisedInverse
from skinsource.errors import SkinSourceError
from skinsource.rigs import SUFFIX, Rig, open_rig
from skinsource_gui.stimulus_page import form_fields as specs
from skinsource_gui.widgets.fields.choice_field import ChoiceField

_KEPT = "kept"


class RigFields(QObject):
    """A list to choose a rig file with, and one for the equaliser, which takes a rig.

    Attributes
    ----------
    rig_field, equaliser_field
        The lists.
    rig
        What the file holds; None without one.
    """

    changed = Signal()
    #: Why a file was not taken.
    refused = Signal(str)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._owner = parent
        self.rig: Rig | None = None
        self.rig_field = ChoiceField(specs.RIG)
        self.equaliser_field = ChoiceField(specs.EQUALISER)
        self.rig_field.setObjectName("stimulus_rig")
        self.equaliser_field.setObjectName("stimulus_equaliser")
        self.rig_field.chosen.connect(self._choose)
        self.equaliser_field.chosen.connect(self.changed)

    @property
    def equaliser(self) -> Equaliser | None:
        """The equaliser that was chosen; none without a rig."""
        phase = self.equaliser_field.value
        if self.rig is None or phase == "none":
            return None
        return RegularisedInverse(phase=phase)

    def _choose(self, option: str) -> None:
        if option == "file":
            self._ask()
        elif option == "none":
            self.rig = None
            self.changed.emit()

    def _ask(self) -> None:
        """Ask for a file; the rig that there was stays where there is no other."""
        name, _ = QFileDialog.getOpenFileName(
            self._owner, "Choose a rig", "", f"Rigs (*{SUFFIX});;All files (*)"
        )
        try:
            found = open_rig(Path(name)) if name else None
        except SkinSourceError as error:
            self._show()
            self.refused.emit(str(error))
            return
        if found is not None:
            self.rig = found
            index = self.rig_field.findData(_KEPT)
            title = found.title or Path(name).stem
            if index < 0:
                self.rig_field.insertItem(1, title, _KEPT)
            else:
                self.rig_field.setItemText(index, title)
        self._show()
        self.changed.emit()

    def _show(self) -> None:
        self.rig_field.set_value("none" if self.rig is None else _KEPT)
