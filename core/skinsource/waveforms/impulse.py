"""A single sample."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.sampling import band_limited_delay, shift_of
from skinsource.signals import impulse


@dataclass(frozen=True, slots=True)
class Impulse:
    """One sample of 1: what comes out is the impulse response itself.

    It is one sample at any rate, so its energy depends on the rate: at half the rate it has twice
    the area.  Between two samples it is the closest to a delayed one that these two can be: the
    onset is right, frequencies near 0 are up to 2.1 dB stronger, and high ones are weaker, 600 Hz
    by up to 16 dB where the sample rate is 1300 Hz.
    """

    title: ClassVar[str] = "Impulse"

    # As it is drawn; it plays one sample of whatever limb.
    duration_s: ClassVar[float] = 1 / SAMPLE_RATE_HZ

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        shift = shift_of(shift_s, sample_rate_hz)
        return band_limited_delay(impulse(sample_rate_hz=sample_rate_hz), shift * sample_rate_hz)
