"""Predicted figures of one place, or why there are none and what to do."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from skinsource.engine.actuator_demand import LONGEST_S, ActuatorSettings, Demand
from skinsource.limbs.locations import input_words
from skinsource_gui.panel import PREPARING
from skinsource_gui.panels.actuator.figures import Figure, rows_of
from skinsource_gui.panels.actuator.figures_table import FiguresTable
from skinsource_gui.theme import UNIT_PX, set_tone

_NOTHING = "Nothing plays: add an input to see what it asks of the actuator"


class FiguresView(QWidget):
    """A heading over the table of figures; where the equaliser refuses the drive, the reason.

    Attributes
    ----------
    heading, refusal, limits, centred, table
        Its parts.
    """

    #: Another tap is wanted in place of one that leaves a velocity.
    centred_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.heading, self.refusal, self.table = QLabel(), QLabel(), FiguresTable()
        self.heading.setObjectName("actuator_heading")
        self.refusal.setObjectName("actuator_refusal")
        self.limits = QLabel()
        self.limits.setObjectName("actuator_limits")
        set_tone(self.limits, "error")
        for label in (self.heading, self.refusal, self.limits):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self.centred = QPushButton("Use a centred tap")
        self.centred.setToolTip("Let the selected clips play a tap that leaves nothing moving")
        self.centred.clicked.connect(self.centred_wanted)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 4)
        column.addWidget(self.heading)
        column.addWidget(self.refusal)
        column.addWidget(self.limits)
        column.addWidget(self.centred, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(self.table)

    def show_demand(
        self, found: Demand, settings: ActuatorSettings, *, tap: bool, limb: str = ""
    ) -> None:
        """Show the figures of an actuator; ``tap``: a tap could be replaced by another."""
        rows = () if found.figures is None else rows_of(settings, found.figures)
        self.table.show_figures(rows)
        reason = found.refusal or ("" if found.place is not None else _NOTHING)
        self.refusal.setText(reason)
        self.refusal.setVisible(bool(reason))
        # Where nothing plays, or is known yet, nothing is wrong.
        set_tone(self.refusal, "dim" if found.refusal in ("", PREPARING) else "error")
        beyond = _beyond(rows)
        self.limits.setText(beyond)
        self.limits.setVisible(bool(beyond))
        self.centred.setVisible(found.leaves_velocity and tap)
        words = "" if found.place is None else f"Place {found.place}, "
        words += "" if found.place is None else input_words(found.place, limb).name
        part = f" · the strongest {LONGEST_S:g} s" if found.part else ""
        gain = " · uncalibrated gain" if words and not settings.profile.gain_calibrated else ""
        self.heading.setText(f"{words}{part}{gain}")


def _beyond(rows: tuple[Figure, ...]) -> str:
    """Which figures pass their limits, in a sentence; "" where none does."""
    names = [one.label.lower() for one in rows if one.passed]
    return f"Beyond its limit: {', '.join(names)}" if names else ""
