"""Resampling by a Kaiser-windowed polyphase filter of 140 dB, and points between samples.

The lower of the two rates decides the band.  Half of it is the middle of the transition: below
12/13 of that half (600 Hz where the lower rate is 1300 Hz) all passes, above 14/13 of it (700 Hz)
nothing does, and what lies between may fold back, but only above the pass band.  Lower rates from
1200 to 1300 Hz get a steeper filter, so that 600 Hz still passes; at 1210 Hz it is ten times as
long, and it gets no steeper than that.  The pass band depends on the two rates, not on a limb: the
measured band of any limb lies below half its own rate.

Extremes of waves that are drawn are computed with a shorter filter, which is quick enough for every
edit: up to 12/13 of half the rate it errs by at most 0.2 % of an amplitude, and points an eighth of
a sample apart miss a peak by at most 1.7 %.  Peaks whose numbers are said are looked for around the
highest of these extremes, with the long filter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, lru_cache
from math import ceil

import numpy as np
import scipy
from numpy.lib.stride_tricks import as_strided, sliding_window_view
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import integer, real_array
from skinsource.base.conventions import BAND_HZ, Floats, Indices
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, never, stop_if
from skinsource.signals.generators import MAX_SAMPLES

_STOP_BAND_DB = 140.0
_BETA = 0.1102 * (_STOP_BAND_DB - 8.7)
# Half the transition, as a share of half the lower rate.
_WIDEST, _NARROWEST = 1.0 / 13.0, 1.0 / 130.0
#: The share of half the lower rate that passes for any two rates.
PASSED_SHARE = 1.0 - _WIDEST
# Longest half of a filter that is cached: to compute it takes longer than to use it.
_LONGEST_CACHED = 2**18
# Most values of a matrix of weights; larger ones cost more than they save.
_LARGEST_MATRIX = 2**19
# Least results of a product; short periods of the rates are multiplied by several at once.
_LEAST_IN_PERIOD = 16
# Values that are computed at once.
_BLOCK = 2**18
# Longest filter that is computed as a whole; of longer ones only the weights that are used.
_LONGEST_FILTER = 2**25
# Groups of periods in one product, always the same number: the bits of a result then do not depend
# on which others are computed.  For so few the linear algebra library starts no threads.
_BATCH = 4

# Most weights that are computed one by one: some minutes.
_MOST_WEIGHTS = 2 * 10**9
# Largest numerator and denominator of a ratio: positions of all samples are then whole numbers of
# 64 bits.
_LARGEST_TERM = 2**36

#: The highest sample rate.
MAX_RATE_HZ = 10_000_000
#: Points for each sample of a drawn signal: a wave at the end of the band has more than thirty.
FINER = 8
#: The largest error of the extremes of a wave, as a share of its amplitude.
EXTREMES_ERROR = 0.02

# Samples on either side of a drawn point that it is made of, and the shape of their Kaiser window.
_REACH, _EXTREMES_BETA = 24, 5.7
# Samples whose points are one product, and the number of those products at once: for so few the
# linear algebra library starts no threads, which would cost more than they save.
_STRETCH, _EXTREMES_BATCH = 32, 12
# Samples of all signals in a block: its points stay in the processor's cache.
_EXTREMES_BLOCK = 2**15
# Samples of a curve whose extremes are remembered.
_MOST_REMEMBERED = 2**16
# Smaller values, relative to the peak, count as silence: the smallest floats are slow.
_SILENT = 1e-9

# Samples of the filter in each sample at the lower rate, and points of its response.
_RESPONSE_FINER, _POINTS = 8, 2**17
# Duration of the ringing: periods of the lower rate, over half its transition; samples at most.
_RINGS, _LONGEST_RING = 5.0, 2**21

# Places where the peak of a wave is looked for, and points for each sample there.
_TRIED, _PEAK_FINER = 16, 16

Singles = NDArray[np.float32]


class Kernel:
    """The filter on the grid of the common multiple of both rates.

    Attributes
    ----------
    half_length
        Its last sample on either side of the middle.
    reach, n_used
        Samples on either side of a result that it is made of; samples that a group of periods of
        the results is made of.
    periods
        Number of periods in a group.
    """

    def __init__(self, up: int, down: int, half_transition: float) -> None:
        self.up, self.down, self._half_transition = up, down, half_transition
        self._slower = max(up, down)
        # Kaiser's formula.
        width = 2.0 * half_transition * np.pi / self._slower
        self.half_length = ceil((_STOP_BAND_DB - 7.95) / (2.285 * width) / 2.0)
        self.reach = -(-self.half_length // up)
        # Several periods share the samples that they reach.
        self.periods = min(-(-_LEAST_IN_PERIOD // up), max((2 * self.reach + 1) // down, 1))
        self.n_used = self.periods * down + 2 * self.reach + 1

    @property
    def is_small(self) -> bool:
        """Whether the weights of a group fit in a small matrix without many zeros."""
        filled = self.periods * self.down <= 2 * (2 * self.reach + 1)
        return filled and self.periods * self.up * self.n_used <= _LARGEST_MATRIX

    def at(self, position: Indices) -> Floats:
        """Return the filter ``position`` samples off its middle; the sum of a phase is nearly 1."""
        within = np.clip(1.0 - (position / self.half_length) ** 2, 0.0, None)
        taper = np.i0(_BETA * np.sqrt(within)) / np.i0(_BETA)
        ideal = np.sinc(position / self._slower) * min(1.0, self.up / self.down)
        return np.where(np.abs(position) <= self.half_length, ideal * taper, 0.0)

    def taps(self) -> Floats:
        """Return the whole filter, (2 half_length + 1,), from a cache unless it is long."""
        if self.half_length <= _LONGEST_CACHED:
            return _cached_taps(self.up, self.down, self._half_transition)
        return self.computed_taps()

    def computed_taps(self) -> Floats:
        """Compute the whole filter, (2 half_length + 1,)."""
        taps = np.empty(2 * self.half_length + 1)
        for start, end in blocks(taps.size, _BLOCK):
            taps[start:end] = self.at(np.arange(start, end) - self.half_length)
        return taps

    def weights(self) -> Floats:
        """Return the weights of the results of a group, (n_used, periods up), from a cache."""
        return _cached_weights(self.up, self.down, self._half_transition)


@lru_cache(maxsize=4)
def _cached_taps(up: int, down: int, half_transition: float) -> Floats:
    taps = Kernel(up, down, half_transition).computed_taps()
    taps.flags.writeable = False
    return taps


@lru_cache(maxsize=4)
def _cached_weights(up: int, down: int, half_transition: float) -> Floats:
    kernel = Kernel(up, down, half_transition)
    used = np.arange(kernel.n_used)[:, np.newaxis] - kernel.reach
    position = np.arange(kernel.periods * up) * down - used * up
    weights = np.where(
        np.abs(position) <= kernel.half_length,
        kernel.taps()[np.clip(position + kernel.half_length, 0, 2 * kernel.half_length)],
        0.0,
    )
    weights.flags.writeable = False
    return weights


def half_transition(lower_hz: float) -> float:
    """Return half the transition, as a share of half the lower rate.

    It does not depend on the limb: 600 Hz passes at rates from 1200 to 1300 Hz too.
    """
    if lower_hz <= 2.0 * BAND_HZ[1]:
        return _WIDEST
    return min(max(1.0 - 2.0 * BAND_HZ[1] / lower_hz, _NARROWEST), _WIDEST)


def blocks(n: int, step: int) -> Iterator[tuple[int, int]]:
    """Give start and end of each block of ``step`` out of ``n``; the last may be shorter."""
    for start in range(0, n, step):
        yield start, min(start + step, n)


def resample(samples: ArrayLike, from_hz: int, to_hz: int) -> Floats:
    """Return a signal at another sample rate.

    Sample k of the result is the band-limited signal at time k / ``to_hz``, so nothing is
    delayed.  The signal is silent before its first and after its last sample: where it is cut
    off hard, the first and last 0.1 s ring, as with any method.

    Parameters
    ----------
    samples : (..., n_times)
        Finite real numbers; a kind smaller than float64 is converted block by block.
    from_hz, to_hz
        Rates, whole numbers of hertz from 1 to 1e7.  From 25 Hz to 600 Hz, or to 12/13 of half the
        lower rate if that is less, the gain is 1 within 0.001 dB, the phase 0 within 1e-6 rad, and
        aliases stay below -115 dB.

    Returns
    -------
    (..., ceil(n_times to_hz / from_hz))
        The same bits where the rates are equal.

    Raises
    ------
    InvalidInputError
        A rate is not a whole number, a sample is not finite, the result would be too long, or it
        would take minutes.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.resample(ss.sinusoid(100.0, 0.2), 1300, 48000).shape)
    (9600,)
    """
    rates = [
        integer(name, rate, 1, MAX_RATE_HZ)
        for name, rate in (("from_hz", from_hz), ("to_hz", to_hz))
    ]
    return by_ratio(samples, Fraction(rates[1], rates[0]), min(rates))


def by_ratio(
    samples: ArrayLike, ratio: Fraction, lower_hz: float, *, offset: float = 0.0
) -> Floats:
    """Return a signal with ``ratio`` times as many samples a second, as `resample` does.

    Parameters
    ----------
    samples : (..., n_times)
        Finite real numbers.
    ratio
        New rate over old.
    lower_hz
        The lower of the two rates: it decides how steep the filter is.
    offset
        Subtracted from each sample first, without a copy of all of them.
    """
    source = _Signals(_array(samples), offset)
    up, down = ratio.numerator, ratio.denominator
    n = -(-source.shape[-1] * up // down)
    if n > MAX_SAMPLES:
        raise InvalidInputError(
            f"{source.shape[-1]} samples become {n}, expected at most {MAX_SAMPLES}; take a part"
        )
    result = np.empty((*source.shape[:-1], n))
    if ratio == 1:
        for start, end in blocks(n, _steps_in_block(source.shape, 1)):
            result[..., start:end] = source.part(start, end)
        return result
    up, down = _shortened(ratio)
    kernel = Kernel(up, down, half_transition(lower_hz))
    length = 2 * kernel.half_length
    if kernel.is_small:
        _fill_by_matrix(source, kernel, result)
    elif length < min(n * (length // up + 1), _LONGEST_FILTER):
        _fill_by_filter(source, kernel, result)
    else:
        _fill_by_sums(source, kernel, result)
    return result


def _shortened(ratio: Fraction) -> tuple[int, int]:
    """Return numerator and denominator of a ratio, or of the nearest with smaller ones.

    Over 10 million samples that moves the last one by less than 1e-3 of a sample.
    """
    if max(ratio.numerator, ratio.denominator) <= _LARGEST_TERM:
        return ratio.numerator, ratio.denominator
    if ratio < 1:
        down, up = _shortened(1 / ratio)
        return up, down
    near = ratio.limit_denominator(max(int(_LARGEST_TERM / ratio), 1))
    return near.numerator, near.denominator


class _Signals:
    """Signals to resample, which it returns part by part as float64."""

    def __init__(self, samples: np.ndarray, offset: float) -> None:
        self._samples, self._offset = samples, offset
        self.shape = samples.shape

    def part(self, start: int, end: int) -> Floats:
        """Return samples ``start`` to ``end``; raise an error where one is not finite."""
        part = np.asarray(self._samples[..., start:end], np.float64)
        if not np.isfinite(part).all():
            position = np.argwhere(~np.isfinite(part))[0]
            position[-1] += start
            index = tuple(int(k) for k in position)
            raise InvalidInputError(
                f"samples is {self._samples[index]} at index {index}, expected finite real numbers"
            )
        return part - self._offset if self._offset else part


def _fill_by_matrix(samples: _Signals, kernel: Kernel, result: Floats) -> None:
    """Fill ``result`` with products of a matrix: all groups of periods have the same weights."""
    weights, reach = kernel.weights(), kernel.reach
    n_in, n_out = kernel.periods * kernel.down, kernel.periods * kernel.up
    step = _BATCH * max(_steps_in_block(samples.shape, _BATCH * (n_in + n_out)), 1)
    used = np.empty((_BATCH, kernel.n_used))
    for start, end in blocks(-(-result.shape[-1] // n_out), step):
        n_periods = -(-(end - start) // _BATCH) * _BATCH
        first, last = start * n_in - reach, (start + n_periods) * n_in + reach + 1
        inside = min(max(first, 0), samples.shape[-1]), min(last, samples.shape[-1])
        part = np.zeros((*samples.shape[:-1], last - first))
        part[..., inside[0] - first : inside[1] - first] = samples.part(*inside)
        out = result[..., start * n_out : end * n_out]
        for signal in np.ndindex(samples.shape[:-1]):
            windows = sliding_window_view(part[signal], kernel.n_used)[::n_in]
            for k in range(0, n_periods, _BATCH):
                np.copyto(used, windows[k : k + _BATCH])
                target = out[signal][k * n_out : (k + _BATCH) * n_out]
                target[:] = (used @ weights).ravel()[: target.size]


def _fill_by_filter(samples: _Signals, kernel: Kernel, result: Floats) -> None:
    """Fill ``result`` block by block with one filter for all."""
    up, down, half = kernel.up, kernel.down, kernel.half_length
    # Blocks are whole periods of both rates, so that all of them begin at the same tap.
    periods = max(_steps_in_block(samples.shape, up + down), 1)
    reach = -(-half // up)
    lead = -(-reach // down) * down
    taps = np.concatenate((np.zeros(-half % down), kernel.taps()))
    skipped = lead * up // down + (half + -half % down) // down
    for block, (start, end) in enumerate(blocks(result.shape[-1], periods * up)):
        first = block * periods * down
        last = min(-(-end * down // up) + reach + 1, samples.shape[-1])
        before = min(lead, first)
        missing = (lead - before) * up // down
        part = samples.part(first - before, max(last, first - before))
        filtered = scipy.signal.upfirdn(taps, part, up, down, axis=-1) if part.size else part
        values = filtered[..., skipped - missing : skipped - missing + end - start]
        result[..., start : start + values.shape[-1]] = values
        result[..., start + values.shape[-1] : end] = 0.0


def _fill_by_sums(samples: _Signals, kernel: Kernel, result: Floats) -> None:
    """Fill ``result`` with sums whose weights are computed one by one."""
    up, down, half = kernel.up, kernel.down, kernel.half_length
    n_in, n_out = samples.shape[-1], result.shape[-1]
    n_taps = 2 * (half // up) + 3
    # All samples of a signal that is shorter than the filter.
    width = min(n_taps, n_in)
    if n_out * width > _MOST_WEIGHTS:
        raise InvalidInputError(
            f"to resample {n_in} samples to {n_out} takes {n_out * width:.1e} steps, expected at "
            f"most {_MOST_WEIGHTS:.0e}. Take a part, or go through a rate between the two."
        )
    for start, end in blocks(n_out, max(_steps_in_block(samples.shape, 1) // max(width, 1), 1)):
        position = np.arange(start, end, dtype=np.int64) * down
        begin = position // up - n_taps // 2 if width < n_in else np.zeros_like(position)
        result[..., start:end] = 0.0
        for tap, last_tap in blocks(width, _BLOCK):
            index = begin[:, np.newaxis] + np.arange(tap, last_tap)
            first, last = max(int(index[0, 0]), 0), min(int(index[-1, -1]) + 1, n_in)
            part = samples.part(first, max(last, first))
            if part.shape[-1]:
                weights = kernel.at(position[:, np.newaxis] - index * up)
                weights[(index < 0) | (index >= n_in)] = 0.0
                gathered = part[..., np.clip(index - first, 0, part.shape[-1] - 1)]
                result[..., start:end] += np.einsum("...kt,kt->...k", gathered, weights)


def _array(samples: ArrayLike) -> np.ndarray:
    if isinstance(samples, np.ndarray) and samples.dtype.kind in "iuf" and samples.ndim:
        array = samples
    else:
        array = real_array("samples", samples, "finite real numbers, (..., n_times)")
    if not array.ndim:
        raise InvalidInputError("samples is a single number, expected (..., n_times)")
    return array


def _steps_in_block(shape: tuple[int, ...], per_step: int) -> int:
    """Return how many steps of ``per_step`` values for each signal make a block."""
    signals = int(np.prod(shape[:-1], dtype=np.int64))
    return max(_BLOCK // max(signals * per_step, 1), 1)


def finer(
    time_s: Floats, signals: Floats, first: int = 0, end: int | None = None
) -> tuple[Floats, Floats]:
    """Return instants and band-limited signals with `FINER` points for each sample.

    Straight lines between samples cut off the peaks of a wave that has four samples a period.

    Parameters
    ----------
    time_s : (n_times,)
        Equally spaced.
    signals : (..., n_times)
        Silent before and after.
    first, end
        Only samples from ``first`` to before ``end``, by default all; fewer than two are returned
        as they are.  The samples around them contribute to the points.

    Returns
    -------
    (n_points,) and (..., n_points), from the first sample to the last; samples keep their values
    within 1e-6 of the peak.
    """
    end = time_s.size if end is None else end
    n = end - first
    if n < 2:
        return time_s[first:end], signals[..., first:end]
    step_s = float(time_s[-1] - time_s[0]) / (time_s.size - 1)
    reach = Kernel(FINER, 1, half_transition(1.0 / step_s)).reach
    before = min(first, reach)
    dense = by_ratio(signals[..., first - before : end + reach], Fraction(FINER), 1.0 / step_s)
    n_points = (n - 1) * FINER + 1
    skipped = before * FINER
    instants = time_s[first] + np.arange(n_points) * (step_s / FINER)
    return instants, dense[..., skipped : skipped + n_points]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Extremes:
    """Lowest and highest value of waves from each sample to before the next one.

    Attributes
    ----------
    low, high : (n_curves, n_times)
        Relative to ``sizes``; 7 digits are enough for drawing.
    sizes : (n_curves, 1)
        The peak of the samples of each curve, or 1.
    """

    low: Singles
    high: Singles
    sizes: Floats

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest value of all curves; zeros if there are none."""
        if not self.low.size:
            return 0.0, 0.0
        low = self.low.min(axis=1, keepdims=True) * self.sizes
        high = self.high.max(axis=1, keepdims=True) * self.sizes
        return float(low.min()), float(high.max())

    def part(self, first: int, end: int) -> Extremes:
        """Return the extremes from one sample to before another."""
        return replace(self, low=self.low[:, first:end], high=self.high[:, first:end])

    def of_first(self, n_curves: int) -> Extremes:
        """Return the extremes of the first curves."""
        return Extremes(
            low=self.low[:n_curves], high=self.high[:n_curves], sizes=self.sizes[:n_curves]
        )

    def relative_to(self, sizes: Floats) -> Extremes:
        """Return the extremes of the curves divided by ``sizes``, (n_curves, 1)."""
        return replace(self, sizes=self.sizes / sizes)

    def of_columns(self, starts: Indices) -> tuple[Floats, Floats]:
        """Return the lowest and highest value of each column, (n_curves, n_columns) each.

        Parameters
        ----------
        starts : (n_columns,)
            The first sample of each column; rising.
        """
        low = np.minimum.reduceat(self.low, starts, axis=1) * self.sizes
        high = np.maximum.reduceat(self.high, starts, axis=1) * self.sizes
        return low, high


