"""A square wave."""

from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.arrays import Complexes, Floats
from skinsource.fields import NumberSpec
from skinsource.signals import WindowName
from skinsource.waveforms.harmonic_burst import harmonic_burst
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.tone import FREQUENCY, PHASE

# Slower than 1 Hz, it is a few edges: each a clip of its own.
FUNDAMENTAL = replace(FREQUENCY, minimum=1.0)
DUTY = NumberSpec(
    label="Duty", minimum=0.01, maximum=0.99, step=0.01, hint="Share of each period that is high"
)


@dataclass(frozen=True, slots=True)
class Square:
    """A square wave without aliases: 1 for the first part of each period, then -1.

    Its Fourier series, 2 duty - 1 + sum of (4 / pi h) sin(pi h duty) cos(2 pi h (u - duty / 2))
    at the turn u = frequency t + phase / 2 pi, up to half the sample rate.  What has peak 1 is
    the full series: cut off anywhere, it passes 1 beside each edge (Gibbs), by 18 % with many
    harmonics left and by 27 % with the fundamental alone.  Its harmonics are the same at every
    rate.  The burst is cut out of it with hard ends, or by the window.

    Attributes
    ----------
    frequency_hz
        1 Hz up to below half the sample rate.
    duty
        Share of each period that is high, 0.01 to 0.99; other than 0.5 it has a mean, 2 duty - 1.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; 0 is the rising edge.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Square"

    frequency_hz: float = fields.number(100.0, FUNDAMENTAL)
    duty: float = fields.number(0.5, DUTY)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,); 1 is the height of the square wave without limit of its band."""
        mean = 2.0 * self.duty - 1.0
        return harmonic_burst(self, self._series, sample_rate_hz, shift_s, mean=mean)

    def _series(self, harmonics: Floats) -> Complexes:
        half = pi * np.remainder(harmonics * self.duty, 2.0)
        turned: Complexes = np.exp(-1j * half)
        return turned * (4.0 / (pi * harmonics) * np.sin(half))
