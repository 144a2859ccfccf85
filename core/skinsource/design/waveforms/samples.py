"""A waveform drawn by hand."""

from dataclasses import dataclass
from functools import lru_cache, reduce
from typing import ClassVar, Literal

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.published import SAMPLE_RATE_HZ
from skinsource.design.clips import Clip
from skinsource.design.waveform import DURATION
from skinsource.design.waveforms.tones import count_of
from skinsource.signals.formula import functions, playing, reading
from skinsource.signals.generators import window
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec, OptionalSpec, SamplesSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec, TextSpec

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
            samples = Samples(values=np.asarray(self.samples), sample_rate_hz=SAMPLE_RATE_HZ)
            object.__setattr__(self, "samples", samples)
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.samples.duration_s


# A recording.

RECORDING_SAMPLES = SamplesSpec(label="Samples", unit=None, hint="What was recorded")
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

    samples: Samples = fields.field(RECORDING_SAMPLES, SWELL)
    name: str = fields.text("", NAME)
    source_rate_hz: float | None = fields.field(SOURCE_RATE, None)

    def __post_init__(self) -> None:
        if isinstance(self.samples, np.ndarray | list | tuple):
            samples = Samples(values=np.asarray(self.samples), sample_rate_hz=SAMPLE_RATE_HZ)
            object.__setattr__(self, "samples", samples)
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.samples.duration_s


# A signal that a text describes.

TEXT = TextSpec(
    label="Formula",
    longest=reading.LONGEST,
    one_line=True,
    reader=reading.read,
    hint="Of t in s, such as sin(2*pi*100*t) * hann(). Functions: "
    + ", ".join(function.usage for function in functions.FUNCTIONS.values()),
)
# So much is tried when it is made, at one rate for all limbs; the rest when it is played.
_TRIED_S = 10.0


@dataclass(frozen=True, slots=True)
class Formula:
    """What a text says, for a duration; see `skinsource.signals.formula` for the language.

    It plays as written: its peak is what the formula gives, neither scaled nor limited.
    It is a function of time alone, sampled at any rate; what it holds above half the rate
    folds down, as it does with any formula that is sampled.

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
            A result is no finite number.
        """
        count = count_of(self.duration_s, sample_rate_hz, shift_s)
        return _played(self.text, count, sample_rate_hz, shift_s, self.duration_s)


@lru_cache(maxsize=256)
def _try(text: str, duration_s: float) -> None:
    """Raise what playing it raises; what was tried, as of many clips alike, is good for ever."""
    count = count_of(min(duration_s, _TRIED_S), SAMPLE_RATE_HZ, 0.0)
    _played(text, count, SAMPLE_RATE_HZ, 0.0, duration_s)


def _played(
    text: str, count: int, sample_rate_hz: float, shift_s: float, duration_s: float
) -> Floats:
    return playing.played(reading.read(text), count, sample_rate_hz, shift_s, duration_s)


# Several clips as one waveform.

Mode = Literal["sum", "product"]

#: Clips in one group; groups may stand in groups.
MAX_PARTS = 100

PARTS = ListSpec(
    label="Parts",
    of=ModelSpec(label="Clip", kinds=lambda: (Clip,)),
    fewest=1,
    most=MAX_PARTS,
    hint="Clips, as they lie to each other",
)
MODE = ChoiceSpec(
    label="Together",
    options=(("sum", "Sum"), ("product", "Product")),
    hint="A product is 0 where one of the parts does not play",
)


@dataclass(frozen=True, slots=True)
class Layers:
    r"""Clips that are added up, or multiplied, and played as one; its peak need not be 1.

    .. math:: x(t) = \sum_k g_k x_k(t - t_k) \quad\text{or}\quad \prod_k g_k x_k(t - t_k)

    Each part is sampled at its own instants.  A muted one takes no part, but its length counts.

    Attributes
    ----------
    parts
        Clips; their onsets count from the start of the whole.
    mode
        ``"sum"`` or ``"product"``; the product is 0 where a part does not play.
    """

    title: ClassVar[str] = "Layers"

    parts: tuple[Clip, ...] = fields.field(PARTS, factory=lambda: (Clip(),))
    mode: Mode = fields.choice("sum", MODE)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """To the end of the last part."""
        return max(part.end_s for part in self.parts)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); its peak follows from the parts."""
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        parts = [self._placed(part, n, sample_rate_hz, shift_s) for part in self._in_order()]
        if not parts:
            return np.zeros(n)
        combine = np.multiply if self.mode == "product" else np.add
        total: Floats = reduce(combine, parts)
        return total

    def _in_order(self) -> list[Clip]:
        # The order in which they are listed plays no part, not even for rounding.
        return sorted(
            (part for part in self.parts if not part.muted),
            key=lambda part: (part.onset_s, part.gain, repr(part)),
        )

    def _placed(self, part: Clip, n: int, sample_rate_hz: float, shift_s: float) -> Floats:
        first, samples = part.sampled(sample_rate_hz, shift_s)
        aligned = np.zeros(n)
        within = samples[: max(n - first, 0)]
        aligned[first : first + within.size] = part.gain * within
        return aligned
