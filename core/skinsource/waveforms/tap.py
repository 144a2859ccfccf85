"""A light tap."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.signals import TAP_SAMPLES, tap


@dataclass(frozen=True, slots=True, kw_only=True)
class Tap:
    """A Hanning pulse of 21 samples (16.2 ms at 1300 Hz), as upstream."""

    title: ClassVar[str] = "Tap"

    duration_s: ClassVar[float] = TAP_SAMPLES / SAMPLE_RATE_HZ

    def samples(self, sample_rate_hz: float) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return tap(sample_rate_hz=sample_rate_hz)
