"""From one sample rate to another."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, lru_cache
from math import ceil

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import integer, real_array
from skinsource.base.arrays import Floats, Indices
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, never, stop_if
from skinsource.base.published import BAND_HZ
from skinsource.signals.generators import MAX_SAMPLES

# The filter between two rates, and its weights as a matrix.

_STOP_BAND_DB = 140.0
_BETA = 0.1102 * (_STOP_BAND_DB - 8.7)
# Half the transition, as a share of half the lower rate.
_WIDEST, _NARROWEST = 1.0 / 13.0, 1.0 / 130.0
#: So much of half the lower rate passes, whatever the two rates are.
PASSED_SHARE = 1.0 - _WIDEST
# Of a filter that is kept for the next time: to compute it takes longer than to use it.
_LONGEST_KEPT = 2**18
# Values of a matrix of weights; larger ones cost more than they save.
_LARGEST_MATRIX = 2**19
# Results of a period, which is taken several times where the rates have a short one.
_LEAST_IN_PERIOD = 16
# Values that are computed at once.
_BLOCK = 2**18


class Kernel:
    """The filter on the grid of both rates' common multiple.

    Attributes
    ----------
    half_length
        Its last sample on either side of the middle.
    reach, n_used
        Samples on either side that a result is made of; samples that some periods of the results
        are made of together.
    periods
        How many those are.
    """

    def __init__(self, up: int, down: int, half_transition: float) -> None:
        self.up, self.down, self._half_transition = up, down, half_transition
        self._slower = max(up, down)
        # Kaiser's formula; the transition is twice the half, of half the lower rate.
        width = 2.0 * half_transition * np.pi / self._slower
        self.half_length = ceil((_STOP_BAND_DB - 7.95) / (2.285 * width) / 2.0)
        self.reach = -(-self.half_length // up)
        # Several periods share the samples that they reach.
        self.periods = min(-(-_LEAST_IN_PERIOD // up), max((2 * self.reach + 1) // down, 1))
        self.n_used = self.periods * down + 2 * self.reach + 1

    @property
    def is_small(self) -> bool:
        """Whether all weights of a period fit in a matrix that is mostly filled."""
        filled = self.periods * self.down <= 2 * (2 * self.reach + 1)
        return filled and self.periods * self.up * self.n_used <= _LARGEST_MATRIX

    def at(self, place: Indices) -> Floats:
        """The filter ``place`` samples off its middle; its sum over each phase is nearly 1."""
        within = np.clip(1.0 - (place / self.half_length) ** 2, 0.0, None)
        taper = scipy.special.i0(_BETA * np.sqrt(within)) / scipy.special.i0(_BETA)
        ideal = np.sinc(place / self._slower) * min(1.0, self.up / self.down)
        return np.where(np.abs(place) <= self.half_length, ideal * taper, 0.0)

    def whole(self) -> Floats:
        """All of it, (2 half_length + 1,); the last few that are not long are kept."""
        if self.half_length <= _LONGEST_KEPT:
            return _kept(self.up, self.down, self._half_transition)
        return self.made()

    def made(self) -> Floats:
        """Compute all of it, (2 half_length + 1,)."""
        taps = np.empty(2 * self.half_length + 1)
        for start, end in blocks(taps.size, _BLOCK):
            taps[start:end] = self.at(np.arange(start, end) - self.half_length)
        return taps

    def weights(self) -> Floats:
        """What each result of a period is made of, (n_used, periods up); the last are kept."""
        return _kept_weights(self.up, self.down, self._half_transition)


@lru_cache(maxsize=4)
def _kept(up: int, down: int, half_transition: float) -> Floats:
    taps = Kernel(up, down, half_transition).made()
    taps.flags.writeable = False
    return taps


@lru_cache(maxsize=4)
def _kept_weights(up: int, down: int, half_transition: float) -> Floats:
    kernel = Kernel(up, down, half_transition)
    used = np.arange(kernel.n_used)[:, np.newaxis] - kernel.reach
    place = np.arange(kernel.periods * up) * down - used * up
    weights = np.where(
        np.abs(place) <= kernel.half_length,
        kernel.whole()[np.clip(place + kernel.half_length, 0, 2 * kernel.half_length)],
        0.0,
    )
    weights.flags.writeable = False
    return weights


def half_transition(lower_hz: float) -> float:
    """Half the transition, as a share of half the lower rate.

    Part of the function, whatever the limb: of 1200 to 1300 Hz, too, 600 Hz shall pass.
    """
    if lower_hz <= 2.0 * BAND_HZ[1]:
        return _WIDEST
    return min(max(1.0 - 2.0 * BAND_HZ[1] / lower_hz, _NARROWEST), _WIDEST)


def blocks(n: int, step: int) -> Iterator[tuple[int, int]]:
    """Begin and end of each ``step`` of ``n``; the last may be shorter."""
    for start in range(0, n, step):
        yield start, min(start + step, n)


# From one sample rate to another: a Kaiser-windowed polyphase filter of 140 dB.
#
# The lower of the two rates decides the band.  Half of it is the middle of the transition: below
# 12/13 of that half (600 Hz where the lower rate is 1300 Hz) all passes, above 14/13 of it (700 Hz)
# nothing does, and what lies between may fold back, but only above the pass band.  Lower rates from
# 1200 to 1300 Hz get a steeper filter, so that 600 Hz still passes; at 1210 Hz it is ten times as
# long, and steeper it does not get.  The pass band belongs to the two rates, not to a limb:
# whatever band a limb was measured in, at its own rate it lies below half of it.

#: The highest rate that is known.
MAX_RATE_HZ = 10_000_000

# Of a filter that is kept whole; longer ones are computed where they are needed.
_LONGEST_FILTER = 2**25
# Values that a block works on.

# Periods that are multiplied together, always: the bits of a result then do not depend on which
# others are computed.  So few that the library of products does not call for other threads.
_TOGETHER = 4


def resample(samples: ArrayLike, from_hz: int, to_hz: int) -> Floats:
    """Return a signal at another sample rate.

    Sample k of the result is the band-limited signal at time k / ``to_hz``, so nothing is
    delayed.  Before its first and after its last sample the signal is taken as silent: where it
    is cut off hard, the first and last 0.1 s ring, as with any method.

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
        A rate is not a whole number, a sample is not finite, or the result would be too long.
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
        Taken off each sample first, without another copy of them all.
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
        for start, end in blocks(n, _step(source.shape, 1)):
            result[..., start:end] = source.part(start, end)
        return result
    kernel = Kernel(up, down, half_transition(lower_hz))
    length = 2 * kernel.half_length
    if kernel.is_small:
        _multiplied(source, kernel, result)
    elif length < min(n * (length // up + 1), _LONGEST_FILTER):
        _filtered(source, kernel, result)
    else:
        _summed(source, kernel, result)
    return result


@dataclass(frozen=True, slots=True, kw_only=True)
class Stretch:
    """What a part of a signal must hold to be resampled by itself, to the last bit.

    Attributes
    ----------
    reach
        Samples at the old rate, on either side, that a sample at the new rate is made of.
    period
        It begins at a multiple of so many.
    """

    reach: int
    period: int


def stretch_of(from_hz: int, to_hz: int) -> Stretch:
    """What `resample` needs of a part."""
    if from_hz == to_hz:
        return Stretch(reach=0, period=1)
    ratio = Fraction(to_hz, from_hz)
    kernel = Kernel(ratio.numerator, ratio.denominator, half_transition(min(from_hz, to_hz)))
    n_periods = _TOGETHER * kernel.periods if kernel.is_small else 1
    return Stretch(reach=kernel.reach + 1, period=n_periods * kernel.down)


class _Signals:
    """What is resampled; given part by part, as float64."""

    def __init__(self, samples: np.ndarray, offset: float) -> None:
        self._samples, self._offset = samples, offset
        self.shape = samples.shape

    def part(self, start: int, end: int) -> Floats:
        """Samples ``start`` to ``end``; refuses what is not finite."""
        part = np.asarray(self._samples[..., start:end], np.float64)
        if not np.isfinite(part).all():
            place = np.argwhere(~np.isfinite(part))[0]
            place[-1] += start
            where = tuple(int(k) for k in place)
            raise InvalidInputError(
                f"samples is {self._samples[where]} at index {where}, expected finite real numbers"
            )
        return part - self._offset if self._offset else part


def _multiplied(samples: _Signals, kernel: Kernel, result: Floats) -> None:
    """Fill ``result`` with products of a matrix: the weights of a period are those of all."""
    weights, reach = kernel.weights(), kernel.reach
    n_in, n_out = kernel.periods * kernel.down, kernel.periods * kernel.up
    step = _TOGETHER * max(_step(samples.shape, _TOGETHER * (n_in + n_out)), 1)
    used = np.empty((_TOGETHER, kernel.n_used))
    for start, end in blocks(-(-result.shape[-1] // n_out), step):
        n_periods = -(-(end - start) // _TOGETHER) * _TOGETHER
        first, last = start * n_in - reach, (start + n_periods) * n_in + reach + 1
        inside = min(max(first, 0), samples.shape[-1]), min(last, samples.shape[-1])
        part = np.zeros((*samples.shape[:-1], last - first))
        part[..., inside[0] - first : inside[1] - first] = samples.part(*inside)
        out = result[..., start * n_out : end * n_out]
        for place in np.ndindex(samples.shape[:-1]):
            windows = sliding_window_view(part[place], kernel.n_used)[::n_in]
            for k in range(0, n_periods, _TOGETHER):
                np.copyto(used, windows[k : k + _TOGETHER])
                wanted = out[place][k * n_out : (k + _TOGETHER) * n_out]
                wanted[:] = (used @ weights).ravel()[: wanted.size]


def _filtered(samples: _Signals, kernel: Kernel, result: Floats) -> None:
    """Fill ``result`` block by block with one filter for all."""
    up, down, half = kernel.up, kernel.down, kernel.half_length
    # In blocks of whole periods of both rates, so that the filter lies alike in all of them.
    periods = max(_step(samples.shape, up + down), 1)
    reach = -(-half // up)
    lead = -(-reach // down) * down
    taps = np.concatenate((np.zeros(-half % down), kernel.whole()))
    skipped = lead * up // down + (half + -half % down) // down
    for block, (start, end) in enumerate(blocks(result.shape[-1], periods * up)):
        first = block * periods * down
        last = min(-(-end * down // up) + reach + 1, samples.shape[-1])
        before = min(lead, first)
        missing = (lead - before) * up // down
        part = samples.part(first - before, max(last, first - before))
        filtered = scipy.signal.upfirdn(taps, part, up, down, axis=-1) if part.size else part
        wanted = filtered[..., skipped - missing : skipped - missing + end - start]
        result[..., start : start + wanted.shape[-1]] = wanted
        result[..., start + wanted.shape[-1] : end] = 0.0


def _summed(samples: _Signals, kernel: Kernel, result: Floats) -> None:
    """Fill ``result`` with sums whose weights are computed one by one."""
    up, down, half = kernel.up, kernel.down, kernel.half_length
    n_taps = 2 * (half // up) + 3
    for start, end in blocks(result.shape[-1], max(_step(samples.shape, 1) // n_taps, 1)):
        place = np.arange(start, end, dtype=np.int64) * down
        nearest = place // up
        index = nearest[:, np.newaxis] + np.arange(n_taps) - n_taps // 2
        weights = kernel.at(place[:, np.newaxis] - index * up)
        first, last = max(int(index[0, 0]), 0), min(int(index[-1, -1]) + 1, samples.shape[-1])
        part = samples.part(first, max(last, first))
        if not part.shape[-1]:
            result[..., start:end] = 0.0
            continue
        weights[(index < 0) | (index >= samples.shape[-1])] = 0.0
        gathered = part[..., np.clip(index - first, 0, part.shape[-1] - 1)]
        result[..., start:end] = np.einsum("...kt,kt->...k", gathered, weights)


def _array(samples: ArrayLike) -> np.ndarray:
    if isinstance(samples, np.ndarray) and samples.dtype.kind in "iuf" and samples.ndim:
        array = samples
    else:
        array = real_array("samples", samples, "finite real numbers, (..., n_times)")
    if not array.ndim:
        raise InvalidInputError("samples is a single number, expected (..., n_times)")
    return array


def _step(shape: tuple[int, ...], per_step: int) -> int:
    """Steps of ``per_step`` values for each signal that make a block."""
    signals = int(np.prod(shape[:-1], dtype=np.int64))
    return max(_BLOCK // max(signals * per_step, 1), 1)


# Signals as they are drawn: with points between their samples.

#: Points for each sample: a wave at the end of the band has more than thirty.
FINER = 8


def finer(
    time_s: Floats, signals: Floats, first: int = 0, end: int | None = None
) -> tuple[Floats, Floats]:
    """Instants and band-limited signals, `FINER` points for each sample.

    Straight lines between samples cut off the peaks of a wave that has four samples a period.

    Parameters
    ----------
    time_s : (n_times,)
        Equally spaced.
    signals : (..., n_times)
        Silent before and after.
    first, end
        Samples from ``first`` to before ``end`` alone, all of them unless given; of fewer than
        two nothing lies between.  What lies around them has its part in the points.

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


# How far a wave reaches between the samples that describe it.
#
# A tone of a quarter of the rate has samples that all miss its peak by 3 dB, and a sweep through it
# has a notch in the envelope of its samples that the wave has not.  A filter shorter than that of
# `skinsource.signals.resampling.by_ratio` is enough for what is drawn, and is quick enough to be
# computed with every edit: up to 12/13 of half the rate (600 Hz of 1300) it errs by at most 0.2 %
# of an amplitude, and points an eighth of a sample apart miss a peak by at most 1.7 %.

#: The share of an amplitude by which the extremes of a wave may be wrong.
EXTREMES_ERROR = 0.02

Singles = NDArray[np.float32]

# Samples on either side that a point is made of, and the shape of Kaiser's window over them.
_REACH, _EXTREMES_BETA = 24, 5.7
# Samples whose points are one product, and so many of those at once: fewer than those for which
# the library of products calls for other threads, which costs more than they save.
_STRETCH, _EXTREMES_TOGETHER = 32, 12
# Samples of all signals that a block works on: its points stay in the processor's cache.
_EXTREMES_BLOCK = 2**14
# What is smaller, beside the peak, counts as silence: numbers near the least there are take long.
_SILENT = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Extremes:
    """Lowest and highest value of waves from each sample to before the next.

    Attributes
    ----------
    low, high : (n_curves, n_times)
        In parts of ``sizes``; 7 digits are more than is seen.
    sizes : (n_curves, 1)
        The peak of the samples of each curve, or 1.
    """

    low: Singles
    high: Singles
    sizes: Floats

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest value of all curves; zeros where there are none."""
        if not self.low.size:
            return 0.0, 0.0
        low = self.low.min(axis=1, keepdims=True) * self.sizes
        high = self.high.max(axis=1, keepdims=True) * self.sizes
        return float(low.min()), float(high.max())

    def part(self, first: int, end: int) -> "Extremes":
        """Those from one sample to before another."""
        return replace(self, low=self.low[:, first:end], high=self.high[:, first:end])

    def of_first(self, n_curves: int) -> "Extremes":
        """Those of the first curves."""
        return Extremes(
            low=self.low[:n_curves], high=self.high[:n_curves], sizes=self.sizes[:n_curves]
        )

    def relative_to(self, sizes: Floats) -> "Extremes":
        """Those of the curves divided by ``sizes``, (n_curves, 1)."""
        return replace(self, sizes=self.sizes / sizes)

    def of_columns(self, starts: Indices) -> tuple[Floats, Floats]:
        """Lowest and highest value of each column, (n_curves, n_columns) each.

        Parameters
        ----------
        starts : (n_columns,)
            The first sample of each; rising.
        """
        low = np.minimum.reduceat(self.low, starts, axis=1) * self.sizes
        high = np.maximum.reduceat(self.high, starts, axis=1) * self.sizes
        return low, high


def extremes_between(
    signals: Floats, first: int = 0, end: int | None = None, *, stop: Stop = never
) -> Extremes:
    """Extremes of waves, within `EXTREMES_ERROR` of the amplitude of a tone in the pass band.

    Parameters
    ----------
    signals : (n_curves, n_times) or (n_curves, n_axes, n_times)
        Equally spaced samples, silent before and after; of those along several axes the length of
        the vector is the wave.
    first, end
        Samples from ``first`` to before ``end`` alone, all of them unless given.  What lies around
        them has its part.
    stop
        Asked before each block.
    """
    vectors = signals if signals.ndim == 3 else signals[:, np.newaxis]
    n_curves, n_axes, n_times = vectors.shape
    end = n_times if end is None else end
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
        samples = _samples(vectors, sizes, first + start, first + last)
        low, high = extremes.low[:, start:last], extremes.high[:, start:last]
        _find(samples, low, high, length=signals.ndim == 3)
    if n_curves and end == n_times and end > first:
        # Behind the last sample there is no next one.
        only = vectors[..., -1] / sizes[:, :, 0]
        only = np.sqrt(np.square(only).sum(axis=1)) if signals.ndim == 3 else only[:, 0]
        extremes.low[:, -1] = extremes.high[:, -1] = only
    extremes.low.flags.writeable = extremes.high.flags.writeable = False
    return extremes


def _sizes(vectors: Floats) -> Floats:
    """Peak of each curve, (n_curves, 1, 1); 1 where it is silent."""
    if not vectors.size:
        return np.ones((len(vectors), 1, 1))
    each = (1, 2)
    peaks = np.maximum(
        vectors.max(axis=each, keepdims=True), -vectors.min(axis=each, keepdims=True)
    )
    return np.where(peaks > 0.0, peaks, 1.0)


def _samples(vectors: Floats, sizes: Floats, first: int, end: int) -> Singles:
    """Whole stretches of samples, and those around them that they need; all in parts of sizes."""
    n_curves, n_axes, n_times = vectors.shape
    n = -(-(end - first) // _STRETCH) * _STRETCH
    samples = np.zeros((n_curves, n_axes, n + 2 * _REACH - 1), np.float32)
    begin = first - _REACH + 1
    inside = max(begin, 0), min(begin + samples.shape[-1], n_times)
    held = samples[..., inside[0] - begin : inside[1] - begin]
    # What is not finite is told elsewhere.
    with np.errstate(invalid="ignore", under="ignore"):
        np.divide(vectors[..., slice(*inside)], sizes, out=held, casting="same_kind")
    held[np.abs(held) < _SILENT] = 0.0
    return samples


def _find(samples: Singles, low: Singles, high: Singles, *, length: bool) -> None:
    """Fill ``low`` and ``high``, (n_curves, n), with the extremes of a block."""
    n_curves, n_axes, n_wide = samples.shape
    n = n_wide - 2 * _REACH + 1
    wide = _STRETCH + 2 * _REACH - 1
    windows = sliding_window_view(samples, wide, axis=-1)[:, :, ::_STRETCH]
    n_rows = n_curves * n_axes * windows.shape[2]
    rows = np.zeros((-(-n_rows // _EXTREMES_TOGETHER), _EXTREMES_TOGETHER, wide), np.float32)
    rows.reshape(-1, wide)[:n_rows].reshape(windows.shape)[...] = windows
    products = np.matmul(rows, _weights()).reshape(-1, FINER - 1, _STRETCH)[:n_rows]
    points = products.reshape(*windows.shape[:3], FINER - 1, _STRETCH)
    own = samples[..., _REACH - 1 : _REACH - 1 + n]
    if length:
        # Of squares: roots are drawn of the extremes alone.
        between = np.einsum("caspt,caspt->cspt", points, points)
        values = np.einsum("cat,cat->ct", own, own)
    else:
        between, values = points[:, 0], own[:, 0]
    wanted = low.shape[1]
    for reached, of_two in ((low, np.minimum), (high, np.maximum)):
        extreme = values.reshape(n_curves, n // _STRETCH, _STRETCH)
        for k in range(FINER - 1):  # three times as quick as along the axis
            extreme = of_two(extreme, between[:, :, k])
        extreme = extreme.reshape(n_curves, n)[:, :wanted]
        if length:
            np.sqrt(extreme, out=reached)
        else:
            reached[:] = extreme


@cache
def _weights() -> Singles:
    """What the points of a stretch are made of, (n_samples, (FINER - 1) _STRETCH)."""
    used = np.arange(_STRETCH + 2 * _REACH - 1) - (_REACH - 1)
    shift = np.arange(1, FINER) / FINER
    points = (shift[:, np.newaxis] + np.arange(_STRETCH)).ravel()
    away = points - used[:, np.newaxis]
    within = np.clip(1.0 - (away / _REACH) ** 2, 0.0, None)
    weights = (
        np.sinc(away) * np.i0(_EXTREMES_BETA * np.sqrt(within)) / np.i0(_EXTREMES_BETA)
    ).astype(np.float32)
    weights[np.abs(away) > _REACH] = 0.0
    weights.flags.writeable = False
    return weights


# What of a signal reaches another rate.

# Samples of the filter in each sample at the lower rate, and points of its response.
_FINER, _POINTS = 8, 2**17
# How long it rings: periods of the lower rate, over half its transition; samples at most.
_RINGS, _LONGEST_RING = 5.0, 2**21


def passed(samples: Floats, from_hz: float, to_hz: float) -> Floats:
    """Return what the filter between two rates leaves of a signal, at its own rate.

    Nothing folds, so that its energy depends on no phase.

    Parameters
    ----------
    samples : (n_times,)
        Silent before and after.
    from_hz, to_hz
        As of `resample`.

    Returns
    -------
    (ring + n_times + ring,)
        With what rings before and after.
    """
    lower_hz = min(from_hz, to_hz)
    transition = half_transition(lower_hz)
    ring = min(ceil(_RINGS / transition * from_hz / lower_hz), _LONGEST_RING)
    padded = np.pad(samples, ring)
    length = scipy.fft.next_fast_len(padded.size, real=True)
    share = scipy.fft.rfftfreq(length, 1.0 / from_hz) / (0.5 * lower_hz)
    gain = np.interp(share, *_response(transition))
    signal: Floats = scipy.fft.irfft(gain * scipy.fft.rfft(padded, length), length)[: padded.size]
    return signal


@lru_cache(maxsize=4)
def _response(transition: float) -> tuple[Floats, Floats]:
    """Frequencies, in parts of half the lower rate, and the gain of the filter there."""
    taps = Kernel(1, _FINER, transition).made()
    share: Floats = np.linspace(0.0, _FINER, _POINTS // 2 + 1)
    gain: Floats = np.abs(scipy.fft.rfft(taps, _POINTS))
    return share, gain
