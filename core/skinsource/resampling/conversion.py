"""From one sample rate to another: a Kaiser-windowed polyphase filter of 140 dB.

The lower of the two rates decides the band.  Half of it is the middle of the transition: below
12/13 of that half (600 Hz where the lower rate is 1300 Hz) all passes, above 14/13 of it (700 Hz)
nothing does, and what lies between may fold back, but only above the pass band.  Lower rates from
1200 to 1300 Hz get a steeper filter, so that 600 Hz still passes; at 1210 Hz it is ten times as
long, and steeper it does not get.  The pass band belongs to the two rates, not to a limb: whatever
band a limb was measured in, at its own rate it lies below half of it.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from skinsource.arguments import real_array, whole_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.resampling.kernel import Kernel, blocks, half_transition
from skinsource.signals import MAX_SAMPLES

#: The highest rate that is known.
MAX_RATE_HZ = 10_000_000

# Of a filter that is kept whole; longer ones are computed where they are needed.
_LONGEST_FILTER = 2**25
# Values that a block works on.
_BLOCK = 2**18
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
        whole_number(name, rate, 1, MAX_RATE_HZ)
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
    found = _Signals(_array(samples), offset)
    up, down = ratio.numerator, ratio.denominator
    n = -(-found.shape[-1] * up // down)
    if n > MAX_SAMPLES:
        raise InvalidInputError(
            f"{found.shape[-1]} samples become {n}, expected at most {MAX_SAMPLES}; take a part"
        )
    result = np.empty((*found.shape[:-1], n))
    if ratio == 1:
        for start, end in blocks(n, _step(found.shape, 1)):
            result[..., start:end] = found.part(start, end)
        return result
    kernel = Kernel(up, down, half_transition(lower_hz))
    length = 2 * kernel.half_length
    if kernel.is_small:
        _multiplied(found, kernel, result)
    elif length < min(n * (length // up + 1), _LONGEST_FILTER):
        _filtered(found, kernel, result)
    else:
        _summed(found, kernel, result)
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
        found = scipy.signal.upfirdn(taps, part, up, down, axis=-1) if part.size else part
        wanted = found[..., skipped - missing : skipped - missing + end - start]
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
        found = samples
    else:
        found = real_array("samples", samples, "finite real numbers, (..., n_times)")
    if not found.ndim:
        raise InvalidInputError("samples is a single number, expected (..., n_times)")
    return found


def _step(shape: tuple[int, ...], per_step: int) -> int:
    """Steps of ``per_step`` values for each signal that make a block."""
    signals = int(np.prod(shape[:-1], dtype=np.int64))
    return max(_BLOCK // max(signals * per_step, 1), 1)