def extremes_between(
    signals: Floats, first: int = 0, end: int | None = None, *, stop: Stop = never
) -> Extremes:
    """Return extremes of waves, within `EXTREMES_ERROR` of the amplitude in the pass band.

    Samples alone do not tell them: those of a tone of a quarter of the rate can all miss its peak
    by 3 dB.

    Parameters
    ----------
    signals : (n_curves, n_times) or (n_curves, n_axes, n_times)
        Equally spaced samples, silent before and after; with several axes the wave is the length
        of the vector.
    first, end
        Only samples from ``first`` to before ``end``, by default all.  The samples around them
        contribute.
    stop
        Called before each block.
    """
    end = signals.shape[-1] if end is None else end
    if len(signals) == 1 and signals.size <= _MOST_REMEMBERED:
        return _last_extremes(signals.tobytes(), signals.shape, first, end)
    return _extremes(signals, first, end, stop)


# What an input plays is often its only clip: its peak is shown, and the curve drawn twice.
@lru_cache(maxsize=1)
def _last_extremes(samples: bytes, shape: tuple[int, ...], first: int, end: int) -> Extremes:
    return _extremes(np.frombuffer(samples).reshape(shape), first, end)


def _extremes(signals: Floats, first: int, end: int, stop: Stop = never) -> Extremes:
    vectors = signals if signals.ndim == 3 else signals[:, np.newaxis]
    n_curves, n_axes, n_times = vectors.shape
    around = max(first - _REACH, 0), min(end + _REACH, n_times)
    sizes = _sizes(vectors[..., slice(*around)])
    extremes = Extremes(
        low=np.empty((n_curves, end - first), np.float32),
        high=np.empty((n_curves, end - first), np.float32),
        sizes=sizes[:, 0],
    )
    step = max(_EXTREMES_BLOCK // max(n_curves * n_axes * _STRETCH, 1), 1) * _STRETCH
    for start, last in blocks(end - first, step):
        stop_if(stop)
        samples = _scaled_samples(vectors, sizes, first + start, first + last)
        low, high = extremes.low[:, start:last], extremes.high[:, start:last]
        _find_extremes(samples, low, high, length=signals.ndim == 3)
    if n_curves and end == n_times and end > first:
        # The last sample has no next one.
        only = vectors[..., -1] / sizes[:, :, 0]
        only = np.sqrt(np.square(only).sum(axis=1)) if signals.ndim == 3 else only[:, 0]
        extremes.low[:, -1] = extremes.high[:, -1] = only
    extremes.low.flags.writeable = extremes.high.flags.writeable = False
    return extremes


def peaks_between(
    signals: Floats, first: int = 0, end: int | None = None, *, stop: Stop = never
) -> Floats:
    """Return the largest magnitude of waves between their samples too, (n_curves,).

    That of a tone up to 12/13 of half the rate is right within 0.04 dB, whatever its phase.

    Parameters
    ----------
    signals, first, end, stop
        As of `extremes_between`.

    Examples
    --------
    >>> import numpy as np
    >>> tone = np.hanning(1300) * np.sin(np.pi * (np.arange(1300) / 2 + 0.25))  # 325 Hz
    >>> print(f"{abs(tone).max():.3f}, {peaks_between(tone[np.newaxis])[0]:.3f}")
    0.707, 1.000
    """
    vectors = signals if signals.ndim == 3 else signals[:, np.newaxis]
    extremes = extremes_between(signals, first, end, stop=stop)
    kernel = Kernel(_PEAK_FINER, 1, _WIDEST)
    peaks = np.zeros(len(vectors))
    for row, (vector, size) in enumerate(zip(vectors, extremes.sizes[:, 0], strict=True)):
        highest = np.maximum(extremes.high[row], -extremes.low[row])
        n_tried = min(_TRIED, highest.size)
        places = np.argpartition(highest, -n_tried)[-n_tried:]
        used = first + places[:, np.newaxis] + np.arange(kernel.n_used) - kernel.reach
        inside = (used >= 0) & (used < vector.shape[-1])
        samples = np.where(inside, vector[:, np.where(inside, used, 0)] / size, 0.0)
        points = np.sqrt(np.square(samples @ kernel.weights()).sum(axis=0))
        peaks[row] = size * points.max(initial=0.0)
    return peaks


def _sizes(vectors: Floats) -> Floats:
    """Return the peak of each curve, (n_curves, 1, 1); 1 where it is silent."""
    if not vectors.size:
        return np.ones((len(vectors), 1, 1))
    each = (1, 2)
    peaks = np.maximum(
        vectors.max(axis=each, keepdims=True), -vectors.min(axis=each, keepdims=True)
    )
    return np.where(peaks > 0.0, peaks, 1.0)


def _scaled_samples(vectors: Floats, sizes: Floats, first: int, end: int) -> Singles:
    """Return stretches of samples with those around them, relative to ``sizes``."""
    n_curves, n_axes, n_times = vectors.shape
    n = -(-(end - first) // _STRETCH) * _STRETCH
    samples = np.zeros((n_curves, n_axes, n + 2 * _REACH - 1), np.float32)
    begin = first - _REACH + 1
    inside = max(begin, 0), min(begin + samples.shape[-1], n_times)
    target = samples[..., inside[0] - begin : inside[1] - begin]
    # Others report values that are not finite.
    with np.errstate(invalid="ignore", under="ignore"):
        np.divide(vectors[..., slice(*inside)], sizes, out=target, casting="same_kind")
    target[np.abs(target) < _SILENT] = 0.0
    return samples


def _find_extremes(samples: Singles, low: Singles, high: Singles, *, length: bool) -> None:
    """Fill ``low`` and ``high``, (n_curves, n), with the extremes of a block."""
    n_curves, n_axes, n_wide = samples.shape
    n = n_wide - 2 * _REACH + 1
    wide = _STRETCH + 2 * _REACH - 1
    shape = (n_curves, n_axes, n // _STRETCH, wide)
    steps = (*samples.strides[:2], _STRETCH * samples.strides[2], samples.strides[2])
    windows = as_strided(samples, shape, steps, writeable=False)
    n_rows = n_curves * n_axes * windows.shape[2]
    rows = np.zeros((-(-n_rows // _EXTREMES_BATCH), _EXTREMES_BATCH, wide), np.float32)
    rows.reshape(-1, wide)[:n_rows].reshape(windows.shape)[...] = windows
    own = samples[..., _REACH - 1 : _REACH - 1 + n]
    # Squares of lengths are compared, and only the roots of the extremes are computed.
    least = np.einsum("cat,cat->ct", own, own) if length else own[:, 0].copy()
    most = least.copy()
    products = np.empty((*rows.shape[:2], _STRETCH), np.float32)
    for weights in _extremes_weights():
        points = np.matmul(rows, weights, out=products).reshape(-1, _STRETCH)[:n_rows]
        points = points.reshape(n_curves, n_axes, n)
        between = np.einsum("cat,cat->ct", points, points) if length else points[:, 0]
        np.minimum(least, between, out=least)
        np.maximum(most, between, out=most)
    for result, extreme in ((low, least), (high, most)):
        result[:] = (np.sqrt(extreme) if length else extreme)[:, : low.shape[1]]


@cache
def _extremes_weights() -> Singles:
    """Return the weights of the points of a stretch, (FINER - 1, n_samples, _STRETCH)."""
    used = np.arange(_STRETCH + 2 * _REACH - 1) - (_REACH - 1)
    shift = np.arange(1, FINER) / FINER
    points = shift[:, np.newaxis, np.newaxis] + np.arange(_STRETCH)
    distance = points - used[:, np.newaxis]
    within = np.clip(1.0 - (distance / _REACH) ** 2, 0.0, None)
    weights = (
        np.sinc(distance) * np.i0(_EXTREMES_BETA * np.sqrt(within)) / np.i0(_EXTREMES_BETA)
    ).astype(np.float32)
    weights[np.abs(distance) > _REACH] = 0.0
    weights.flags.writeable = False
    return weights


def passed(samples: Floats, from_hz: float, to_hz: float) -> Floats:
    """Return a signal after the filter between two rates, at its own rate.

    Nothing folds, so that its energy does not depend on the phase.

    Parameters
    ----------
    samples : (n_times,)
        Silent before and after.
    from_hz, to_hz
        As of `resample`.

    Returns
    -------
    (ring + n_times + ring,)
        With the ringing before and after.
    """
    lower_hz = min(from_hz, to_hz)
    transition = half_transition(lower_hz)
    ring = min(ceil(_RINGS / transition * from_hz / lower_hz), _LONGEST_RING)
    padded = np.pad(samples, ring)
    length = scipy.fft.next_fast_len(padded.size, real=True)
    share = scipy.fft.rfftfreq(length, 1.0 / from_hz) / (0.5 * lower_hz)
    gain = np.interp(share, *_response(transition))
    return scipy.fft.irfft(gain * scipy.fft.rfft(padded, length), length)[: padded.size]


@lru_cache(maxsize=4)
def _response(transition: float) -> tuple[Floats, Floats]:
    """Return frequencies, relative to half the lower rate, and the gain of the filter there."""
    taps = Kernel(1, _RESPONSE_FINER, transition).computed_taps()
    share: Floats = np.linspace(0.0, _RESPONSE_FINER, _POINTS // 2 + 1)
    gain: Floats = np.abs(scipy.fft.rfft(taps, _POINTS))
    return share, gain
