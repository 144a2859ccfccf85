"""Tones: sine bursts, modulated tones, chirps and glides."""

from dataclasses import dataclass, replace
from decimal import Decimal, localcontext
from itertools import pairwise
from math import ceil, pi
from typing import Any, ClassVar, Literal

import numpy as np

from skinsource.base.conventions import BAND_HZ, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.waveform import CENTRE, DURATION, LONGEST_S, WINDOW, lists_to_tuples
from skinsource.signals.generators import WindowName, sample_count, sinusoid
from skinsource.signals.sampling import shift_of, turns
from skinsource.signals.synthesis import (
    DIGITS,
    bent_turns,
    burst,
    check_below_half_rate,
    linear_sweep_turns,
    logarithmic_sweep_turns,
)
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec, PointsSpec
from skinsource.specs.spec import ChoiceSpec

FREQUENCY = replace(CENTRE, minimum=0.01, hint="")
PHASE = NumberSpec(
    label="Phase", unit="rad", minimum=-2 * pi, maximum=2 * pi, step=pi / 36, hint="Phase at onset"
)


@dataclass(frozen=True, slots=True)
class Tone(fields.CheckedModel):
    """A sine burst.

    Attributes
    ----------
    frequency_hz, phase_rad, duration_s
        Frequency (25 to 600 Hz is the measured band; it must be below half the sample rate of
        the limb), phase at onset, length.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Tone"

    frequency_hz: float = fields.number(100.0, FREQUENCY)
    phase_rad: float = fields.number(0.0, PHASE)
    duration_s: float = fields.number(0.2, DURATION)
    window: WindowName = fields.choice("tukey", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), of peak 1."""
        return sinusoid(
            self.frequency_hz,
            self.duration_s,
            phase_rad=self.phase_rad,
            window_name=self.window,
            sample_rate_hz=sample_rate_hz,
            shift_s=shift_s,
        )


def count_of(duration_s: float, sample_rate_hz: float, shift_s: float) -> int:
    """Return the number of samples of a waveform: one more if it starts between two samples."""
    return sample_count(duration_s, sample_rate_hz) + (shift_of(shift_s, sample_rate_hz) > 0.0)


def angles(
    frequency_hz: float, phase_rad: float, n: int, sample_rate_hz: float, shift_s: float
) -> Floats:
    """Return the angle of a steady wave at a waveform's samples, (n_times,), in rad."""
    angle = turns(frequency_hz, n, sample_rate_hz, shift_s)
    angle *= 2.0 * pi
    angle += phase_rad
    return angle


CARRIER = replace(FREQUENCY, label="Carrier")
MODULATOR = replace(
    FREQUENCY,
    label="Modulator",
    minimum=0.1,
    measured_band_hz=None,
    hint="Modulation frequency: swells per second",
)
DEPTH = NumberSpec(
    label="Depth", minimum=0.0, maximum=1.0, step=0.01, hint="1: down to silence; 0: a plain tone"
)
MODULATOR_PHASE = replace(
    PHASE, label="Modulator phase", hint="Phase of the modulator at onset; π starts at the quietest"
)


