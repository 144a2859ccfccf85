"""A tone that swings up and down."""

from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import NumberSpec
from skinsource.signals import WindowName
from skinsource.synthesis.burst import burst, refuse_aliases
from skinsource.waveforms.amplitude_modulated import CARRIER, MODULATOR, MODULATOR_PHASE
from skinsource.waveforms.instants import count_of, turns
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.tone import PHASE

DEVIATION = NumberSpec(
    label="Deviation",
    unit="Hz",
    minimum=0.0,
    maximum=100_000.0,
    step=5.0,
    hint="How far the frequency swings to either side of the carrier",
)


@dataclass(frozen=True, slots=True)
class FrequencyModulated:
    """A tone whose frequency is modulated by a sine.

    sin(2 pi carrier t + phase + (deviation / modulator) (sin(2 pi modulator t + modulator phase)
    - sin(modulator phase))): the frequency is carrier + deviation cos(2 pi modulator t +
    modulator phase).  The lines beside the carrier, one modulator apart, have no end: by Carson's
    rule 98 % of the energy lie within deviation + modulator of it, and what lies at or above half
    the sample rate folds down, as with the formula sampled.

    Attributes
    ----------
    carrier_hz, modulator_hz, deviation_hz
        Frequency, swings per second, and how far they go; carrier + deviation, the highest
        frequency that it passes, must be below half the sample rate.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad, modulator_phase_rad
        Phases at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.

    References
    ----------
    Carson, Notes on the theory of modulation, Proceedings of the IRE 10(1), 1922.
    """

    title: ClassVar[str] = "Frequency modulated"

    carrier_hz: float = fields.number(200.0, CARRIER)
    modulator_hz: float = fields.number(20.0, replace(MODULATOR, hint="Swings per second"))
    deviation_hz: float = fields.number(50.0, DEVIATION)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    modulator_phase_rad: float = fields.number(
        0.0, replace(MODULATOR_PHASE, hint="Phase of the modulator at onset; 0 begins highest")
    )
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        refuse_aliases("carrier_hz", self.carrier_hz, sample_rate_hz)
        refuse_aliases("modulator_hz", self.modulator_hz, sample_rate_hz)
        highest_hz = self.carrier_hz + self.deviation_hz
        refuse_aliases("carrier_hz + deviation_hz", highest_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        swing = turns(self.modulator_hz, n, sample_rate_hz, shift_s)
        # Of a small angle the sine is more exact, and the deviation may multiply it by thousands.
        swing -= np.rint(swing)
        swing *= 2.0 * pi
        swing += self.modulator_phase_rad
        np.sin(swing, out=swing)
        swing -= np.sin(self.modulator_phase_rad)
        swing *= self.deviation_hz / self.modulator_hz
        found = turns(self.carrier_hz, n, sample_rate_hz, shift_s)
        found *= 2.0 * pi
        found += self.phase_rad
        found += swing
        return burst(np.sin(found, out=found), self.window, sample_rate_hz, shift_s)
