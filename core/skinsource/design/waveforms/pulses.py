"""Taps, impulses, damped sines and noise."""

from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arguments import positive_number
from skinsource.base.conventions import BAND_HZ, SAMPLE_RATE_HZ
from skinsource.base.errors import InvalidInputError
from skinsource.design.waveform import DURATION, WINDOW
from skinsource.design.waveforms.tones import FREQUENCY, PHASE, angles, count_of
from skinsource.signals.generators import TAP_S, WindowName, impulse, sample_count, tap, white_noise
from skinsource.signals.sampling import band_limited_delay, shift_of
from skinsource.signals.synthesis import (
    about_middle,
    burst,
    check_below_half_rate,
    silent_before_start,
)
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec


@dataclass(frozen=True, slots=True)
class Tap:
    """A Hanning pulse of 16.2 ms, 21 samples at 1300 Hz, as upstream.

    0.5 (1 - cos(2 pi (t + h) / (22 h))) for 0 <= t < 21 h, with h = 1/1300 s, at any rate.
    """

    title: ClassVar[str] = "Tap"

    duration_s: ClassVar[float] = TAP_S

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return tap(sample_rate_hz=sample_rate_hz, shift_s=shift_s)


WIDTH = NumberSpec(
    label="Width",
    unit="s",
    minimum=0.004,
    maximum=10.0,
    step=0.02,
    logarithmic=True,
    hint="Length of the pulse; its spectrum peaks at 1.5 / width",
)


@dataclass(frozen=True, slots=True)
class CentredTap(fields.CheckedModel):
    """A tap whose mean is 0: as an acceleration it leaves neither velocity nor displacement.

    (cos(2 pi t / T) + cos(4 pi t / T)) / 2 for |t| <= T / 2: a crest of 1 and of a third of the
    width, between two troughs of -0.56, with a level start and end.  It has n = round(T rate)
    samples, about their middle: t = (k - (n - 1) / 2) / rate.  The upstream tap (`Tap`) has half
    of its energy below 25 Hz, where nothing was measured, and leaves a velocity.

    Attributes
    ----------
    width_s
        T, 4 ms to 10 s; the frequency of its second cosine, 2 / T, must be below half the sample
        rate.
    """

    title: ClassVar[str] = "Centred tap"

    width_s: float = fields.number(0.02, WIDTH)

    @property
    def duration_s(self) -> float:
        """The width."""
        return self.width_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        if 2.0 / self.width_s >= positive_number("sample_rate_hz", sample_rate_hz) / 2:
            raise InvalidInputError(
                f"width_s is {self.width_s:g}, expected more than {4.0 / sample_rate_hz:g} s at "
                f"{sample_rate_hz:g} Hz; a shorter tap would alias"
            )
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.width_s, sample_rate_hz)
        turn = about_middle(n, sample_rate_hz, shift_s) / self.width_s
        pulse = 0.5 * (np.cos(2.0 * pi * turn) + np.cos(4.0 * pi * turn))
        pulse[np.abs(turn) > 0.5] = 0.0
        return silent_before_start(pulse, shift_s)


@dataclass(frozen=True, slots=True)
class Impulse:
    """One sample of 1, whose result is the impulse response itself.

    It is one sample at any rate, so its energy depends on the rate: at half the rate it has twice
    the area.  If it starts between two samples, these two approximate a delayed impulse: the onset
    is right, frequencies near 0 are up to 2.1 dB stronger, and high ones are weaker, 600 Hz by up
    to 16 dB at a sample rate of 1300 Hz.
    """

    title: ClassVar[str] = "Impulse"

    # The length that is drawn; in fact it is one sample at the rate of the limb.
    duration_s: ClassVar[float] = 1 / SAMPLE_RATE_HZ

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        shift = shift_of(shift_s, sample_rate_hz)
        return band_limited_delay(impulse(sample_rate_hz=sample_rate_hz), shift * sample_rate_hz)


