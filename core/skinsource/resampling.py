"""From one sample rate to another: a Kaiser-windowed polyphase filter of 140 dB.

The lower of the two rates decides the band.  Half of it is the middle of the transition: below
12/13 of that half (600 Hz where the lower rate is 1300 Hz) all passes, above 14/13 of it (700 Hz)
nothing does, and what lies between may fold back, but only above the pass band.  Lower rates from
1200 to 1300 Hz get a steeper filter, so that 600 Hz still passes; at 1210 Hz it is ten times as
long, and steeper it does not get.
"""

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from math import ceil

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.arguments import real_array, whole_number
from skinsource.arrays import Floats, Indices
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ
from skinsource.signals import MAX_SAMPLES

#: The highest rate that is known.
MAX_RATE_HZ = 10_000_000

_STOP_BAND_DB = 140.0
_BETA = 0.1102 * (_STOP_BAND_DB - 8.7)
# Half the transition, as a share of half the lower rate.
_WIDEST, _NARROWEST = 1.0 / 13.0, 1.0 / 130.0
# Of a filter that is kept whole; longer ones are computed where they are needed.
_LONGEST_FILTER = 2**25
# … and of one that is kept for the next time: to compute it takes longer than to use it.
_LONGEST_KEPT = 2**18
# Values that a block works on.
_BLOCK = 2**18


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
        for start, end in _blocks(n, _step(found.shape, 1)):
            result[..., start:end] = found.part(start, end)
        return result
    kernel = _Kernel(up, down, _half_transition(lower_hz))
    length = 2 * kernel.half_length
    if length < min(n * (length // up + 1), _LONGEST_FILTER):
        _filtered(found, kernel, result)
    else:
        _summed(found, kernel, result)
    return result


def reach_samples(from_hz: int, to_hz: int) -> int:
    """Samples at ``from_hz``, on either side, that a sample at ``to_hz`` is made of."""
    if from_hz == to_hz:
        return 0
    ratio = Fraction(to_hz, from_hz)
    kernel = _Kernel(ratio.numerator, ratio.denominator, _half_transition(min(from_hz, to_hz)))
    return kernel.half_length // kernel.up + 1


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


class _Kernel:
    """The filter on the grid of both rates' common multiple.

    Attributes
    ----------
    half_length
        Its last sample on either side of the middle.
    """

    def __init__(self, up: int, down: int, half_transition: float) -> None:
        self.up, self.down, self._half_transition = up, down, half_transition
        self._slower = max(up, down)
        # Kaiser's formula; the transition is twice the half, of half the lower rate.
        width = 2.0 * half_transition * np.pi / self._slower
        self.half_length = ceil((_STOP_BAND_DB - 7.95) / (2.285 * width) / 2.0)

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
        found = np.empty(2 * self.half_length + 1)
        for start, end in _blocks(found.size, _BLOCK):
            found[start:end] = self.at(np.arange(start, end) - self.half_length)
        return found


@lru_cache(maxsize=4)
def _kept(up: int, down: int, half_transition: float) -> Floats:
    found = _Kernel(up, down, half_transition).made()
    found.flags.writeable = False
    return found


def _half_transition(lower_hz: float) -> float:
    if lower_hz <= 2.0 * BAND_HZ[1]:
        return _WIDEST
    return min(max(1.0 - 2.0 * BAND_HZ[1] / lower_hz, _NARROWEST), _WIDEST)


def _filtered(samples: _Signals, kernel: _Kernel, result: Floats) -> None:
    """Fill ``result`` block by block with one filter for all."""
    up, down, half = kernel.up, kernel.down, kernel.half_length
    # In blocks of whole periods of both rates, so that the filter lies alike in all of them.
    periods = max(_step(samples.shape, up + down), 1)
    reach = -(-half // up)
    lead = -(-reach // down) * down
    taps = np.concatenate((np.zeros(-half % down), kernel.whole()))
    skipped = lead * up // down + (half + -half % down) // down
    for block, (start, end) in enumerate(_blocks(result.shape[-1], periods * up)):
        first = block * periods * down
        last = min(-(-end * down // up) + reach + 1, samples.shape[-1])
        before = min(lead, first)
        missing = (lead - before) * up // down
        part = samples.part(first - before, max(last, first - before))
        found = scipy.signal.upfirdn(taps, part, up, down, axis=-1) if part.size else part
        wanted = found[..., skipped - missing : skipped - missing + end - start]
        result[..., start : start + wanted.shape[-1]] = wanted
        result[..., start + wanted.shape[-1] : end] = 0.0


def _summed(samples: _Signals, kernel: _Kernel, result: Floats) -> None:
    """Fill ``result`` with sums whose weights are computed one by one."""
    up, down, half = kernel.up, kernel.down, kernel.half_length
    n_taps = 2 * (half // up) + 3
    for start, end in _blocks(result.shape[-1], max(_step(samples.shape, 1) // n_taps, 1)):
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


def _blocks(n: int, step: int) -> Iterator[tuple[int, int]]:
    for start in range(0, n, step):
        yield start, min(start + step, n)
