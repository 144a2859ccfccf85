"""How far a tone that rises or falls has turned."""

from collections.abc import Iterator
from decimal import Decimal, localcontext
from itertools import islice
from math import ceil

import numpy as np

from skinsource.arrays import Floats

#: Digits of the phase at the start of each block; an hour has some ten of whole turns.
_DIGITS = 60
_BLOCK = 256


def linear_sweep_turns(
    ends_hz: tuple[float, float],
    duration_s: float,
    n: int,
    sample_rate_hz: float,
    shift_s: float = 0.0,
) -> Floats:
    """Turns of a tone that changes by equal steps in equal times, (n,), less whole ones.

    Integral of f0 + (f1 - f0) t / T.  The phase at the start of each block of samples is computed
    with 60 digits, and from there by what is left of it, so that the error does not grow with
    time: below 1e-13 turns.
    """
    low_hz, high_hz = ends_hz
    with localcontext(prec=_DIGITS):
        slope = (Decimal(high_hz) - Decimal(low_hz)) / Decimal(duration_s)
        bend = float(slope / (2 * Decimal(float(sample_rate_hz)) ** 2))

        def starts() -> Iterator[tuple[float, float]]:
            first, rate = Decimal(low_hz), Decimal(float(sample_rate_hz))
            block, shift = 0, Decimal(float(shift_s))
            while True:
                time = block / rate - shift
                yield (
                    float((first + slope / 2 * time) * time % 1),
                    float((first + slope * time) / rate),
                )
                block += _BLOCK

        start, step = _blocks(starts(), n)
    within = np.arange(_BLOCK)
    found = np.multiply.outer(step, within)
    found += bend * within**2
    return _less_whole_turns(found, start, n)


def logarithmic_sweep_turns(
    ends_hz: tuple[float, float],
    duration_s: float,
    n: int,
    sample_rate_hz: float,
    shift_s: float = 0.0,
) -> Floats:
    """Turns of a tone that changes by equal factors in equal times, (n,), less whole ones.

    Integral of f0 (f1 / f0)^(t / T), computed as `linear_sweep_turns` is.  The ends differ.
    """
    low_hz, high_hz = ends_hz
    with localcontext(prec=_DIGITS):
        growth = (Decimal(high_hz) / Decimal(low_hz)).ln() / Decimal(duration_s)
        per_sample = growth / Decimal(float(sample_rate_hz))

        def starts() -> Iterator[tuple[float, float]]:
            frequency = Decimal(low_hz) * (-growth * Decimal(float(shift_s))).exp()
            factor = (per_sample * _BLOCK).exp()
            while True:
                turns = (frequency - Decimal(low_hz)) / growth
                yield float(turns % 1), float(frequency / Decimal(float(sample_rate_hz)))
                frequency *= factor

        start, step = _blocks(starts(), n)
    exponent = float(per_sample) * np.arange(_BLOCK)
    within = np.arange(_BLOCK, dtype=np.float64)
    within[1:] *= np.expm1(exponent[1:]) / exponent[1:]
    return _less_whole_turns(np.multiply.outer(step, within), start, n)


def _blocks(starts: Iterator[tuple[float, float]], n: int) -> tuple[Floats, Floats]:
    """Phase at the start of each block in turns, and frequency there in turns per sample."""
    found = np.array(list(islice(starts, ceil(n / _BLOCK)))).reshape(-1, 2)
    return found[:, 0], found[:, 1]


def _less_whole_turns(within: Floats, start: Floats, n: int) -> Floats:
    within += start[:, np.newaxis]
    for block in within:
        block -= np.rint(block)
    return within.ravel()[:n]