DECAY = NumberSpec(
    label="Decay",
    unit="s",
    minimum=0.0001,
    maximum=60.0,
    step=0.05,
    logarithmic=True,
    hint="Time to fall to 37 %; hard contacts: 5 to 30 ms",
)


@dataclass(frozen=True, slots=True)
class DampedSine(fields.CheckedModel):
    """A sine with an exponential decay, as of a struck object.

    exp(-t / decay) sin(2 pi frequency t + phase).  The decay starts at 1, and the first crest, a
    quarter of a period later, is lower.

    Attributes
    ----------
    frequency_hz
        0.01 Hz up to below half the sample rate.
    decay_s
        Time constant, 0.1 ms to 60 s.
    duration_s
        Length, 0.001 to 600 s; the rest of the decay is cut off.
    phase_rad
        Phase at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``, over the decay.

    References
    ----------
    Okamura, Cutkosky and Dennerlein, Reality-based models for vibration feedback in virtual
    environments, IEEE/ASME Transactions on Mechatronics 6(3), 2001.
    """

    title: ClassVar[str] = "Damped sine"

    frequency_hz: float = fields.number(100.0, FREQUENCY)
    decay_s: float = fields.number(0.03, DECAY)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), below a decay that starts at 1."""
        check_below_half_rate("frequency_hz", self.frequency_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        wave = angles(self.frequency_hz, self.phase_rad, n, sample_rate_hz, shift_s)
        np.sin(wave, out=wave)
        decay = np.arange(n) / sample_rate_hz - shift_s
        decay /= -self.decay_s
        wave *= np.exp(decay, out=decay)
        return burst(wave, self.window, sample_rate_hz, shift_s)


SEED = NumberSpec(
    label="Seed", minimum=0, maximum=2**31 - 1, whole=True, hint="The same seed, the same noise"
)
LOW = NumberSpec(
    label="From",
    unit="Hz",
    minimum=0.0,
    maximum=99_999.0,
    step=1.0,
    measured_band_hz=BAND_HZ,
    hint="Lowest frequency of the noise",
)
HIGH = replace(
    LOW, label="To", minimum=1.0, maximum=100_000.0, hint="Highest frequency of the noise"
)
# Shorter noise holds no frequency of the band.
NOISE_DURATION = replace(DURATION, minimum=0.01)


@dataclass(frozen=True, slots=True)
class Noise:
    """Gaussian noise, flat within a band and zero outside.

    It is a sum of waves at multiples of 1 / ``duration_s``, and its largest sample is 1.  A window
    widens the spectrum a little.

    Attributes
    ----------
    seed
        Whole number; the same seed gives the same noise.
    duration_s
        Length; at least 1 / (``high_hz`` - ``low_hz``).
    low_hz, high_hz
        The band, both ends included.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Noise"

    seed: int = fields.number(0, SEED)
    duration_s: float = fields.number(0.2, NOISE_DURATION)
    # The defaults are the same for every limb, because files leave defaults out.
    low_hz: float = fields.number(BAND_HZ[0], LOW)
    high_hz: float = fields.number(BAND_HZ[1], HIGH)
    window: WindowName = fields.choice("tukey", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.low_hz < self.high_hz:
            raise InvalidInputError(
                f"Noise.low_hz is {self.low_hz:g}, expected less than high_hz, {self.high_hz:g} Hz"
            )
        if (self.high_hz - self.low_hz) * self.duration_s < 1.0:
            raise InvalidInputError(
                f"Noise.duration_s is {self.duration_s:g}, expected at least "
                f"{1.0 / (self.high_hz - self.low_hz):g} s: shorter noise holds no frequency "
                f"between {self.low_hz:g} and {self.high_hz:g} Hz"
            )

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return white_noise(
            self.duration_s,
            self.seed,
            band_hz=(self.low_hz, self.high_hz),
            window_name=self.window,
            sample_rate_hz=sample_rate_hz,
            shift_s=shift_s,
        )
