"""A sine burst."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import NumberSpec
from skinsource.limb import BAND_HZ
from skinsource.signals import WindowName, sinusoid
from skinsource.waveforms.shared_specs import DURATION, WINDOW

FREQUENCY = NumberSpec(
    label="Frequency",
    unit="Hz",
    minimum=0.01,
    maximum=100_000.0,
    step=0.02,
    logarithmic=True,
    below_half_rate=True,
    felt_hz=BAND_HZ,
)
PHASE = NumberSpec(
    label="Phase", unit="rad", minimum=-2 * pi, maximum=2 * pi, step=pi / 36, hint="Phase at onset"
)


@dataclass(frozen=True, slots=True)
class Tone:
    """A sine burst.

    Attributes
    ----------
    frequency_hz, phase_rad, duration_s
        Frequency (25 to 600 Hz is the measured band; it must be below half the sample rate of
        the limb), phase at onset, length.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Tone"

    frequency_hz: float = fields.number(100.0, FREQUENCY)
    phase_rad: float = fields.number(0.0, PHASE)
    duration_s: float = fields.number(0.2, DURATION)
    window: WindowName = fields.choice("tukey", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        return sinusoid(
            self.frequency_hz,
            self.duration_s,
            phase_rad=self.phase_rad,
            window_name=self.window,
            sample_rate_hz=sample_rate_hz,
            shift_s=shift_s,
        )
