"""An actuator given by its measured response, and the fit of a voice coil to one."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import ClassVar

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.models import VoiceCoil
from skinsource.actuators.simulation import ActuatorMotion, Hold, samples_of
from skinsource.base.arguments import finite_array, positive_number
from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.specs import fields
from skinsource.specs.numbers import SMALLEST, NumberSpec, PointsSpec

MAX_POINTS = 20_000
POINTS = PointsSpec(
    label="Response",
    columns=(
        NumberSpec(label="Frequency", unit="Hz", minimum=SMALLEST, maximum=1e9),
        NumberSpec(label="Gain", unit="m/s² per V", minimum=SMALLEST, maximum=1e30),
        NumberSpec(label="Phase", unit="rad", minimum=-1e6, maximum=1e6),
    ),
    fewest=2,
    most=MAX_POINTS,
)
# Silence behind the signal, in which what rings dies away: of the lowest frequency, so many turns.
_TURNS_OF_SILENCE = 50.0
_MOST_SILENCE_S = 20.0


@dataclass(frozen=True, slots=True)
class MeasuredResponse(Actuator):
    """Acceleration for each volt as it was measured, in place of a model.

    Between the points, gain in decibels and phase go evenly over the logarithm of the frequency;
    below the first and above the last the gain falls by 12 dB in each octave.  The current is
    not known, and given as NaN.

    Attributes
    ----------
    points
        2 to 20 000 of (Hz, m/s² per V, rad), frequencies rising.
    """

    title: ClassVar[str] = "Measured response"

    points: tuple[tuple[float, float, float], ...] = fields.field(POINTS)

    def __post_init__(self) -> None:
        fields.check(self)
        frequency_hz = np.array(self.points)[:, 0]
        if not (np.diff(frequency_hz) > 0.0).all():
            raise InvalidInputError(
                "MeasuredResponse.points has a frequency twice, expected rising ones"
            )

    @classmethod
    def of(cls, frequency_hz: ArrayLike, response: ArrayLike) -> MeasuredResponse:
        """Make a response from arrays, (n,) each: frequencies in any order, complex m/s² per V."""
        rising_hz, values = measured_arrays(frequency_hz, response)
        phase_rad = np.unwrap(np.angle(values))
        return cls(
            tuple(zip(rising_hz.tolist(), np.abs(values).tolist(), phase_rad.tolist(), strict=True))
        )

    def response(self, frequency_hz: ArrayLike) -> Complexes:
        """Return acceleration over voltage, in m/s² per V."""
        at_hz = finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz")
        known_hz, gain, phase_rad = np.array(self.points).T
        size_hz = np.abs(at_hz)
        with np.errstate(divide="ignore"):
            place = np.log(size_hz)
            log_gain = np.interp(place, np.log(known_hz), np.log(gain))
            below = 2.0 * np.minimum(place - np.log(known_hz[0]), 0.0)
            above = -2.0 * np.maximum(place - np.log(known_hz[-1]), 0.0)
        angle = np.interp(place, np.log(known_hz), phase_rad) * np.sign(at_hz)
        return np.exp(log_gain + below + above) * np.exp(1j * angle)

    def admittance(self, frequency_hz: ArrayLike) -> Complexes:
        """Return NaN: the current was not measured."""
        at_hz = finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz")
        return np.full(at_hz.shape, np.nan + 0j)

    def simulate(
        self, voltage: ArrayLike, sample_rate_hz: float, hold: Hold = "zero"
    ) -> ActuatorMotion:
        """Return the motion under a voltage, from rest, at its samples, below half the rate."""
        samples = samples_of(voltage, hold)
        rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
        silence_s = min(_TURNS_OF_SILENCE / self.points[0][0], _MOST_SILENCE_S)
        length = scipy.fft.next_fast_len(samples.size + int(silence_s * rate_hz) + 1, real=True)
        frequency_hz = np.arange(length // 2 + 1) * rate_hz / length
        held = np.sinc(frequency_hz / rate_hz)
        if hold == "zero":
            half_step_delay = np.exp(-1j * np.pi * frequency_hz / rate_hz)
            passed = held * half_step_delay
        else:
            passed = held * held
        spectrum = scipy.fft.rfft(samples, length) * passed * self.response(frequency_hz)

        def in_time(values: Complexes) -> Floats:
            return scipy.fft.irfft(values, length)[: samples.size]

        turning = 2j * np.pi * np.where(frequency_hz == 0.0, 1.0, frequency_hz)
        return ActuatorMotion(
            acceleration=in_time(spectrum),
            velocity=in_time(spectrum / turning),
            displacement=in_time(spectrum / turning**2),
            current=np.full(samples.size, np.nan),
        )


def measured_arrays(frequency_hz: ArrayLike, response: ArrayLike) -> tuple[Floats, Complexes]:
    """Return rising frequencies and complex values, (n,) each; raise where they are unusable."""
    rising_hz = finite_array("frequency_hz", frequency_hz, "frequencies in Hz, (n,)")
    values = np.asarray(response)
    if values.dtype.kind not in "iufc":
        raise InvalidInputError(f"response is {values.dtype}, expected complex numbers, (n,)")
    if rising_hz.ndim != 1 or values.shape != rising_hz.shape or rising_hz.size < 2:
        raise InvalidInputError(
            f"frequency_hz and response have the shapes {rising_hz.shape} and {values.shape}, "
            "expected two rows of equal length, at least 2"
        )
    if not np.isfinite(values).all() or not values.all():
        raise InvalidInputError("response holds zeros or values that are not numbers; remove them")
    if not (rising_hz > 0.0).all():
        raise InvalidInputError("frequency_hz holds frequencies of 0 or below; remove them")
    order = np.argsort(rising_hz, kind="stable")
    return rising_hz[order], values.astype(np.complex128)[order]


#: The model has four constants that a response determines; fewer points than these are no fit.
_FEWEST_POINTS = 8
_QUALITIES, _TIMES_S = (0.7, 3.0, 15.0), (1e-5, 2e-4)


def fit(
    frequency_hz: ArrayLike,
    response: ArrayLike,
    *,
    resistance_ohm: float = 8.0,
    moving_mass_kg: float | None = None,
) -> VoiceCoil:
    """Return the voice coil whose response is nearest to a measured one.

    Nearest means: the sum of squares of the relative differences is the least.  A response in m/s²
    per V determines four of the six parameters of a coil: the resistance is given (measure it with
    an ohmmeter), and the mass may be; without it the motion is that of the measurement, and the
    current is a guess.

    Parameters
    ----------
    frequency_hz, response : (n,)
        At least 8 points; real values are taken as magnitudes without a known phase.
    resistance_ohm, moving_mass_kg
        Above 0.

    Raises
    ------
    InvalidInputError
        There are too few points, or nothing near them is a voice coil.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> coil, hz = ss.actuators.load("example-voice-coil"), np.geomspace(25.0, 600.0, 40)
    >>> fitted = ss.actuators.fit(hz, coil.response(hz))
    >>> print(f"{ss.actuators.misfit_db(fitted, hz, coil.response(hz)):.1f} dB")
    0.0 dB
    """
    known_hz, values = measured_arrays(frequency_hz, response)
    resistance = positive_number("resistance_ohm", resistance_ohm)
    mass = None if moving_mass_kg is None else positive_number("moving_mass_kg", moving_mass_kg)
    if known_hz.size < _FEWEST_POINTS:
        raise InvalidInputError(
            f"{known_hz.size} points are too few for a fit, expected at least {_FEWEST_POINTS}"
        )
    with_phase = bool(np.iscomplexobj(np.asarray(response)) and values.imag.any())

    def coil(logs: Floats) -> VoiceCoil:
        inductance, force, damping, stiffness, *free = np.exp(logs).tolist()
        return VoiceCoil(
            resistance, inductance, force, free[0] if mass is None else mass, damping, stiffness
        )

    def misfits(logs: Floats) -> Floats:
        fitted = coil(logs).response(known_hz)
        if not with_phase:
            return np.log(np.abs(fitted) / np.abs(values))
        relative = (fitted - values) / np.abs(values)
        return np.concatenate((relative.real, relative.imag))

    def cost(start: Floats) -> float:
        return float(np.square(misfits(start)).sum())

    starts = sorted(_starts(known_hz, values, resistance, mass), key=cost)[:4]
    fits = (
        scipy.optimize.least_squares(misfits, start, bounds=(start - 14.0, start + 14.0))
        for start in starts
    )
    best = min(fits, key=lambda result: float(result.cost))
    return coil(best.x)


def misfit_db(actuator: Actuator, frequency_hz: ArrayLike, response: ArrayLike) -> float:
    """Return the largest difference between the gains of an actuator and a measurement, in dB.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> model, hz = ss.actuators.load(ss.actuators.names()[0]), np.geomspace(25.0, 600.0, 20)
    >>> print(ss.actuators.misfit_db(model, hz, model.response(hz)))
    0.0
    """
    known_hz, values = measured_arrays(frequency_hz, response)
    gain = np.abs(actuator.response(known_hz))
    with np.errstate(divide="ignore"):
        return float(np.abs(20.0 * np.log10(gain / np.abs(values))).max())


def _starts(
    frequency_hz: Floats, values: Complexes, resistance: float, mass: float | None
) -> list[Floats]:
    """Return logarithms of parameters to start from: resonances in the band and at the peak.

    Force factors are such that the gain fits in the middle.
    """
    first, last = frequency_hz[0], frequency_hz[-1]
    resonances = [*np.geomspace(first, last, 7), frequency_hz[np.abs(values).argmax()]]
    starts = []
    for resonance_hz, quality, time_s in product(resonances, _QUALITIES, _TIMES_S):
        turning = 2.0 * np.pi * resonance_hz
        own = 1e-3 if mass is None else mass
        shape = VoiceCoil(
            resistance, resistance * time_s, 1e-3, own, own * turning / quality, own * turning**2
        )
        ratio = np.abs(values) / np.abs(shape.response(frequency_hz))
        force = 1e-3 * float(np.exp(np.median(np.log(ratio))))
        # What brakes electrically must not brake mechanically as well.
        damping = max(
            own * turning / quality - force**2 / resistance, 0.05 * own * turning / quality
        )
        logs = [resistance * time_s, force, damping, own * turning**2]
        starts.append(np.log([*logs, own] if mass is None else logs))
    return starts
