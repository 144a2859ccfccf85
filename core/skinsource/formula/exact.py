"""Phases that do not lose digits with time.

``sin(2*pi*250*t)`` after an hour is the sine of six million; in floats its argument is known to
1e-9.  So what is a polynomial in ``t`` is kept as one, with whole numbers above and below, and
reduced to one turn before it becomes a float.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import lcm

import numpy as np

from skinsource.arrays import Floats

#: pi to 1e-60, which no phase of a signal that can be played comes near.
PI = Fraction(
    3_141592653589793238462643383279502884197169399375105820974944592,
    10**63,
)
_MAX_DEGREE, _MAX_BITS = 2, 6000
_BLOCK = 128


@dataclass(frozen=True, slots=True)
class Polynomial:
    """Exact numbers ``c[0] + c[1] t + c[2] t^2``."""

    c: tuple[Fraction, ...]

    @property
    def constant(self) -> Fraction | None:
        """Its value where it does not depend on the time."""
        return self.c[0] if len(self.c) == 1 else None

    def plus(self, other: "Polynomial") -> "Polynomial | None":
        """The sum; None where it became too long to be worth it."""
        length = max(len(self.c), len(other.c))
        ours, theirs = self._of(length), other._of(length)
        return _bounded([one + two for one, two in zip(ours, theirs, strict=True)])

    def times(self, other: "Polynomial") -> "Polynomial | None":
        """The product; None where it became too long, or of a degree above two."""
        if len(self.c) + len(other.c) - 2 > _MAX_DEGREE:
            return None
        found = [Fraction(0)] * (len(self.c) + len(other.c) - 1)
        for k, one in enumerate(self.c):
            for m, two in enumerate(other.c):
                found[k + m] += one * two
        return _bounded(found)

    def _of(self, length: int) -> tuple[Fraction, ...]:
        return self.c + (Fraction(0),) * (length - len(self.c))


def _bounded(found: list[Fraction]) -> Polynomial | None:
    while len(found) > 1 and not found[-1]:
        found.pop()
    bits = max(max(one.numerator.bit_length(), one.denominator.bit_length()) for one in found)
    return Polynomial(tuple(found)) if bits <= _MAX_BITS else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """Samples ``first`` to ``first + count - 1``; number k is played at ``k / rate - shift``.

    Attributes
    ----------
    first, count
        Numbers of samples.
    rate_hz, shift_s
        Which instants they are.
    duration_s
        How long the formula plays.
    """

    first: int
    count: int
    rate_hz: float
    shift_s: float
    duration_s: float

    @property
    def instants(self) -> Floats:
        """(count,), in s."""
        t = np.arange(self.first, self.first + self.count) / self.rate_hz
        return t - self.shift_s if self.shift_s else t


def cycles(phase: Polynomial, period: Fraction, grid: Grid) -> Floats:
    """``phase / period`` less whole numbers, (count,), from -1/2 to 1/2.

    In each block the phase is a polynomial in the whole number of samples from its middle; its
    coefficients are reduced to half a turn in whole numbers, and only then divided: the error is
    below 1e-14 for a straight phase and 1e-12 for a quadratic one, however late it is.
    """
    per_sample, shift = 1 / Fraction(grid.rate_hz), Fraction(grid.shift_s)
    one, linear, square = (c / period for c in phase._of(_MAX_DEGREE + 1))
    # With t = k per_sample - shift, in powers of k.
    in_k = (
        one - linear * shift + square * shift**2,
        (linear - 2 * square * shift) * per_sample,
        square * per_sample**2,
    )
    below = lcm(*(each.denominator for each in in_k))
    c, b, a = (each.numerator * (below // each.denominator) for each in in_k)
    middles = range(grid.first + _BLOCK // 2, grid.first + grid.count + _BLOCK // 2, _BLOCK)
    starts = np.array([_reduced((a * k + b) * k + c, below) for k in middles], np.float64)
    slopes = np.array([_reduced(2 * a * k + b, below) for k in middles], np.float64)
    m = np.arange(_BLOCK) - _BLOCK // 2
    found = starts[:, None] + slopes[:, None] * m
    if a:
        found += _reduced(a, below) * (m * m)
    flat = found.ravel()[: grid.count]
    return flat - np.rint(flat)


def _reduced(above: int, below: int) -> float:
    """``above / below`` less the nearest whole number."""
    rest = above % below
    return (rest - below if 2 * rest > below else rest) / below
