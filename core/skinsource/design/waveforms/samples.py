"""Waveforms of given samples: drawings, recordings, formulas, and layers of clips."""

from dataclasses import dataclass
from functools import cached_property, lru_cache, reduce
from typing import ClassVar, Literal

import numpy as np

from skinsource.base.conventions import SAMPLE_RATE_HZ, Floats
from skinsource.design.clips import Clip
from skinsource.design.waveform import DURATION
from skinsource.design.waveforms.tones import count_of
from skinsource.signals.formula import reading
from skinsource.signals.generators import window
from skinsource.specs import fields, models
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec, OptionalSpec, SamplesSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec, TextSpec

SAMPLES = SamplesSpec(label="Samples", hint="Drawn samples")
#: A single swell of 0.1 s, with which a drawing starts.
SWELL = Samples(values=window("hanning", 130), sample_rate_hz=SAMPLE_RATE_HZ)


class HoldsSamples:
    """A waveform of given samples."""

    __slots__ = ()

    samples: Samples

    def __post_init__(self) -> None:
        """Convert an array or a list to samples at 1300 Hz, and check the fields."""
        if isinstance(self.samples, np.ndarray | list | tuple):
            samples = Samples(values=np.asarray(self.samples), sample_rate_hz=SAMPLE_RATE_HZ)
            object.__setattr__(self, "samples", samples)
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.samples.duration_s


@dataclass(frozen=True, slots=True)
class Drawn(HoldsSamples):
    """Samples as they were drawn, without scaling; 1 is the peak of other waveforms.

    The signal is the band-limited one that the samples describe.  ``samples(sample_rate_hz)``
    gives them bit by bit at their own rate, and otherwise the signal, see `Samples`.

    Attributes
    ----------
    samples
        `Samples` without a unit; an array or a list is converted, with 1300 Hz.
    """

    title: ClassVar[str] = "Drawn"

    samples: Samples = fields.field(SAMPLES, SWELL)


RECORDING_SAMPLES = SamplesSpec(label="Samples", unit=None, hint="Recorded samples")
NAME = TextSpec(label="Name", longest=200, one_line=True, hint="Source of the recording")
SOURCE_RATE = OptionalSpec(
    label="Recorded at",
    of=NumberSpec(label="Recorded at", unit="Hz", minimum=1e-6, maximum=1e9),
    hint="Sample rate of the file",
)


@dataclass(frozen=True, slots=True)
class Recording(HoldsSamples):
    """Samples of a recording, without scaling, so that the peak is the recorded one.

    The signal is the band-limited one that the samples describe.  ``samples(sample_rate_hz)``
    gives them bit by bit at their own rate, and otherwise the signal, see `Samples`.  Resampling
    a recording with hard ends makes its first and last 0.1 s ring.

    Attributes
    ----------
    samples
        `Samples` of any unit; an array or a list is converted, with 1300 Hz.  The default is a
        swell of 0.1 s.
    name
        Their origin: "tap.wav, channel 1".
    source_rate_hz
        Sample rate of the origin, or ``None`` if it is not known.
    """

    title: ClassVar[str] = "Recording"

    samples: Samples = fields.field(RECORDING_SAMPLES, SWELL)
    name: str = fields.text("", NAME)
    source_rate_hz: float | None = fields.field(SOURCE_RATE, None)


TEXT = TextSpec(
    label="Formula",
    longest=reading.LONGEST,
    one_line=True,
    reader=reading.read,
    hint="Of t in s, such as sin(2*pi*100*t) * hann(). Functions: "
    + ", ".join(function.usage for function in reading.FUNCTIONS.values()),
)
# A new formula is checked over this time at 1300 Hz; the rest is checked when it is played.
_TRIED_S = 10.0


@dataclass(frozen=True, slots=True)
class Formula:
    """A formula for a duration; see `skinsource.signals.formula` for the language.

    It plays as written: the peak of the formula is neither scaled nor limited.  It is a function
    of time alone, sampled at any rate; frequencies above half the rate alias.

    Attributes
    ----------
    text
        The formula, at most 1000 characters: numbers, ``t``, ``pi``, ``duration``, operators,
        comparisons, functions.
    duration_s
        Length.
    """

    title: ClassVar[str] = "Formula"

    text: str = fields.text("sin(2*pi*100*t) * hann()", TEXT)
    duration_s: float = fields.number(0.2, DURATION)

    def __post_init__(self) -> None:
        fields.check(self)
        _try(self.text, self.duration_s)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), as written.

        Raises
        ------
        FormulaError
            A result is not finite.
        """
        count = count_of(self.duration_s, sample_rate_hz, shift_s)
        return _played(self.text, count, sample_rate_hz, shift_s, self.duration_s)


@lru_cache(maxsize=256)
def _try(text: str, duration_s: float) -> None:
    """Raise what `reading.played` raises; the cache serves many clips with the same formula."""
    count = count_of(min(duration_s, _TRIED_S), SAMPLE_RATE_HZ, 0.0)
    _played(text, count, SAMPLE_RATE_HZ, 0.0, duration_s)


def _played(
    text: str, count: int, sample_rate_hz: float, shift_s: float, duration_s: float
) -> Floats:
    return reading.played(reading.read(text), count, sample_rate_hz, shift_s, duration_s)


Mode = Literal["sum", "product"]

#: Most clips in one group; groups can be nested.
MAX_PARTS = 100

PARTS = ListSpec(
    label="Parts",
    of=ModelSpec(label="Clip", kinds=lambda: (Clip,)),
    fewest=1,
    most=MAX_PARTS,
    hint="Clips with their relative onsets",
)
MODE = ChoiceSpec(
    label="Together",
    options=(("sum", "Sum"), ("product", "Product")),
    hint="A product is 0 where any part is silent",
)


@dataclass(frozen=True, slots=True)
class Layers(fields.CheckedModel, models.Nesting):
    r"""Clips that are added up, or multiplied, and played as one; its peak need not be 1.

    .. math:: x(t) = \sum_k g_k x_k(t - t_k) \quad\text{or}\quad \prod_k g_k x_k(t - t_k)

    Each part is sampled at its own instants.  A muted part is left out, but its length counts.

    Attributes
    ----------
    parts
        Clips; their onsets count from the start of the layers.
    mode
        ``"sum"`` or ``"product"``; the product is 0 where a part does not play.
    """

    title: ClassVar[str] = "Layers"

    parts: tuple[Clip, ...] = fields.field(PARTS, factory=lambda: (Clip(),))
    mode: Mode = fields.choice("sum", MODE)

    @cached_property
    def duration_s(self) -> float:
        """Time to the end of the last part."""
        return max(part.end_s for part in self.parts)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); its peak follows from the parts."""
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        placed = [(part.gain, *part.sampled(sample_rate_hz, shift_s)) for part in self._in_order()]
        # Backwards, the first sample comes at the very end.
        n = max([n, *(first + samples.size for _, first, samples in placed)])
        parts = [
            gain * np.pad(samples, (first, n - first - samples.size))
            for gain, first, samples in placed
        ]
        if not parts:
            return np.zeros(n)
        combine = np.multiply if self.mode == "product" else np.add
        return reduce(combine, parts)

    def _in_order(self) -> list[Clip]:
        # The result must not depend on the order of the parts, not even by rounding.
        return sorted(
            (part for part in self.parts if not part.muted),
            key=lambda part: (part.onset_s, part.gain, repr(part)),
        )
