"""A light tap."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.signals import TAP_S, tap


@dataclass(frozen=True, slots=True)
class Tap:
    """A Hanning pulse of 16.2 ms, 21 samples at 1300 Hz, as upstream.

    0.5 (1 - cos(2 pi (t + h) / (22 h))) for 0 <= t < 21 h, with h = 1/1300 s, at any rate.
    """

    title: ClassVar[str] = "Tap"

    duration_s: ClassVar[float] = TAP_S

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return tap(sample_rate_hz=sample_rate_hz, shift_s=shift_s)
