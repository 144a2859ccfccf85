"""The switch that lets predictions go through the actuator, and words on what they go through."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QVBoxLayout, QWidget

from skinsource.actuators import names, profile
from skinsource.chain import Actuation, ActuatorAt
from skinsource.design import Design
from skinsource.equalising import Equaliser, PolePairReplacement, RegularisedInverse
from skinsource.fields import specs_of
from skinsource_gui.panels.actuator.settings import ActuatorSettings
from skinsource_gui.theme import UNIT_PX, Theme

_TITLE = "Predict through the actuator"
_HINT = (
    "Levels, map, traces and spectra become those of the skin under this actuator and equaliser; "
    "saved with the design"
)
_OTHER = "Predictions go through {words}, not through what is shown here."


class ThroughSwitch(QWidget):
    """Whether the design is predicted through an actuator.

    Attributes
    ----------
    box, words
        The switch; what amplitudes are then, or through what else it goes.
    """

    #: Whether predictions shall go through what the panel shows.
    wanted = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.box, self.words = QCheckBox(_TITLE), QLabel()
        self.box.setObjectName("actuator_through")
        self.box.setToolTip(_HINT)
        self.box.clicked.connect(self.wanted)
        self.words.setObjectName("actuator_through_words")
        self.words.setWordWrap(True)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 4)
        column.addWidget(self.box)
        column.addWidget(self.words)

    def show_state(self, design: Design, settings: ActuatorSettings) -> None:
        """Show what the design is predicted through, beside what the panel shows."""
        actuated = design.actuated
        self.box.setChecked(actuated is not None)
        self.box.setEnabled(actuated is not None or settings.model is not None)
        words = ""
        if actuated is not None and actuated != actuation_of(settings):
            words = _OTHER.format(words=actuated.words)
        elif actuated is not None and actuated.equaliser is None:
            words = "An amplitude of 1 is 1 V at the actuator."
        elif actuated is not None:
            words = "An amplitude of 1 asks the contactor for 1 m/s²."
        self.words.setText(words)
        self.words.setVisible(bool(words))

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self.words.setStyleSheet(f"color: {theme.dim};")


def actuation_of(settings: ActuatorSettings) -> Actuation | None:
    """What predictions go through under these settings; None for a shape."""
    model = settings.model
    if model is None:
        return None
    one = ActuatorAt(actuator=settings.profile.title, model=model)
    return Actuation(actuators=(one,), equaliser=settings.made(model))


def settings_through(settings: ActuatorSettings, actuated: Actuation | None) -> ActuatorSettings:
    """The settings that stand for what a design is predicted through.

    As they were where it is not, or goes through what no settings stand for.
    """
    if actuated is None or len(actuated.actuators) > 1:
        return settings
    (one,) = actuated.actuators
    listed = next((name for name in names() if profile(name).title == one.actuator), None)
    if listed is None or type(profile(listed).model) is not type(one.model):
        return settings
    before = profile(listed).model
    changed = tuple(
        (name, getattr(one.model, name))
        for name in specs_of(one.model)
        if getattr(one.model, name) != getattr(before, name)
    )
    found = replace(settings, actuator=listed, parameters=changed, **_of(actuated.equaliser))
    # The same values in another order are the same settings.
    if dict(found.parameters) == dict(settings.parameters):
        found = replace(found, parameters=settings.parameters)
    return found if actuation_of(found) == actuated else settings


def _of(equaliser: Equaliser | None) -> dict[str, Any]:
    """Settings of an equaliser."""
    if isinstance(equaliser, RegularisedInverse):
        phase, boost_db = equaliser.phase, equaliser.boost_db
        return {"equaliser": "inverse", "boost_db": boost_db, "phase": phase}
    if isinstance(equaliser, PolePairReplacement):
        return {"equaliser": "pole_pair", "new_quality": equaliser.new_quality}
    return {"equaliser": "none"}
