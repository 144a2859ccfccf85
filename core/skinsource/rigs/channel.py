"""One actuator of a rig and all that lies before it."""

from dataclasses import dataclass
from datetime import date

from skinsource import fields
from skinsource.actuators import MODEL, Limits, MeasuredResponse, Model, Thermal
from skinsource.errors import InvalidInputError
from skinsource.fields import (
    SMALLEST,
    ChoiceSpec,
    NumberSpec,
    OptionalSpec,
    RecipeSpec,
    TextSpec,
)
from skinsource.limb import MOST_PLACES
from skinsource.quoting import quoted

PLACE = NumberSpec(label="Place", minimum=1, maximum=MOST_PLACES, whole=True)
NAME = TextSpec(label="Actuator", longest=100, one_line=True)
DEVICE = TextSpec(label="Device", longest=200, one_line=True, hint="Sound card, as it is called")
OUTPUT = NumberSpec(label="Output", minimum=1, maximum=1024, whole=True, hint="Of the device")
FULL_SCALE = OptionalSpec(
    label="Full scale",
    of=NumberSpec(label="Full scale", unit="V", minimum=SMALLEST, maximum=1e6),
    hint="Volts at the connector of the device where a sample is 1",
)
GAIN = NumberSpec(label="Amplifier gain", minimum=SMALLEST, maximum=1e6, hint="Volts for each volt")
POLARITY = ChoiceSpec(
    label="Polarity",
    options=(("normal", "Normal"), ("inverted", "Inverted")),
    hint="Inverted: a positive voltage pulls away from the skin",
)
DELAY = NumberSpec(label="Delay", unit="s", minimum=0.0, maximum=10.0, hint="From sample to motion")
DATE = TextSpec(label="Measured on", longest=10, one_line=True, hint="Year-month-day, or empty")


@dataclass(frozen=True, slots=True, kw_only=True)
class RigChannel:
    """A place of the skin, its actuator, and the output that drives it.

    Attributes
    ----------
    place
        Input place, from 1; the limb says which it has.
    actuator
        What it is called: a name of `skinsource.actuators.names`, or words for another.
    model
        How it moves; None: not known.
    device, output
        Sound card, and number of its output, from 1.
    full_scale_v
        Voltage at that output where a sample is 1; None: not known.
    amplifier_gain
        Volts at the actuator for each volt of the output.
    measured
        Acceleration on the skin for each volt at the actuator, as it was measured; None: it was
        not.
    polarity
        ``"normal"``, or ``"inverted"`` where a positive voltage moves it the other way.
    delay_s
        From the sample to the motion.
    measured_on
        Date, ``"2026-11-22"``; empty where nothing was measured.
    limits, thermal
        What must not be passed, at the actuator; how it warms.
    """

    place: int = fields.field(PLACE)
    actuator: str = fields.text("", NAME)
    model: Model | None = fields.field(OptionalSpec(label="Model", of=MODEL), None)
    device: str = fields.text("", DEVICE)
    output: int = fields.number(1, OUTPUT)
    full_scale_v: float | None = fields.field(FULL_SCALE, None)
    amplifier_gain: float = fields.number(1.0, GAIN)
    measured: MeasuredResponse | None = fields.field(
        OptionalSpec(
            label="Measured response",
            of=RecipeSpec(label="Measured response", kinds=lambda: (MeasuredResponse,)),
        ),
        None,
    )
    polarity: str = fields.choice("normal", POLARITY)
    delay_s: float = fields.number(0.0, DELAY)
    measured_on: str = fields.text("", DATE)
    limits: Limits = fields.field(
        RecipeSpec(label="Limits", kinds=lambda: (Limits,)), factory=Limits
    )
    thermal: Thermal | None = fields.field(
        OptionalSpec(label="Warming", of=RecipeSpec(label="Warming", kinds=lambda: (Thermal,))),
        None,
    )

    def __post_init__(self) -> None:
        fields.check(self)
        if self.measured_on:
            try:
                date.fromisoformat(self.measured_on)
            except ValueError:
                raise InvalidInputError(
                    f"RigChannel.measured_on is {quoted(self.measured_on)}, expected a date such "
                    "as 2026-11-22, or nothing"
                ) from None

    @property
    def calibrated(self) -> bool:
        """Whether m/s² on the skin follow from samples: volts and response are both known."""
        return self.full_scale_v is not None and self.measured is not None

    @property
    def moves_as(self) -> Model | None:
        """What tells the motion: the measured response, else the model."""
        return self.measured if self.measured is not None else self.model

    @property
    def volts_at_full_scale(self) -> float | None:
        """Voltage at the actuator where a sample is 1, with its sign; None where not known."""
        if self.full_scale_v is None:
            return None
        sign = -1.0 if self.polarity == "inverted" else 1.0
        return sign * self.full_scale_v * self.amplifier_gain
