"""Settings of the actuator panel, and the demand of a design on an actuator: volts and travel."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.actuator import Actuator
from skinsource.actuators.catalog import ActuatorProfile, names, profile, shape_names
from skinsource.actuators.equalising import (
    BOOST,
    NEW_QUALITY,
    PHASE,
    Equaliser,
    PolePairReplacement,
    RegularisedInverse,
    equalised,
    followed_band,
    net_velocity,
    resonance_of,
)
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.prediction import Prediction, duty_of, predicted
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import BAND_HZ, Band
from skinsource.engine.gains import Placed
from skinsource.specs import fields
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec, Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, PlainSpec, TextSpec

ACTUATOR = TextSpec(label="Actuator", longest=100, one_line=True)
#: Name of the actuator where its response was measured.
MEASURED = "measured"
_TITLE = "Measured response"
# A view stores at most so many numbers for a panel.
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
DEFAULT_ACTUATOR = "example-voice-coil"


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorSettings:
    """Actuator and equaliser of the panel, and how they are drawn.

    Attributes
    ----------
    actuator
        A name of `skinsource.actuators.names` or ``shape_names``, or ``"measured"``.
    measured, measured_from
        Points of a measured response, (Hz, m/s² per V, rad) each, and its title.
    parameters
        Changed fields of the model: pairs of name and value.
    equaliser
        ``"inverse"``, ``"pole_pair"`` or ``"none"``.
    boost_db, phase, new_quality
        See the equalisers.
    strength_m_per_s2, volts
        Meaning of an amplitude of 1, with an equaliser and without.
    picture
        ``"response"`` over frequency or ``"step"`` over time.
    """

    actuator: str = fields.text(DEFAULT_ACTUATOR, ACTUATOR)
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
        """Profile of the actuator, or of the default one where its name is not known."""
        if self.actuator == MEASURED:
            measured = _measured_profile(self.measured, self.measured_from)
            if measured is not None:
                return measured
        known = self.actuator in (*names(), *shape_names())
        return profile(self.actuator if known else DEFAULT_ACTUATOR)

    @property
    def measured_title(self) -> str:
        """Title of the measured response; "" where there is none."""
        measured = _measured_profile(self.measured, self.measured_from)
        return "" if measured is None else measured.title

    @property
    def model(self) -> Actuator | None:
        """Model with changed parameters; None where only a shape is known."""
        published = self.profile.model
        if not isinstance(published, Actuator):
            return None
        try:
            return replace(published, **dict(self.parameters))
        except (InvalidInputError, TypeError, ValueError):
            # Parameters of another actuator, or of a newer studio.
            return published

    def made(self, model: Actuator) -> Equaliser | None:
        """Return the equaliser for a model; None where none is chosen."""
        if self.equaliser == "inverse":
            return RegularisedInverse(self.boost_db, self.phase)
        if self.equaliser == "pole_pair":
            return PolePairReplacement(*resonance_of(model), self.new_quality)
        return None

    def with_measured(self, response: MeasuredResponse, title: str) -> "ActuatorSettings":
        """Return settings with a measured response; very many points are thinned out."""
        step = -(-len(response.points) // _MOST_POINTS)
        return replace(
            self,
            actuator=MEASURED,
            measured=response.points[::step],
            measured_from=title,
            parameters=(),
            zoom=None,
        )

    def with_parameter(self, name: str, value: float) -> "ActuatorSettings":
        """Return settings with another value of a field of the model."""
        changed: dict[str, float] = dict(self.parameters)
        changed.pop(name, None)
        if getattr(self.profile.model, name) != value:
            changed[name] = value
        return replace(self, parameters=tuple(changed.items()))


@lru_cache(maxsize=8)
def _measured_profile(points: Any, title: str) -> ActuatorProfile | None:
    """Return the profile of a measured response; None where points are no response."""
    try:
        model = MeasuredResponse(points)
    except (InvalidInputError, TypeError, ValueError, IndexError):
        # A newer studio, or a person, wrote them.
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
    """Return the choice of actuators: complete ones first, then ``measured`` if there is one."""
    moving = tuple((name, profile(name).title) for name in names())
    shapes = tuple((name, f"{profile(name).title} (shape)") for name in shape_names())
    from_file = ((MEASURED, f"{measured} (measured)"),) if measured else ()
    return ChoiceSpec(
        label="Actuator",
        options=(*moving, *from_file, *shapes),
        hint="Of shapes only the resonance is known: nothing is predicted in volts",
    )


#: Of a longer drive only so many seconds around its peak are predicted.
LONGEST_S = 1.0
# Fine enough for figures on the screen; exports are checked at 48 kHz.
_LEAST_RATE_HZ = 20_000
_SHAPE_ONLY = "Too little is known of this actuator to predict volts."


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Demand of a design on the actuator at one location.

    Attributes
    ----------
    place
        Number of the location; None where nothing plays.
    part
        Whether only the strongest part of a long drive was predicted.
    figures
        Predicted figures; None where the drive is refused.
    refusal
        Why there are no figures, or "".
    leaves_velocity
        Whether the reason is that the drive leaves a velocity.
    """

    place: int | None
    part: bool = False
    figures: Prediction | None = None
    refusal: str = ""
    leaves_velocity: bool = False


