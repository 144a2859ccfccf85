"""What the library knows of an actuator: its model, where the numbers come from, its limits."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.actuators.limits import Limits, Thermal
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.piezo import Piezo
from skinsource.actuators.recoil_voice_coil import RecoilVoiceCoil
from skinsource.actuators.response_shape import ResponseShape
from skinsource.actuators.voice_coil import VoiceCoil
from skinsource.fields import OptionalSpec, RecipeSpec, SwitchSpec, TextSpec

#: Every kind that moves, in the order in which a user meets them.
KINDS = (VoiceCoil, RecoilVoiceCoil, Piezo, MeasuredResponse)
Model = VoiceCoil | RecoilVoiceCoil | Piezo | MeasuredResponse

MODEL: RecipeSpec = RecipeSpec(label="Model", kinds=lambda: KINDS)
_ANY = RecipeSpec(label="Model", kinds=lambda: (*KINDS, ResponseShape))
_LIMITS = RecipeSpec(label="Limits", kinds=lambda: (Limits,))
_THERMAL = OptionalSpec(label="Warming", of=RecipeSpec(label="Warming", kinds=lambda: (Thermal,)))


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorProfile:
    """An actuator as the library lists it.

    Attributes
    ----------
    title
        What a user reads.
    source
        Where the numbers come from.
    calibration
        What of it is calibrated, and what is not.
    gain_calibrated
        Whether m/s² for each volt may be trusted; else the shape of the response is what counts.
    model
        A model that moves, or a `ResponseShape` where too little is known for one.
    limits, thermal
        What must not be passed; how it warms, where that is known.
    """

    title: str = fields.field(TextSpec(label="Title", longest=100, one_line=True))
    source: str = fields.field(TextSpec(label="Source", longest=1000))
    calibration: str = fields.field(TextSpec(label="Calibration", longest=1000))
    gain_calibrated: bool = fields.switch(False, SwitchSpec(label="Gain is calibrated"))
    model: Model | ResponseShape = fields.field(_ANY)
    limits: Limits = fields.field(_LIMITS, Limits())
    thermal: Thermal | None = fields.field(_THERMAL, None)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def complete(self) -> bool:
        """Whether the model moves."""
        return not isinstance(self.model, ResponseShape)
