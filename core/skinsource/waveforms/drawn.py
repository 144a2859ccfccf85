"""A waveform drawn by hand."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.fields import SamplesSpec
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.samples import Samples
from skinsource.signals import window

SAMPLES = SamplesSpec(label="Samples", hint="What was drawn")
#: A single swell of 0.1 s: something to draw on.
SWELL = Samples(values=window("hanning", 130), sample_rate_hz=SAMPLE_RATE_HZ)


@dataclass(frozen=True, slots=True)
class Drawn:
    """Samples as they were drawn; nothing is scaled, 1 is the peak of other waveforms.

    The signal is the band-limited one that the samples describe.  ``samples(sample_rate_hz)``
    gives them bit by bit at their own rate, and otherwise the signal, see `Samples`.

    Attributes
    ----------
    samples
        `Samples` without a unit; of an array or a list at 1300 Hz they are made.
    """

    title: ClassVar[str] = "Drawn"

    samples: Samples = fields.field(SAMPLES, SWELL)

    def __post_init__(self) -> None:
        if isinstance(self.samples, np.ndarray | list | tuple):
            made = Samples(values=np.asarray(self.samples), sample_rate_hz=SAMPLE_RATE_HZ)
            object.__setattr__(self, "samples", made)
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.samples.duration_s
