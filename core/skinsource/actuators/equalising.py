"""Drives that make an actuator move as a design says: inverse filters, bounded and checked.

A drive in m/s² becomes a voltage that makes the contactor accelerate so, within a band and as far
as a limited boost reaches.

>>> from skinsource import actuators, equalising
>>> coil = actuators.load("example-voice-coil")
>>> curves = equalising.curves(equalising.RegularisedInverse(), coil, [100.0, 200.0])
>>> bool(abs(curves.after_db).max() < 0.1)
True
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import lru_cache
from math import ceil, log2
from typing import ClassVar

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.models import VoiceCoil
from skinsource.base.arguments import checking, finite_array, positive_number, real_number
from skinsource.base.conventions import BAND_HZ, Band, Complexes, Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.signals.resampling import PASSED_SHARE
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

__all__ = [
    "EQUALISERS",
    "Equaliser",
    "EqualiserCurves",
    "NetVelocity",
    "PolePairReplacement",
    "RegularisedInverse",
    "curves",
    "equalised",
    "followed_band",
    "net_velocity",
    "resonance_of",
]


# Beyond the band the target falls to nothing: over an octave below, and up to 7/6 of its end, 700
# Hz of the published limbs, above.
_FALLS_BELOW, _FALLS_ABOVE = 1.0 / 2.0, 7.0 / 6.0
_ZOOMS, _ZOOMED = 4, 41


class Equaliser(ABC):
    """A frozen dataclass of settings.

    Attributes
    ----------
    title
        What a user calls this kind.
    """

    __slots__ = ()

    title: ClassVar[str]

    @abstractmethod
    def filter(
        self, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
    ) -> Complexes:
        """Return the voltage for each m/s² of the drive, V per m/s², shaped as ``frequency_hz``.

        Parameters
        ----------
        actuator
            What it is made for.
        frequency_hz
            0 or above.
        band_hz
            In which it is made to follow; see `skinsource.actuators.equalising.followed_band`.

        Raises
        ------
        InvalidInputError
            The actuator does not move in the band, so that nothing inverts it.
        """


def target(frequency_hz: ArrayLike, band_hz: Band = BAND_HZ) -> Floats:
    """Return the target gain, shaped as ``frequency_hz``: 1 in the band, 0 far from it.

    Between, half a cosine over the logarithm of the frequency.
    """
    size_hz = np.abs(finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz"))
    with np.errstate(divide="ignore"):
        place = np.log(size_hz)
    low, high = band_hz
    edges = ((low, low * _FALLS_BELOW), (high, high * _FALLS_ABOVE))
    beyond = [
        np.clip((place - np.log(full_hz)) / (np.log(zero_hz) - np.log(full_hz)), 0.0, 1.0)
        for full_hz, zero_hz in edges
    ]
    return np.prod([0.5 * (1.0 + np.cos(np.pi * part)) for part in beyond], axis=0)


def in_band_hz(band_hz: Band = BAND_HZ) -> Floats:
    """Return the frequencies of a band at which an actuator is evaluated, (400,)."""
    return np.geomspace(*band_hz, 400)


def largest_gain(actuator: Actuator, band_hz: Band = BAND_HZ) -> float:
    """Return the largest gain in the band, in m/s² per V, however sharp its peak; above 0."""
    gain, frequency_hz = gain_in_band(actuator, band_hz), in_band_hz(band_hz)
    for _ in range(_ZOOMS):
        # On both sides of a resonance the gain rises towards it.
        place = int(gain.argmax())
        low = float(frequency_hz[max(place - 1, 0)])
        high = float(frequency_hz[min(place + 1, frequency_hz.size - 1)])
        frequency_hz = np.linspace(low, high, _ZOOMED)
        gain = np.abs(actuator.response(frequency_hz))
    return float(gain.max())


def mean_of(gain: Floats) -> float:
    """Return the geometric mean of those gains, (n,), that are above 0."""
    # A gain of 0 would make the mean 0, whatever the others are.
    return float(np.exp(np.mean(np.log(gain[gain > 0.0]))))


def gain_in_band(actuator: Actuator, band_hz: Band = BAND_HZ) -> Floats:
    """Return the gain of an actuator at `in_band_hz`, (400,), in m/s² per V; above 0 somewhere.

    Raises
    ------
    InvalidInputError
        It does not move at all.
    """
    gain = np.abs(actuator.response(in_band_hz(band_hz)))
    if not gain.max() > 0.0:
        raise InvalidInputError(
            f"the actuator does not move from {band_hz[0]:g} to {band_hz[1]:g} Hz, so no equaliser "
            "can help; give it a force factor or a coupling above 0"
        )
    return gain


@checking
def followed_band(band_hz: Band | None, sample_rate_hz: float) -> Band:
    """Return the band in which drives are followed on a limb: that of its measurement.

    It ends at most at 12/13 of half the rate; None: the band is unknown, and ends there. A band
    that begins at 0 is followed from 25 Hz, or over its upper octave if that is lower.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.equalising.followed_band((25.0, 600.0), 1300.0))
    (25.0, 600.0)
    """
    low, high = (0.0, np.inf) if band_hz is None else band_hz
    positive_number("sample_rate_hz", sample_rate_hz)
    if not 0.0 <= low < high:
        raise InvalidInputError(f"band_hz is {quoted(band_hz)}, expected two rising frequencies")
    high = min(high, PASSED_SHARE * 0.5 * sample_rate_hz)
    return (low, high) if 0.0 < low < high else (min(BAND_HZ[0], high / 2.0), high)


#: Share that may be left of the velocity that a drive would leave if all of it had one sign.
ALLOWED_SHARE = 0.05


@dataclass(frozen=True, slots=True)
class NetVelocity:
    """Velocity that a drive leaves behind, taken as an acceleration.

    Attributes
    ----------
    left
        Velocity at its end for each m/s² of its peak, in s.
    share
        That over the velocity which it would leave if all of it had one sign, 0 to 1.
    share_below_band
        Share of its energy below the band, 0 to 1.
    lowest_hz
        Where the band begins: 25 Hz of the published limbs.
    """

    left: float
    share: float
    share_below_band: float
    lowest_hz: float = BAND_HZ[0]

    @property
    def returns(self) -> bool:
        """Whether the velocity returns to 0, as nearly as any filter needs."""
        # However long the drive is: as much as the slowest tone of the band has at the same peak.
        allowed_left_s = 1.0 / (2.0 * np.pi * self.lowest_hz)
        return self.share <= ALLOWED_SHARE and self.left <= allowed_left_s

    @property
    def reason(self) -> str:
        """Why it cannot be followed, and what to do."""
        below = f"{100.0 * self.share_below_band:.0f} % of its energy lies below "
        below += f"{self.lowest_hz:g} Hz"
        return (
            f"the drive leaves a velocity of {1e3 * self.left:.3g} mm/s for each m/s² of its peak, "
            f"and {below}: no contactor can follow it, its displacement would grow without end. "
            "Choose a waveform whose velocity returns to zero, for a tap the 'Centred tap', or let "
            "it fade in and out."
        )


@checking
def net_velocity(
    drive: ArrayLike, sample_rate_hz: float, lowest_hz: float = BAND_HZ[0]
) -> NetVelocity:
    """Return the velocity that a drive leaves behind.

    Parameters
    ----------
    drive : (n_times,)
        Taken as an acceleration, silent before and after.
    sample_rate_hz
        Above 0.
    lowest_hz
        Where the band begins in which it is followed.

    Examples
    --------
    >>> import skinsource as ss
    >>> leaves = ss.equalising.net_velocity(ss.tap(), 1300.0)
    >>> print(type(leaves).__name__)
    NetVelocity
    """
    samples = finite_array("drive", drive, "finite numbers, (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    if samples.ndim != 1:
        raise InvalidInputError(f"drive has the shape {samples.shape}, expected (n_times,)")
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0.0:
        return NetVelocity(0.0, 0.0, 0.0, lowest_hz)
    scaled = samples / peak
    left = abs(float(scaled.sum()))
    # Fine enough that the lowest band is seen however short the drive is.
    length = scipy.fft.next_fast_len(max(samples.size, int(4.0 * rate_hz)), real=True)
    energy = np.abs(scipy.fft.rfft(scaled, length)) ** 2
    # Of the two sides, frequency 0 has one.
    energy[0] *= 0.5
    below = np.arange(energy.size) * rate_hz / length < lowest_hz
    return NetVelocity(
        left=left / rate_hz,
        share=left / float(np.abs(scaled).sum()),
        share_below_band=float(energy[below].sum() / energy.sum()),
        lowest_hz=lowest_hz,
    )


# Longest time that a filter rings before a drive begins and after it ends.
_RINGING_S = 0.5


@checking
def equalised(
    drive: ArrayLike,
    sample_rate_hz: float,
    actuator: Actuator,
    equaliser: Equaliser,
    *,
    band_hz: Band | None = BAND_HZ,
    lead_s: float = 0.0,
    tail_s: float = 0.0,
) -> Floats:
    """Return the voltage that makes an actuator accelerate as a drive says.

    Parameters
    ----------
    drive : (n_times,) or (n_channels, n_times)
        Acceleration of the contactor in m/s²; silent before and after.
    sample_rate_hz
        High enough for the band: 1300 Hz at least where it ends at 600 Hz.
    actuator, equaliser
        What is driven, and the filter that is made for it.
    band_hz
        In which the limb was measured, so that the drive is followed there; None: not known, and
        it is followed from 25 Hz to 12/13 of half the rate.
    lead_s, tail_s
        Time that is kept before the first sample and after the last, 0 to 0.5 s, where a filter
        rings; without it that is cut off.

    Returns
    -------
    (..., lead + n_times + tail), in V.

    Raises
    ------
    InvalidInputError
        A drive ends with a velocity, which no actuator can follow.

    Examples
    --------
    >>> import skinsource as ss
    >>> model = ss.actuators.load(ss.actuators.names()[0])
    >>> drive = ss.sinusoid(100.0, window_name="hann")
    >>> volts = ss.equalising.equalised(drive, 1300.0, model, ss.equalising.RegularisedInverse())
    >>> print(volts.shape)
    (130,)
    """
    rows = finite_array("drive", drive, "finite numbers in m/s², (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    band = followed_band(None, rate_hz) if band_hz is None else band_hz
    # 1300 Hz for 600 Hz.
    least_hz = 2.0 / PASSED_SHARE * band[1]
    if rate_hz < least_hz * (1.0 - 1e-9):
        raise InvalidInputError(
            f"sample_rate_hz is {rate_hz:g}, expected at least {least_hz:g} Hz for a band that "
            f"ends at {band[1]:g} Hz. Resample the drive, or end the band lower."
        )
    margins = [
        int(rate_hz * real_number(name, value, "0 to 0.5 s", least=0.0, most=_RINGING_S))
        for name, value in (("lead_s", lead_s), ("tail_s", tail_s))
    ]
    if rows.ndim not in (1, 2):
        raise InvalidInputError(
            f"drive has the shape {rows.shape}, expected (n_times,) or (n_channels, n_times)"
        )
    for place, row in enumerate(np.atleast_2d(rows)):
        velocity = net_velocity(row, rate_hz, band[0])
        if not velocity.returns:
            where = f"channel {place}: " if rows.ndim == 2 else ""
            raise InvalidInputError(f"{where}{velocity.reason}")
    n, silence = rows.shape[-1], int(_RINGING_S * rate_hz)
    length = scipy.fft.next_fast_len(n + 2 * silence, real=True)
    frequency_hz = np.arange(length // 2 + 1) * rate_hz / length
    spectrum = scipy.fft.rfft(rows, length) * equaliser.filter(actuator, frequency_hz, band)
    around = np.roll(scipy.fft.irfft(spectrum, length), margins[0], axis=-1)
    return around[..., : margins[0] + n + margins[1]]


RESONANCE = NumberSpec(
    label="Resonance",
    unit="Hz",
    minimum=1.0,
    maximum=2000.0,
    step=0.01,
    logarithmic=True,
    hint="Resonance of the actuator, which the filter removes",
)
QUALITY = NumberSpec(
    label="Quality factor",
    minimum=0.3,
    maximum=10_000.0,
    step=0.02,
    logarithmic=True,
    hint="Of the resonance that the filter removes",
)
NEW_QUALITY = replace(
    QUALITY,
    label="New quality factor",
    maximum=10.0,
    hint="Afterwards; 0.7: flattest response, 0.5: no ringing",
)


@dataclass(frozen=True, slots=True)
class PolePairReplacement(fields.CheckedModel, Equaliser):
    """(s² + s w / Q + w²) / (s² + s w / Q' + w²): a resonance is taken out, a damped one put in.

    All else of the actuator stays as it is: below its resonance it still moves little.  One
    factor makes the geometric mean of the gain in the band that of the drive.

    Attributes
    ----------
    resonance_hz, quality
        w / 2 pi, 1 to 2000 Hz, and Q, 0.3 to 10 000, as of the actuator (`resonance_of` tells).
    new_quality
        Q', 0.3 to 10.
    """

    title: ClassVar[str] = "Pole-pair replacement"

    resonance_hz: float = fields.number(170.0, RESONANCE)
    quality: float = fields.number(10.0, QUALITY)
    new_quality: float = fields.number(0.7, NEW_QUALITY)

    def filter(
        self, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
    ) -> Complexes:
        """Return the voltage for each m/s² of the drive, in V per m/s²."""
        at_hz = finite_array("frequency_hz", frequency_hz, "frequencies in Hz")
        gain = gain_in_band(actuator, band_hz) * np.abs(self._replaced(in_band_hz(band_hz)))
        return self._replaced(at_hz) / mean_of(gain)

    def _replaced(self, frequency_hz: Floats) -> Complexes:
        ratio = frequency_hz / self.resonance_hz
        still = 1.0 - ratio**2
        replaced = (still + 1j * ratio / self.quality) / (still + 1j * ratio / self.new_quality)
        return replaced.astype(np.complex128)


@checking
def resonance_of(actuator: Actuator) -> tuple[float, float]:
    """Return the resonance of an actuator, in Hz, and its quality, for `PolePairReplacement`.

    Of a voice coil they follow from its parameters: sqrt(k / m) / 2 pi and sqrt(k m) / (c + Bl² /
    R).  For others it follows from the response: displacement, acceleration over the square of the
    frequency, lags by a quarter of a turn at the resonance, and its phase passes there with a slope
    of 2 Q over the logarithm of the frequency.

    Examples
    --------
    >>> import skinsource as ss
    >>> model = ss.actuators.load(ss.actuators.names()[0])
    >>> frequency_hz, quality = ss.equalising.resonance_of(model)
    >>> print(f"{frequency_hz:.0f} Hz")
    220 Hz
    """
    if isinstance(actuator, VoiceCoil):
        stiffness = actuator.stiffness_n_per_m + actuator.skin_stiffness_n_per_m
        damping = actuator.damping_n_s_per_m + actuator.skin_damping_n_s_per_m
        resonance_hz = np.sqrt(stiffness / actuator.moving_mass_kg) / (2.0 * np.pi)
        with np.errstate(all="ignore"):
            damping += np.square(actuator.force_factor_n_per_a) / actuator.resistance_ohm
            quality = np.sqrt(stiffness * actuator.moving_mass_kg) / damping
    else:
        resonance_hz, quality = _resonance_in_response(actuator)
    return _clipped(RESONANCE, resonance_hz), _clipped(QUALITY, np.nan_to_num(quality))


def _clipped(spec: NumberSpec, value: float) -> float:
    return float(np.clip(value, spec.minimum, spec.maximum))


def _resonance_in_response(actuator: Actuator) -> tuple[float, float]:
    frequency_hz = np.geomspace(5.0, 2000.0, 20_001)
    phase_rad = np.unwrap(np.angle(-actuator.response(frequency_hz)))
    lag = phase_rad - phase_rad[0] + 0.5 * np.pi
    crossing = int(np.argmax(lag <= 0.0)) if (lag <= 0.0).any() else int(np.abs(lag).argmin())
    place = min(max(crossing, 1), frequency_hz.size - 2)
    step = np.log(frequency_hz[place + 1] / frequency_hz[place - 1])
    slope = (phase_rad[place + 1] - phase_rad[place - 1]) / step
    return float(frequency_hz[place]), float(-0.5 * slope)


BOOST = NumberSpec(
    label="Boost",
    unit="dB",
    minimum=0.0,
    maximum=60.0,
    step=1.0,
    hint="Largest voltage gain, relative to that at the response's peak",
)
PHASE = ChoiceSpec(
    label="Phase",
    options=(("linear", "Linear"), ("minimum", "Minimum")),
    hint="Linear: no delay, some ringing before the onset; minimum: no such ringing",
)
# Grid on which a gain's phase is computed, and floor of the gain relative to its peak.
_LENGTH, _RATE_HZ, _FLOOR = 2**16, 48_000.0, 1e-5
# The grid's rate is at least so many times the end of the band; its spacing stays.
_OF_BAND = 4.0


@dataclass(frozen=True, slots=True)
class RegularisedInverse(fields.CheckedModel, Equaliser):
    """W = T H* / (|H|² + beta max|H|²), beta such that |W| is at most the boost over 1 / max|H|.

    T is 1 in the band of the limb, 25 to 600 Hz of the published ones, H the response of the
    actuator, and max|H| its largest gain in that band.  |W| max|H| is largest, 1 / (2 sqrt(beta)),
    where |H| is sqrt(beta) max|H|.

    Attributes
    ----------
    boost_db
        0 to 60 dB.
    phase
        ``"linear"``: the filter also removes the phase of the actuator: no delay, but some ringing
        before sharp starts; ``"minimum"``: the same gain with the least delay, and no ringing
        before a start.

    References
    ----------
    Kirkeby and Nelson, Digital filter design for inversion problems in sound reproduction,
    J. Audio Eng. Soc. 47(7/8), 1999.
    """

    title: ClassVar[str] = "Regularised inverse"

    boost_db: float = fields.number(20.0, BOOST)
    phase: str = fields.choice("linear", PHASE)

    def filter(
        self, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
    ) -> Complexes:
        """Return the voltage for each m/s² of the drive, in V per m/s²."""
        at_hz = np.abs(finite_array("frequency_hz", frequency_hz, "frequencies in Hz"))
        if self.phase == "linear":
            return self._inverse(actuator, at_hz, band_hz)
        phase_hz, phase_rad = _minimum_phase(self, actuator, band_hz)
        angle = np.interp(at_hz, phase_hz, phase_rad)
        return np.abs(self._inverse(actuator, at_hz, band_hz)) * np.exp(1j * angle)

    def _inverse(self, actuator: Actuator, frequency_hz: Floats, band_hz: Band) -> Complexes:
        most = largest_gain(actuator, band_hz)
        # In parts of the largest gain, so that no square leaves the range of floats.
        response = actuator.response(frequency_hz) / most
        beta = 0.25 * 10.0 ** (-self.boost_db / 10.0)
        inverse = response.conj() / (np.abs(response) ** 2 + beta)
        return target(frequency_hz, band_hz) * inverse / most


@lru_cache(maxsize=16)
def _minimum_phase(
    equaliser: RegularisedInverse, actuator: Actuator, band_hz: Band
) -> tuple[Floats, Floats]:
    """Return frequencies, and the minimum phase that belongs to the gain there."""
    higher = 2 ** max(ceil(log2(_OF_BAND * band_hz[1] / _RATE_HZ)), 0)
    length, rate_hz = higher * _LENGTH, higher * _RATE_HZ
    frequency_hz = np.arange(length // 2 + 1) * rate_hz / length
    gain = np.abs(equaliser._inverse(actuator, frequency_hz, band_hz))
    logarithms = np.log(np.maximum(gain, _FLOOR * gain.max()))
    return frequency_hz, minimum_phase_of(logarithms, length)


def minimum_phase_of(logarithms: Floats, length: int) -> Floats:
    """Return the phase, rad, of the minimum-phase system with these logarithms of its gain.

    Parameters
    ----------
    logarithms : (length // 2 + 1,)
        Natural logarithms at equal steps, from 0 to half the rate.
    """
    cepstrum = scipy.fft.irfft(logarithms, length)
    cepstrum[1 : length // 2] *= 2.0
    cepstrum[length // 2 + 1 :] = 0.0
    return scipy.fft.rfft(cepstrum).imag


#: Every kind, in the order in which a user meets them.
EQUALISERS: tuple[type[Equaliser], ...] = (RegularisedInverse, PolePairReplacement)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EqualiserCurves:
    """Gains in dB, (n,) each.

    Attributes
    ----------
    frequency_hz
        Of the points.
    before_db
        Acceleration for each volt, re its geometric mean in the band.
    filter_db
        Voltage for each m/s² of the drive, re the voltage that the mean needs.
    after_db
        Acceleration over the drive.
    """

    frequency_hz: Floats
    before_db: Floats
    filter_db: Floats
    after_db: Floats


@checking
def curves(
    equaliser: Equaliser, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
) -> EqualiserCurves:
    """Return the gains before, of and after the filter, at frequencies above 0, (n,).

    Examples
    --------
    >>> import skinsource as ss
    >>> model = ss.actuators.load(ss.actuators.names()[0])
    >>> inverse = ss.equalising.RegularisedInverse()
    >>> print(type(ss.equalising.curves(inverse, model, [50.0, 100.0])).__name__)
    EqualiserCurves
    """
    at_hz = finite_array("frequency_hz", frequency_hz, "frequencies in Hz, (n,)")
    mean = mean_of(gain_in_band(actuator, band_hz))
    response = actuator.response(at_hz)
    passed = equaliser.filter(actuator, at_hz, band_hz)
    return EqualiserCurves(
        frequency_hz=at_hz,
        before_db=decibels(np.abs(response) / mean),
        filter_db=decibels(np.abs(passed) * mean),
        after_db=decibels(np.abs(response * passed)),
    )
