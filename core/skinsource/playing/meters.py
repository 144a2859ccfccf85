"""How loud each output is."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.decibels import decibels

#: What a peak and an RMS are measured over.
WINDOW_S = 0.1


@dataclass(frozen=True, slots=True)
class Levels:
    """Levels of the outputs, dB of full scale (dBFS), (n_outputs,) each.

    Attributes
    ----------
    peak_db, rms_db
        Over the last whole window of 0.1 s; a steady tone at full scale has an RMS of -3 dB.
    highest_db
        The highest peak since playing began.
    """

    peak_db: Floats
    rms_db: Floats
    highest_db: Floats


class Meters:
    """Gathers peaks and squares of blocks; makes nothing new while it does."""

    def __init__(self, n_outputs: int, sample_rate_hz: int) -> None:
        self._window = max(round(WINDOW_S * sample_rate_hz), 1)
        self._peak, self._squares, self._seen = np.zeros(n_outputs), np.zeros(n_outputs), 0
        self._of_block = np.zeros(n_outputs)
        self._shown_peak, self._shown_rms = np.zeros(n_outputs), np.zeros(n_outputs)
        self._highest = np.zeros(n_outputs)

    def hear(self, samples: Floats, scratch: Floats) -> None:
        """Take in what was played, (n_outputs, n_times); ``scratch`` has room for as much."""
        taken, n = 0, samples.shape[1]
        while taken < n:
            step = min(self._window - self._seen, n - taken)
            part = samples[:, taken : taken + step]
            work = scratch[:, :step]
            np.abs(part, out=work)
            np.max(work, axis=1, out=self._of_block)
            np.maximum(self._peak, self._of_block, out=self._peak)
            np.multiply(part, part, out=work)
            np.sum(work, axis=1, out=self._of_block)
            self._squares += self._of_block
            self._seen += step
            taken += step
            if self._seen == self._window:
                self._show()

    def _show(self) -> None:
        np.copyto(self._shown_peak, self._peak)
        np.divide(self._squares, self._window, out=self._shown_rms)
        np.sqrt(self._shown_rms, out=self._shown_rms)
        np.maximum(self._highest, self._peak, out=self._highest)
        self._peak[:] = 0.0
        self._squares[:] = 0.0
        self._seen = 0

    def levels(self) -> Levels:
        """What can be shown; asked from another thread."""
        return Levels(
            decibels(self._shown_peak),
            decibels(self._shown_rms),
            decibels(np.maximum(self._highest, self._peak)),
        )
