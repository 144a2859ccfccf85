"""Drawn signals: strokes of a pen as samples, and signals limited to a band."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor

import numpy as np
import scipy

from skinsource.base.arguments import positive_number, real_number
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import BAND_HZ, Band
from skinsource.signals.generators import MAX_SAMPLES

# A stroke that ends this near to a sample, as a share of one, covers it.
_ON_SAMPLE = 1e-6
# Points of a stroke are at least this far apart.
_APART_S = 1e-9
_LEAST = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Bounded:
    """The part of a signal within a band.

    Attributes
    ----------
    samples : (n_times,)
        That part.
    removed
        Share of the energy outside the band, from 0 to 1.
    """

    samples: Floats
    removed: float


def bounded_to_band(samples: Floats, sample_rate_hz: float, band_hz: Band = BAND_HZ) -> Bounded:
    """Return the part of a signal within a band, without moving anything in time.

    Frequencies are those of the signal repeated after its own length: the result has the same
    length, and a second call changes nothing.

    Parameters
    ----------
    samples : (n_times,)
        The signal.
    sample_rate_hz
        Its rate.
    band_hz
        Lowest and highest frequency of the result.
    """
    low, high = band_hz
    if not samples.any():
        return Bounded(samples.copy(), 0.0)
    spectrum = scipy.fft.rfft(samples)
    frequency_hz = np.arange(spectrum.size) * sample_rate_hz / samples.size
    spectrum[(frequency_hz < low) | (frequency_hz > high)] = 0.0
    inside = np.asarray(scipy.fft.irfft(spectrum, samples.size), np.float64)
    # Without the division the squares of a tiny signal would underflow.
    peak = float(np.abs(samples).max())
    share = float(np.sum((inside / peak) ** 2) / np.sum((samples / peak) ** 2))
    return Bounded(inside, min(max(1.0 - share, 0.0), 1.0))


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
