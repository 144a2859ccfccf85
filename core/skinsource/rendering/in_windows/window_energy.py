"""Energy within windows, of signals that come piece by piece."""

import numpy as np

from skinsource.analysis import Windows
from skinsource.arrays import Floats, Indices


class WindowEnergy:
    """Sums squares of signals within windows that follow each other.

    Parameters
    ----------
    n_outputs
        How many signals there are.
    windows
        Where the windows lie.
    """

    def __init__(self, n_outputs: int, windows: Windows) -> None:
        self._windows = windows
        self._energy = np.zeros((windows.count, n_outputs))

    def add(self, outputs: Indices, first: int, signals: Floats) -> None:
        """Take samples of some outputs, (n_outputs, n), from sample ``first`` on."""
        begin, length = self._windows.first_sample, self._windows.window_samples
        end = first + signals.shape[-1]
        earliest = max((first - begin) // length, 0)
        latest = min(-((begin - end) // length), self._windows.count)
        for window in range(earliest, latest):
            low = max(begin + window * length - first, 0)
            high = min(begin + (window + 1) * length - first, signals.shape[-1])
            if low < high:
                piece = signals[:, low:high]
                self._energy[window, outputs] += np.einsum("ot,ot->o", piece, piece)

    def rms(self) -> Floats:
        """RMS of each output in each window, (n_windows, n_outputs)."""
        return np.sqrt(self._energy / self._windows.window_samples)
