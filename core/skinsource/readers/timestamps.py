"""Time stamps: at a steady rate, or not."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import ceil

import numpy as np
import scipy

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.readers import limits

# Of a step: what deviates less is as good as steady.
_STEADY = 1e-3
# Steps: a longer one is a gap, across which nothing is known.
_GAP = 8.0
_BLOCK, _OVERLAP = 2**15, 64
_MOST_DIGITS = 10


@dataclass(frozen=True, slots=True, kw_only=True)
class SampleClock:
    """How stamps follow each other.

    Attributes
    ----------
    rate_hz
        Samples a second, on average; a fraction of small numbers.
    steady
        Whether each sample lies where that says, as far as the stamps' digits tell.
    note
        How it is not steady, in a sentence; empty if it is.
    """

    rate_hz: Fraction
    steady: bool
    note: str = ""


def sample_clock(stamps_s: Floats) -> SampleClock:
    """Look at time stamps, (n,), n >= 2, in s.

    Raises
    ------
    InvalidInputError
        They do not increase, or are no numbers.
    """
    if stamps_s.size < 2:
        raise InvalidInputError("one time stamp says no rate, expected two or more; type the rate")
    steps = np.diff(stamps_s)
    if not (steps > 0.0).all():  # also where they are not numbers
        at = int(np.argmin(steps > 0.0)) + 1
        raise InvalidInputError(
            f"the time stamps do not increase at sample {at + 1} (from {stamps_s[at - 1]:g} to "
            f"{stamps_s[at]:g} s), expected later ones; choose another column or type the rate"
        )
    n, lasts = stamps_s.size - 1, float(stamps_s[-1] - stamps_s[0])
    quantum = _quantum(stamps_s)
    rate = n / lasts
    if not limits.LEAST_RATE_HZ / 2 <= rate <= limits.MOST_RATE_HZ:
        raise InvalidInputError(
            f"the time stamps say {rate:g} samples a second, expected {limits.LEAST_RATE_HZ:g} to "
            f"{limits.MOST_RATE_HZ:g}; check their unit"
        )
    whole = round(rate)
    if whole >= 1 and abs(rate - whole) <= rate * (quantum / lasts + 1e-6):
        exact = Fraction(whole)
    else:
        exact = Fraction(rate).limit_denominator(1000)
    line = stamps_s[0] + np.arange(stamps_s.size) / float(exact)
    deviation = float(np.abs(stamps_s - line).max())
    step = 1.0 / float(exact)
    # A rounded stamp is half a last digit off; so is the first one, which the others are held to.
    if deviation <= max(_STEADY * step, 1.1 * quantum):
        return SampleClock(rate_hz=exact, steady=True)
    note = (
        f"The time stamps are not steady: steps of {steps.min() * 1e3:.4g} to "
        f"{steps.max() * 1e3:.4g} ms. Between them a cubic spline was taken."
    )
    return SampleClock(rate_hz=Fraction(ceil(rate)), steady=False, note=note)


def at_steady_rate(values: Floats, stamps_s: Floats, rate_hz: Fraction) -> Floats:
    """Return the signal at a steady rate from its first stamp on, (n,).

    It is a cubic spline through the samples, and a straight line across gaps.
    """
    start = stamps_s[0]
    n = int((stamps_s[-1] - start) * float(rate_hz) + 1e-6) + 1
    times = start + np.arange(n) / float(rate_hz)
    resampled = np.interp(times, stamps_s, values)
    for first, last in _without_gaps(stamps_s):
        for a, b in _blocks(first, last):
            within = slice(*np.searchsorted(times, (stamps_s[a], stamps_s[b - 1])))
            around = slice(max(a - _OVERLAP, first), min(b + _OVERLAP, last))
            spline = scipy.interpolate.CubicSpline(stamps_s[around], values[around])
            resampled[within] = spline(times[within])
    return resampled


def _without_gaps(stamps_s: Floats) -> Iterator[tuple[int, int]]:
    """First and last + 1 of the samples of each stretch that is long enough for a spline."""
    steps = np.diff(stamps_s)
    after = np.flatnonzero(steps > _GAP * np.median(steps)) + 1
    edges = [0, *after.tolist(), stamps_s.size]
    for first, last in pairwise(edges):
        if last - first >= 4:
            yield first, last


def _blocks(first: int, last: int) -> Iterator[tuple[int, int]]:
    # Each begins with the last sample of the one before.
    for start in range(first, last - 1, _BLOCK - 1):
        yield start, min(start + _BLOCK, last)


def _quantum(stamps_s: Floats) -> float:
    """The last decimal place to which stamps are written, in s; 0 if they are full numbers."""
    some = stamps_s[np.linspace(0, stamps_s.size - 1, min(stamps_s.size, 1000)).astype(int)]
    for digits in range(_MOST_DIGITS):
        scaled = some * 10.0**digits
        if np.abs(scaled - np.rint(scaled)).max() <= 1e-9 * max(np.abs(scaled).max(), 1.0):
            return float(10.0**-digits)
    return 0.0


# What the lines before a table say about its sample rate.

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
    """The first rate that one of the lines states; None where none does.

    Parameters
    ----------
    lines
        Those before the numbers.
    decimal
        Of the numbers below, "." or ",": the other one parts thousands, as in 48,000 Hz.
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
    parting = "," if decimal == "." else "."
    if not kilo and re.fullmatch(rf"\d{{1,3}}(\{parting}\d{{3}})+(\{decimal}\d+)?", plain):
        plain = plain.replace(parting, "")
    try:
        return float(plain.replace(",", ".")) * (1000.0 if kilo else 1.0)
    except ValueError:  # more than one point: whatever it is, it is no rate
        return None
