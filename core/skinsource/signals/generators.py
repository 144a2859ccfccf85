"""Sampled stimuli as plain functions.

Times are ``arange(n) / sample_rate_hz``; amplitude 1 is the peak of the stimulus.
"""

from __future__ import annotations

from functools import lru_cache
from math import floor
from typing import Literal, get_args

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.base.arguments import finite_array, integer, one_of, positive_number, real_number
from skinsource.base.conventions import BAND_HZ, SAMPLE_RATE_HZ, Band, Floats
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.signals.sampling import shift_of, turns

WindowName = Literal["none", "tukey", "hanning"]
WINDOWS: tuple[WindowName, ...] = get_args(WindowName)
#: Names that SciPy has for the same windows; its ``hann`` has zeros at the ends besides.
OTHER_NAMES: dict[str, WindowName] = {"boxcar": "none", "hann": "hanning"}

#: The tapered share of a Tukey window, as upstream.
TUKEY_TAPER = 0.25
#: Samples of the upstream tap, at 1300 Hz.
TAP_SAMPLES = 21
#: Duration of the tap at any rate, in s.
TAP_S = TAP_SAMPLES / SAMPLE_RATE_HZ

#: Samples of the longest signal: a day at 1300 Hz takes 0.9 GB.
MAX_SAMPLES = 120_000_000

_LARGEST_SEED = 2**128 - 1

# Samples of a window that are computed at once.
_BLOCK = 2**20
# Windows up to this length are cached: sweeps play many bursts of one length.
_SHORT = 2**14


def sample_count(duration_s: float, sample_rate_hz: float = SAMPLE_RATE_HZ) -> int:
    """Return the number of samples in a duration, rounded half up.

    The product is rounded first, because 0.35 s x 1300 Hz is 454.99999999999994 in binary.
    """
    duration = real_number("duration_s", duration_s, "a finite time of 0 or more", least=0.0)
    samples = duration * positive_number("sample_rate_hz", sample_rate_hz)
    if samples > MAX_SAMPLES:
        raise InvalidInputError(
            f"duration_s is {duration:g}: {samples:g} samples at {sample_rate_hz:g} Hz, expected "
            f"at most {MAX_SAMPLES} samples"
        )
    return floor(round(samples, 6) + 0.5)


def window_named(name: str) -> WindowName:
    """Return the window that is called so, here or in SciPy.

    Raises
    ------
    InvalidInputError
        There is none.
    """
    known = OTHER_NAMES.get(name, name) if isinstance(name, str) else name
    return one_of("window", known, WINDOWS)


def window(name: WindowName | str, n: int) -> Floats:
    """Return the samples of a window, (n,).

    Parameters
    ----------
    name
        ``"none"`` or ``"boxcar"``: ones; ``"hanning"`` or ``"hann"``: MATLAB's ``hanning``,
        0.5 (1 - cos(2 pi k / (n + 1))) for k = 1..n, which has no zero at its ends; ``"tukey"``:
        MATLAB's ``tukeywin(n, 0.25)``, which has.
    n
        Length in samples, 0 or more.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.window("hanning", 3))
    [0.5 1.  0.5]
    """
    name = window_named(name)
    n = integer("n", n, 0, MAX_SAMPLES)
    samples = np.empty(n)
    for start in range(0, n, _BLOCK):
        end = min(start + _BLOCK, n)
        samples[start:end] = window_at(name, np.arange(start, end), n)
    return samples


def window_at(name: WindowName, position: NDArray[np.floating | np.integer], n: int) -> Floats:
    """Return a window of ``n`` samples at any positions, in the shape of ``position``.

    Parameters
    ----------
    name, n
        As of `window`.
    position
        In samples, 0 up to ``n``, the end of the last one.
    """
    if name == "hanning":
        return 0.5 * (1.0 - np.cos(2.0 * np.pi * (position + 1) / (n + 1)))
    samples = np.ones(position.shape)
    if name == "tukey" and n > 1:
        # The taper covers the first and last eighth of the time from 0 to 1.
        time = position / (n - 1)
        from_end = np.maximum(np.minimum(time, 1.0 - time), 0.0)
        tapered = from_end < TUKEY_TAPER / 2.0
        phase = 2.0 * np.pi / TUKEY_TAPER * (from_end[tapered] - TUKEY_TAPER / 2.0)
        samples[tapered] = 0.5 * (1.0 + np.cos(phase))
    return samples


def window_between(name: WindowName, n: int, shift: float) -> Floats:
    """Return a window that starts ``shift`` of a sample late; it may be read-only."""
    if not shift:
        return _cached_window(name, n) if n <= _SHORT else window(name, n)
    between = window_at(name, np.arange(n + 1) - shift, n)
    between[0] = 0.0
    return between


@lru_cache(maxsize=8)
def _cached_window(name: WindowName, n: int) -> Floats:
    samples = window(name, n)
    samples.flags.writeable = False
    return samples


