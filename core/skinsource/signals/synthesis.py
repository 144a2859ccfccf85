"""Parts of waveforms: phases of sweeps, windows, curves, harmonic series, strokes of a pen.

Phases are computed with 60 digits at the start of each block of samples, so that their error does
not grow with time.  A glide has frequency and amplitude at the same times; a curve of one of them
has only the points at which it bends.  What repeats and has edges is a Fourier series up to half
the sample rate, so that nothing aliases: the sum of the harmonics and its derivatives are computed
on a grid over one turn, by transforms, and a sample is the Taylor series about the nearest point.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import pairwise
from math import ceil, factorial, floor, pi
from typing import Literal

import numpy as np
import scipy

from skinsource.base.arguments import positive_number, real_number
from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.signals.generators import MAX_SAMPLES, WindowName, window_between
from skinsource.signals.sampling import turns

#: Digits of the phase at the start of each block; an hour has some ten of whole turns.
DIGITS = 60
_BLOCK, _SWEEP_BLOCK = 512, 256

Column = Literal["frequency", "amplitude"]
#: (time, value), times never falling; two at one time are a step.
Curve = tuple[tuple[float, float], ...]
#: (time, frequency, amplitude).
Points = tuple[tuple[float, float, float], ...]

_COLUMNS: dict[str, int] = {"frequency": 1, "amplitude": 2}
# A point lies on a line if it is this near to it, as a share of the larger value.
_STRAIGHT = 1e-12

# Half a step of the grid is at most an eighth of a radian times pi of the highest harmonic.  The
# rest of the Taylor series, (pi / 8)^13 / 13! of the sum of all amplitudes, is below 1e-15.
_POINTS_PER_HARMONIC = 8
_TERMS = 13
# Samples of which the terms take less than a megabyte.
_HARMONICS_BLOCK = 8192


def bent_turns(
    start: Decimal,
    frequency_hz: Decimal,
    slope_hz_per_s: Decimal,
    first: Decimal,
    n: int,
    sample_rate_hz: float,
) -> Floats:
    """Return the turns of a tone, (n,), without whole ones: start + f t + s t² / 2.

    The error is below 1e-13 while the frequency stays below half the sample rate.

    Parameters
    ----------
    start
        Turns at t = 0.
    frequency_hz, slope_hz_per_s
        f at t = 0, and s.
    first
        t of the first sample, in s; may be negative.
    """
    starts, steps = np.empty(ceil(n / _BLOCK)), np.empty(ceil(n / _BLOCK))
    with localcontext(prec=DIGITS):
        rate = Decimal(sample_rate_hz)
        bend = _less_whole(slope_hz_per_s / (2 * rate**2))
        for block in range(starts.size):
            time = first + block * _BLOCK / rate
            starts[block] = _less_whole(start + (frequency_hz + slope_hz_per_s / 2 * time) * time)
            steps[block] = _less_whole((frequency_hz + slope_hz_per_s * time) / rate)
    within = np.arange(min(n, _BLOCK))
    phases = np.multiply.outer(steps, within)
    # An integer times whole turns is a number of whole turns.
    phases += bend * np.square(within)
    phases += starts[:, np.newaxis]
    phases -= np.rint(phases)
    return phases.ravel()[:n]


def _less_whole(turns: Decimal) -> float:
    """Return turns without the nearest integer."""
    return float(turns - turns.to_integral_value())


def burst(samples: Floats, window: WindowName, sample_rate_hz: float, shift_s: float) -> Floats:
    """Window ``samples`` of an endless signal in place, and return them, (n_times,).

    Parameters
    ----------
    samples : (n_times,)
        From the instant -``shift_s`` on; with a shift one more than the burst has.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``; the burst starts and ends with the window.
    """
    if window != "none" or shift_s:
        shift = shift_s * sample_rate_hz
        samples *= window_between(window, samples.size - (shift_s > 0.0), shift)
    return samples


def check_below_half_rate(name: str, frequency_hz: float, sample_rate_hz: float) -> None:
    """Raise an error if samples of this rate cannot represent a frequency.

    Raises
    ------
    InvalidInputError
        It is at or above half the sample rate.
    """
    half_hz = positive_number("sample_rate_hz", sample_rate_hz) / 2
    if frequency_hz >= half_hz:
        raise InvalidInputError(
            f"{name} is {frequency_hz:g}, expected less than {half_hz:g} Hz (half the sample rate "
            f"of {sample_rate_hz:g} Hz); it would alias"
        )


def about_middle(n: int, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
    """Return times from the middle of ``n`` samples, in s, (n_times,).

    (k - (n - 1) / 2) / rate, less the shift; with one, there is one sample more.
    """
    position: Floats = np.arange(n + (shift_s > 0.0)) - np.float64((n - 1) / 2)
    return position / sample_rate_hz - shift_s


def turns_about_middle(
    frequency_hz: float, n: int, sample_rate_hz: float, shift_s: float = 0.0
) -> Floats:
    """Return the turns of a tone at the times `about_middle`, (n_times,), less whole ones."""
    phases = turns(frequency_hz, n + (shift_s > 0.0), sample_rate_hz, shift_s)
    until_middle = Fraction(frequency_hz) * (n - 1) / (2 * Fraction(sample_rate_hz))
    phases -= float(until_middle % 1)
    return phases


def silent_before_start(samples: Floats, shift_s: float) -> Floats:
    """Set the first sample of a shifted waveform, which lies before its start, to 0, in place."""
    if shift_s > 0.0:
        samples[:1] = 0.0
    return samples


def curve_of(points: Points, column: Column) -> Curve:
    """Return the points at which the frequency, or the amplitude, bends; and both ends.

    >>> curve_of(((0.0, 50.0, 0.0), (0.1, 60.0, 1.0), (0.2, 70.0, 1.0)), "frequency")
    ((0.0, 50.0), (0.2, 70.0))
    """
    index = _COLUMNS[column]
    return bends_of(tuple((point[0], point[index]) for point in points))


def bends_of(curve: Curve) -> Curve:
    """Return the curve without the points that lie on the line between their neighbours."""
    bends = list(curve[:1])
    for here, after in pairwise(curve[1:]):
        if not _is_between(bends[-1], here, after):
            bends.append(here)
    return (*bends, *curve[-1:]) if len(curve) > 1 else curve


def with_curve(points: Points, column: Column, curve: Curve) -> Points:
    """Return the points of a glide with another curve of frequency, or of amplitude.

    The glide ends with that curve: the other one is cut there, or held until then.

    Raises
    ------
    InvalidInputError
        The curve has no points.
    """
    if not curve:
        raise InvalidInputError(f"the curve of {column} is empty, expected two points or more")
    other: Column = "amplitude" if column == "frequency" else "frequency"
    other_curve = curve_of(points, other)
    end_s = curve[-1][0]
    times = sorted({point[0] for point in (*curve, *other_curve) if point[0] <= end_s})
    new_points = []
    for time_s in times:
        both = zip(_around(curve, time_s), _around(other_curve, time_s), strict=True)
        values = [(a, b) if column == "frequency" else (b, a) for a, b in both]
        new_points += [(time_s, *pair) for pair in dict.fromkeys(values)]
    return tuple(new_points)


def _around(curve: Curve, time_s: float) -> tuple[float, float]:
    """Return the values of a curve just before a time, and from it on."""
    first = bisect_left(curve, time_s, key=_time)
    after = bisect_right(curve, time_s, key=_time)
    if first < after:
        return curve[first][1], curve[after - 1][1]
    if first in (0, len(curve)):
        held = curve[max(first - 1, 0)][1]
        return held, held
    (start_s, low), (end_s, high) = curve[first - 1], curve[first]
    value = low + (high - low) * ((time_s - start_s) / (end_s - start_s))
    return value, value


def _time(point: tuple[float, float]) -> float:
    return point[0]


def _is_between(
    before: tuple[float, float], here: tuple[float, float], after: tuple[float, float]
) -> bool:
    """Whether ``here`` lies on the line from ``before`` to ``after``."""
    if not before[0] < here[0] < after[0]:
        return before == here or here == after
    part = (here[0] - before[0]) / (after[0] - before[0])
    line = before[1] + (after[1] - before[1]) * part
    return abs(here[1] - line) <= _STRAIGHT * max(abs(before[1]), abs(after[1]), abs(here[1]))


def harmonics_below(limit_hz: float, frequency_hz: float) -> int:
    """Return how many multiples of a frequency lie below a limit.

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
    """Return a Fourier series up to half the sample rate, at ``n`` instants, (n,).

    Parameters
    ----------
    series
        Returns the complex coefficients of the harmonics 1, 2, 3, …, see `sum_of_harmonics`.
    frequency_hz, phase_rad
        Of the fundamental; below half the sample rate.
    mean
        Mean of the series.
    """
    count = harmonics_below(float(sample_rate_hz) / 2, frequency_hz)
    coefficients = np.concatenate(([mean], series(np.arange(1.0, count + 1.0))))
    phase = turns(frequency_hz, n, sample_rate_hz, shift_s)
    phase += phase_rad / (2.0 * pi)
    return sum_of_harmonics(coefficients, phase)


