"""What the actuators of a stimulus have to do, and which of their limits it passes."""

import numpy as np

from skinsource.actuators import (
    Limits,
    Prediction,
    Thermal,
    breaches,
    names,
    predicted,
    profile,
)
from skinsource.arrays import Floats
from skinsource.chain import Actuation, ActuatorAt
from skinsource.equalising import equalised, followed_band
from skinsource.limb import Limb
from skinsource.rigs.checking import strictest
from skinsource.sweeps.prepared import Prepared

#: Of the channel where each is largest, in the order of the columns.
ACTUATOR_METRICS = (
    "peak_voltage_v",
    "rms_voltage_v",
    "peak_current_a",
    "rms_current_a",
    "peak_displacement_m",
    "peak_velocity_m_per_s",
    "linear_share",
    "limits_passed",
)
# What an equaliser rings for before and after belongs to what the actuator does.
_RINGS_S = 0.1


def actuator_metrics(one: Prepared, factor: float, limits: Limits) -> dict[str, float]:
    """Metrics of the voltages at the actuators that a design is predicted through.

    ``limits_passed`` counts the limits that any channel passes, of ``limits`` and those that the
    library knows of the actuator; NaN where there are none.  All are NaN where the design is not
    predicted through actuators.

    Parameters
    ----------
    factor
        What all amplitudes are multiplied with.

    Raises
    ------
    InvalidInputError
        A place has no actuator, or drives at one place leave a velocity, so that nothing can follow
        them.
    """
    actuation = one.design.actuated
    if actuation is None:
        return dict.fromkeys(ACTUATOR_METRICS, np.nan)
    found = dict.fromkeys(ACTUATOR_METRICS, 0.0)
    passed: set[str] = set()
    known = False
    for place, drive in _drives_of(one, factor).items():
        at = actuation.at(place)
        own, thermal = _known_of(at)
        allowed = strictest(limits, own)
        known = known or allowed != Limits()
        told = _told(drive, one.limb, at, actuation, thermal)
        passed |= {breach.name for breach in breaches(told, allowed)}
        for name in ACTUATOR_METRICS[:-1]:
            found[name] = float(np.maximum(found[name], getattr(told, name)))
    found["limits_passed"] = float(len(passed)) if known else np.nan
    return found


def _told(
    drive: Floats, limb: Limb, at: ActuatorAt, actuation: Actuation, thermal: Thermal | None
) -> Prediction:
    voltage, rate_hz = drive, limb.sample_rate_hz
    if actuation.equaliser is not None:
        voltage = equalised(
            drive,
            rate_hz,
            at.model,
            actuation.equaliser,
            band_hz=followed_band(limb.band_hz, rate_hz),
            lead_s=_RINGS_S,
            tail_s=_RINGS_S,
        )
    (told,) = predicted(voltage, round(rate_hz), at.model, thermal=thermal)
    return told


def _known_of(at: ActuatorAt) -> tuple[Limits, Thermal | None]:
    """What the library knows of an actuator by its name."""
    if at.actuator not in names():
        return Limits(), None
    about = profile(at.actuator)
    return about.limits, about.thermal


def _drives_of(one: Prepared, factor: float) -> dict[int, Floats]:
    """The drive of each place where anything moves, (n_times,), m/s² or V."""
    n_times = one.stimulus_samples
    channels: dict[int, Floats] = {}
    for each in one.moving:
        drive = channels.setdefault(each.voice.location, np.zeros(n_times))
        weight = each.voice.amplitude * each.drive.factor * factor
        drive[each.start : each.end] += weight * each.drive.samples
    return channels
