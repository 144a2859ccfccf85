"""When samples lie, and what a signal is between them."""

from functools import cache
from math import floor

import numpy as np

from skinsource.base.arguments import positive_number, real_number
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError

# Delay of samples by a part of the time between two of them.

#: Samples on each side of an instant that its value is made of.
REACH = 64
#: Form of the Kaiser window over them: what it leaves of images is below -120 dB.
_BETA = 12.3


def band_limited_delay(samples: Floats, delay: float) -> Floats:
    """Samples of the same signal, ``delay`` of a sample later, (n + 1,).

    The signal is the one that the samples describe between them: a sum of sin(pi u) / (pi u),
    of which a Kaiser window keeps 64 samples on either side.  Up to 0.92 of half the sample rate
    (600 Hz at 1300 Hz) gain and delay are kept within 1e-6.  What would ring before the first
    and after the last sample is left out, so that a delayed signal begins no earlier: signals
    that begin and end in silence lose nothing by that.

    Parameters
    ----------
    samples : (n,)
        The signal; silent before and after.
    delay
        In samples, 0 up to 1.

    Returns
    -------
    (n + 1,), with a delay of 0 (n,): the samples as they are.

    Raises
    ------
    InvalidInputError
        The delay is not between 0 and 1.

    References
    ----------
    Laakso et al., Splitting the unit delay, IEEE Signal Processing Magazine 13(1), 1996.
    """
    delay = real_number("delay", delay, "a number from 0 to 1", least=0.0, most=1.0)
    if delay == 0.0 or samples.size == 0:
        return samples
    taps = np.arange(1 - REACH, REACH + 1) - delay
    kernel = np.sinc(taps) * np.i0(_BETA * np.sqrt(1.0 - (taps / REACH) ** 2)) / np.i0(_BETA)
    # The sample at its own place comes first in the result.
    return np.convolve(samples, kernel)[REACH - 1 : REACH + samples.size]


# Where something lies between samples, on a grid far finer than any clock.

#: Parts of a sample.  Sums of decimal times miss their exact values by some last digits: what
#: differs by less is at one place, so that it is drawn once wherever it is moved by whole samples.
_PER_SAMPLE = 2**32
#: As near to a sample is on it: less than a nanosecond at 1300 Hz.
NEAR = 1e-6


def on_grid(position: float) -> tuple[int, float]:
    """Sample at or before a position, and how far behind it the position lies, 0 to less than 1.

    Parameters
    ----------
    position
        In samples.
    """
    whole, behind = parted(position)
    return whole, round(behind * _PER_SAMPLE) / _PER_SAMPLE


def parted(position: float) -> tuple[int, float]:
    """The same to the last digit of the position: for what is added to others."""
    nearest = round(position)
    if abs(position - nearest) < NEAR:
        return nearest, 0.0
    whole = floor(position)
    return whole, position - whole


# Values of many signals at one instant, between samples or on one.

# As of the band-limited delay: what is left of images is below -120 dB.


def values_at(samples: Floats, place: float) -> Floats:
    """The band-limited signals that samples describe, at one place, (...).

    The sum of sin(pi u) / (pi u), of which a Kaiser window keeps 64 samples on either side: up to
    0.92 of half the sample rate (600 Hz at 1300 Hz) the gain is kept within 1e-6.  On a sample
    its value comes out as it is.

    Parameters
    ----------
    samples : (..., n_times)
        The signals; silent before and after.
    place
        In samples.
    """
    n_times = samples.shape[-1]
    whole, behind = parted(place)
    if behind == 0.0:
        inside = 0 <= whole < n_times
        return samples[..., whole].copy() if inside else np.zeros(samples.shape[:-1])
    first, end = max(whole + 1 - REACH, 0), min(whole + 1 + REACH, n_times)
    if first >= end:
        return np.zeros(samples.shape[:-1])
    apart = np.arange(first, end) - whole - behind
    window = np.i0(_BETA * np.sqrt(1.0 - (apart / REACH) ** 2)) / np.i0(_BETA)
    values: Floats = samples[..., first:end] @ (np.sinc(apart) * window)
    return values