def sum_of_harmonics(coefficients: Complexes, turns: Floats) -> Floats:
    """Return the real part of the sum over h of coefficient h times exp(2 pi i h turn).

    Parameters
    ----------
    coefficients : (n_harmonics + 1,)
        Complex; the first, of the mean, has no imaginary part.
    turns : (n,)
        Phases, in turns.

    Returns
    -------
    sums : (n,)
        The error is at most 1e-15 of the sum of all amplitudes, plus that of the phases.
    """
    table = _taylor_table(coefficients)
    n_points = table.shape[0]
    sums = np.empty(turns.shape)
    for start in range(0, turns.size, _HARMONICS_BLOCK):
        part = slice(start, start + _HARMONICS_BLOCK)
        # The points are a power of two: multiplying by it does not round.
        steps = turns[part] * n_points
        nearest = np.rint(steps)
        steps -= nearest
        terms = table[nearest.astype(np.int64) & (n_points - 1)]
        part_sums = terms[:, -1].copy()
        for power in range(_TERMS - 2, -1, -1):
            part_sums *= steps
            part_sums += terms[:, power]
        sums[part] = part_sums
    return sums


def _taylor_table(coefficients: Complexes) -> Floats:
    """Return the Taylor series about each point of the grid, in its steps, (n_points, 13)."""
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


