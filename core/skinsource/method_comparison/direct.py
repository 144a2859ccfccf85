"""The sum of products itself, as matrix products; no transforms."""

from collections.abc import Iterator

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from skinsource.method_comparison.accuracy import Block
from skinsource.method_comparison.method import (
    Method,
    Prepared,
    Unfit,
    all_channels,
    drives_of,
    require_bytes,
    taps_of,
)
from skinsource.method_comparison.scenes import ComparedScene

#: Samples computed together: the matrix of delayed drives then fits a cache.
_STEP = 1024
#: More products than these take a personal computer tens of seconds.
_MOST_PRODUCTS = 5e11


def prepare(scene: ComparedScene, method: Method) -> Prepared:
    """Lay the responses side by side, (n_channels, n_inputs x n_taps), last tap first."""
    taps, drives = taps_of(scene, method), drives_of(scene, method)
    n_taps = taps.shape[-1]
    require_bytes(len(drives) * n_taps * _STEP * drives.itemsize)
    n_products = float(taps.size) * scene.response_samples
    if n_products > _MOST_PRODUCTS:
        raise Unfit(f"would take {n_products:.0e} products; the limit is {_MOST_PRODUCTS:.0e}")
    matrix = np.ascontiguousarray(taps[..., ::-1].transpose(1, 0, 2).reshape(taps.shape[1], -1))
    padded = np.pad(drives, ((0, 0), (n_taps - 1, n_taps - 1)))
    n_times = drives.shape[-1] + n_taps - 1

    def run(_: int) -> Iterator[Block]:
        for first in range(0, n_times, _STEP):
            n = min(_STEP, n_times - first)
            piece = padded[:, first : first + n + n_taps - 1]
            delayed = sliding_window_view(piece, n, axis=-1).reshape(len(drives) * n_taps, n)
            yield first, matrix @ delayed

    return Prepared(rows=all_channels(scene), run=run)
