"""A sine that dies away."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import NumberSpec
from skinsource.signals import WindowName
from skinsource.synthesis.burst import burst, refuse_aliases
from skinsource.waveforms.instants import count_of, instants, turns
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.tone import FREQUENCY, PHASE

DECAY = NumberSpec(
    label="Decay",
    unit="s",
    minimum=0.0001,
    maximum=60.0,
    step=0.05,
    logarithmic=True,
    hint="Time in which it falls to 37 %; 5 to 30 ms feel like a touch on something hard",
)


@dataclass(frozen=True, slots=True)
class DampedSine:
    """A sine with an exponential decay, as of something that is struck.

    exp(-t / decay) sin(2 pi frequency t + phase).  What has peak 1 is the decay: it starts at 1,
    and the first crest, a quarter of a period later, is lower.

    Attributes
    ----------
    frequency_hz
        0.01 Hz up to below half the sample rate.
    decay_s
        Time constant, 0.1 ms to 60 s.
    duration_s
        Length, 0.001 to 600 s; what is left then is cut off.
    phase_rad
        Phase at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``, over the decay.

    References
    ----------
    Okamura, Cutkosky and Dennerlein, Reality-based models for vibration feedback in virtual
    environments, IEEE/ASME Transactions on Mechatronics 6(3), 2001.
    """

    title: ClassVar[str] = "Damped sine"

    frequency_hz: float = fields.number(100.0, FREQUENCY)
    decay_s: float = fields.number(0.03, DECAY)
    duration_s: float = fields.number(0.2, DURATION)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), that stays below its decay of peak 1."""
        refuse_aliases("frequency_hz", self.frequency_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        found = turns(self.frequency_hz, n, sample_rate_hz, shift_s)
        found *= 2.0 * pi
        found += self.phase_rad
        np.sin(found, out=found)
        decay = instants(self.duration_s, sample_rate_hz, shift_s)
        decay /= -self.decay_s
        found *= np.exp(decay, out=decay)
        return burst(found, self.window, sample_rate_hz, shift_s)
