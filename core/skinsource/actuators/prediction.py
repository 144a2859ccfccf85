"""What an actuator will do under a voltage, its limits, and how its coil warms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import fields as dataclass_fields

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.simulation import ActuatorMotion
from skinsource.base.arguments import checking, finite_array, integer
from skinsource.base.conventions import LARGEST_VELOCITY_M_PER_S, Floats
from skinsource.base.errors import InvalidInputError, lowered
from skinsource.signals.loudest_window import loudest_energy
from skinsource.signals.resampling import MAX_RATE_HZ, resample
from skinsource.specs import fields
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import SMALLEST, NumberSpec, OptionalSpec


def _limit(label: str, unit: str, hint: str, most: float = float("inf")) -> OptionalSpec:
    return OptionalSpec(
        label=label,
        hint=hint,
        of=NumberSpec(
            label=label, unit=unit, minimum=SMALLEST, maximum=most, step=0.02, logarithmic=True
        ),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits(fields.CheckedModel):
    """Limits of an actuator; None: unknown, and not checked.

    Attributes
    ----------
    peak_voltage_v, rms_voltage_v
        Largest voltage, and its RMS over the loudest second.
    slew_v_per_s
        Fastest change of the voltage.
    duration_s
        Longest stimulus.
    displacement_m
        Farthest the contactor may go from rest, to either side.
    peak_current_a, rms_current_a
        Largest current, and its RMS over the loudest second.
    duty
        Largest share of time that it is driven, above 0 to 1.
    """

    peak_voltage_v: float | None = fields.field(_limit("Peak voltage", "V", "Largest"), None)
    rms_voltage_v: float | None = fields.field(
        _limit("RMS voltage", "V", "Highest over any second"), None
    )
    slew_v_per_s: float | None = fields.field(_limit("Slew rate", "V/s", "Fastest change"), None)
    duration_s: float | None = fields.field(_limit("Duration", "s", "Longest stimulus"), None)
    displacement_m: float | None = fields.field(
        _limit("Displacement", "m", "Largest distance from rest"), None
    )
    peak_current_a: float | None = fields.field(_limit("Peak current", "A", "Largest"), None)
    rms_current_a: float | None = fields.field(
        _limit("RMS current", "A", "Highest over any second"), None
    )
    duty: float | None = fields.field(
        _limit("Duty cycle", "", "Largest share of time that it is driven", 1.0), None
    )


def limit_text(name: str) -> str:
    """Return the name of a field of `Limits` for the middle of a sentence."""
    label = _spec_of(name).label
    return label if label[1].isupper() else lowered(label)


def with_unit(name: str, value: float) -> str:
    """Return a value of a field of `Limits`, with its unit."""
    return f"{value:.4g} {_spec_of(name).unit}".rstrip()


def _spec_of(name: str) -> NumberSpec:
    spec = specs_of(Limits)[name]
    if not (isinstance(spec, OptionalSpec) and isinstance(spec.of, NumberSpec)):
        raise KeyError(name)
    return spec.of


@dataclass(frozen=True, slots=True, kw_only=True)
class Thermal(fields.CheckedModel):
    """How the coil warms: one heat capacity behind one thermal resistance.

    Attributes
    ----------
    resistance_k_per_w
        Rise of the temperature for each watt, in the end.
    time_constant_s
        After which 63 % of it are reached.
    """

    resistance_k_per_w: float = fields.field(
        NumberSpec(label="Thermal resistance", unit="K/W", minimum=SMALLEST)
    )
    time_constant_s: float = fields.field(
        NumberSpec(label="Thermal time constant", unit="s", minimum=SMALLEST)
    )


#: Motion is computed at this rate at least.
LEAST_RATE_HZ = 48_000
# Duration of an RMS: the loudest so many seconds, or a shorter stimulus.
_RMS_S = 1.0
# Intervals of so many seconds count as driven that hold a sample above this part of the peak.
_INTERVAL_S, _DRIVEN_SHARE = 0.01, 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Prediction:
    """Figures of one actuator under one voltage; NaN where the model does not tell.

    Attributes
    ----------
    peak_voltage_v, rms_voltage_v, slew_v_per_s
        Largest voltage, its RMS over the loudest second (or over all, where that is shorter), and
        its fastest change.
    duration_s
        Of the stimulus.
    duty
        Share of the time in which it is driven.
    peak_current_a, rms_current_a
        As of the voltage.
    mean_power_w, peak_power_w
        Into the actuator, on average and at most.
    peak_acceleration_m_per_s2, peak_velocity_m_per_s, peak_displacement_m
        Of what touches the skin.
    linear_share
        Peak velocity over 40 mm/s, up to which the measured skin was linear.
    temperature_rise_k
        Highest, where it is known how the actuator warms.
    """

    peak_voltage_v: float
    rms_voltage_v: float
    slew_v_per_s: float
    duration_s: float
    duty: float
    peak_current_a: float
    rms_current_a: float
    mean_power_w: float
    peak_power_w: float
    peak_acceleration_m_per_s2: float
    peak_velocity_m_per_s: float
    peak_displacement_m: float
    linear_share: float
    temperature_rise_k: float


@checking
def predicted(
    voltage: ArrayLike,
    sample_rate_hz: int,
    actuators: Actuator | Sequence[Actuator],
    *,
    thermal: Thermal | None = None,
    least_rate_hz: int = LEAST_RATE_HZ,
) -> tuple[Prediction, ...]:
    """Predict what each channel's actuator will do, from rest.

    Parameters
    ----------
    voltage : (n_times,) or (n_channels, n_times)
        In V, band-limited between its samples.
    sample_rate_hz
        A whole number of hertz.
    actuators
        One for all channels, or one for each.
    thermal
        How they warm; None: not known.
    least_rate_hz
        Lower rates are raised to this one, so that peaks between samples are found: from 48 kHz on,
        within 0.005 dB at 600 Hz.

    Returns
    -------
    As many predictions as there are channels.

    Raises
    ------
    InvalidInputError
        The voltage is none, or there are not as many actuators as channels.

    Examples
    --------
    >>> import skinsource as ss
    >>> model = ss.actuators.load(ss.actuators.names()[0])
    >>> (motion,) = ss.actuators.predicted(ss.sinusoid(100.0, sample_rate_hz=8000.0), 8000, model)
    >>> print(motion.peak_voltage_v)
    1.0
    """
    rate_hz = integer("sample_rate_hz", sample_rate_hz, 1, MAX_RATE_HZ)
    least_hz = integer("least_rate_hz", least_rate_hz, 1, MAX_RATE_HZ)
    rows = finite_array("voltage", voltage, "finite numbers in V, (n_channels, n_times)")
    if rows.ndim not in (1, 2) or not rows.shape[-1]:
        raise InvalidInputError(
            f"voltage has the shape {rows.shape}, expected (n_times,) or (n_channels, n_times)"
        )
    rows = np.atleast_2d(rows)
    models = [actuators] * len(rows) if isinstance(actuators, Actuator) else list(actuators)
    if len(models) != len(rows):
        raise InvalidInputError(
            f"{len(models)} actuators for {len(rows)} channels, expected one each"
        )
    dense_rate_hz = max(rate_hz, least_hz)
    predictions = []
    for row, model in zip(rows, models, strict=True):
        dense = resample(row, rate_hz, dense_rate_hz)
        motion = model.simulate(dense, dense_rate_hz, "first")
        power = dense * motion.current
        velocity = _peak(motion.velocity)
        prediction = Prediction(
            peak_voltage_v=_peak(dense),
            rms_voltage_v=_loudest_rms(dense, dense_rate_hz),
            slew_v_per_s=_peak(np.diff(dense, prepend=0.0)) * dense_rate_hz,
            duration_s=row.size / rate_hz,
            duty=duty_of(dense, dense_rate_hz),
            peak_current_a=_peak(motion.current),
            rms_current_a=_loudest_rms(motion.current, dense_rate_hz),
            mean_power_w=float(power.mean()),
            peak_power_w=float(power.max()),
            peak_acceleration_m_per_s2=_peak(motion.acceleration),
            peak_velocity_m_per_s=velocity,
            peak_displacement_m=_peak(motion.displacement),
            linear_share=velocity / LARGEST_VELOCITY_M_PER_S,
            temperature_rise_k=_temperature_rise(motion, model, dense_rate_hz, thermal),
        )
        predictions.append(prediction)
    return tuple(predictions)


def duty_of(drive: Floats, sample_rate_hz: float) -> float:
    """Return the share of the time in which a voltage or drive, (n_times,), is not silent.

    Counted are stretches of 10 ms that hold more than a thousandth of the peak.
    """
    if not drive.any():
        return 0.0
    peaks = _intervals(np.abs(drive), sample_rate_hz).max(axis=1)
    return float(np.mean(peaks > _DRIVEN_SHARE * peaks.max()))


def _intervals(values: Floats, rate_hz: float) -> Floats:
    """Return values, (n_times,), in rows of 10 ms, the last one filled up with zeros."""
    n = max(int(_INTERVAL_S * rate_hz), 1)
    return np.pad(values, (0, -values.size % n)).reshape(-1, n)


@dataclass(frozen=True, slots=True)
class Breach:
    """A limit that is passed.

    Attributes
    ----------
    name
        The field of `Limits`.
    found, limit
        In the unit of that field.
    """

    name: str
    found: float
    limit: float

    def __str__(self) -> str:
        value, limit = (with_unit(self.name, value) for value in (self.found, self.limit))
        return f"{limit_text(self.name)}: {value}, expected at most {limit}"


@checking
def breaches(prediction: Prediction, limits: Limits) -> tuple[Breach, ...]:
    """Return the limits that a prediction exceeds; NaN exceeds none.

    Examples
    --------
    >>> import skinsource as ss
    >>> model = ss.actuators.load(ss.actuators.names()[0])
    >>> (motion,) = ss.actuators.predicted(ss.sinusoid(100.0, sample_rate_hz=8000.0), 8000, model)
    >>> limits = ss.actuators.Limits(peak_voltage_v=0.5)
    >>> print([each.name for each in ss.actuators.breaches(motion, limits)])
    ['peak_voltage_v']
    """
    values = {
        limit.name: getattr(prediction, limit.name)
        for limit in dataclass_fields(Limits)
        if limit.name != "displacement_m"
    }
    values["displacement_m"] = prediction.peak_displacement_m
    return tuple(
        Breach(name, value, limit)
        for name, value in values.items()
        if (limit := getattr(limits, name)) is not None and value > limit
    )


def _peak(values: Floats) -> float:
    return float(np.abs(values).max())


def _loudest_rms(values: Floats, rate_hz: int) -> float:
    if np.isnan(values).any():
        return float("nan")
    n_window = min(int(_RMS_S * rate_hz), values.size)
    return float(np.sqrt(loudest_energy(values, n_window) / n_window))


def _temperature_rise(
    motion: ActuatorMotion, actuator: Actuator, rate_hz: int, thermal: Thermal | None
) -> float:
    """Return the highest rise of the coil's temperature, by one capacity and one resistance."""
    resistance = getattr(actuator, "resistance_ohm", None)
    if thermal is None or resistance is None:
        return float("nan")
    heat = _intervals(resistance * motion.current**2, rate_hz)
    decay = float(np.exp(-heat.shape[1] / rate_hz / thermal.time_constant_s))
    gain = (1.0 - decay) * thermal.resistance_k_per_w
    return float(scipy.signal.lfilter([gain], [1.0, -decay], heat.mean(axis=1)).max())
