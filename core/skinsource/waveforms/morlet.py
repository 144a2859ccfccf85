"""The Morlet wavelet."""

from dataclasses import dataclass
from math import expm1, pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import NumberSpec
from skinsource.sampling import shift_of
from skinsource.signals import sample_count
from skinsource.synthesis.burst import refuse_aliases
from skinsource.synthesis.centred import about_middle, begun, turns_about_middle
from skinsource.waveforms.shared_specs import CENTRE, refuse_length

W0 = NumberSpec(
    label="w0",
    minimum=1.0,
    maximum=1000.0,
    step=0.02,
    logarithmic=True,
    hint="Radians of the tone per standard deviation of its Gaussian; 5 or 6 are usual",
)


@dataclass(frozen=True, slots=True)
class Morlet:
    """Real part of the admissible Morlet wavelet, whose mean is 0 for every w0.

    (cos(w0 u) - c) exp(-u² / 2) / (1 - c), with c = exp(-w0² / 2), u = t / s and
    s = w0 / (2 pi f), cut at u = ±5, where 4e-6 of the peak is left.  It takes
    n = round(10 s rate) samples, about their middle: t = (k - (n - 1) / 2) / rate.  The peak of
    the formula is 1; w0 = 6 differs from a Gabor wavelet of 6 cycles by 2e-8, w0 = 1 by half.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate; for w0 below 3 the spectrum is highest above
        it.
    w0
        1 to 1000.

    References
    ----------
    Grossmann and Morlet, Decomposition of Hardy functions into square integrable wavelets of
    constant shape, SIAM Journal on Mathematical Analysis 15(4), 1984.
    """

    title: ClassVar[str] = "Morlet wavelet"

    frequency_hz: float = fields.number(100.0, CENTRE)
    w0: float = fields.number(6.0, W0)

    def __post_init__(self) -> None:
        fields.check(self)
        refuse_length("Morlet", self.duration_s, "Raise frequency_hz or lower w0.")

    @property
    def duration_s(self) -> float:
        """Ten standard deviations of the Gaussian."""
        return 10.0 * self._s

    @property
    def _s(self) -> float:
        return self.w0 / (2.0 * pi * self.frequency_hz)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        refuse_aliases("frequency_hz", self.frequency_hz, sample_rate_hz)
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        u = about_middle(n, sample_rate_hz, shift_s) / self._s
        found = np.cos(2.0 * pi * turns_about_middle(self.frequency_hz, n, sample_rate_hz, shift_s))
        peak = -expm1(-(self.w0**2) / 2.0)
        found -= 1.0 - peak
        found *= np.exp(-0.5 * np.square(u)) / peak
        return begun(found, shift_s)
