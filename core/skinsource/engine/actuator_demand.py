"""The demand of a design on an actuator: volts, current and travel."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt, ActuatorProfile, names, profile
from skinsource.actuators.equalising import equalised, followed_band, net_velocity
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.prediction import Prediction, duty_of, predicted
from skinsource.base.conventions import BAND_HZ, Band, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.engine.gains import Placed
from skinsource.limbs.scaling import Scaling
from skinsource.signals.resampling import extremes_between


def listed_name(actuator: ActuatorAt) -> str | None:
    """Return the name of the listed actuator of the same title and kind; None: there is none."""
    for name in names():
        same_kind = type(profile(name).model) is type(actuator.model)
        if same_kind and actuator.actuator in (name, profile(name).title):
            return name
    return None


def actuator_at(actuation: Actuation, place: int | None) -> ActuatorAt:
    """Return the actuator at a place; the first one where there is none, or no place."""
    with suppress(InvalidInputError):
        return actuation.at(place or 0)
    return actuation.actuators[0]


def profile_of(actuator: ActuatorAt) -> ActuatorProfile:
    """Return what is known of an actuator of a design, with its own parameters."""
    name, model = listed_name(actuator), actuator.model
    if name is not None:
        return replace(profile(name), model=model)
    measured = isinstance(model, MeasuredResponse)
    source = "The model comes from the design."
    if isinstance(model, MeasuredResponse):
        first, last = model.points[0][0], model.points[-1][0]
        source = (
            f"{len(model.points)} points that were measured, from {first:.4g} to {last:.4g} Hz."
        )
    return ActuatorProfile(
        title=actuator.actuator or model.title,
        source=source,
        calibration="Valid as far as the measurement; the current is unknown." if measured else "",
        gain_calibrated=measured,
        model=model,
    )


#: Of a longer voltage only so many seconds around its peak are predicted.
LONGEST_S = 1.0
# Before and after them: the filter rings there, and what is cut out fades in and out.
_MARGIN_S = 0.1
# Fine enough for figures on the screen; exports are checked at 48 kHz.
_LEAST_RATE_HZ = 20_000
_NO_ACCELERATIONS = "The equaliser needs accelerations. Choose the scaling Probe acceleration."
_NO_VOLTS = (
    "Without an equaliser the volts are not known. Choose one, or predict through the actuator."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Demand of a design on the actuator at one location.

    Attributes
    ----------
    place
        Number of the location; None where nothing plays, or no actuator is chosen.
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
    actuation: Actuation | None,
    placed: Sequence[Placed],
    selected_input: int | None,
    sample_rate_hz: float,
    band_hz: Band | None = BAND_HZ,
    *,
    scaling: Scaling = "probe",
) -> Demand:
    """Return the demand at the location of the selected input, else of the first that plays.

    Parameters
    ----------
    actuation
        Actuators and equaliser; None: none is chosen.
    placed
        Voices with their drives, in order of time.
    selected_input
        Id of an input.
    sample_rate_hz
        Of the drives.
    band_hz
        Frequencies at which the limb was measured; None where they are not known.
    scaling
        What amplitudes mean.
    """
    if not placed or actuation is None:
        return Demand(place=None)
    chosen = next((player for player in placed if player.voice.id == selected_input), placed[0])
    location, equaliser = chosen.voice.location, actuation.equaliser
    if scaling != "probe" or (equaliser is None and not actuation.on):
        refusal = _NO_VOLTS if equaliser is None else _NO_ACCELERATIONS
        return Demand(place=location, refusal=refusal)
    drive = drive_at(placed, location)
    voltage, band = drive, followed_band(band_hz, sample_rate_hz)
    try:
        shown_profile = profile_of(actuation.at(location))
        model: Any = shown_profile.model
        if equaliser is not None:
            voltage = equalised(
                drive,
                sample_rate_hz,
                model,
                equaliser,
                band_hz=band,
                lead_s=_MARGIN_S,
                tail_s=_MARGIN_S,
            )
        shown = strongest(voltage, sample_rate_hz)
        (figures,) = predicted(
            shown,
            int(sample_rate_hz),
            model,
            thermal=shown_profile.thermal,
            least_rate_hz=-(-_LEAST_RATE_HZ // int(sample_rate_hz)) * int(sample_rate_hz),
        )
    except InvalidInputError as error:
        rest = net_velocity(drive, sample_rate_hz, band[0])
        text = str(error)
        refusal = f"{text[:1].upper()}{text[1:]}"
        leaves_velocity = equaliser is not None and not rest.returns
        return Demand(place=location, refusal=refusal, leaves_velocity=leaves_velocity)
    # The duty is that of the drive, without the ringing of the filter before and after.  All
    # channels are sent as long as the design, with that ringing.
    n_sent = max(player.end for player in placed) + voltage.size - drive.size
    figures = replace(
        figures, duty=duty_of(drive, sample_rate_hz), duration_s=n_sent / sample_rate_hz
    )
    return Demand(place=location, part=shown.size < voltage.size, figures=figures)


def strongest(voltage: Floats, sample_rate_hz: float) -> Floats:
    """Return the voltage, or the part around its peak where it is long, cut out softly."""
    longest = int((LONGEST_S + 2.0 * _MARGIN_S) * sample_rate_hz)
    if voltage.size <= longest:
        return voltage if voltage.size else np.zeros(1)
    between = extremes_between(voltage[np.newaxis])
    peak = int(np.maximum(between.high, -between.low).argmax())
    start = min(max(peak - longest // 2, 0), voltage.size - longest)
    end, n = start + longest, int(_MARGIN_S * sample_rate_hz)
    part = voltage[start:end].copy()
    fade = 0.5 - 0.5 * np.cos(np.pi * np.arange(n) / n)
    if start > 0:
        part[:n] *= fade
    if end < voltage.size:
        part[-n:] *= fade[::-1]
    return part
