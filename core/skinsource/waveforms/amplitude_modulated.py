"""A tone that swells and fades."""

from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import NumberSpec
from skinsource.signals import WindowName
from skinsource.synthesis.burst import burst, refuse_aliases
from skinsource.waveforms.instants import count_of, turns
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.tone import FREQUENCY, PHASE

CARRIER = replace(FREQUENCY, label="Carrier")
MODULATOR = replace(
    FREQUENCY, label="Modulator", minimum=0.1, felt_hz=None, hint="How often it swells per second"
)
DEPTH = NumberSpec(
    label="Depth", minimum=0.0, maximum=1.0, step=0.01, hint="1: down to silence; 0: a plain tone"
)
MODULATOR_PHASE = replace(
    PHASE, label="Modulator phase", hint="Phase of the modulator at onset; π begins at the quietest"
)


@dataclass(frozen=True, slots=True)
class AmplitudeModulated:
    """A tone whose amplitude is modulated by a sine.

    (1 + depth cos(2 pi modulator t + modulator phase)) / (1 + depth)
    sin(2 pi carrier t + phase): three lines, at the carrier and one modulator below and above.
    Its loudest moments have peak 1.

    Attributes
    ----------
    carrier_hz, modulator_hz
        Frequencies; their sum must be below half the sample rate.
    depth
        0 to 1.
    duration_s
        Length, 0.001 to 600 s.
    phase_rad, modulator_phase_rad
        Phases at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.
    """

    title: ClassVar[str] = "Amplitude modulated"

    carrier_hz: float = fields.number(200.0, CARRIER)
    modulator_hz: float = fields.number(20.0, MODULATOR)
    depth: float = fields.number(1.0, DEPTH)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    modulator_phase_rad: float = fields.number(0.0, MODULATOR_PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        refuse_aliases("carrier_hz", self.carrier_hz, sample_rate_hz)
        if self.depth:
            highest_hz = self.carrier_hz + self.modulator_hz
            refuse_aliases("carrier_hz + modulator_hz", highest_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        found = turns(self.carrier_hz, n, sample_rate_hz, shift_s)
        found *= 2.0 * pi
        found += self.phase_rad
        np.sin(found, out=found)
        swell = turns(self.modulator_hz, n, sample_rate_hz, shift_s)
        swell *= 2.0 * pi
        swell += self.modulator_phase_rad
        np.cos(swell, out=swell)
        swell *= self.depth
        swell += 1.0
        found *= swell
        found /= 1.0 + self.depth
        return burst(found, self.window, sample_rate_hz, shift_s)
