"""What lies in a band."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import scipy

from skinsource import fields
from skinsource.arrays import Complexes, Floats
from skinsource.effects.effect import ON, KeepsTime, own_duration_s
from skinsource.effects.places import silent_outside
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.limb import BAND_HZ

LOW = NumberSpec(
    label="Lowest",
    unit="Hz",
    minimum=0.0,
    maximum=20_000.0,
    step=1.0,
    hint="Lower frequencies are removed; 0: none",
)
HIGH = NumberSpec(
    label="Highest",
    unit="Hz",
    minimum=1.0,
    maximum=24_000.0,
    step=0.02,
    logarithmic=True,
    hint="Higher frequencies are removed",
)
#: Gain falls from 1 to 0 over this part of an edge frequency, outside the band.
SLOPE = 0.2
# The tail of a slope of one hertz has died away after this time.
_TAIL_S_HZ = 6.0


@dataclass(frozen=True, slots=True)
class BandLimit(KeepsTime):
    """Keeps what lies in a band, without moving it in time.

    The gain is 1 from ``low_hz`` to ``high_hz``, and falls as a raised cosine to 0 at 0.8
    ``low_hz`` and 1.2 ``high_hz``; the phase is 0.  What would ring before the start and after the
    end is left out, so that a clip that is cut hard keeps some of what lies outside.

    Attributes
    ----------
    low_hz, high_hz
        Edges; 0 removes nothing below, and an upper edge above half the rate nothing above.
    """

    title: ClassVar[str] = "Band limit"

    # Part of the recipe, whatever the limb: so a file means that says no others.
    low_hz: float = fields.number(BAND_HZ[0], LOW)
    high_hz: float = fields.number(BAND_HZ[1], HIGH)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)
        if self.low_hz >= self.high_hz:
            raise InvalidInputError(
                f"BandLimit.low_hz is {self.low_hz:g}, expected less than high_hz, "
                f"{self.high_hz:g} Hz"
            )

    def gains_at(self, frequencies_hz: Floats) -> Floats:
        """Gain at frequencies, of their shape."""
        found = np.ones(np.shape(frequencies_hz))
        for edge_hz, over_hz in (
            (self.low_hz, self.low_hz - frequencies_hz),
            (self.high_hz, frequencies_hz - self.high_hz),
        ):
            if edge_hz > 0.0:
                share = np.clip(over_hz / (SLOPE * edge_hz), 0.0, 1.0)
                found = found * 0.5 * (1.0 + np.cos(np.pi * share))
        return found

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the samples of the band, (n_times,)."""
        if not samples.size:
            return samples
        length_s = own_duration_s(samples, sample_rate_hz, shift_s, duration_s)
        spectrum, size = self._spectrum(samples, sample_rate_hz)
        gains = self.gains_at(scipy.fft.rfftfreq(size, 1.0 / sample_rate_hz))
        found: Floats = scipy.fft.irfft(spectrum * gains, size)[: samples.size]
        length_s = max(length_s, (samples.size - 1) / sample_rate_hz)
        return silent_outside(found, sample_rate_hz, shift_s, length_s)

    def share_removed(self, samples: Floats, sample_rate_hz: float) -> float:
        """Part of the energy of samples, (n_times,), that lies outside; 0 of silence."""
        if not samples.any():
            return 0.0
        spectrum, size = self._spectrum(samples, sample_rate_hz)
        frequencies_hz = scipy.fft.rfftfreq(size, 1.0 / sample_rate_hz)
        energy = np.abs(spectrum) ** 2
        # All but the first, and the last of an even number, stand for two.
        energy[1 : -1 if size % 2 == 0 else None] *= 2.0
        kept = energy @ self.gains_at(frequencies_hz) ** 2 / energy.sum()
        return float(np.clip(1.0 - kept, 0.0, 1.0))

    def _spectrum(self, samples: Floats, sample_rate_hz: float) -> tuple[Complexes, int]:
        """Spectrum with room for what rings, and its number of samples."""
        edges_hz = [SLOPE * edge_hz for edge_hz in (self.low_hz, self.high_hz) if edge_hz > 0.0]
        tail_s = min(_TAIL_S_HZ / min(edges_hz), 60.0)
        size = scipy.fft.next_fast_len(samples.size + int(tail_s * sample_rate_hz) + 1, real=True)
        return scipy.fft.rfft(samples, size), size
