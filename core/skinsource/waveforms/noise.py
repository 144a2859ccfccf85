"""A burst of noise."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import NumberSpec
from skinsource.signals import WindowName, white_noise
from skinsource.waveforms.common import WINDOW

SEED = NumberSpec(
    label="Seed", minimum=0, maximum=2**31 - 1, whole=True, hint="The same seed, the same noise"
)
# Shorter noise holds no frequency of the band.
DURATION = NumberSpec(
    label="Duration", unit="s", minimum=0.01, maximum=600.0, step=0.01, hint="Length of the burst"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise:
    """Gaussian noise, flat from 25 to 600 Hz and nothing outside.

    Attributes
    ----------
    seed
        Whole number; the same seed gives the same noise.
    duration_s
        Length.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Noise"

    seed: int = fields.number(0, SEED)
    duration_s: float = fields.number(0.2, DURATION)
    window: WindowName = fields.choice("tukey", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return white_noise(
            self.duration_s, self.seed, window_name=self.window, sample_rate_hz=sample_rate_hz
        )
