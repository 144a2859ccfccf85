"""Values of the parts of a formula, with phases that do not lose digits with time, and its noise.

``sin(2*pi*250*t)`` after an hour is the sine of six million; in floats its argument is known to
1e-9.  So a polynomial in ``t`` stays one, with fractions of integers as coefficients, and is
reduced to one turn before it becomes a float.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, lcm

import numpy as np
import scipy

from skinsource.base.conventions import Complexes, Floats

#: pi to 1e-60, far more exact than any phase of a signal.
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
        """Its value if it does not depend on the time, else None."""
        return self.c[0] if len(self.c) == 1 else None

    def plus(self, other: "Polynomial") -> "Polynomial | None":
        """Return the sum; None if its coefficients have too many digits."""
        length = max(len(self.c), len(other.c))
        ours, theirs = self._of(length), other._of(length)
        return _bounded([left + right for left, right in zip(ours, theirs, strict=True)])

    def times(self, other: "Polynomial") -> "Polynomial | None":
        """Return the product; None if it has too many digits, or a degree above two."""
        if len(self.c) + len(other.c) - 2 > _MAX_DEGREE:
            return None
        product = [Fraction(0)] * (len(self.c) + len(other.c) - 1)
        for k, left in enumerate(self.c):
            for m, right in enumerate(other.c):
                product[k + m] += left * right
        return _bounded(product)

    def _of(self, length: int) -> tuple[Fraction, ...]:
        return self.c + (Fraction(0),) * (length - len(self.c))


def _bounded(coefficients: list[Fraction]) -> Polynomial | None:
    while len(coefficients) > 1 and not coefficients[-1]:
        coefficients.pop()
    bits = max(max(c.numerator.bit_length(), c.denominator.bit_length()) for c in coefficients)
    return Polynomial(tuple(coefficients)) if bits <= _MAX_BITS else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """Samples ``first`` to ``first + count - 1``; sample k has the instant ``k / rate - shift``.

    Attributes
    ----------
    first, count
        First sample, and number of samples.
    rate_hz, shift_s
        Sample rate, and delay of the formula.
    duration_s
        Duration of the formula.
    """

    first: int
    count: int
    rate_hz: float
    shift_s: float
    duration_s: float

    @property
    def instants(self) -> Floats:
        """Instants of the samples, (count,), in s."""
        t = np.arange(self.first, self.first + self.count) / self.rate_hz
        return t - self.shift_s if self.shift_s else t


def cycles(phase: Polynomial, period: Fraction, grid: Grid) -> Floats:
    """Return ``phase / period`` without whole periods, (count,), from -1/2 to 1/2.

    In each block the phase is a polynomial in the whole number of samples from its middle; its
    coefficients are reduced to half a turn as integers, and only then divided: the error is
    below 1e-14 for a straight phase and 1e-12 for a quadratic one, however late it is.
    """
    per_sample, shift = 1 / Fraction(grid.rate_hz), Fraction(grid.shift_s)
    constant, linear, square = (c / period for c in phase._of(_MAX_DEGREE + 1))
    # With t = k per_sample - shift, in powers of k.
    in_k = (
        constant - linear * shift + square * shift**2,
        (linear - 2 * square * shift) * per_sample,
        square * per_sample**2,
    )
    below = lcm(*(each.denominator for each in in_k))
    c, b, a = (each.numerator * (below // each.denominator) for each in in_k)
    middles = range(grid.first + _BLOCK // 2, grid.first + grid.count + _BLOCK // 2, _BLOCK)
    starts = np.array([_reduced((a * k + b) * k + c, below) for k in middles], np.float64)
    slopes = np.array([_reduced(2 * a * k + b, below) for k in middles], np.float64)
    m = np.arange(_BLOCK) - _BLOCK // 2
    phases = starts[:, None] + slopes[:, None] * m
    if a:
        phases += _reduced(a, below) * (m * m)
    flat = phases.ravel()[: grid.count]
    return flat - np.rint(flat)


def _reduced(above: int, below: int) -> float:
    """Return ``above / below`` without the nearest integer."""
    rest = above % below
    return (rest - below if 2 * rest > below else rest) / below


_LARGEST_WHOLE_POWER = 2


@dataclass(frozen=True, slots=True)
class Value:
    """Numbers at the samples, and how they are made of a polynomial in time.

    Attributes
    ----------
    at : (n_times,) or ()
        The numbers as floats.
    exact
        The polynomial that they are, except for ``rest``; None where there is none.
    rest : (n_times,), (), or None
        What is added to the polynomial.
    """

    at: Floats
    exact: Polynomial | None = None
    rest: Floats | None = None

    @staticmethod
    def of(number: float) -> "Value":
        """Return a constant."""
        exact = Polynomial((Fraction(number),)) if isfinite(number) else None
        return Value(np.asarray(number, np.float64), exact)

    @staticmethod
    def pi() -> "Value":
        """Return pi, exact."""
        return Value(np.asarray(np.pi), Polynomial((PI,)))

    @staticmethod
    def time(grid: Grid) -> "Value":
        """Return the time, exact."""
        return Value(grid.instants, Polynomial((Fraction(0), Fraction(1))))

    def __add__(self, other: "Value") -> "Value":
        at = self.at + other.at
        if self.exact is None and other.exact is None:
            return Value(at)
        ours, theirs = self._parts(), other._parts()
        exact = ours[0].plus(theirs[0])
        return Value(at) if exact is None else Value(at, exact, _summed(ours[1], theirs[1]))

    def __neg__(self) -> "Value":
        return self._scaled(Fraction(-1), np.asarray(-1.0), -self.at)

    def __sub__(self, other: "Value") -> "Value":
        total = self + -other
        return Value(self.at - other.at, total.exact, total.rest)

    def __mul__(self, other: "Value") -> "Value":
        at = self.at * other.at
        for left, right in ((self, other), (other, self)):
            factor = left.constant
            if factor is not None:
                return right._scaled(factor, left.at, at)
        if self.exact is None or other.exact is None:
            return Value(at)
        if self.rest is not None or other.rest is not None:
            return Value(at)
        return Value(at, self.exact.times(other.exact))

    def __truediv__(self, other: "Value") -> "Value":
        at = self.at / other.at
        divisor = other.constant
        return self._scaled(1 / divisor, 1 / other.at, at) if divisor else Value(at)

    def __pow__(self, other: "Value") -> "Value":
        at = np.power(self.at, other.at)
        if self.exact is not None and self.rest is None and other.constant is not None:
            power = other.constant
            if power.denominator == 1 and 1 <= power <= _LARGEST_WHOLE_POWER:
                exact = self.exact if power == 1 else self.exact.times(self.exact)
                return Value(at, exact)
        return Value(at)

    def cycles(self, period: Fraction, grid: Grid) -> Floats:
        """Return the value in periods without whole ones, exact however large it is."""
        if self.exact is None:
            turned = self.at / float(period)
        else:
            turned = cycles(self.exact, period, grid)
            if self.rest is not None:
                turned = turned + self.rest / float(period)
        return np.asarray(turned - np.rint(turned))

    @property
    def constant(self) -> Fraction | None:
        """Its exact number if it is the same at all times, else None."""
        return self.exact.constant if self.exact is not None and self.rest is None else None

    def _parts(self) -> tuple[Polynomial, Floats | None]:
        return (self.exact, self.rest) if self.exact else (Polynomial((Fraction(0),)), self.at)

    def _scaled(self, factor: Fraction, in_floats: Floats, at: Floats) -> "Value":
        exact = None if self.exact is None else self.exact.times(Polynomial((factor,)))
        if exact is None:
            return Value(at)
        return Value(at, exact, None if self.rest is None else self.rest * in_floats)


def _summed(left: Floats | None, right: Floats | None) -> Floats | None:
    if left is None or right is None:
        return left if right is None else right
    return left + right


#: RMS of the noise; its samples seldom exceed 1.
RMS = 1 / 3
LARGEST_SEED = 2**31 - 1
_BLOCK_S = 2.0
_HOP_S = 1.0
# Numbers of the lowest and highest tone; tones are 1 / block apart.  The window widens each by some
# hertz, so that the outermost stay inside 25 to 600 Hz.  The band does not depend on the limb: a
# formula is the same wherever it is played.
_LOWEST, _HIGHEST = 56, 1194


def band_noise(seed: int, grid: Grid) -> Floats:
    """Return Gaussian noise of RMS 1/3 from 28 to 597 Hz at the samples of ``grid``, (count,).

    It is a sum of blocks of 2 s, one of which begins each second, and each is faded in and out so
    that the power stays; a block is a sum of tones, every 0.5 Hz, with amplitudes and phases drawn
    from the seed and the number of the block.  So it is a function of continuous time: sampled
    faster, later by a part of a sample, or for longer, it is the same noise; outside 25 to 600 Hz
    lies less than 1e-8 of its energy.  At a rate of 1200 Hz or less the tones that do not fit below
    half the rate are left out.
    """
    instants = grid.instants
    noise = np.zeros(grid.count)
    if not grid.count:
        return noise
    first, last = int(np.floor(instants[0])) - 1, int(np.floor(instants[-1]))
    highest = min(_HIGHEST, int(np.ceil(_BLOCK_S * grid.rate_hz / 2)) - 1)
    for block in range(first, last + 1):
        since = instants - block * _HOP_S
        begin, end = np.searchsorted(since, (0.0, _BLOCK_S))
        if begin == end or highest < _LOWEST:
            continue
        part = since[begin:end]
        fade = np.sin(np.pi / 2 * np.sin(np.pi / _BLOCK_S * part) ** 2)
        tones = _tones(seed, block)[: highest - _LOWEST + 1]
        noise[begin:end] += fade * _sum_of_tones(tones, part, grid.rate_hz)
    return noise


def _tones(seed: int, block: int) -> Complexes:
    """Return the complex amplitudes of the tones of a block, (n_tones,); blocks count from -2."""
    drawn = np.random.default_rng((seed, block + 2)).standard_normal((_HIGHEST - _LOWEST + 1, 2))
    return (drawn[:, 0] + 1j * drawn[:, 1]) * (RMS / np.sqrt(len(drawn)))


def _sum_of_tones(tones: Complexes, since: Floats, rate_hz: float) -> Floats:
    """Return the sum of the tones of a block at equally spaced times from its start, (n_times,).

    By Bluestein's convolution, which takes any rate.  Its chirp is reduced to one turn by a
    remainder, which is exact.
    """
    n, m = len(since), len(tones)
    lag = np.arange(-(m - 1), n)
    turns = np.fmod(lag.astype(float) ** 2, 2 * _BLOCK_S * rate_hz) / (2 * _BLOCK_S * rate_hz)
    chirp = np.exp(2j * np.pi * turns)
    number = np.arange(m)
    # Phases at the first of the times, relative to the lowest tone.
    started = tones * np.exp(2j * np.pi * np.fmod(number * since[0] / _BLOCK_S, 1.0))
    size = scipy.fft.next_fast_len(n + 2 * m)
    left = scipy.fft.fft(started * chirp[m - 1 :: -1][:m], size)
    right = scipy.fft.fft(np.conj(chirp), size)
    summed = scipy.fft.ifft(left * right)[m - 1 : m - 1 + n] * chirp[m - 1 :]
    lowest = np.exp(2j * np.pi * np.fmod(_LOWEST * since / _BLOCK_S, 1.0))
    return np.asarray((summed * lowest).real)
