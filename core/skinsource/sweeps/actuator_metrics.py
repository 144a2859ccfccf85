"""What the actuators of a stimulus would have to do, and which of their limits it passes."""

import numpy as np

from skinsource.actuators import Limits, breaches, load, predicted, profile
from skinsource.arrays import Floats
from skinsource.equalising import RegularisedInverse, equalised
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
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
_RATE_HZ = 48_000


def actuator_metrics(
    one: Prepared, factor: float, actuator: str, limits: Limits
) -> dict[str, float]:
    """Metrics of the voltages that make one kind of actuator follow all drives.

    The drive of each place is equalised by `skinsource.equalising.RegularisedInverse`.
    ``limits_passed`` counts the limits that any channel passes, of ``limits`` and those of the
    actuator; NaN where there are none.

    Parameters
    ----------
    factor
        What all amplitudes are multiplied with.
    actuator
        A name of `skinsource.actuators.names`.

    Raises
    ------
    InvalidInputError
        There is no such actuator, amplitudes are no accelerations, or a drive leaves a velocity, so
        that nothing can follow it.
    """
    model, about = load(actuator), profile(actuator)
    if one.design.scaling != "probe":
        raise InvalidInputError(
            f"the scaling is {quoted(one.design.scaling)}, and an actuator is to follow m/s². "
            "Choose the scaling Probe acceleration."
        )
    drives = _drives_of(one, factor)
    allowed = strictest(limits, about.limits)
    known = allowed != Limits()
    found = dict.fromkeys(ACTUATOR_METRICS, 0.0)
    passed: set[str] = set()
    if drives.size and drives.any():
        rate_hz = one.limb.sample_rate_hz
        # What the filter rings for before and after belongs to what the actuator does.
        voltages = equalised(drives, rate_hz, model, RegularisedInverse(), lead_s=0.1, tail_s=0.1)
        told = predicted(voltages, round(rate_hz), model, thermal=about.thermal)
        for name in ACTUATOR_METRICS[:-1]:
            found[name] = float(np.max([getattr(each, name) for each in told]))
        passed = {breach.name for each in told for breach in breaches(each, allowed)}
    found["limits_passed"] = float(len(passed)) if known else np.nan
    return found


def _drives_of(one: Prepared, factor: float) -> Floats:
    """The drive of each place, (n_places, n_times), m/s²."""
    n_times = one.stimulus_samples
    channels: dict[int, Floats] = {}
    for each in one.placed:
        drive = channels.setdefault(each.voice.location, np.zeros(n_times))
        weight = each.voice.amplitude * each.drive.factor * factor
        drive[each.start : each.end] += weight * each.drive.samples
    return np.array(list(channels.values()))
