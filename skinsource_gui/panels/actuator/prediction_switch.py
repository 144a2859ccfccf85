"""The switch that lets predictions go through the actuator, and words on what they go through."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QVBoxLayout, QWidget

from skinsource.design.design import Design
from skinsource.engine.actuator_demand import ActuatorSettings, actuation_of
from skinsource_gui.theme import UNIT_PX, set_tone

_TITLE = "Predict through the actuator"
_HINT = (
    "Levels, map, traces and spectra become those of the skin under this actuator and equaliser; "
    "saved with the design"
)
_SHAPE = (
    "Of {title} only the shape of its response is known, not how strong it is: nothing can be "
    "predicted through it. Choose an actuator without “(shape)”, or open a response measured at "
    "yours."
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
        set_tone(self.words, "dim")
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
        if actuated is None and settings.model is None:
            words = _SHAPE.format(title=settings.profile.title)
        elif actuated is not None and actuated != actuation_of(settings):
            words = _OTHER.format(words=actuated.words)
        elif actuated is not None and actuated.equaliser is None:
            words = "An amplitude of 1 is 1 V at the actuator."
        elif actuated is not None:
            words = "An amplitude of 1 asks the contactor for 1 m/s²."
        self.box.setToolTip(_HINT if self.box.isEnabled() else words)
        self.words.setText(words)
        self.words.setVisible(bool(words))
