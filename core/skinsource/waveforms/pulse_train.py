"""Pulses at a steady rate."""

from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.arrays import Complexes, Floats
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.signals import WindowName
from skinsource.synthesis.burst import burst, refuse_aliases
from skinsource.synthesis.harmonics import sampled_series
from skinsource.waveforms.instants import count_of
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.square import FUNDAMENTAL
from skinsource.waveforms.tone import PHASE

RATE = replace(FUNDAMENTAL, label="Rate", felt_hz=None, hint="Pulses per second")
PULSE = NumberSpec(
    label="Pulse",
    unit="s",
    minimum=1e-6,
    maximum=0.99,
    step=0.05,
    logarithmic=True,
    hint="Length of each pulse; shorter than the time from one to the next",
)


@dataclass(frozen=True, slots=True)
class PulseTrain:
    """Rectangular pulses without aliases: 1 for the first part of each period, then 0.

    Their Fourier series, d + sum of (2 / pi h) sin(pi h d) cos(2 pi h (u - d / 2)) at the turn
    u = rate t + phase / 2 pi, up to half the sample rate; d = rate times pulse.  What has peak 1
    is the full series: cut off, it passes 1 and 0 beside each edge (Gibbs), and pulses shorter
    than two samples are lower, since only part of them lies in the band.  Its harmonics are the
    same at every rate.  The burst is cut out of it with hard ends, or by the window.

    Attributes
    ----------
    rate_hz
        Pulses per second, 1 up to below half the sample rate.
    pulse_s
        Length of a pulse, 1 µs up to below 1 / ``rate_hz``.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad
        Phase at onset; 0 is the start of a pulse.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Pulse train"

    rate_hz: float = fields.number(40.0, RATE)
    pulse_s: float = fields.number(0.004, PULSE)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self._duty < 1.0:
            raise InvalidInputError(
                f"PulseTrain.pulse_s is {self.pulse_s:g}, expected less than "
                f"{1.0 / self.rate_hz:g} s, the time from one pulse to the next; shorten it or "
                "lower rate_hz"
            )

    @property
    def _duty(self) -> float:
        return self.rate_hz * self.pulse_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,); 1 is the height of the pulses without limit of their band."""
        refuse_aliases("rate_hz", self.rate_hz, sample_rate_hz)
        found = sampled_series(
            self._series,
            self.rate_hz,
            self.phase_rad,
            count_of(self.duration_s, sample_rate_hz, shift_s),
            sample_rate_hz,
            shift_s,
            mean=self._duty,
        )
        return burst(found, self.window, sample_rate_hz, shift_s)

    def _series(self, harmonics: Floats) -> Complexes:
        half = pi * np.remainder(harmonics * self._duty, 2.0)
        turned: Complexes = np.exp(-1j * half)
        return turned * (2.0 / (pi * harmonics) * np.sin(half))