def sinusoid(
    frequency_hz: float,
    duration_s: float = 0.1,
    *,
    phase_rad: float = 0.0,
    window_name: WindowName | str = "none",
    sample_rate_hz: float = SAMPLE_RATE_HZ,
    shift_s: float = 0.0,
) -> Floats:
    """Return a windowed sine burst of peak 1, (n,).

    The phase is reduced to one turn in exact arithmetic, so that the error does not grow with
    time (below 1e-12 at one hour).  With a shift, less than one sample, burst and window start
    that much later, and take one sample more.

    Raises
    ------
    InvalidInputError
        The frequency is not between 0 and half the sample rate, where it would alias.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.sinusoid(325.0, 4 / 1300).round(3))
    [ 0.  1.  0. -1.]
    """
    frequency = real_number("frequency_hz", frequency_hz)
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    phase = real_number("phase_rad", phase_rad)
    window_name = window_named(window_name)
    if not 0 <= frequency < rate_hz / 2:
        raise InvalidInputError(
            f"frequency_hz is {frequency:g}, expected 0 to {rate_hz / 2:g} Hz (half the sample "
            f"rate of {rate_hz:g} Hz); a higher tone would alias"
        )
    shift = shift_of(shift_s, rate_hz)
    n = sample_count(duration_s, rate_hz)
    samples = np.sin(2.0 * np.pi * turns(frequency, n + (shift > 0.0), rate_hz, shift) + phase)
    if window_name != "none" or shift:
        samples *= window_between(window_name, n, shift * rate_hz)
    return samples


def tap(
    time_s: float = 0.0, *, sample_rate_hz: float = SAMPLE_RATE_HZ, shift_s: float = 0.0
) -> Floats:
    """Return the upstream tap: a Hanning pulse of 16.2 ms that starts at ``time_s``, (n,).

    At 1300 Hz it is 21 samples long, and its peak comes ten samples after its start.  At other
    rates, and with a shift of less than one sample, the same pulse is sampled at other instants:
    0.5 (1 - cos(2 pi (t + h) / (22 h))) for 0 <= t < 21 h, where h is 1/1300 s.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.tap().size, ss.tap().max())
    21 1.0
    """
    shift = shift_of(shift_s, sample_rate_hz)
    silence = np.zeros(sample_count(time_s, sample_rate_hz))
    n = sample_count(TAP_S, sample_rate_hz) + (shift > 0.0)
    position = (np.arange(n) - shift * sample_rate_hz) * (SAMPLE_RATE_HZ / sample_rate_hz)
    pulse = window_at("hanning", position, TAP_SAMPLES)
    pulse[(position < 0.0) | (position >= TAP_SAMPLES)] = 0.0
    return np.concatenate((silence, pulse))


def impulse(
    time_s: float = 0.0,
    duration_s: float | None = None,
    *,
    sample_rate_hz: float = SAMPLE_RATE_HZ,
) -> Floats:
    """Return a single sample of 1 at ``time_s``, (n,); it ends there unless given a duration.

    It is one sample at any rate, so its energy depends on the rate: half the rate, twice the area.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.impulse(0.0, 0.004))
    [1. 0. 0. 0. 0.]
    """
    at = sample_count(time_s, sample_rate_hz)
    n = at + 1 if duration_s is None else sample_count(duration_s, sample_rate_hz)
    if at >= n:
        raise InvalidInputError(
            f"the impulse at {time_s} s is after the end of the stimulus, {duration_s} s; move it"
        )
    samples = np.zeros(n)
    samples[at] = 1.0
    return samples


def white_noise(
    duration_s: float = 0.1,
    seed: int = 0,
    *,
    band_hz: Band = BAND_HZ,
    window_name: WindowName | str = "none",
    sample_rate_hz: float = SAMPLE_RATE_HZ,
    shift_s: float = 0.0,
) -> Floats:
    """Return Gaussian noise of peak 1, flat within a band and zero outside it, (n,).

    The same seed gives the same noise everywhere; it is not MATLAB's noise of that seed.  A
    window other than ``"none"`` widens the spectrum: some of the noise then lies outside the band.
    With a shift, less than one sample, the same sum of waves is sampled that much earlier, with one
    sample more; between its samples it may exceed 1.

    Raises
    ------
    InvalidInputError
        The band is empty or lies above half the sample rate, the seed is negative, or the noise
        is too short to hold a single frequency of the band.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(abs(ss.white_noise(0.2, seed=3)).max())
    1.0
    """
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    band = finite_array("band_hz", band_hz, "two frequencies")
    window_name = window_named(window_name)
    if band.shape != (2,) or not 0 <= band[0] < band[1]:
        raise InvalidInputError(
            f"band_hz is {quoted(band_hz)}, expected 0 <= low < high <= {rate_hz / 2:g}"
        )
    if band[1] > rate_hz / 2:
        raise InvalidInputError(
            f"band_hz goes up to {band[1]:g} Hz, expected at most {rate_hz / 2:g} Hz (half the "
            f"sample rate of {rate_hz:g} Hz); higher noise would alias"
        )
    low, high = band.tolist()
    seed = integer("seed", seed, 0, _LARGEST_SEED)
    shift = shift_of(shift_s, rate_hz)
    n = sample_count(duration_s, sample_rate_hz)
    spectrum = scipy.fft.rfft(np.random.default_rng(seed).standard_normal(n)) if n else np.zeros(0)
    frequency_hz = np.arange(len(spectrum)) * rate_hz / max(n, 1)
    spectrum[(frequency_hz < low) | (frequency_hz > high)] = 0.0
    if n and not spectrum.any():
        raise InvalidInputError(
            f"noise of {n} samples holds no frequency between {low:g} and {high:g} Hz; make it "
            f"longer than {1 / high:.4f} s or widen the band"
        )
    samples = scipy.fft.irfft(spectrum, n) if n else np.zeros(0)
    samples *= window(window_name, n)
    peak = np.abs(samples).max(initial=0.0)
    if n and shift:
        # The waves repeat after n samples.
        samples = scipy.fft.irfft(spectrum * np.exp(-2j * np.pi * shift * frequency_hz), n)
        samples = np.append(samples, samples[0]) * window_between(window_name, n, shift * rate_hz)
    return samples / peak if peak > 0 else samples
