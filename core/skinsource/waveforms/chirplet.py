"""A tone within a Gaussian whose frequency rises or falls."""

from dataclasses import dataclass
from decimal import Decimal, localcontext
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.sampling import shift_of
from skinsource.signals import sample_count
from skinsource.synthesis.bent_turns import DIGITS, bent_turns
from skinsource.synthesis.burst import refuse_aliases
from skinsource.synthesis.centred import about_middle, begun
from skinsource.waveforms.shared_specs import CENTRE

SLOPE = NumberSpec(
    label="Slope",
    unit="Hz/s",
    minimum=-1e6,
    maximum=1e6,
    step=50.0,
    hint="How fast the frequency rises; a negative slope falls",
)
SIGMA = NumberSpec(
    label="Sigma",
    unit="s",
    minimum=0.001,
    maximum=60.0,
    step=0.02,
    logarithmic=True,
    hint="Standard deviation of its Gaussian; it lasts eight of them",
)
#: Beyond so many standard deviations lies half a per cent of the energy.
_HEARD = 2.0


@dataclass(frozen=True, slots=True)
class Chirplet:
    """A tone within a Gaussian whose frequency rises or falls evenly.

    exp(-t² / 2 sigma²) cos(2 pi (f t + c t² / 2)), whose frequency at t is f + c t, cut at
    t = ±4 sigma.  It takes n = round(8 sigma rate) samples, about their middle:
    t = (k - (n - 1) / 2) / rate.  The peak of the formula is 1; no sample need lie on it.  The
    phase is wrong by less than 1e-12 rad.

    Attributes
    ----------
    frequency_hz
        f, 0.1 Hz up to below half the sample rate, as all that it plays within 2 sigma has to be.
    rate_hz_per_s
        c, up to ±1e6 Hz/s.
    sigma_s
        1 ms to 60 s.

    References
    ----------
    Mann and Haykin, The chirplet transform: physical considerations, IEEE Transactions on Signal
    Processing 43(11), 1995.
    """

    title: ClassVar[str] = "Chirplet"

    frequency_hz: float = fields.number(150.0, CENTRE)
    rate_hz_per_s: float = fields.number(1500.0, SLOPE)
    sigma_s: float = fields.number(0.03, SIGMA)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """8 sigma."""
        return 8.0 * self.sigma_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        refuse_aliases("frequency_hz", self.frequency_hz, sample_rate_hz)
        highest_hz = self.frequency_hz + abs(self.rate_hz_per_s) * _HEARD * self.sigma_s
        if highest_hz >= sample_rate_hz / 2:
            raise InvalidInputError(
                f"rate_hz_per_s is {self.rate_hz_per_s:g}: within 2 sigma the frequency reaches "
                f"{highest_hz:g} Hz, expected less than {sample_rate_hz / 2:g} Hz (half the sample "
                "rate); lower the slope, sigma_s or frequency_hz"
            )
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.duration_s, sample_rate_hz)
        time_s = about_middle(n, sample_rate_hz, shift_s)
        with localcontext(prec=DIGITS):
            first = Decimal(1 - n) / (2 * Decimal(sample_rate_hz)) - Decimal(shift_s)
        phase = bent_turns(
            Decimal(0),
            Decimal(self.frequency_hz),
            Decimal(self.rate_hz_per_s),
            first,
            time_s.size,
            sample_rate_hz,
        )
        envelope = np.exp(-0.5 * np.square(time_s / self.sigma_s))
        return begun(envelope * np.cos(2.0 * pi * phase), shift_s)
