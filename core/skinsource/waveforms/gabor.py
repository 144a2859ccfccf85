"""A tone within a Gaussian."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.sampling import shift_of
from skinsource.signals import sample_count
from skinsource.synthesis.burst import refuse_aliases
from skinsource.synthesis.centred import about_middle, begun, turns_about_middle
from skinsource.waveforms.shared_specs import CENTRE, CYCLES, refuse_length
from skinsource.waveforms.tone import PHASE


@dataclass(frozen=True, slots=True)
class Gabor:
    """A tone within a Gaussian: of all bursts the one that is narrowest in time and frequency.

    exp(-t² / 2 sigma²) cos(2 pi f t + phase), with sigma = cycles / (2 pi f), cut at t = ±4 sigma,
    where 0.03 % of the peak are left.  It takes n = round(8 sigma rate) samples, about their
    middle: t = (k - (n - 1) / 2) / rate.  The peak of the formula is 1; no sample need lie on it.
    The phase is wrong by less than 1e-12 rad.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate.  The spectrum is a Gaussian about it, with a
        standard deviation of f / cycles.
    cycles
        0.5 to 10 000; about so many are seen.
    phase_rad
        At the middle: 0 is a crest, -pi / 2 a rising zero.

    References
    ----------
    Gabor, Theory of communication, Journal of the IEE 93(3), 1946.
    """

    title: ClassVar[str] = "Gabor wavelet"

    frequency_hz: float = fields.number(100.0, CENTRE)
    cycles: float = fields.number(4.0, CYCLES)
    phase_rad: float = fields.number(0.0, PHASE)

    def __post_init__(self) -> None:
        fields.check(self)
        refuse_length("Gabor", self.duration_s, "Raise frequency_hz or lower cycles.")

    @property
    def sigma_s(self) -> float:
        """Standard deviation of the Gaussian."""
        return self.cycles / (2.0 * pi * self.frequency_hz)

    @property
    def duration_s(self) -> float:
        """8 sigma."""
        return 8.0 * self.sigma_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        refuse_aliases("frequency_hz", self.frequency_hz, sample_rate_hz)
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        envelope = about_middle(n, sample_rate_hz, shift_s)
        envelope /= self.sigma_s
        np.square(envelope, out=envelope)
        envelope *= -0.5
        found = turns_about_middle(self.frequency_hz, n, sample_rate_hz, shift_s)
        found *= 2.0 * pi
        found += self.phase_rad
        np.cos(found, out=found)
        found *= np.exp(envelope, out=envelope)
        return begun(found, shift_s)
