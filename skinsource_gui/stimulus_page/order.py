"""What is to be exported, as it was chosen on the page."""

from dataclasses import dataclass, field

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.export.formats.format import StimulusFormat
from skinsource.export.formats.formats import FORMATS
from skinsource.export.stimulus_export.options import StimulusOptions


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """One export.

    Attributes
    ----------
    format
        As what.
    rate_hz
        None: the usual one of the format.
    options
        How.
    actuation, rig, equaliser
        Actuators, where no rig says them; what is wired; what makes volts of accelerations.
    """

    format: StimulusFormat = FORMATS[0]
    rate_hz: int | None = None
    options: StimulusOptions = field(default_factory=StimulusOptions)
    actuation: Actuation | None = None
    rig: Rig | None = None
    equaliser: Equaliser | None = None
