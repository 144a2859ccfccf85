"""Square, saw and triangle waves and pulse trains, made of their harmonics without aliases."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import pi
from typing import ClassVar

import numpy as np

from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.waveform import DURATION, WINDOW
from skinsource.design.waveforms.tones import FREQUENCY, PHASE, count_of
from skinsource.signals.generators import WindowName
from skinsource.signals.synthesis import burst, check_below_half_rate, sampled_series
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec

# A slower wave would be a few edges, for which clips of their own do better.
FUNDAMENTAL = replace(FREQUENCY, minimum=1.0)
DUTY = NumberSpec(
    label="Duty cycle", minimum=0.01, maximum=0.99, step=0.01, hint="High share of each period"
)


@dataclass(frozen=True, slots=True)
class Square(fields.CheckedModel):
    """A square wave without aliases: 1 for the first part of each period, then -1.

    Its Fourier series, 2 duty - 1 + sum of (4 / pi h) sin(pi h duty) cos(2 pi h (u - duty / 2))
    at the turn u = frequency t + phase / 2 pi, up to half the sample rate.  The full series has
    peak 1: with fewer harmonics it passes 1 at each edge (Gibbs), by 18 % with many harmonics and
    by 27 % with the fundamental alone.  Its harmonics are the same at every rate.  The burst is
    cut out of the wave with hard ends, or by the window.

    Attributes
    ----------
    frequency_hz
        1 Hz up to below half the sample rate.
    duty
        Share of each period that is high, 0.01 to 0.99; other than 0.5 it has a mean, 2 duty - 1.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; 0 is the rising edge.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Square"

    frequency_hz: float = fields.number(100.0, FUNDAMENTAL)
    duty: float = fields.number(0.5, DUTY)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); 1 is the height of the square wave without limit of its band."""
        series = partial(_pulse_series, self.duty, 2.0)
        mean = 2.0 * self.duty - 1.0
        return _harmonic_burst(self, series, sample_rate_hz, shift_s, mean=mean)


def _pulse_series(duty: float, height: float, harmonics: Floats) -> Complexes:
    half = pi * np.remainder(harmonics * duty, 2.0)
    turned: Complexes = np.exp(-1j * half)
    return turned * (2.0 * height / (pi * harmonics) * np.sin(half))


@dataclass(frozen=True, slots=True)
class Saw(fields.CheckedModel):
    """A sawtooth wave without aliases: it rises from 0 to 1, falls to -1, and rises again.

    Its Fourier series, the sum of (2 / pi h) (-1)^(h + 1) sin(2 pi h u) at the turn
    u = frequency t + phase / 2 pi, up to half the sample rate; without that limit it is 2 u for
    -1/2 < u < 1/2.  It starts as a sine does, without a click, and falls at half a period.  The
    full series has peak 1: with fewer harmonics it passes 1 by up to 18 % at the fall (Gibbs).
    Its harmonics are the same at every rate.  The burst is cut out of the wave with hard ends, or
    by the window.

    Attributes
    ----------
    frequency_hz
        1 Hz up to below half the sample rate.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; pi is the fall.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Saw"

    frequency_hz: float = fields.number(100.0, FUNDAMENTAL)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); 1 is the height of the saw without limit of its band."""
        return _harmonic_burst(self, _saw_series, sample_rate_hz, shift_s)


def _saw_series(harmonics: Floats) -> Complexes:
    odd = np.remainder(harmonics, 2.0) == 1.0
    return -1j * np.where(odd, 2.0, -2.0) / (pi * harmonics)


@dataclass(frozen=True, slots=True)
class Triangle(fields.CheckedModel):
    """A triangle wave without aliases: from 0 up to 1, down to -1, and back.

    Its Fourier series, the sum over odd h of (8 / pi² h²) (-1)^((h - 1) / 2) sin(2 pi h u) at
    the turn u = frequency t + phase / 2 pi, up to half the sample rate; without that limit it is
    1 - 4 |u - 1/4| for -1/4 < u < 3/4.  The full series has peak 1; with fewer harmonics it stays
    below.  Its harmonics are the same at every rate.  The burst is cut out of the wave with hard
    ends, or by the window.

    Attributes
    ----------
    frequency_hz
        1 Hz up to below half the sample rate.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; pi/2 is the upper corner.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Triangle"

    frequency_hz: float = fields.number(100.0, FUNDAMENTAL)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); 1 is the height of the triangle without limit of its band."""
        return _harmonic_burst(self, _triangle_series, sample_rate_hz, shift_s)


def _triangle_series(harmonics: Floats) -> Complexes:
    sign = np.array([0.0, 1.0, 0.0, -1.0])[harmonics.astype(np.int64) % 4]
    return -8j * sign / (pi * harmonics) ** 2


def _harmonic_burst(
    waveform: "Square | Saw | Triangle | PulseTrain",
    series: Callable[[Floats], Complexes],
    sample_rate_hz: float,
    shift_s: float,
    *,
    mean: float = 0.0,
    frequency: str = "frequency_hz",
) -> Floats:
    """Cut a burst out of a periodic wave, (n_times,).

    Parameters
    ----------
    series, mean
        Coefficients of the harmonics, and the mean of the wave: see
        `skinsource.signals.synthesis.sampled_series`.
    frequency
        Field that holds the frequency of the wave.
    """
    frequency_hz: float = getattr(waveform, frequency)
    check_below_half_rate(frequency, frequency_hz, sample_rate_hz)
    wave = sampled_series(
        series,
        frequency_hz,
        waveform.phase_rad,
        count_of(waveform.duration_s, sample_rate_hz, shift_s),
        sample_rate_hz,
        shift_s,
        mean=mean,
    )
    return burst(wave, waveform.window, sample_rate_hz, shift_s)


RATE = replace(FUNDAMENTAL, label="Rate", measured_band_hz=None, hint="Pulses per second")
PULSE = NumberSpec(
    label="Pulse",
    unit="s",
    minimum=1e-6,
    maximum=0.99,
    step=0.05,
    logarithmic=True,
    hint="Length of each pulse; shorter than one period",
)


@dataclass(frozen=True, slots=True)
class PulseTrain:
    """Rectangular pulses without aliases: 1 for the first part of each period, then 0.

    Their Fourier series, d + sum of (2 / pi h) sin(pi h d) cos(2 pi h (u - d / 2)) at the turn
    u = rate t + phase / 2 pi, up to half the sample rate; d = rate times pulse.  The full series
    has peak 1: with fewer harmonics it passes 1 and 0 at each edge (Gibbs), and pulses shorter
    than two samples are lower, since only part of them lies in the band.  Its harmonics are the
    same at every rate.  The burst is cut out of the wave with hard ends, or by the window.

    Attributes
    ----------
    rate_hz
        Pulses per second, 1 up to below half the sample rate.
    pulse_s
        Length of a pulse, 1 µs up to below 1 / ``rate_hz``.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; 0 is the start of a pulse.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Pulse train"

    rate_hz: float = fields.number(40.0, RATE)
    pulse_s: float = fields.number(0.004, PULSE)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self._duty < 1.0:
            raise InvalidInputError(
                f"PulseTrain.pulse_s is {self.pulse_s:g}, expected less than "
                f"{1.0 / self.rate_hz:g} s, the time from one pulse to the next; shorten it or "
                "lower rate_hz"
            )

    @property
    def _duty(self) -> float:
        return self.rate_hz * self.pulse_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); 1 is the height of the pulses without limit of their band."""
        series = partial(_pulse_series, self._duty, 1.0)
        return _harmonic_burst(
            self, series, sample_rate_hz, shift_s, mean=self._duty, frequency="rate_hz"
        )
