"""A burst of noise."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.limb import BAND_HZ
from skinsource.signals import WindowName, white_noise
from skinsource.waveforms.shared_specs import WINDOW

SEED = NumberSpec(
    label="Seed", minimum=0, maximum=2**31 - 1, whole=True, hint="The same seed, the same noise"
)
LOW = NumberSpec(
    label="From",
    unit="Hz",
    minimum=0.0,
    maximum=99_999.0,
    step=1.0,
    felt_hz=BAND_HZ,
    hint="Lowest frequency of the noise",
)
HIGH = replace(
    LOW, label="To", minimum=1.0, maximum=100_000.0, hint="Highest frequency of the noise"
)
# Shorter noise holds no frequency of the band.
DURATION = NumberSpec(
    label="Duration", unit="s", minimum=0.01, maximum=600.0, step=0.01, hint="Length of the burst"
)


@dataclass(frozen=True, slots=True)
class Noise:
    """Gaussian noise, flat within a band and nothing outside.

    A sum of waves at multiples of 1 / ``duration_s``; its peak at its samples is 1.  A window
    widens the spectrum a little.

    Attributes
    ----------
    seed
        Whole number; the same seed gives the same noise.
    duration_s
        Length; at least 1 / (``high_hz`` - ``low_hz``).
    low_hz, high_hz
        The band; both ends belong to it.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Noise"

    seed: int = fields.number(0, SEED)
    duration_s: float = fields.number(0.2, DURATION)
    # Part of the recipe, whatever the limb: so a file means that says no others.
    low_hz: float = fields.number(BAND_HZ[0], LOW)
    high_hz: float = fields.number(BAND_HZ[1], HIGH)
    window: WindowName = fields.choice("tukey", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.low_hz < self.high_hz:
            raise InvalidInputError(
                f"Noise.low_hz is {self.low_hz:g}, expected less than high_hz, {self.high_hz:g} Hz"
            )
        if (self.high_hz - self.low_hz) * self.duration_s < 1.0:
            raise InvalidInputError(
                f"Noise.duration_s is {self.duration_s:g}, expected at least "
                f"{1.0 / (self.high_hz - self.low_hz):g} s: shorter noise holds no frequency "
                f"between {self.low_hz:g} and {self.high_hz:g} Hz"
            )

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return white_noise(
            self.duration_s,
            self.seed,
            band_hz=(self.low_hz, self.high_hz),
            window_name=self.window,
            sample_rate_hz=sample_rate_hz,
            shift_s=shift_s,
        )
