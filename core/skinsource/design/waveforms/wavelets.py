"""Single wavelets: Gabor, Morlet, Ricker, and the chirplet."""

from dataclasses import dataclass
from decimal import Decimal, localcontext
from math import expm1, pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveform import CENTRE, CYCLES, check_waveform_duration
from skinsource.design.waveforms.tones import PHASE
from skinsource.signals.generators import sample_count
from skinsource.signals.sampling import shift_of
from skinsource.signals.synthesis import (
    DIGITS,
    about_middle,
    bent_turns,
    check_below_half_rate,
    silent_before_start,
    turns_about_middle,
)
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec


@dataclass(frozen=True, slots=True)
class Gabor:
    """A tone within a Gaussian, the burst that is narrowest in time and frequency together.

    exp(-t² / 2 sigma²) cos(2 pi f t + phase), with sigma = cycles / (2 pi f), cut at t = ±4 sigma,
    where 0.03 % of the peak are left.  It has n = round(8 sigma rate) samples, about their
    middle: t = (k - (n - 1) / 2) / rate.  The peak of the formula is 1; no sample need lie on it.
    The phase is wrong by less than 1e-12 rad.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate.  The spectrum is a Gaussian about it, with a
        standard deviation of f / cycles.
    cycles
        0.5 to 10 000; about as many are visible.
    phase_rad
        Phase at the middle: 0 is a crest, -pi / 2 a rising zero.

    References
    ----------
    Gabor, Theory of communication, Journal of the IEE 93(3), 1946.
    """

    title: ClassVar[str] = "Gabor wavelet"

    frequency_hz: float = fields.number(100.0, CENTRE)
    cycles: float = fields.number(4.0, CYCLES)
    phase_rad: float = fields.number(0.0, PHASE)

    def __post_init__(self) -> None:
        fields.check(self)
        check_waveform_duration("Gabor", self.duration_s, "Raise frequency_hz or lower cycles.")

    @property
    def sigma_s(self) -> float:
        """Standard deviation of the Gaussian."""
        return self.cycles / (2.0 * pi * self.frequency_hz)

    @property
    def duration_s(self) -> float:
        """8 sigma."""
        return 8.0 * self.sigma_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        check_below_half_rate("frequency_hz", self.frequency_hz, sample_rate_hz)
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        envelope = about_middle(n, sample_rate_hz, shift_s)
        envelope /= self.sigma_s
        np.square(envelope, out=envelope)
        envelope *= -0.5
        wave = turns_about_middle(self.frequency_hz, n, sample_rate_hz, shift_s)
        wave *= 2.0 * pi
        wave += self.phase_rad
        np.cos(wave, out=wave)
        wave *= np.exp(envelope, out=envelope)
        return silent_before_start(wave, shift_s)


W0 = NumberSpec(
    label="w0",
    minimum=1.0,
    maximum=1000.0,
    step=0.02,
    logarithmic=True,
    hint="Tone radians per standard deviation of the Gaussian; usually 5 or 6",
)


@dataclass(frozen=True, slots=True)
class Morlet:
    """Real part of the admissible Morlet wavelet, whose mean is 0 for every w0.

    (cos(w0 u) - c) exp(-u² / 2) / (1 - c), with c = exp(-w0² / 2), u = t / s and
    s = w0 / (2 pi f), cut at u = ±5, where 4e-6 of the peak is left.  It takes
    n = round(10 s rate) samples, about their middle: t = (k - (n - 1) / 2) / rate.  The peak of
    the formula is 1; w0 = 6 differs from a Gabor wavelet of 6 cycles by 2e-8, w0 = 1 by half.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate; for w0 below 3 the spectrum has its peak above
        it.
    w0
        1 to 1000.

    References
    ----------
    Grossmann and Morlet, Decomposition of Hardy functions into square integrable wavelets of
    constant shape, SIAM Journal on Mathematical Analysis 15(4), 1984.
    """

    title: ClassVar[str] = "Morlet wavelet"

    frequency_hz: float = fields.number(100.0, CENTRE)
    w0: float = fields.number(6.0, W0)

    def __post_init__(self) -> None:
        fields.check(self)
        check_waveform_duration("Morlet", self.duration_s, "Raise frequency_hz or lower w0.")

    @property
    def duration_s(self) -> float:
        """Ten standard deviations of the Gaussian."""
        return 10.0 * self._s

    @property
    def _s(self) -> float:
        return self.w0 / (2.0 * pi * self.frequency_hz)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        check_below_half_rate("frequency_hz", self.frequency_hz, sample_rate_hz)
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        u = about_middle(n, sample_rate_hz, shift_s) / self._s
        wave = np.cos(2.0 * pi * turns_about_middle(self.frequency_hz, n, sample_rate_hz, shift_s))
        peak = -expm1(-(self.w0**2) / 2.0)
        wave -= 1.0 - peak
        wave *= np.exp(-0.5 * np.square(u)) / peak
        return silent_before_start(wave, shift_s)


