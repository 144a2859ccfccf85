"""What a part of a formula is worth at the samples."""

from dataclasses import dataclass
from fractions import Fraction
from math import isfinite

import numpy as np

from skinsource.arrays import Floats
from skinsource.formula.exact import PI, Grid, Polynomial, cycles

_LARGEST_WHOLE_POWER = 2


@dataclass(frozen=True, slots=True)
class Value:
    """Numbers at the samples, and how they are made of a polynomial in time.

    Attributes
    ----------
    at : (n_times,) or ()
        The numbers in floats.
    exact
        A polynomial that they are, but for ``rest``; None where they are not made of one.
    rest : (n_times,), (), or None
        What is added to the polynomial.
    """

    at: Floats
    exact: Polynomial | None = None
    rest: Floats | None = None

    @staticmethod
    def of(number: float) -> "Value":
        """A constant."""
        exact = Polynomial((Fraction(number),)) if isfinite(number) else None
        return Value(np.asarray(number, np.float64), exact)

    @staticmethod
    def pi() -> "Value":
        """The number pi, exact."""
        return Value(np.asarray(np.pi), Polynomial((PI,)))

    @staticmethod
    def time(grid: Grid) -> "Value":
        """The time, exact."""
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
        return Value(self.at - other.at, *_exact_parts(self + -other))

    def __mul__(self, other: "Value") -> "Value":
        at = self.at * other.at
        for one, two in ((self, other), (other, self)):
            factor = one._factor
            if factor is not None:
                return two._scaled(factor, one.at, at)
        if self.exact is None or other.exact is None:
            return Value(at)
        if self.rest is not None or other.rest is not None:
            return Value(at)
        return Value(at, self.exact.times(other.exact))

    def __truediv__(self, other: "Value") -> "Value":
        at = self.at / other.at
        divisor = other._factor
        return self._scaled(1 / divisor, 1 / other.at, at) if divisor else Value(at)

    def __pow__(self, other: "Value") -> "Value":
        at = np.power(self.at, other.at)
        if self.exact is not None and self.rest is None and other._factor is not None:
            power = other._factor
            if power.denominator == 1 and 1 <= power <= _LARGEST_WHOLE_POWER:
                exact = self.exact if power == 1 else self.exact.times(self.exact)
                return Value(at, exact)
        return Value(at)

    def cycles(self, period: Fraction, grid: Grid) -> Floats:
        """The value in periods, less whole ones: exact to the last digits, however large it is."""
        if self.exact is None:
            turned = self.at / float(period)
        else:
            turned = cycles(self.exact, period, grid)
            if self.rest is not None:
                turned = turned + self.rest / float(period)
        return np.asarray(turned - np.rint(turned))

    @property
    def constant(self) -> Fraction | None:
        """The exact number that it is at all times, if it is one."""
        return self._factor

    @property
    def _factor(self) -> Fraction | None:
        return self.exact.constant if self.exact is not None and self.rest is None else None

    def _parts(self) -> tuple[Polynomial, Floats | None]:
        return (self.exact, self.rest) if self.exact else (Polynomial((Fraction(0),)), self.at)

    def _scaled(self, factor: Fraction, in_floats: Floats, at: Floats) -> "Value":
        exact = None if self.exact is None else self.exact.times(Polynomial((factor,)))
        if exact is None:
            return Value(at)
        return Value(at, exact, None if self.rest is None else self.rest * in_floats)


def _summed(one: Floats | None, two: Floats | None) -> Floats | None:
    if one is None or two is None:
        return one if two is None else two
    return one + two


def _exact_parts(value: Value) -> tuple[Polynomial | None, Floats | None]:
    return value.exact, value.rest
