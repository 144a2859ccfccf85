"""The least and the largest of each stretch of a long signal: enough for a picture of all of it."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.recordings.reader import Block


class Overview:
    """Takes a signal block by block.

    Parameters
    ----------
    n_samples
        How long it is.
    columns
        Stretches of equal length; at most ``n_samples``.

    Attributes
    ----------
    extremes : (2, columns)
        Least and largest; NaN where nothing was seen.
    done
        Samples that were seen.
    """

    def __init__(self, n_samples: int, columns: int) -> None:
        columns = max(min(columns, n_samples), 1)
        self._starts = np.arange(columns, dtype=np.int64) * n_samples // columns
        self.extremes: Floats = np.full((2, columns), np.nan)
        self.done = 0

    def add(self, block: Block) -> None:
        """Take the next samples, (1, n)."""
        n = block.shape[1]
        if not n:
            return
        first = int(np.searchsorted(self._starts, self.done, side="right")) - 1
        last = int(np.searchsorted(self._starts, self.done + n))
        starts = np.maximum(self._starts[first:last] - self.done, 0)
        least, largest = self.extremes[:, first:last]
        # NaN loses against any number.
        least[:] = np.fmin(least, np.fmin.reduceat(block[0], starts))
        largest[:] = np.fmax(largest, np.fmax.reduceat(block[0], starts))
        self.done += n