def linear_sweep_turns(
    ends_hz: tuple[float, float],
    duration_s: float,
    n: int,
    sample_rate_hz: float,
    shift_s: float = 0.0,
) -> Floats:
    """Return the turns of a tone that changes by equal steps in equal times, less whole ones.

    They are the integral of f0 + (f1 - f0) t / T, (n,), with an error below 1e-13 turns.
    """
    low_hz, high_hz = map(Decimal, ends_hz)
    with localcontext(prec=DIGITS):
        slope = (high_hz - low_hz) / Decimal(duration_s)
    shift = Decimal(float(shift_s))
    return bent_turns(Decimal(0), low_hz, slope, -shift, n, float(sample_rate_hz))


def logarithmic_sweep_turns(
    ends_hz: tuple[float, float],
    duration_s: float,
    n: int,
    sample_rate_hz: float,
    shift_s: float = 0.0,
) -> Floats:
    """Return the turns of a tone that changes by equal factors in equal times, less whole ones.

    They are the integral of f0 (f1 / f0)^(t / T), (n,), as exact as `linear_sweep_turns`.  The two
    frequencies must differ.
    """
    low_hz, high_hz = map(Decimal, ends_hz)
    n_blocks = ceil(n / _SWEEP_BLOCK)
    starts, steps = np.empty((n_blocks, 1)), np.empty((n_blocks, 1))
    with localcontext(prec=DIGITS):
        rate = Decimal(float(sample_rate_hz))
        growth = (high_hz / low_hz).ln() / Decimal(duration_s)
        factor = (growth / rate * _SWEEP_BLOCK).exp()
        frequency = low_hz * (-growth * Decimal(float(shift_s))).exp()
        for block in range(n_blocks):
            starts[block] = float((frequency - low_hz) / growth % 1)
            steps[block] = float(frequency / rate)
            frequency *= factor
    within = np.arange(_SWEEP_BLOCK, dtype=np.float64)
    exponent = float(growth / rate) * within
    within[1:] *= np.expm1(exponent[1:]) / exponent[1:]
    phases = steps * within + starts
    phases -= np.rint(phases)
    return phases.ravel()[:n]


# A stroke that ends this near to a sample, as a share of one, covers it.
_ON_SAMPLE = 1e-6
# Points of a stroke are at least this far apart.
_APART_S = 1e-9
_LEAST = 1e-12


