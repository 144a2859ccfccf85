"""Responses of actuators from measurements: sweeps with an accelerometer, and files.

Sweeps are recorded several times, with an unknown delay, by a clock of its own, and in noise.
Spectra are added up over bands a tenth of an octave wide, which averages noise out.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from math import floor
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.equalising import minimum_phase_of
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.base.arguments import checking, finite_array, positive_number, real_number
from skinsource.base.conventions import Complexes, Floats, Indices
from skinsource.base.errors import InvalidInputError, RecordingError, sentence
from skinsource.base.files import path_text
from skinsource.readers.reader import Found
from skinsource.readers.reading_process import ReadingProcess

__all__ = ["open_response", "response_from_sweep"]


_POINTS = 240
# A band reaches a twentieth of an octave to either side, and holds at least three frequencies.
_HALF_WIDTH = 2.0 ** (1.0 / 20.0)


@dataclass(frozen=True, slots=True, eq=False)
class Bands:
    """240 frequencies, evenly over their logarithm, and what is added up around each.

    Attributes
    ----------
    centre_hz, first, last : (n_bands,)
        The frequencies, and the first and last number of a spectrum that each takes in.
    """

    centre_hz: Floats
    first: Indices
    last: Indices

    @classmethod
    def between(cls, band_hz: tuple[float, float], step_hz: float, n: int) -> Bands:
        """Make bands of spectra of ``n`` frequencies with a distance of ``step_hz``."""
        centre_hz = np.geomspace(*band_hz, _POINTS)
        middle = np.rint(centre_hz / step_hz).astype(np.intp)
        first = np.ceil(centre_hz / _HALF_WIDTH / step_hz).astype(np.intp)
        last = np.floor(centre_hz * _HALF_WIDTH / step_hz).astype(np.intp)
        return cls(
            centre_hz,
            np.minimum(first, middle - 1).clip(1),
            np.maximum(last, middle + 1).clip(max=n - 1),
        )

    @property
    def counts(self) -> Floats:
        """How many frequencies each takes in, (n_bands,)."""
        return (self.last + 1 - self.first).astype(np.float64)

    def sums(self, spectrum: Any) -> Any:
        """Sum spectra, (..., n_frequencies), over each band, (..., n_bands)."""
        rising = np.cumsum(spectrum, axis=-1)
        return rising[..., self.last] - rising[..., self.first - 1]


#: Largest difference of clocks that is found; quartz differs by a tenth of it at most.
MOST_DIFFERENCE = 2e-3
_LAG_ROUNDS = 3


def clock_ratio(recorded: Floats, start: int, period: int, repeats: int) -> float:
    """Return how many samples are recorded while one is played.

    A repeated sweep is recorded one period later, by the recording clock.  The first two sweeps
    give a rough ratio, by which the last one is found; the first and the last give a good one.

    Parameters
    ----------
    recorded : (n_times,)
        What came back, without a constant.
    start
        Sample at which the first sweep begins, or a little before.
    period
        Samples from one sweep to the next, by the clock that plays.
    repeats
        Sweeps that there are, at least 2.
    """
    most = max(round(MOST_DIFFERENCE * period), 1)
    ratio = 1.0
    for n_periods in dict.fromkeys((1, repeats - 1)):
        later = start + round(n_periods * period * ratio)
        parts = recorded[start : start + period], recorded[later : later + period]
        lag = later - start + lag_of(*parts, most)
        ratio = lag / (n_periods * period)
    return ratio


def lag_of(first: Floats, later: Floats, most: int) -> float:
    """Return the samples by which ``later`` lags, of either sign, at most about ``most``."""
    length = scipy.fft.next_fast_len(first.size + later.size, real=True)
    cross = scipy.fft.rfft(first, length).conj() * scipy.fft.rfft(later, length)
    common = scipy.fft.irfft(cross, length)
    lags = np.arange(-most, most + 1)
    lag = float(lags[np.argmax(common[lags])])
    turn = 2.0 * np.pi * np.arange(cross.size) / length
    weight = np.abs(cross)
    scale = float(weight @ turn**2)
    for _ in range(_LAG_ROUNDS if scale > 0.0 else 0):
        # Beside the right lag the phase is a straight line through 0, and short of a turn.
        left = np.angle(cross * np.exp(1j * turn * lag))
        lag -= float((weight * left) @ turn) / scale
    return lag


def part_from(samples: Floats, begin: float, n: int) -> Floats:
    """Return ``n`` samples from a time that may lie between two of them; zeros after the last."""
    nearest = round(begin)
    part = np.zeros(n)
    available = samples[nearest : nearest + n]
    part[: available.size] = available
    if begin == nearest:
        return part
    length = scipy.fft.next_fast_len(n, real=True)
    turn = 2j * np.pi * np.arange(length // 2 + 1) / length
    moved = scipy.fft.rfft(part, length) * np.exp(turn * (begin - nearest))
    return scipy.fft.irfft(moved, length)[:n]


# Share of the sweep that is faded at each end: a voltage that jumps would be a click.
_FADE = 0.04


def exponential_sweep(
    band_hz: tuple[float, float],
    duration_s: float,
    sample_rate_hz: int,
    clock_ratio: float = 1.0,
) -> Floats:
    """Return a sweep of amplitude 1, (n_times,), that begins and ends in silence.

    Each octave takes the same time, so that low frequencies, which take longest to tell from
    noise, get most of the energy.  Source: A. Farina, "Simultaneous measurement of impulse
    response and distortion with a swept-sine technique", 108th AES Convention, 2000.

    Parameters
    ----------
    band_hz
        First and last frequency, rising.
    duration_s
        From first to last sample.
    sample_rate_hz
        A whole number of hertz, more than twice the last frequency.
    clock_ratio
        Samples are taken by a clock that is so many times as quick as the one that plays: the
        sweep as a device records it that has a clock of its own.

    Raises
    ------
    InvalidInputError
        It is too short.
    """
    first_hz, last_hz = band_hz
    expected = "at least two periods of the first frequency"
    long_s = real_number("duration_s", duration_s, expected, least=2.0 / first_hz)
    n = round(long_s * sample_rate_hz)
    # Where, in samples of the clock that plays.
    place = np.arange(floor((n - 1) * clock_ratio) + 1) / clock_ratio
    octaves = np.log(last_hz / first_hz) / long_s
    phase_rad = 2.0 * np.pi * first_hz * np.expm1(octaves * place / sample_rate_hz) / octaves
    sweep: Floats = np.sin(phase_rad)
    n_fade = max(round(_FADE * n), 1)
    inside = np.minimum(np.minimum(place, n - 1 - place) / n_fade, 1.0)
    return sweep * (0.5 - 0.5 * np.cos(np.pi * inside))


# Enough frequencies for the lowest, and so far above the highest that what is not known there
# turns the phase by next to nothing.
_LENGTH, _ABOVE = 2**17, 16.0
# Below and above what was measured a gain falls, or rises, by no more than this for each octave.
_STEEPEST = 3.0
# Part of an octave over which the slope at an end is fitted.
_END_OCTAVES = 0.5
# Frequencies with less than this part of the source's largest power are not divided by.
_LEAST_POWER = 1e-5


@dataclass(frozen=True, slots=True)
class ExcessDelay:
    """The part of a phase that the gain does not explain.

    Attributes
    ----------
    seconds
        Delay.
    inverted
        Whether the sign is turned over.
    misfit_rad
        Root mean square of the rest.
    """

    seconds: float
    inverted: bool
    misfit_rad: float


def coarse_delay(played: Floats, recorded: Floats, noise_power: Floats) -> int:
    """Return the samples by which ``recorded`` lags: where its impulse response is largest.

    Parameters
    ----------
    played : (n_times,)
        What was sent, silence at its end.
    recorded : (n_recorded,)
        What came back; from the first sample of ``played`` on, and at least as long.
    noise_power : (n_frequencies,)
        Expected |rfft|² of noise in a recording of that length, from 0 to half the rate: what
        is not above it is left out.
    """
    length = scipy.fft.next_fast_len(played.size + recorded.size, real=True)
    sent, came = scipy.fft.rfft(played, length), scipy.fft.rfft(recorded, length)
    power = np.abs(sent) ** 2
    known = np.linspace(0.0, 1.0, noise_power.size)
    noise = np.interp(np.linspace(0.0, 1.0, power.size), known, noise_power)
    above = np.maximum(1.0 - noise / np.maximum(np.abs(came) ** 2, np.finfo(float).tiny), 0.0)
    swept = power > _LEAST_POWER * power.max()
    whitened = np.zeros(power.size, complex)
    whitened[swept] = (above * came * sent.conj())[swept] / power[swept]
    latest = recorded.size - played.size
    return int(np.argmax(np.abs(scipy.fft.irfft(whitened, length)[: latest + 1])))


def excess_delay(frequency_hz: Floats, response: Complexes) -> ExcessDelay:
    """Return the delay in a response, and its sign.

    An actuator is a system of minimum phase: its gain alone says its phase (Bode's relation).
    What is left of the phase is a straight line through 0, the delay, or through half a turn.

    Parameters
    ----------
    frequency_hz : (n,)
        Rising, so dense that the phase turns by less than half a turn from one to the next.
    response : (n,)
        As measured.
    """
    left = np.unwrap(np.angle(response) - minimum_phase(frequency_hz, np.abs(response)))
    # A line with an offset of its own first: it determines the multiple of half a turn.
    offset = np.polynomial.polynomial.polyfit(frequency_hz, left, 1)[0]
    half_turns = round(float(offset) / np.pi)
    left -= half_turns * np.pi
    slope = float(left @ frequency_hz / (frequency_hz @ frequency_hz))
    misfit = np.sqrt(np.mean((left - slope * frequency_hz) ** 2))
    return ExcessDelay(-slope / (2.0 * np.pi), half_turns % 2 == 1, float(misfit))


def minimum_phase(frequency_hz: Floats, gain: Floats) -> Floats:
    """Return the phase, rad, (n,), of the minimum-phase system with these gains, (n,).

    Outside of what is known the gain goes on as steeply as it ends.
    """
    place, level = np.log(frequency_hz), np.log(gain)
    step_hz = _ABOVE * frequency_hz[-1] / (_LENGTH // 2)
    every_hz = np.arange(_LENGTH // 2 + 1) * step_hz
    # At 0 Hz the logarithm of a gain may be infinite: half a step above it is as good.
    every_hz[0] = 0.5 * step_hz
    log_hz = np.log(every_hz)
    low, high = _slope(place, level, place[0], 1.0), _slope(place, level, place[-1], -1.0)
    levels = np.interp(log_hz, place, level)
    levels += low * np.minimum(log_hz - place[0], 0.0)
    levels += high * np.maximum(log_hz - place[-1], 0.0)
    return np.interp(frequency_hz, every_hz, minimum_phase_of(levels, _LENGTH))


def _slope(place: Floats, level: Floats, end: float, inwards: float) -> float:
    """Return the slope at which a gain ends, in units of gain over frequency."""
    near = np.abs(place - end) <= _END_OCTAVES * np.log(2.0)
    if near.sum() < 2:
        return 0.0
    slope = float(np.polynomial.polynomial.polyfit(place[near], level[near], 1)[1])
    # Rising for ever, or out of nothing, it would not be a response.
    least, most = (0.0, _STEEPEST) if inwards > 0 else (-_STEEPEST, 0.0)
    return min(max(slope, least), most)


#: A point whose error, relative to its gain, may be larger than this is left out.
MOST_ERROR = 0.1
#: Fewer points are no response.
FEWEST = 12
# A delay is fitted to less exact points too, and to those above the requested band.
_MOST_ERROR_OF_DELAY = 0.3
_DELAY_ROUNDS = 4
_TURN = 2j * np.pi


@dataclass(frozen=True, slots=True, eq=False)
class Sweeps:
    """A sweep that was played several times, and its recordings.

    Attributes
    ----------
    voltage : (n_times,)
        In V at the actuator: one sweep, and silence until the next.
    recorded : (n_repeats, n_recorded)
        From the first sample of each sweep on, longer than ``voltage`` by the longest delay that
        is looked for; in m/s², or whatever unit the response shall have.
    noise : (n_noise,)
        The same while nothing was played.
    sample_rate_hz
        Of all of them.
    """

    voltage: Floats
    recorded: Floats
    noise: Floats
    sample_rate_hz: int


@dataclass(frozen=True, slots=True, eq=False)
class AveragedResponse:
    """A response with its error.

    Attributes
    ----------
    frequency_hz, response, error : (n_points,)
        Where the sweep is above the noise: Hz, m/s² per V without the delay, and the
        standard error relative to the gain, from the noise or from how far the sweeps differ,
        whichever is larger.
    n_left_out
        Points of the band that the noise covers.
    delay
        What was taken out.
    """

    frequency_hz: Floats
    response: Complexes
    error: Floats
    n_left_out: int
    delay: ExcessDelay


def averaged_response(
    sweeps: Sweeps,
    band_hz: tuple[float, float],
    delay_band_hz: tuple[float, float],
    known_delay: ExcessDelay | None = None,
) -> AveragedResponse:
    """Return the mean response over all repeats.

    Parameters
    ----------
    sweeps
        What was recorded.
    band_hz
        Lowest and highest frequency of the response.
    delay_band_hz
        Band within which the delay is fitted: the wider, the better.
    known_delay
        Where the delay is known from elsewhere, as from a wire from output to input.

    Raises
    ------
    InvalidInputError
        Next to nothing of the sweep is above the noise.
    """
    delay = known_delay or delay_of(sweeps, delay_band_hz)
    shift = max(round(delay.seconds * sweeps.sample_rate_hz), 0)
    hz, response, error = _band_responses(sweeps, shift, band_hz)
    usable = error <= MOST_ERROR
    if usable.sum() < FEWEST:
        raise InvalidInputError(_noise_message(error))
    rest_s = delay.seconds - shift / sweeps.sample_rate_hz
    return AveragedResponse(
        frequency_hz=hz[usable],
        response=response[usable] * np.exp(_TURN * hz[usable] * rest_s),
        error=error[usable],
        n_left_out=int((~usable).sum()),
        delay=delay,
    )


def delay_of(sweeps: Sweeps, band_hz: tuple[float, float]) -> ExcessDelay:
    """Return the delay from the sweep to its recording.

    Raises
    ------
    InvalidInputError
        Next to nothing of the sweep is above the noise.
    """
    rate_hz = sweeps.sample_rate_hz
    first = sweeps.recorded[0]
    shift = coarse_delay(sweeps.voltage, first, _noise_power(sweeps, first.size))
    latest = first.size - sweeps.voltage.size
    delay = ExcessDelay(0.0, False, 0.0)
    for _ in range(_DELAY_ROUNDS):
        hz, response, error = _band_responses(sweeps, shift, band_hz)
        usable = error <= _MOST_ERROR_OF_DELAY
        if usable.sum() < FEWEST:
            raise InvalidInputError(_noise_message(error))
        delay = excess_delay(hz[usable], response[usable])
        delay = replace(delay, seconds=delay.seconds + shift / rate_hz)
        nearest = min(max(round(delay.seconds * rate_hz), 0), latest)
        if nearest == shift:
            break
        shift = nearest
    return delay


def _band_responses(
    sweeps: Sweeps, shift: int, band_hz: tuple[float, float]
) -> tuple[Floats, Complexes, Floats]:
    """Return frequencies, responses with the remaining delay, and their relative errors."""
    n = sweeps.voltage.size
    delayed = sweeps.recorded[:, shift : shift + n]
    # Silence behind, so that what rings does not come round to the beginning.
    length = scipy.fft.next_fast_len(2 * n, real=True)
    sent, came = scipy.fft.rfft(sweeps.voltage, length), scipy.fft.rfft(delayed, length)
    bands = Bands.between(band_hz, sweeps.sample_rate_hz / length, sent.size)
    power = bands.sums(np.abs(sent) ** 2)
    each = bands.sums(sent.conj() * came) / power
    mean = each.mean(axis=0)
    # What noise adds to the sum over a band; padded spectra are smooth, and their neighbours
    # have half of their noise in common.
    noise = bands.sums(_noise_power(sweeps, n, length)) / bands.counts
    variance = noise * (length / n) / (power * len(each))
    if len(each) > 1:
        variance = np.maximum(variance, each.var(axis=0, ddof=1) / len(each))
    gain = np.abs(mean)
    error = np.full(gain.size, np.inf)
    np.divide(np.sqrt(variance), gain, out=error, where=gain > 0.0)
    return bands.centre_hz, mean, error


def _noise_power(sweeps: Sweeps, n: int, length: int | None = None) -> Floats:
    """Return the expected |rfft|² of noise in ``n`` samples, at the frequencies of ``length``."""
    noise = sweeps.noise
    length = scipy.fft.next_fast_len(2 * n, real=True) if length is None else length
    # Parts of an eighth, so that single frequencies are not mistaken for their mean.
    part = max(noise.size // 8, 1)
    hz, density = scipy.signal.welch(noise, 1.0, nperseg=part, detrend="constant")
    cycles_per_sample = np.arange(length // 2 + 1) / length
    return np.interp(cycles_per_sample, hz, density) * (n / 2.0)


def _noise_message(error: Floats) -> str:
    best = float(error.min(initial=np.inf))
    known = f"; the best point has an error of {100.0 * best:.0f} %" if np.isfinite(best) else ""
    return (
        f"hardly any of the sweep is above the noise of the input{known}. Check amplifier, sensor "
        "and wiring, or raise the level"
    )


#: Frequencies at which the voltage has less than this part of its largest density say nothing.
_LEAST_AMPLITUDE = 1e-2


@checking
def response_from_sweep(
    voltage: ArrayLike,
    acceleration: ArrayLike,
    sample_rate_hz: float,
    band_hz: tuple[float, float] = (20.0, 1000.0),
) -> MeasuredResponse:
    """Return acceleration over voltage, from both at the same samples.

    H = S_ua / S_uu, cross spectrum over spectrum of the voltage, both added up over a tenth of an
    octave: noise of the accelerometer that has nothing to do with the voltage averages out.

    Parameters
    ----------
    voltage, acceleration : (n_times,)
        In V at the actuator and m/s²; a sweep or noise, and what rings after it.
    sample_rate_hz
        Of both.
    band_hz
        Lowest and highest frequency of the response; points at which the voltage holds next to
        nothing are left out.

    Raises
    ------
    InvalidInputError
        They do not fit together, or the voltage holds too little in the band.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> rng = np.random.default_rng(1)
    >>> volts = ss.resample(ss.white_noise(2.0, seed=1), 1300, 8000)
    >>> measured = ss.measuring.response_from_sweep(volts, 3.0 * volts, 8000.0, (50.0, 500.0))
    >>> print(f"{abs(measured.response(np.array([100.0])))[0]:.1f}")
    3.0
    """
    driven = finite_array("voltage", voltage, "finite numbers in V, (n_times,)")
    moved = finite_array("acceleration", acceleration, "finite numbers in m/s², (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    if driven.ndim != 1 or driven.shape != moved.shape or driven.size < 2:
        raise InvalidInputError(
            f"voltage and acceleration have the shapes {driven.shape} and {moved.shape}, expected "
            "two rows of equal length"
        )
    low_hz, high_hz = (positive_number("band_hz", frequency) for frequency in band_hz)
    if not low_hz < high_hz <= rate_hz / 2.0:
        raise InvalidInputError(
            f"band_hz is {low_hz:g} to {high_hz:g}, expected rising and at most {rate_hz / 2:g} Hz"
        )
    # Silence behind, so that what rings does not come round to the beginning.
    length = scipy.fft.next_fast_len(2 * driven.size, real=True)
    source = scipy.fft.rfft(driven, length)
    bands = Bands.between((low_hz, high_hz), rate_hz / length, source.size)
    summed = bands.sums(np.abs(source) ** 2)
    density = summed / bands.counts
    usable = density > _LEAST_AMPLITUDE**2 * density.max(initial=0.0)
    if density.max(initial=0.0) == 0.0 or usable.sum() < 2:
        raise InvalidInputError(
            f"the voltage holds almost nothing from {low_hz:g} to {high_hz:g} Hz; measure with a "
            "sweep over that band"
        )
    cross = bands.sums(source.conj() * scipy.fft.rfft(moved, length))
    return MeasuredResponse.of(bands.centre_hz[usable], cross[usable] / summed[usable])


_FREQUENCY = ("frequency", "freq", "f", "hz")
_GAIN, _GAIN_DB = ("gain", "magnitude", "mag", "amplitude", "response"), ("db", "gain_db", "level")
_RADIANS, _DEGREES = ("phase_rad",), ("phase_deg", "phase")
_REAL, _IMAGINARY = ("real", "re"), ("imag", "imaginary", "im")


@checking
def open_response(
    path: str | os.PathLike[str],
    *,
    volts_at_full_scale: float = 1.0,
    m_per_s2_at_full_scale: float = 1.0,
) -> MeasuredResponse:
    """Return the measured response that a file holds.

    A table (CSV, or another format that `skinsource.design.recordings` reads) has a column of
    frequencies (``frequency_hz``), and ``gain`` in m/s² per V, or ``gain_db`` re 1 m/s² per V, with
    ``phase_rad`` or ``phase_deg`` if it was measured; or ``real`` and ``imag``.  A sound file has
    the voltage of a sweep in its first channel, and the signal of the accelerometer in its second.

    Parameters
    ----------
    volts_at_full_scale, m_per_s2_at_full_scale
        What a sample of 1 is in the two channels of a sound file.

    Raises
    ------
    RecordingError
        The file holds nothing of that kind.
    StorageError
        It cannot be read.
    """
    file = Path(path)
    scales = (
        positive_number("volts_at_full_scale", volts_at_full_scale),
        positive_number("m_per_s2_at_full_scale", m_per_s2_at_full_scale),
    )
    with ReadingProcess() as process:
        contents = process.look(file)
        rate_hz = contents.rate_hz
        keys = [series.key for series in contents.series]
        n_samples = min(series.n_samples for series in contents.series)
        values = process.read(file, keys, 0, n_samples).astype(np.float64)
    try:
        table = _columns(contents, values)
        if _FREQUENCY[0] in table:
            return _table_response(table)
        if rate_hz is None or len(values) < 2:
            raise InvalidInputError(
                "it has no column frequency_hz, expected a table with columns frequency_hz and "
                "gain, or sound with a voltage and an acceleration"
            )
        return response_from_sweep(values[0] * scales[0], values[1] * scales[1], rate_hz)
    except InvalidInputError as error:
        raise RecordingError(f"{path_text(Path(file.name))}: {sentence(str(error))}") from error


def _columns(contents: Found, values: Floats) -> dict[str, Floats]:
    """Return columns by the first of the names that mean the same."""
    known = (_FREQUENCY, _GAIN, _GAIN_DB, _RADIANS, _DEGREES, _REAL, _IMAGINARY)
    table: dict[str, Floats] = {}
    for series, column in zip(contents.series, values, strict=True):
        name = series.name.strip().lower().removesuffix("_hz").removesuffix(" (hz)")
        for names in known:
            if name in names:
                table.setdefault(names[0], column)
    return table


def _table_response(table: dict[str, Floats]) -> MeasuredResponse:
    frequency_hz = table[_FREQUENCY[0]]
    response: Complexes
    if _REAL[0] in table and _IMAGINARY[0] in table:
        response = table[_REAL[0]] + 1j * table[_IMAGINARY[0]]
    else:
        if _GAIN[0] in table:
            gain = table[_GAIN[0]]
        elif _GAIN_DB[0] in table:
            gain = 10.0 ** (table[_GAIN_DB[0]] / 20.0)
        else:
            raise InvalidInputError(
                "it has frequencies but no gain, expected a column gain, gain_db, or real and imag"
            )
        phase = table.get(_RADIANS[0])
        if phase is None:
            phase = np.radians(table.get(_DEGREES[0], np.zeros(gain.size)))
        response = gain.astype(np.complex128) * np.exp(1j * phase)
    return MeasuredResponse.of(frequency_hz, response)
