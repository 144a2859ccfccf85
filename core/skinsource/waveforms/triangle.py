"""A triangle wave."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.arrays import Complexes, Floats
from skinsource.signals import WindowName
from skinsource.waveforms.harmonic_burst import harmonic_burst
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.square import FUNDAMENTAL
from skinsource.waveforms.tone import PHASE


@dataclass(frozen=True, slots=True)
class Triangle:
    """A triangle wave without aliases: from 0 up to 1, down to -1, and back.

    Its Fourier series, the sum over odd h of (8 / pi² h²) (-1)^((h - 1) / 2) sin(2 pi h u) at
    the turn u = frequency t + phase / 2 pi, up to half the sample rate; without that limit it is
    1 - 4 |u - 1/4| for -1/4 < u < 3/4.  What has peak 1 is the full series; cut off, it stays
    within 1.  Its harmonics are the same at every rate.  The burst is cut out of it with hard
    ends, or by the window.

    Attributes
    ----------
    frequency_hz
        1 Hz up to below half the sample rate.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; pi/2 is the upper corner.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Triangle"

    frequency_hz: float = fields.number(100.0, FUNDAMENTAL)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,); 1 is the height of the triangle without limit of its band."""
        return harmonic_burst(self, _series, sample_rate_hz, shift_s)


def _series(harmonics: Floats) -> Complexes:
    sign = np.array([0.0, 1.0, 0.0, -1.0])[harmonics.astype(np.int64) % 4]
    return -8j * sign / (pi * harmonics) ** 2
