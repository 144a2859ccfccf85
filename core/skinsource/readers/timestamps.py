"""Sample rates of recordings: from timestamps, steady or not, and from lines before a table."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import ceil

import numpy as np
import scipy

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.readers import limits

# Largest deviation of steady timestamps, as a share of a step.
_STEADY = 1e-3
# A step longer than this many median ones is a gap, across which nothing is known.
_GAP = 8.0
_BLOCK, _OVERLAP = 2**15, 64
_MOST_DIGITS = 10


@dataclass(frozen=True, slots=True, kw_only=True)
class SampleClock:
    """Rate of timestamps.

    Attributes
    ----------
    rate_hz
        Average sample rate; a fraction of small numbers.
    steady
        Whether all timestamps fit that rate, within their last digit.
    note
        Sentence on how they are not steady; empty if they are.
    """

    rate_hz: Fraction
    steady: bool
    note: str = ""


def sample_clock(timestamps_s: Floats) -> SampleClock:
    """Return the rate of timestamps, (n,), n >= 2, in s.

    Raises
    ------
    InvalidInputError
        They do not increase, or are no numbers.
    """
    if timestamps_s.size < 2:
        raise InvalidInputError("one time stamp says no rate, expected two or more; type the rate")
    steps = np.diff(timestamps_s)
    if not (steps > 0.0).all():  # also where they are not numbers
        k = int(np.argmin(steps > 0.0)) + 1
        raise InvalidInputError(
            f"the time stamps do not increase at sample {k + 1} (from {timestamps_s[k - 1]:g} to "
            f"{timestamps_s[k]:g} s), expected later ones; choose another column or type the rate"
        )
    n, duration_s = timestamps_s.size - 1, float(timestamps_s[-1] - timestamps_s[0])
    quantum = _quantum(timestamps_s)
    rate = n / duration_s
    if not limits.LEAST_RATE_HZ / 2 <= rate <= limits.MOST_RATE_HZ:
        raise InvalidInputError(
            f"the time stamps say {rate:g} samples a second, expected {limits.LEAST_RATE_HZ:g} to "
            f"{limits.MOST_RATE_HZ:g}; check their unit"
        )
    nearest = round(rate)
    if nearest >= 1 and abs(rate - nearest) <= rate * (quantum / duration_s + 1e-6):
        exact = Fraction(nearest)
    else:
        exact = Fraction(rate).limit_denominator(1000)
    line = timestamps_s[0] + np.arange(timestamps_s.size) / float(exact)
    deviation = float(np.abs(timestamps_s - line).max())
    step = 1.0 / float(exact)
    # A rounded timestamp is off by half a last digit; so is the first one, where the line begins.
    if deviation <= max(_STEADY * step, 1.1 * quantum):
        return SampleClock(rate_hz=exact, steady=True)
    note = (
        f"The time stamps are not steady: steps of {steps.min() * 1e3:.4g} to "
        f"{steps.max() * 1e3:.4g} ms. Between them a cubic spline was taken."
    )
    return SampleClock(rate_hz=Fraction(ceil(rate)), steady=False, note=note)


def at_steady_rate(values: Floats, timestamps_s: Floats, rate_hz: Fraction) -> Floats:
    """Return the signal at a steady rate from its first timestamp on, (n,).

    It follows a cubic spline through the samples, and a straight line across gaps.
    """
    start_s = timestamps_s[0]
    n = int((timestamps_s[-1] - start_s) * float(rate_hz) + 1e-6) + 1
    times = start_s + np.arange(n) / float(rate_hz)
    resampled = np.interp(times, timestamps_s, values)
    for first, last in _without_gaps(timestamps_s):
        for start in range(first, last - 1, _BLOCK - 1):
            # Each block begins with the last sample of the previous one.
            end = min(start + _BLOCK, last)
            within = slice(*np.searchsorted(times, (timestamps_s[start], timestamps_s[end - 1])))
            around = slice(max(start - _OVERLAP, first), min(end + _OVERLAP, last))
            spline = scipy.interpolate.CubicSpline(timestamps_s[around], values[around])
            resampled[within] = spline(times[within])
    return resampled


def _without_gaps(timestamps_s: Floats) -> Iterator[tuple[int, int]]:
    """Give the first sample and the end of each stretch that is long enough for a spline."""
    steps = np.diff(timestamps_s)
    after = np.flatnonzero(steps > _GAP * np.median(steps)) + 1
    edges = [0, *after.tolist(), timestamps_s.size]
    for first, last in pairwise(edges):
        if last - first >= 4:
            yield first, last


def _quantum(timestamps_s: Floats) -> float:
    """Return the last decimal place of timestamps, in s; 0 if they have all digits of floats."""
    some = timestamps_s[
        np.linspace(0, timestamps_s.size - 1, min(timestamps_s.size, 1000)).astype(int)
    ]
    for digits in range(_MOST_DIGITS):
        scaled = some * 10.0**digits
        if np.abs(scaled - np.rint(scaled)).max() <= 1e-9 * max(np.abs(scaled).max(), 1.0):
            return float(10.0**-digits)
    return 0.0


_NUMBER = r"(?P<number>\d[\d.,]*(?:e[+-]?\d+)?)\s*(?P<unit>k?hz\b)?"
_BETWEEN = r"\s*(?:\[?\(?hz\)?\]?)?\s*[:=,;\t ]\s*"
# "Sample rate", "fs", and "rate" where nothing says of what.
_NAMED = re.compile(
    rf"(?:(?<![a-z])(?:sampl\w*[ _-]*(?:rate|freq\w*)|fs)|^[\W_]*rate){_BETWEEN}{_NUMBER}",
    re.IGNORECASE,
)
# "Samples: 5000" counts them; "Sampling: 5000 Hz" does not.
_SAMPLING = re.compile(rf"(?<![a-z])sampl\w*{_BETWEEN}{_NUMBER}", re.IGNORECASE)


def stated_rate_hz(lines: Sequence[str], decimal: str) -> float | None:
    """Return the first sample rate that one of the lines states; None where none does.

    Parameters
    ----------
    lines
        The lines before the numbers of a table.
    decimal
        Decimal mark of the table, "." or ",": the other one separates thousands, as in 48,000 Hz.
    """
    for line in lines:
        named, sampling = _NAMED.search(line), _SAMPLING.search(line)
        match = named or (sampling if sampling and sampling["unit"] else None)
        rate_hz = None if match is None else _hz(match["number"], match["unit"] or "", decimal)
        if rate_hz is not None and limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ:
            return rate_hz
    return None


def _hz(number: str, unit: str, decimal: str) -> float | None:
    kilo, plain = unit.lower() == "khz", number.rstrip(".,")
    separator = "," if decimal == "." else "."
    if not kilo and re.fullmatch(rf"\d{{1,3}}(\{separator}\d{{3}})+(\{decimal}\d+)?", plain):
        plain = plain.replace(separator, "")
    try:
        return float(plain.replace(",", ".")) * (1000.0 if kilo else 1.0)
    except ValueError:  # more than one point is no rate
        return None