# Values of a signal between its samples.

# As of the band-limited delay: what is left of images is below -120 dB.

# Entries of the kernel's table for each zero; between them it is straight, within 1e-7.
_PER_ZERO = 4096
_AT_ONCE = 2**20


def values_between(samples: Floats, places: Floats, band: float = 1.0) -> Floats:
    """The band-limited signal that samples describe, at any places, (n_places,).

    The sum of sin(pi u) / (pi u), of which a Kaiser window keeps 64 zeros on either side: up to
    0.92 of the band the gain is kept within 1e-6.  Before the first and after the last sample
    there is silence.

    Parameters
    ----------
    samples : (n_times,)
        The signal.
    places : (n_places,)
        In samples; they rise.
    band
        Part of half the sample rate that is kept, up to 1: less where places lie further apart
        than samples, so that nothing folds.
    """
    values = np.zeros(places.size)
    if not samples.size:
        return values
    reach = int(np.ceil(REACH / band))
    table = _table()
    # Whoever has fewer samples than the kernel reaches adds up all of them.
    taps = np.arange(1 - reach, reach + 1) if 2 * reach < samples.size else None
    rows = max(_AT_ONCE // (samples.size if taps is None else taps.size), 1)
    for start in range(0, places.size, rows):
        part = places[start : start + rows, None]
        if taps is None:
            index = np.arange(samples.size)[None, :]
        else:
            index = np.floor(part).astype(np.intp) + taps
        distance = np.abs(part - index) * (band * _PER_ZERO)
        kernel = np.interp(distance, np.arange(table.size), table, right=0.0)
        there = (index >= 0) & (index < samples.size)
        taken = samples[np.clip(index, 0, samples.size - 1)] * there
        values[start : start + rows] = (kernel * taken).sum(axis=1) * band
    return values


@cache
def _table() -> Floats:
    zeros = np.arange(REACH * _PER_ZERO + 1) / _PER_ZERO
    window = np.i0(_BETA * np.sqrt(1.0 - (zeros / REACH) ** 2)) / np.i0(_BETA)
    kept: Floats = np.sinc(zeros) * window
    return kept


# How far a tone has turned, and by how much a recipe starts between two samples.

_BLOCK = 256


def shift_of(shift_s: float, sample_rate_hz: float) -> float:
    """Return ``shift_s``; refuse what is not between 0 and one sample.

    Raises
    ------
    InvalidInputError
        It is negative, or a sample or longer.
    """
    period_s = 1.0 / positive_number("sample_rate_hz", sample_rate_hz)
    shift = real_number("shift_s", shift_s)
    if not 0.0 <= shift < period_s:
        raise InvalidInputError(
            f"shift_s is {shift:g}, expected 0 to {period_s:g} (one sample at {sample_rate_hz:g} "
            "Hz); move the rest by whole samples"
        )
    return shift


def turns(frequency_hz: float, n: int, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
    """Turns of a tone at the first ``n`` instants of its recipe, (n,), less whole ones.

    They are reduced in exact arithmetic, so that the error does not grow with time: below 1e-12
    at one hour.
    """
    frequency = real_number("frequency_hz", frequency_hz)
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    # Turns per sample as a fraction of whole numbers; dividing those rounds once.
    (hz, per_hz), (rate, per_rate) = (value.as_integer_ratio() for value in (frequency, rate_hz))
    above, below = hz * per_rate, per_hz * rate
    starts = [k * above % below / below for k in range(0, n, _BLOCK)]
    within = np.arange(_BLOCK) * (above / below)
    phases = np.add.outer(np.array(starts), within).ravel()[:n]
    return phases - frequency * shift_s if shift_s else phases
