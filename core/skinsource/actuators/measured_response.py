"""An actuator given by its measured response."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.simulation import ActuatorMotion, Hold, samples_of
from skinsource.base.arguments import finite_array, positive_number
from skinsource.base.arrays import Complexes, Floats
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
    def of(cls, frequency_hz: ArrayLike, response: ArrayLike) -> "MeasuredResponse":
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
