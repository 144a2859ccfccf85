"""A recording."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.fields import NumberSpec, OptionalSpec, SamplesSpec, TextSpec
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.samples import Samples
from skinsource.waveforms.drawn import SWELL

SAMPLES = SamplesSpec(label="Samples", unit=None, hint="What was recorded")
NAME = TextSpec(label="Name", longest=200, one_line=True, hint="Where it comes from")
SOURCE_RATE = OptionalSpec(
    label="Recorded at",
    of=NumberSpec(label="Recorded at", unit="Hz", minimum=1e-6, maximum=1e9),
    hint="Sample rate of the file",
)


@dataclass(frozen=True, slots=True)
class Recording:
    """Samples that something else made; nothing is scaled, so the peak is what was recorded.

    The signal is the band-limited one that the samples describe.  ``samples(sample_rate_hz)``
    gives them bit by bit at their own rate, and otherwise the signal, see `Samples`.  Where it is
    cut off hard, resampling lets the first and last 0.1 s ring.

    Attributes
    ----------
    samples
        `Samples` of any unit; of an array or a list at 1300 Hz they are made.  To begin with,
        a swell of 0.1 s stands for them.
    name
        Where they come from: "tap.wav, channel 1".
    source_rate_hz
        Sample rate that they had there, or ``None`` where nobody knows.
    """

    title: ClassVar[str] = "Recording"

    samples: Samples = fields.field(SAMPLES, SWELL)
    name: str = fields.text("", NAME)
    source_rate_hz: float | None = fields.field(SOURCE_RATE, None)

    def __post_init__(self) -> None:
        if isinstance(self.samples, np.ndarray | list | tuple):
            made = Samples(values=np.asarray(self.samples), sample_rate_hz=SAMPLE_RATE_HZ)
            object.__setattr__(self, "samples", made)
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.samples.duration_s
