"""Sums of the harmonics of a tone, at any phase.

What repeats and has edges is made from its Fourier series up to half the sample rate, so that
nothing aliases.  A sum over all harmonics at each sample would take minutes: 25 Hz at 48 kHz have
959 of them.  The sum and its derivatives are therefore computed on a grid over one turn, by
transforms, and each sample is the Taylor series about the nearest point of the grid.
"""

from collections.abc import Callable
from fractions import Fraction
from math import ceil, factorial, pi

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats
from skinsource.sampling.turns import turns

# Half a step of the grid is at most an eighth of a radian times pi of the highest harmonic.  What
# the series leaves out, (pi / 8)^13 / 13! of the sum of all amplitudes, is below 1e-15.
_POINTS_PER_HARMONIC = 8
_TERMS = 13
#: Samples at a time: their terms take less than a megabyte.
_BLOCK = 8192


def harmonics_below(limit_hz: float, frequency_hz: float) -> int:
    """How many whole multiples of a frequency lie below a limit.

    >>> harmonics_below(650.0, 50.0)
    12
    """
    return max(0, ceil(Fraction(limit_hz) / Fraction(frequency_hz)) - 1)


def sampled_series(
    series: Callable[[Floats], Complexes],
    frequency_hz: float,
    phase_rad: float,
    n: int,
    sample_rate_hz: float,
    shift_s: float = 0.0,
    *,
    mean: float = 0.0,
) -> Floats:
    """A Fourier series up to half the sample rate, at the first ``n`` instants of a recipe, (n,).

    Parameters
    ----------
    series
        Gives the complex coefficients of the harmonics 1, 2, 3, …, see `sum_of_harmonics`.
    frequency_hz, phase_rad
        Of the fundamental; below half the sample rate.
    mean
        What the series swings about.
    """
    count = harmonics_below(float(sample_rate_hz) / 2, frequency_hz)
    coefficients = np.concatenate(([mean], series(np.arange(1.0, count + 1.0))))
    phase = turns(frequency_hz, n, sample_rate_hz, shift_s)
    phase += phase_rad / (2.0 * pi)
    return sum_of_harmonics(coefficients, phase)


def sum_of_harmonics(coefficients: Complexes, turns: Floats) -> Floats:
    """Real part of the sum over h of coefficient h times exp(2 pi i h turn).

    Parameters
    ----------
    coefficients : (n_harmonics + 1,)
        Complex; the first, of the mean, has no imaginary part.
    turns : (n,)
        Phases, in turns.

    Returns
    -------
    sums : (n,)
        Wrong by no more than 1e-15 of the sum of all amplitudes, and by what the phases are.
    """
    table = _taylor_table(coefficients)
    n_points = table.shape[0]
    sums = np.empty(turns.shape)
    for start in range(0, turns.size, _BLOCK):
        part = slice(start, start + _BLOCK)
        # The points are a power of two: multiplying by it does not round.
        steps = turns[part] * n_points
        nearest = np.rint(steps)
        steps -= nearest
        terms = table[nearest.astype(np.int64) & (n_points - 1)]
        found = terms[:, -1].copy()
        for power in range(_TERMS - 2, -1, -1):
            found *= steps
            found += terms[:, power]
        sums[part] = found
    return sums


def _taylor_table(coefficients: Complexes) -> Floats:
    """Terms of the Taylor series about each point of the grid, in its steps, (n_points, 13)."""
    n_harmonics = coefficients.size - 1
    n_points = 1 << max(_POINTS_PER_HARMONIC * n_harmonics - 1, 1).bit_length()
    spectrum = np.zeros(n_points // 2 + 1, np.complex128)
    spectrum[: n_harmonics + 1] = coefficients * (n_points / 2)
    spectrum[0] *= 2.0
    derive = np.zeros_like(spectrum)
    derive[: n_harmonics + 1] = 2j * pi / n_points * np.arange(n_harmonics + 1)
    table = np.empty((n_points, _TERMS))
    for power in range(_TERMS):
        table[:, power] = scipy.fft.irfft(spectrum, n_points) / factorial(power)
        spectrum *= derive
    return table
