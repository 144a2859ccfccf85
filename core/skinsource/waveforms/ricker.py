"""The Mexican hat."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.sampling import shift_of
from skinsource.signals import sample_count
from skinsource.synthesis.burst import refuse_aliases
from skinsource.synthesis.centred import about_middle, begun
from skinsource.waveforms.shared_specs import CENTRE


@dataclass(frozen=True, slots=True)
class Ricker:
    """The Ricker wavelet, or Mexican hat: the shortest pulse that leaves no velocity behind.

    (1 - 2 a) exp(-a), with a = (pi f t)², cut at t = ±1.5 / f, where 1e-8 is left.  It takes
    n = round(3 rate / f) samples, about their middle: t = (k - (n - 1) / 2) / rate.  Its spectrum
    is highest at f, and half as high at about 0.48 f and 1.64 f.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate.

    References
    ----------
    Ricker, The form and laws of propagation of seismic wavelets, Geophysics 18(1), 1953.
    """

    title: ClassVar[str] = "Ricker wavelet"

    frequency_hz: float = fields.number(100.0, CENTRE)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """Three periods of the frequency."""
        return 3.0 / self.frequency_hz

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        refuse_aliases("frequency_hz", self.frequency_hz, sample_rate_hz)
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        a = np.square(about_middle(n, sample_rate_hz, shift_s) * (pi * self.frequency_hz))
        return begun((1.0 - 2.0 * a) * np.exp(-a), shift_s)
