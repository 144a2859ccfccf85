"""What only the panel of the actuator looks at."""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

from skinsource import fields
from skinsource.actuators import (
    Actuator,
    ActuatorProfile,
    MeasuredResponse,
    names,
    profile,
    shape_names,
)
from skinsource.equalising import Equaliser, PolePairReplacement, RegularisedInverse, resonance_of
from skinsource.equalising.pole_pair import NEW_QUALITY
from skinsource.equalising.regularised_inverse import BOOST, PHASE
from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, NumberSpec, PlainSpec, Range, RangeSpec, TextSpec

ACTUATOR = TextSpec(label="Actuator", longest=100, one_line=True)
#: Stands in place of a listed name for a response that was measured.
MEASURED = "measured"
_TITLE = "Measured response"
# A view keeps no more parts for a panel.
_MOST_POINTS = 2000
POINTS = PlainSpec(label=_TITLE)
FROM = TextSpec(label="Measured as", longest=100, one_line=True)
PARAMETERS = PlainSpec(label="Changed parameters")
EQUALISER = ChoiceSpec(
    label="Equaliser",
    options=(
        ("inverse", "Regularised inverse"),
        ("pole_pair", "Pole-pair replacement"),
        ("none", "None"),
    ),
    hint="What makes the actuator move as the design says",
)
STRENGTH = NumberSpec(
    label="Amplitude 1 is",
    unit="m/s²",
    minimum=1e-3,
    maximum=1e3,
    step=0.02,
    logarithmic=True,
    hint="Acceleration of the contactor that an amplitude of 1 asks for",
)
VOLTS = NumberSpec(
    label="Amplitude 1 is",
    unit="V",
    minimum=1e-3,
    maximum=1e3,
    step=0.02,
    logarithmic=True,
    hint="Voltage that an amplitude of 1 puts on the actuator",
)
PICTURE = ChoiceSpec(
    label="Picture", options=(("response", "Response"), ("step", "Step")), hint="Over what"
)
LAYOUT = ChoiceSpec(label="Layout", options=(("overlaid", "Overlaid"), ("stacked", "Stacked")))
ZOOM = RangeSpec(label="Zoom")
USUAL = "example-voice-coil"


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorSettings:
    """Which actuator and equaliser are looked at.

    Attributes
    ----------
    actuator
        A name of `skinsource.actuators.names` or ``shape_names``, or ``"measured"``.
    measured, measured_from
        Points of a response that was measured, (Hz, m/s² per V, rad) each, and its title.
    parameters
        What was changed of it: pairs of a field of the model and its value.
    equaliser
        ``"inverse"``, ``"pole_pair"`` or ``"none"``.
    boost_db, phase, new_quality
        See the equalisers.
    strength_m_per_s2, volts
        What an amplitude of 1 asks for, with an equaliser and without.
    picture
        ``"response"`` over frequency or ``"step"`` over time.
    layout, zoom
        How curves are drawn.
    """

    actuator: str = fields.text(USUAL, ACTUATOR)
    measured: Any = fields.field(POINTS, ())
    measured_from: str = fields.text("", FROM)
    parameters: Any = fields.field(PARAMETERS, ())
    equaliser: str = fields.choice("inverse", EQUALISER)
    boost_db: float = fields.number(20.0, BOOST)
    phase: str = fields.choice("linear", PHASE)
    new_quality: float = fields.number(0.7, NEW_QUALITY)
    strength_m_per_s2: float = fields.number(1.0, STRENGTH)
    volts: float = fields.number(1.0, VOLTS)
    picture: str = fields.choice("response", PICTURE)
    layout: str = fields.choice("overlaid", LAYOUT)
    zoom: Range | None = fields.interval(None, ZOOM)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def profile(self) -> ActuatorProfile:
        """What the library knows of the actuator; the usual one where its name is not known."""
        if self.actuator == MEASURED:
            found = _measured(self.measured, self.measured_from)
            if found is not None:
                return found
        known = self.actuator in (*names(), *shape_names())
        return profile(self.actuator if known else USUAL)

    @property
    def measured_title(self) -> str:
        """What the response that was measured is called; "" where none can be looked at."""
        found = _measured(self.measured, self.measured_from)
        return "" if found is None else found.title

    @property
    def model(self) -> Actuator | None:
        """The model with what was changed; None where there is a shape only."""
        published = self.profile.model
        if not isinstance(published, Actuator):
            return None
        try:
            return replace(published, **dict(self.parameters))
        except (InvalidInputError, TypeError, ValueError):
            # Of another actuator, or of a newer studio.
            return published

    def made(self, model: Actuator) -> Equaliser | None:
        """The equaliser for a model; None where there is none."""
        if self.equaliser == "inverse":
            return RegularisedInverse(self.boost_db, self.phase)
        if self.equaliser == "pole_pair":
            return PolePairReplacement(*resonance_of(model), self.new_quality)
        return None

    def with_measured(self, found: MeasuredResponse, title: str) -> "ActuatorSettings":
        """Look at all of a response that was measured; of very many points, at some."""
        step = -(-len(found.points) // _MOST_POINTS)
        points = found.points[::step]
        return replace(
            self,
            actuator=MEASURED,
            measured=points,
            measured_from=title,
            parameters=(),
            zoom=None,
        )

    def with_parameter(self, name: str, value: float) -> "ActuatorSettings":
        """Another value of one field of the model; what is as published is not kept."""
        changed: dict[str, float] = dict(self.parameters)
        changed.pop(name, None)
        if getattr(self.profile.model, name) != value:
            changed[name] = value
        return replace(self, parameters=tuple(changed.items()))


@lru_cache(maxsize=8)
def _measured(points: Any, title: str) -> ActuatorProfile | None:
    """What is known of a response that was measured; None where it is none."""
    try:
        model = MeasuredResponse(points)
    except (InvalidInputError, TypeError, ValueError, IndexError):
        # Of a newer studio, or written by hand.
        return None
    return ActuatorProfile(
        title=title or _TITLE,
        source=f"{len(model.points)} points that were measured, from {model.points[0][0]:.4g} to "
        f"{model.points[-1][0]:.4g} Hz.",
        calibration="As far as the measurement is; the current is not known.",
        gain_calibrated=True,
        model=model,
    )


def actuator_spec(measured: str = "") -> ChoiceSpec:
    """The actuators that can be chosen: complete ones first, then ``measured`` if there is one."""
    moving = tuple((name, profile(name).title) for name in names())
    shapes = tuple((name, f"{profile(name).title} (shape)") for name in shape_names())
    own = ((MEASURED, f"{measured} (measured)"),) if measured else ()
    return ChoiceSpec(
        label="Actuator",
        options=(*moving, *own, *shapes),
        hint="Of shapes only the resonance is known: nothing is predicted in volts",
    )
