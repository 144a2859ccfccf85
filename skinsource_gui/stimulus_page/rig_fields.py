"""Which rig a stimulus is exported for, and through which equaliser."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.design import Design
from skinsource.equalising import Equaliser, RegularisedInverse
from skinsource.errors import SkinSourceError
from skinsource.rigs import Rig, open_rig
from skinsource_gui.stimulus_page import form_fields as specs
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.rig_field import RigField

_PREDICTED = "predicted"


class RigFields(QObject):
    """A list to choose a rig file with, and one for the equaliser.

    An equaliser takes a rig, or actuators that the design is predicted through.

    Attributes
    ----------
    rig_field, equaliser_field
        The lists.
    rig, path
        What the file holds, and where it is; None without one.
    """

    changed = Signal()
    #: Why a file was not taken.
    refused = Signal(str)

    def __init__(self, design: Design, parent: QWidget) -> None:
        super().__init__(parent)
        self._actuated = design.actuated
        self.rig: Rig | None = None
        self.path: Path | None = None
        self.rig_field = RigField()
        self.equaliser_field = ChoiceField(specs.EQUALISER)
        if self._actuated is not None and self._actuated.equaliser is not None:
            self.equaliser_field.insertItem(1, "As predicted", _PREDICTED)
            self.equaliser_field.set_value(_PREDICTED)
        self.rig_field.setObjectName("stimulus_rig")
        self.equaliser_field.setObjectName("stimulus_equaliser")
        self.rig_field.wanted.connect(self.take)
        self.equaliser_field.chosen.connect(self.changed)

    @property
    def can_equalise(self) -> bool:
        """Whether it is known what an equaliser would be made for."""
        volts = self._actuated is not None and self._actuated.equaliser is None
        return not volts and (self.rig is not None or self._actuated is not None)

    @property
    def equaliser(self) -> Equaliser | None:
        """The equaliser that was chosen."""
        chosen = self.equaliser_field.value
        if not self.can_equalise or chosen == "none":
            return None
        if chosen == _PREDICTED and self._actuated is not None:
            return self._actuated.equaliser
        return RegularisedInverse(phase=chosen)

    def take(self, path: Path | None) -> None:
        """Export for the rig of a file; None: for none."""
        try:
            found = None if path is None else open_rig(path)
        except SkinSourceError as error:
            self.refused.emit(str(error))
            return
        self.rig, self.path = found, path
        title = None if found is None or path is None else found.title or path.stem
        self.rig_field.show_rig(title)
        self.changed.emit()
