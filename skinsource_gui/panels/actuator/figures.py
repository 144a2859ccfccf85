"""What a design asks of an actuator, in words."""

from dataclasses import dataclass
from math import isnan

from skinsource.actuators.prediction import Prediction, breaches
from skinsource.base.published import LARGEST_VELOCITY_M_PER_S
from skinsource.engine.actuator_demand import ActuatorSettings
from skinsource_gui.widgets.fields.units import value_text

_DIGITS = 3


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


def rows_of(settings: ActuatorSettings, found: Prediction) -> tuple[Figure, ...]:
    """Each figure that is known, with its limit."""
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
        limit=_text(LARGEST_VELOCITY_M_PER_S, "mm/s"),
        passed=found.linear_share > 1.0,
    )
    return (rows[0], velocity, *rows[1:])


def _text(value: float, unit: str) -> str:
    if unit == "mm/s":
        return f"{1e3 * value:.{_DIGITS}g} mm/s"
    if unit == "%":
        return f"{100.0 * value:.{_DIGITS}g} %"
    return value_text(value, unit, _DIGITS)