def drive_at(placed: Sequence[Placed], location: int) -> Floats:
    """Return the sum of all drives at a location, (n_times,), from time 0 on."""
    here = [player for player in placed if player.voice.location == location]
    total = np.zeros(max((player.end for player in here), default=0))
    for player in here:
        factor = player.voice.amplitude * player.drive.factor
        if factor:
            total[player.start : player.end] += factor * player.drive.samples
    return total


def demand_of(
    settings: ActuatorSettings,
    placed: Sequence[Placed],
    selected_input: int | None,
    sample_rate_hz: float,
    band_hz: Band | None = BAND_HZ,
) -> Demand:
    """Return the demand at the location of the selected input, else of the first that plays.

    Parameters
    ----------
    settings
        Actuator, equaliser, and the meaning of an amplitude of 1.
    placed
        Voices with their drives, in order of time.
    selected_input
        Id of an input.
    sample_rate_hz
        Of the drives.
    band_hz
        Frequencies at which the limb was measured; None where they are not known.
    """
    if not placed:
        return Demand(place=None)
    chosen = next((player for player in placed if player.voice.id == selected_input), placed[0])
    location, model = chosen.voice.location, settings.model
    if model is None:
        return Demand(place=location, refusal=_SHAPE_ONLY)
    drive = drive_at(placed, location)
    shown, band = strongest(drive, sample_rate_hz), followed_band(band_hz, sample_rate_hz)
    part = shown.size < drive.size
    try:
        equaliser = settings.made(model)
        if equaliser is None:
            voltage = settings.volts * shown
        else:
            acceleration = settings.strength_m_per_s2 * shown
            voltage = equalised(
                acceleration, sample_rate_hz, model, equaliser, band_hz=band, lead_s=0.1, tail_s=0.1
            )
        (figures,) = predicted(
            voltage,
            int(sample_rate_hz),
            model,
            thermal=settings.profile.thermal,
            least_rate_hz=-(-_LEAST_RATE_HZ // int(sample_rate_hz)) * int(sample_rate_hz),
        )
    except InvalidInputError as error:
        rest = net_velocity(shown, sample_rate_hz, band[0])
        leaves_velocity = settings.equaliser != "none" and not rest.returns
        text = str(error)
        refusal = f"{text[:1].upper()}{text[1:]}"
        return Demand(place=location, part=part, refusal=refusal, leaves_velocity=leaves_velocity)
    # The duty is that of the drive, without the ringing of the filter before and after.
    figures = replace(figures, duty=duty_of(drive, sample_rate_hz))
    return Demand(place=location, part=part, figures=figures)


def strongest(drive: Floats, sample_rate_hz: float) -> Floats:
    """Return the drive, or the part around its peak where it is long."""
    longest = int(LONGEST_S * sample_rate_hz)
    if drive.size <= longest:
        return drive if drive.size else np.zeros(1)
    start = min(max(int(np.abs(drive).argmax()) - longest // 2, 0), drive.size - longest)
    return drive[start : start + longest]


def actuation_of(settings: ActuatorSettings) -> Actuation | None:
    """Return the actuation of a prediction under these settings; None for a shape."""
    model: Any = settings.model
    if model is None:
        return None
    equaliser: Any = settings.made(model)
    actuator = ActuatorAt(actuator=settings.profile.title, model=model)
    return Actuation(actuators=(actuator,), equaliser=equaliser)


def settings_through(settings: ActuatorSettings, actuated: Actuation | None) -> ActuatorSettings:
    """Return settings that describe the actuation of a design.

    ``settings`` are returned where there is no actuation, or settings cannot describe it.
    """
    if actuated is None or len(actuated.actuators) > 1:
        return settings
    (actuator,) = actuated.actuators
    if isinstance(actuator.model, MeasuredResponse):
        through = settings.with_measured(actuator.model, actuator.actuator)
        through = replace(through, **_equaliser_settings(actuated.equaliser))
        return through if actuation_of(through) == actuated else settings
    listed = next((name for name in names() if profile(name).title == actuator.actuator), None)
    if listed is None or type(profile(listed).model) is not type(actuator.model):
        return settings
    before = profile(listed).model
    changed = tuple(
        (name, getattr(actuator.model, name))
        for name in specs_of(actuator.model)
        if getattr(actuator.model, name) != getattr(before, name)
    )
    through = replace(
        settings, actuator=listed, parameters=changed, **_equaliser_settings(actuated.equaliser)
    )
    # The same parameters in another order are the same settings.
    if dict(through.parameters) == dict(settings.parameters):
        through = replace(through, parameters=settings.parameters)
    return through if actuation_of(through) == actuated else settings


def _equaliser_settings(equaliser: Equaliser | None) -> dict[str, Any]:
    """Return the fields of settings that describe an equaliser."""
    if isinstance(equaliser, RegularisedInverse):
        phase, boost_db = equaliser.phase, equaliser.boost_db
        return {"equaliser": "inverse", "boost_db": boost_db, "phase": phase}
    if isinstance(equaliser, PolePairReplacement):
        return {"equaliser": "pole_pair", "new_quality": equaliser.new_quality}
    return {"equaliser": "none"}