@dataclass(frozen=True, slots=True)
class Ricker(fields.CheckedModel):
    """The Ricker wavelet, or Mexican hat, the shortest pulse that leaves no velocity.

    (1 - 2 a) exp(-a), with a = (pi f t)², cut at t = ±1.5 / f, where 1e-8 is left.  It takes
    n = round(3 rate / f) samples, about their middle: t = (k - (n - 1) / 2) / rate.  Its spectrum
    is highest at f, and half as high at about 0.48 f and 1.64 f.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate.

    References
    ----------
    Ricker, The form and laws of propagation of seismic wavelets, Geophysics 18(1), 1953.
    """

    title: ClassVar[str] = "Ricker wavelet"

    frequency_hz: float = fields.number(100.0, CENTRE)

    @property
    def duration_s(self) -> float:
        """Three periods of the frequency."""
        return 3.0 / self.frequency_hz

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        check_below_half_rate("frequency_hz", self.frequency_hz, sample_rate_hz)
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        a = np.square(about_middle(n, sample_rate_hz, shift_s) * (pi * self.frequency_hz))
        return silent_before_start((1.0 - 2.0 * a) * np.exp(-a), shift_s)


SLOPE = NumberSpec(
    label="Slope",
    unit="Hz/s",
    minimum=-1e6,
    maximum=1e6,
    step=50.0,
    hint="How fast the frequency rises; a negative slope falls",
)
SIGMA = NumberSpec(
    label="Sigma",
    unit="s",
    minimum=0.001,
    maximum=60.0,
    step=0.02,
    logarithmic=True,
    hint="Standard deviation of its Gaussian; it lasts eight of them",
)
#: Standard deviations on each side that hold all but half a per cent of the energy.
_SIGMAS_OF_ENERGY = 2.0


@dataclass(frozen=True, slots=True)
class Chirplet(fields.CheckedModel):
    """A tone within a Gaussian whose frequency rises or falls evenly.

    exp(-t² / 2 sigma²) cos(2 pi (f t + c t² / 2)), whose frequency at t is f + c t, cut at
    t = ±4 sigma.  It takes n = round(8 sigma rate) samples, about their middle:
    t = (k - (n - 1) / 2) / rate.  The peak of the formula is 1; no sample need lie on it.  The
    phase is wrong by less than 1e-12 rad.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate; the same holds for all frequencies within
        2 sigma.
    rate_hz_per_s
        c, up to ±1e6 Hz/s.
    sigma_s
        1 ms to 60 s.

    References
    ----------
    Mann and Haykin, The chirplet transform: physical considerations, IEEE Transactions on Signal
    Processing 43(11), 1995.
    """

    title: ClassVar[str] = "Chirplet"

    frequency_hz: float = fields.number(150.0, CENTRE)
    rate_hz_per_s: float = fields.number(1500.0, SLOPE)
    sigma_s: float = fields.number(0.03, SIGMA)

    @property
    def duration_s(self) -> float:
        """8 sigma."""
        return 8.0 * self.sigma_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        check_below_half_rate("frequency_hz", self.frequency_hz, sample_rate_hz)
        highest_hz = self.frequency_hz + abs(self.rate_hz_per_s) * _SIGMAS_OF_ENERGY * self.sigma_s
        if highest_hz >= sample_rate_hz / 2:
            raise InvalidInputError(
                f"rate_hz_per_s is {self.rate_hz_per_s:g}: within 2 sigma the frequency reaches "
                f"{highest_hz:g} Hz, expected less than {sample_rate_hz / 2:g} Hz (half the sample "
                "rate); lower the slope, sigma_s or frequency_hz"
            )
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        time_s = about_middle(n, sample_rate_hz, shift_s)
        with localcontext(prec=DIGITS):
            first = Decimal(1 - n) / (2 * Decimal(sample_rate_hz)) - Decimal(shift_s)
        phase = bent_turns(
            Decimal(0),
            Decimal(self.frequency_hz),
            Decimal(self.rate_hz_per_s),
            first,
            time_s.size,
            sample_rate_hz,
        )
        envelope = np.exp(-0.5 * np.square(time_s / self.sigma_s))
        return silent_before_start(envelope * np.cos(2.0 * pi * phase), shift_s)
