"""How far a wave reaches between the samples that describe it.

A tone of a quarter of the rate has samples that all miss its peak by 3 dB, and a sweep through it
has a notch in the envelope of its samples that the wave has not.  A filter shorter than that of
`skinsource.resampling.by_ratio` is enough for what is drawn, and is quick enough to be computed
with every edit: up to 12/13 of half the rate (600 Hz of 1300) it errs by at most 0.2 % of an
amplitude, and points an eighth of a sample apart miss a peak by at most 1.7 %.
"""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from skinsource.arrays import Floats, Indices
from skinsource.job import Stop, never, stop_if
from skinsource.resampling.between import FINER
from skinsource.resampling.kernel import blocks

#: The share of an amplitude by which the extremes of a wave may be wrong.
EXTREMES_ERROR = 0.02

Singles = NDArray[np.float32]

# Samples on either side that a point is made of, and the shape of Kaiser's window over them.
_REACH, _BETA = 24, 5.7
# Samples whose points are one product, and so many of those at once: fewer than those for which
# the library of products calls for other threads, which costs more than they save.
_STRETCH, _TOGETHER = 32, 12
# Samples of all signals that a block works on: its points stay in the processor's cache.
_BLOCK = 2**14
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
    found = Extremes(
        low=np.empty((n_curves, end - first), np.float32),
        high=np.empty((n_curves, end - first), np.float32),
        sizes=sizes[:, 0],
    )
    step = max(_BLOCK // max(n_curves * n_axes * _STRETCH, 1), 1) * _STRETCH
    for start, last in blocks(end - first, step):
        stop_if(stop)
        samples = _samples(vectors, sizes, first + start, first + last)
        low, high = found.low[:, start:last], found.high[:, start:last]
        _find(samples, low, high, length=signals.ndim == 3)
    if n_curves and end == n_times and end > first:
        # Behind the last sample there is no next one.
        only = vectors[..., -1] / sizes[:, :, 0]
        only = np.sqrt(np.square(only).sum(axis=1)) if signals.ndim == 3 else only[:, 0]
        found.low[:, -1] = found.high[:, -1] = only
    found.low.flags.writeable = found.high.flags.writeable = False
    return found


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
    rows = np.zeros((-(-n_rows // _TOGETHER), _TOGETHER, wide), np.float32)
    rows.reshape(-1, wide)[:n_rows].reshape(windows.shape)[...] = windows
    products = np.matmul(rows, _weights()).reshape(-1, FINER - 1, _STRETCH)[:n_rows]
    points = products.reshape(*windows.shape[:3], FINER - 1, _STRETCH)
    own = samples[..., _REACH - 1 : _REACH - 1 + n]
    if length:
        # Of squares: roots are drawn of the extremes alone.
        found = np.einsum("caspt,caspt->cspt", points, points)
        values = np.einsum("cat,cat->ct", own, own)
    else:
        found, values = points[:, 0], own[:, 0]
    wanted = low.shape[1]
    for reached, of_two in ((low, np.minimum), (high, np.maximum)):
        extreme = values.reshape(n_curves, n // _STRETCH, _STRETCH)
        for k in range(FINER - 1):  # three times as quick as along the axis
            extreme = of_two(extreme, found[:, :, k])
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
    found = (np.sinc(away) * np.i0(_BETA * np.sqrt(within)) / np.i0(_BETA)).astype(np.float32)
    found[np.abs(away) > _REACH] = 0.0
    found.flags.writeable = False
    return found
