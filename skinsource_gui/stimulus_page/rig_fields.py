"""For which rig or actuator a stimulus is exported, and through which equaliser."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.catalog import load, profile
from skinsource.actuators.equalising import (
    Equaliser,
    PolePairReplacement,
    RegularisedInverse,
    resonance_of,
)
from skinsource.actuators.rigs import Rig, open_rig
from skinsource.base.errors import SkinSourceError
from skinsource.design.amplitudes import drive_unit
from skinsource.design.design import Design
from skinsource.design.panel_settings import settings_of
from skinsource.design.view import View
from skinsource.engine.actuator_demand import ActuatorSettings, actuation_of
from skinsource_gui.stimulus_page import form_fields as specs
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.rig_field import RigField

_PANEL = "panel"


class RigFields(QObject):
    """Lists to choose a rig file, an actuator and an equaliser with.

    They start with what the panel Actuator shows, or what the design is predicted through.

    Attributes
    ----------
    rig_field, actuator_field, equaliser_field
        The lists.
    chosen
        What was chosen in the panel; None where it shows what it starts with.
    rig, path
        What the file holds, and where it is; None without one.
    """

    changed = Signal()
    #: Why a file was not taken.
    refused = Signal(str)

    def __init__(self, design: Design, view: View, parent: QWidget) -> None:
        super().__init__(parent)
        self._volts = drive_unit(design) == "V"
        self.chosen = design.actuated or _chosen_in_panel(view)
        self.rig: Rig | None = None
        self.path: Path | None = None
        self.rig_field = RigField()
        self.actuator_field = ChoiceField(specs.ACTUATOR)
        self.equaliser_field = ChoiceField(specs.EQUALISER)
        if self.chosen is not None:
            self._offer(self.chosen, design)
        self.rig_field.setObjectName("stimulus_rig")
        self.actuator_field.setObjectName("stimulus_actuator")
        self.equaliser_field.setObjectName("stimulus_equaliser")
        self.rig_field.wanted.connect(self.take)
        self.actuator_field.chosen.connect(self.changed)
        self.equaliser_field.chosen.connect(self.changed)

    def _offer(self, chosen: Actuation, design: Design) -> None:
        """Start with what was chosen, where the drives are accelerations."""
        self.actuator_field.insertItem(1, f"{chosen.title} (as in the panel)", _PANEL)
        self.actuator_field.set_value(_PANEL)
        if chosen.equaliser is not None:
            words = "As in the panel" if design.actuated is None else "As predicted"
            self.equaliser_field.insertItem(1, words, _PANEL)
            if drive_unit(design) == "m/s²":
                self.equaliser_field.set_value(_PANEL)

    @property
    def can_choose_actuator(self) -> bool:
        """Whether an equaliser may be made for an actuator, and no rig says for which."""
        return not self._volts and self.rig is None

    @property
    def can_equalise(self) -> bool:
        """Whether it is known what an equaliser would be made for."""
        return not self._volts and (self.rig is not None or self.actuation is not None)

    @property
    def actuation(self) -> Actuation | None:
        """The actuator that was chosen."""
        name = self.actuator_field.value
        if name == "none":
            return None
        if name == _PANEL:
            return self.chosen
        one = ActuatorAt(actuator=profile(name).title, model=load(name))
        return Actuation(actuators=(one,))

    @property
    def equaliser(self) -> Equaliser | None:
        """The equaliser that was chosen."""
        kind = self.equaliser_field.value
        if not self.can_equalise or kind == "none":
            return None
        if kind != _PANEL or self.chosen is None:
            return RegularisedInverse(phase=kind)
        found, other = self.chosen.equaliser, self.actuation
        if isinstance(found, PolePairReplacement) and other is not None and other != self.chosen:
            # Its pole pair is that of one actuator.
            (one,) = other.actuators
            return PolePairReplacement(*resonance_of(one.model), found.new_quality)
        return found

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


def _chosen_in_panel(view: View) -> Actuation | None:
    """Actuator and equaliser that the panel Actuator shows; None where it is as it starts."""
    found = actuation_of(settings_of(view, "actuator", ActuatorSettings))
    return None if found == actuation_of(ActuatorSettings()) else found
