"""A single sample."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.signals import impulse


@dataclass(frozen=True, slots=True, kw_only=True)
class Impulse:
    """One sample of 1: what comes out is the impulse response itself."""

    title: ClassVar[str] = "Impulse"

    duration_s: ClassVar[float] = 1 / SAMPLE_RATE_HZ

    def samples(self, sample_rate_hz: float) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return impulse(sample_rate_hz=sample_rate_hz)
