"""What a design asks of an actuator."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from skinsource.actuator_demand.settings import ActuatorSettings
from skinsource.actuators import Prediction, predicted
from skinsource.actuators.prediction import duty_of
from skinsource.arrays import Floats
from skinsource.equalising import equalised, followed_band, net_velocity
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ, Band
from skinsource.rendering.placed import Placed

#: A longer drive is looked at where it is strongest, for so many seconds.
LONGEST_S = 1.0
# Fine enough for figures that are read; exports are checked at 48 kHz.
_LEAST_RATE_HZ = 20_000
_SHAPE = "Too little is known of this actuator to predict volts."


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Figures of one place.

    Attributes
    ----------
    place
        Its number; None where nothing plays.
    part
        Whether only the strongest part of a long drive was looked at.
    figures
        What is predicted; None where the drive is refused.
    refusal
        Why there are no figures, or "".
    leaves_velocity
        Whether that is because the drive leaves a velocity.
    """

    place: int | None
    part: bool = False
    figures: Prediction | None = None
    refusal: str = ""
    leaves_velocity: bool = False


def place_looked_at(placed: Sequence[Placed], selected_input: int | None) -> int | None:
    """Place of the selected input, else of the first that plays."""
    for one in placed:
        if one.voice.id == selected_input:
            return one.voice.location
    return placed[0].voice.location if placed else None


def drive_at(placed: Sequence[Placed], place: int) -> Floats:
    """All that is played at a place, (n_times,), from time 0 on."""
    here = [one for one in placed if one.voice.location == place]
    total = np.zeros(max((one.end for one in here), default=0))
    for one in here:
        factor = one.voice.amplitude * one.drive.factor
        if factor:
            total[one.start : one.end] += factor * one.drive.samples
    return total


def demand_of(
    settings: ActuatorSettings,
    placed: Sequence[Placed],
    selected_input: int | None,
    sample_rate_hz: float,
    band_hz: Band | None = BAND_HZ,
) -> Demand:
    """What the place that is looked at asks for.

    Parameters
    ----------
    settings
        Actuator and equaliser, and what an amplitude of 1 is.
    placed
        What plays where, in order of time.
    selected_input
        Its place is looked at, else the first that plays.
    sample_rate_hz
        Of the drives, Hz.
    band_hz
        Of the limb; None: not known.
    """
    place, model = place_looked_at(placed, selected_input), settings.model
    if place is None:
        return Demand(place=None)
    if model is None:
        return Demand(place=place, refusal=_SHAPE)
    drive = drive_at(placed, place)
    shown, band = strongest(drive, sample_rate_hz), followed_band(band_hz, sample_rate_hz)
    part = shown.size < drive.size
    try:
        equaliser = settings.made(model)
        if equaliser is None:
            voltage = settings.volts * shown
        else:
            asked = settings.strength_m_per_s2 * shown
            voltage = equalised(
                asked, sample_rate_hz, model, equaliser, band_hz=band, lead_s=0.1, tail_s=0.1
            )
        (found,) = predicted(
            voltage,
            int(sample_rate_hz),
            model,
            thermal=settings.profile.thermal,
            least_rate_hz=-(-_LEAST_RATE_HZ // int(sample_rate_hz)) * int(sample_rate_hz),
        )
    except InvalidInputError as error:
        rest = net_velocity(shown, sample_rate_hz, band[0])
        left = settings.equaliser != "none" and not rest.returns
        words = str(error)
        refusal = f"{words[:1].upper()}{words[1:]}"
        return Demand(place=place, part=part, refusal=refusal, leaves_velocity=left)
    # Of the drive itself: what the filter rings for before and after is no part of the design.
    found = replace(found, duty=duty_of(drive, sample_rate_hz))
    return Demand(place=place, part=part, figures=found)


def strongest(drive: Floats, sample_rate_hz: float) -> Floats:
    """The drive, or where it is long the part around its peak."""
    most = int(LONGEST_S * sample_rate_hz)
    if drive.size <= most:
        return drive if drive.size else np.zeros(1)
    start = min(max(int(np.abs(drive).argmax()) - most // 2, 0), drive.size - most)
    return drive[start : start + most]
