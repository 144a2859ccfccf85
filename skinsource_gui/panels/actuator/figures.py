"""What a design asks of an actuator, in numbers."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isnan

import numpy as np

from skinsource.actuators import Prediction, breaches, predicted
from skinsource.actuators.prediction import LINEAR_VELOCITY_M_PER_S, duty_of
from skinsource.arrays import Floats
from skinsource.equalising import equalised, net_velocity
from skinsource.errors import InvalidInputError
from skinsource.rendering.placed import Placed
from skinsource_gui.panels.actuator.settings import ActuatorSettings
from skinsource_gui.widgets.fields.units import value_text

#: A longer drive is looked at where it is strongest, for so many seconds.
LONGEST_S = 1.0
# Fine enough for figures that are read; exports are checked at 48 kHz.
_LEAST_RATE_HZ = 20_000
_DIGITS = 3
_SHAPE = "Too little is known of this actuator to predict volts."


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One row.

    Attributes
    ----------
    label, value, limit
        Words; the limit is empty where there is none.
    passed
        Whether the limit is.
    """

    label: str
    value: str
    limit: str = ""
    passed: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Figures:
    """All rows for one place.

    Attributes
    ----------
    place
        Its number; None where nothing plays.
    part
        Whether only the strongest part of a long drive was looked at.
    rows
        The figures; none where the drive is refused.
    refusal
        Why the equaliser refuses the drive, or "".
    leaves_velocity
        Whether it does because the drive leaves a velocity.
    """

    place: int | None
    part: bool = False
    rows: tuple[Figure, ...] = ()
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


def figures_of(
    settings: ActuatorSettings,
    placed: Sequence[Placed],
    selected_input: int | None,
    sample_rate_hz: float,
) -> Figures:
    """Figures of the place that is looked at."""
    place, model = place_looked_at(placed, selected_input), settings.model
    if place is None:
        return Figures(place=None)
    if model is None:
        return Figures(
            place=place, refusal="Too little is known of this actuator to predict volts."
        )
    drive = drive_at(placed, place)
    shown = strongest(drive, sample_rate_hz)
    part = shown.size < drive.size
    try:
        equaliser = settings.made(model)
        if equaliser is None:
            voltage = settings.volts * shown
        else:
            asked = settings.strength_m_per_s2 * shown
            voltage = equalised(asked, sample_rate_hz, model, equaliser, lead_s=0.1, tail_s=0.1)
        (found,) = predicted(
            voltage,
            int(sample_rate_hz),
            model,
            thermal=settings.profile.thermal,
            least_rate_hz=-(-_LEAST_RATE_HZ // int(sample_rate_hz)) * int(sample_rate_hz),
        )
    except InvalidInputError as error:
        left = settings.equaliser != "none" and not net_velocity(shown, sample_rate_hz).returns
        words = str(error)
        refusal = f"{words[:1].upper()}{words[1:]}"
        return Figures(place=place, part=part, refusal=refusal, leaves_velocity=left)
    # Of the drive itself: what the filter rings for before and after is no part of the design.
    found = replace(found, duty=duty_of(drive, sample_rate_hz))
    return Figures(place=place, part=part, rows=_rows(settings, found))


def strongest(drive: Floats, sample_rate_hz: float) -> Floats:
    """The drive, or where it is long the part around its peak."""
    most = int(LONGEST_S * sample_rate_hz)
    if drive.size <= most:
        return drive if drive.size else np.zeros(1)
    start = min(max(int(np.abs(drive).argmax()) - most // 2, 0), drive.size - most)
    return drive[start : start + most]


_ROWS = (
    ("Peak acceleration", "peak_acceleration_m_per_s2", "m/s²", None),
    ("Displacement", "peak_displacement_m", "m", "displacement_m"),
    ("Peak voltage", "peak_voltage_v", "V", "peak_voltage_v"),
    ("RMS voltage", "rms_voltage_v", "V", "rms_voltage_v"),
    ("Slew", "slew_v_per_s", "V/s", "slew_v_per_s"),
    ("Peak current", "peak_current_a", "A", "peak_current_a"),
    ("RMS current", "rms_current_a", "A", "rms_current_a"),
    ("Mean power", "mean_power_w", "W", None),
    ("Duty", "duty", "%", "duty"),
    ("Warming", "temperature_rise_k", "K", None),
)


def _rows(settings: ActuatorSettings, found: Prediction) -> tuple[Figure, ...]:
    limits = settings.profile.limits
    passed = {one.name for one in breaches(found, limits)}
    rows = []
    for label, name, unit, limit_name in _ROWS:
        value = getattr(found, name)
        if not isnan(value):
            limit = None if limit_name is None else getattr(limits, limit_name)
            rows.append(
                Figure(
                    label=label,
                    value=_text(value, unit),
                    limit="" if limit is None else _text(limit, unit),
                    passed=limit_name in passed,
                )
            )
    # Beyond this velocity the measured skin was not seen to be linear; nothing breaks.
    velocity = Figure(
        label="Peak velocity",
        value=_text(found.peak_velocity_m_per_s, "mm/s"),
        limit=_text(LINEAR_VELOCITY_M_PER_S, "mm/s"),
        passed=found.linear_share > 1.0,
    )
    return (rows[0], velocity, *rows[1:])


def _text(value: float, unit: str) -> str:
    if unit == "mm/s":
        return f"{1e3 * value:.{_DIGITS}g} mm/s"
    if unit == "%":
        return f"{100.0 * value:.{_DIGITS}g} %"
    return value_text(value, unit, _DIGITS)