@dataclass(frozen=True, slots=True)
class Stroke:
    """The points of a stroke of a pen, rising in time.

    Where the pen moves back, it replaces what it drew before: a signal has one value at a time.

    Attributes
    ----------
    points
        (time in s, value), times rising.
    """

    points: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        times = [time for time, _ in self.points]
        if any(after <= before for before, after in pairwise(times)):
            raise InvalidInputError(f"times of a stroke are {times[:10]}, expected rising ones")

    @classmethod
    def through(cls, pen: Iterable[tuple[float, float]]) -> "Stroke":
        """Return the stroke of a pen through these points, (time in s, value), in this order."""
        stroke, last = cls(), None
        for time_s, value in pen:
            stroke = stroke.to(time_s, value, last)
            last = time_s
        return stroke

    def to(self, time_s: float, value: float, came_from_s: float | None = None) -> "Stroke":
        """Return the stroke after a move of the pen to another point.

        Parameters
        ----------
        time_s, value
            The point; negative times become 0.
        came_from_s
            Previous time of the pen: points between both times are replaced.
        """
        time_s = max(real_number("time_s", time_s), 0.0)
        value = real_number("value", value)
        # Smaller values are invisible, and their slopes would overflow.
        value = value if abs(value) > _LEAST else 0.0
        came_from_s = time_s if came_from_s is None else max(came_from_s, 0.0)
        times = [time for time, _ in self.points]
        # The previous point stays, and so does everything outside.
        if time_s >= came_from_s:
            low = min(bisect_right(times, came_from_s), bisect_left(times, time_s - _APART_S))
            high = bisect_right(times, time_s + _APART_S)
        else:
            low = bisect_left(times, time_s - _APART_S)
            high = max(bisect_left(times, came_from_s), bisect_right(times, time_s + _APART_S))
        return Stroke((*self.points[:low], (time_s, value), *self.points[high:]))

    @property
    def span_s(self) -> tuple[float, float]:
        """Times of the first and the last point."""
        if not self.points:
            raise InvalidInputError("the stroke has no points; draw one first")
        return (self.points[0][0], self.points[-1][0])

    def samples(self, sample_rate_hz: float) -> tuple[int, Floats]:
        """Return the number of the first sample that it covers, and its samples, (n_times,).

        They follow a smooth curve through the points without overshoot (piecewise cubic, Fritsch
        and Carlson 1980).
        """
        rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
        start_s, end_s = self.span_s
        first = ceil(start_s * rate_hz - _ON_SAMPLE)
        last = floor(end_s * rate_hz + _ON_SAMPLE)
        if last > MAX_SAMPLES:
            raise InvalidInputError(
                f"the stroke ends at {end_s:g} s: {last} samples, expected at most {MAX_SAMPLES}"
            )
        times, values = (np.array(column) for column in zip(*self.points, strict=True))
        if last < first or times.size == 1:
            # A stroke between two samples moves the nearer one.
            nearest = round((start_s + end_s) / 2 * rate_hz)
            return nearest, np.array([values[-1]])
        instants = np.clip(np.arange(first, last + 1) / rate_hz, start_s, end_s)
        curve = np.asarray(scipy.interpolate.PchipInterpolator(times, values)(instants), np.float64)
        # Rounding may exceed the points in the last digit.
        return first, np.clip(curve, values.min(), values.max())


def drawn_over(samples: Floats, stroke: Stroke, sample_rate_hz: float) -> Floats:
    """Return ``samples``, (n_times,), with the samples that a stroke covers replaced.

    A stroke after the last sample extends them, with silence between both.
    """
    first, values = stroke.samples(sample_rate_hz)
    drawn = np.zeros(max(samples.size, first + values.size))
    drawn[: samples.size] = samples
    drawn[first : first + values.size] = values
    return drawn


def zeroed(samples: Floats, start_s: float, end_s: float, sample_rate_hz: float) -> Floats:
    """Return ``samples``, (n_times,), with 0 from ``start_s`` to ``end_s``."""
    low, high = sorted((real_number("start_s", start_s), real_number("end_s", end_s)))
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    zeroed_samples = samples.copy()
    first = max(ceil(low * rate_hz - _ON_SAMPLE), 0)
    zeroed_samples[first : max(floor(high * rate_hz + _ON_SAMPLE) + 1, first)] = 0.0
    return zeroed_samples