@dataclass(frozen=True, slots=True)
class AmplitudeModulated(fields.CheckedModel):
    """A tone whose amplitude is modulated by a sine.

    (1 + depth cos(2 pi modulator t + modulator phase)) / (1 + depth)
    sin(2 pi carrier t + phase): three spectral lines, at the carrier and one modulator below and
    above it.  Its loudest moments have peak 1.

    Attributes
    ----------
    carrier_hz, modulator_hz
        Frequencies; their sum must be below half the sample rate.
    depth
        0 to 1.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad, modulator_phase_rad
        Phases at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Amplitude modulated"

    carrier_hz: float = fields.number(200.0, CARRIER)
    modulator_hz: float = fields.number(20.0, MODULATOR)
    depth: float = fields.number(1.0, DEPTH)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    modulator_phase_rad: float = fields.number(0.0, MODULATOR_PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), of peak 1."""
        check_below_half_rate("carrier_hz", self.carrier_hz, sample_rate_hz)
        if self.depth:
            highest_hz = self.carrier_hz + self.modulator_hz
            check_below_half_rate("carrier_hz + modulator_hz", highest_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        wave = angles(self.carrier_hz, self.phase_rad, n, sample_rate_hz, shift_s)
        np.sin(wave, out=wave)
        swell = angles(self.modulator_hz, self.modulator_phase_rad, n, sample_rate_hz, shift_s)
        np.cos(swell, out=swell)
        swell *= self.depth
        swell += 1.0
        wave *= swell
        wave /= 1.0 + self.depth
        return burst(wave, self.window, sample_rate_hz, shift_s)


DEVIATION = NumberSpec(
    label="Deviation",
    unit="Hz",
    minimum=0.0,
    maximum=100_000.0,
    step=5.0,
    hint="How far the frequency swings to either side of the carrier",
)


@dataclass(frozen=True, slots=True)
class FrequencyModulated(fields.CheckedModel):
    """A tone whose frequency is modulated by a sine.

    sin(2 pi carrier t + phase + (deviation / modulator) (sin(2 pi modulator t + modulator phase)
    - sin(modulator phase))): the frequency is carrier + deviation cos(2 pi modulator t +
    modulator phase).  Spectral lines on both sides of the carrier, one modulator apart, have no
    end: by Carson's rule 98 % of the energy lies within deviation + modulator of the carrier.
    Lines at or above half the sample rate alias, as in any sampled formula.

    Attributes
    ----------
    carrier_hz, modulator_hz, deviation_hz
        Mean frequency, swings per second, and their size; carrier + deviation, the highest
        frequency, must be below half the sample rate.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad, modulator_phase_rad
        Phases at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.

    References
    ----------
    Carson, Notes on the theory of modulation, Proceedings of the IRE 10(1), 1922.
    """

    title: ClassVar[str] = "Frequency modulated"

    carrier_hz: float = fields.number(200.0, CARRIER)
    modulator_hz: float = fields.number(20.0, replace(MODULATOR, hint="Swings per second"))
    deviation_hz: float = fields.number(50.0, DEVIATION)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    modulator_phase_rad: float = fields.number(
        0.0, replace(MODULATOR_PHASE, hint="Phase of the modulator at onset; 0 begins highest")
    )
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), of peak 1."""
        check_below_half_rate("carrier_hz", self.carrier_hz, sample_rate_hz)
        check_below_half_rate("modulator_hz", self.modulator_hz, sample_rate_hz)
        highest_hz = self.carrier_hz + self.deviation_hz
        check_below_half_rate("carrier_hz + deviation_hz", highest_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        swing = turns(self.modulator_hz, n, sample_rate_hz, shift_s)
        # The sine of a small angle is more exact, and the deviation may multiply its error.
        swing -= np.rint(swing)
        swing *= 2.0 * pi
        swing += self.modulator_phase_rad
        np.sin(swing, out=swing)
        swing -= np.sin(self.modulator_phase_rad)
        swing *= self.deviation_hz / self.modulator_hz
        wave = angles(self.carrier_hz, self.phase_rad, n, sample_rate_hz, shift_s)
        wave += swing
        return burst(np.sin(wave, out=wave), self.window, sample_rate_hz, shift_s)


Law = Literal["linear", "logarithmic"]

START = replace(FREQUENCY, label="From", hint="Frequency at onset")
END = replace(FREQUENCY, label="To", hint="Frequency at the end; a lower one falls")
LAW = ChoiceSpec(
    label="Law",
    options=(("linear", "Linear"), ("logarithmic", "Logarithmic")),
    hint="Linear: equal steps in Hz in equal times; logarithmic: equal ratios",
)


@dataclass(frozen=True, slots=True)
class Chirp(fields.CheckedModel):
    """A sine whose frequency goes from f0 to f1 in the time T.

    sin(2 pi p(t) + phase), with p(t) = f0 t + (f1 - f0) t² / 2T (linear: the frequency is
    f0 + (f1 - f0) t / T), or p(t) = f0 T ((f1 / f0)^(t / T) - 1) / ln(f1 / f0) (logarithmic:
    it is f0 (f1 / f0)^(t / T)).  The phase is wrong by less than 1e-12 rad at any time.

    Attributes
    ----------
    start_hz, end_hz
        f0 and f1, 0.01 Hz up to below half the sample rate; the end may be the lower one.
    duration_s
        T, 0.001 to 600 s.
    law
        ``"linear"`` or ``"logarithmic"``.
    phase_rad
        Phase at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.  The default is none, because a window removes
        the first and the last frequencies.
    """

    title: ClassVar[str] = "Chirp"

    # The defaults are the same for every limb, because files leave defaults out.
    start_hz: float = fields.number(BAND_HZ[0], START)
    end_hz: float = fields.number(BAND_HZ[1], END)
    duration_s: float = fields.number(1.0, DURATION)
    law: Law = fields.choice("linear", LAW)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), of peak 1."""
        check_below_half_rate("start_hz", self.start_hz, sample_rate_hz)
        check_below_half_rate("end_hz", self.end_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        if self.start_hz == self.end_hz:
            wave = turns(self.start_hz, n, sample_rate_hz, shift_s)
        else:
            swept = linear_sweep_turns if self.law == "linear" else logarithmic_sweep_turns
            ends_hz = self.start_hz, self.end_hz
            wave = swept(ends_hz, self.duration_s, n, sample_rate_hz, shift_s)
        wave *= 2.0 * pi
        wave += self.phase_rad
        return burst(np.sin(wave, out=wave), self.window, sample_rate_hz, shift_s)


#: Time, frequency, amplitude.
Point = tuple[float, float, float]

POINTS = PointsSpec(
    label="Points",
    columns=(
        NumberSpec(label="Time", unit="s", minimum=0.0, maximum=LONGEST_S, step=0.01),
        replace(FREQUENCY, minimum=0.0),
        NumberSpec(label="Amplitude", minimum=0.0, maximum=1.0, step=0.05),
    ),
    most=2000,
    hint="Frequency and amplitude go straight from each point to the next",
)
_SHORTEST_S = 0.001


@dataclass(frozen=True, slots=True)
class Glide:
    """A sine whose frequency f(t) and amplitude a(t) go straight from point to point.

    a(t) sin(2 pi p(t)), where p(t) is the integral of f from 0 to t: pieces of parabolas, whose
    turns are added up exactly, so that the phase is wrong by less than 1e-12 rad at any time.
    Two points at one time make a step of frequency or amplitude; the phase never jumps.

    Attributes
    ----------
    points
        ((time in s, frequency in Hz, amplitude from 0 to 1), …), 2 to 2000 of them, times never
        falling.  Before the first point its values hold; the last one, between 1 ms and 600 s,
        ends the tone.  Frequencies are 0 Hz up to below half the sample rate.
    """

    title: ClassVar[str] = "Glide"

    points: tuple[Point, ...] = fields.field(
        POINTS, ((0.0, 60.0, 0.0), (0.1, 60.0, 1.0), (0.4, 240.0, 1.0), (0.5, 240.0, 0.0))
    )

    def __post_init__(self) -> None:
        lists_to_tuples(self, "points")
        fields.check(self)
        if self.duration_s < _SHORTEST_S:
            raise InvalidInputError(
                f"Glide.points end at {self.duration_s:g} s, expected a last time of at least "
                f"{_SHORTEST_S:g} s"
            )

    @property
    def duration_s(self) -> float:
        """Time of the last point."""
        return self.points[-1][0]

    @classmethod
    def like(cls, waveform: Any) -> "Glide":
        """Return a glide with the length and frequencies of a waveform that has one or two."""
        low_hz: Any = getattr(waveform, "start_hz", getattr(waveform, "frequency_hz", None))
        high_hz: Any = getattr(waveform, "end_hz", low_hz)
        if low_hz is None or waveform.duration_s < _SHORTEST_S:
            return cls()
        return cls(((0.0, low_hz, 1.0), (waveform.duration_s, high_hz, 1.0)))

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), within the drawn amplitude of at most 1."""
        check_below_half_rate("frequency_hz", max(hz for _, hz, _ in self.points), sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        wave = np.zeros(n)
        rate, shift = Decimal(sample_rate_hz), Decimal(shift_s)
        turned = Decimal(0)
        first = 1 if shift_s else 0
        for before, after in pairwise(((0.0, *self.points[0][1:]), *self.points)):
            with localcontext(prec=DIGITS):
                (start, low, _), (end, high, _) = (map(Decimal, point) for point in (before, after))
                turns_before, until = turned, min(ceil((end + shift) * rate), n)
                turned = (turned + (low + high) / 2 * (end - start)) % 1
                if until <= first:
                    continue
                slope, since = (high - low) / (end - start), first / rate - shift - start
            n_piece = until - first
            part = (float(since) + np.arange(n_piece) / sample_rate_hz) / (after[0] - before[0])
            level = before[2] + (after[2] - before[2]) * np.clip(part, 0.0, 1.0)
            bent = bent_turns(turns_before, low, slope, since, n_piece, sample_rate_hz)
            wave[first:until] = level * np.sin(2.0 * pi * bent)
            first = until
        return wave
