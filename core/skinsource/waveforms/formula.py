"""A signal that a text describes."""

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

from skinsource import fields, formula
from skinsource.arrays import Floats
from skinsource.fields import TextSpec
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.waveforms.instants import count_of
from skinsource.waveforms.shared_specs import DURATION

TEXT = TextSpec(
    label="Formula",
    longest=formula.LONGEST,
    one_line=True,
    reader=formula.read,
    hint="Of t in s, such as sin(2*pi*100*t) * hann(). Functions: "
    + ", ".join(function.usage for function in formula.FUNCTIONS.values()),
)
# So much is tried when it is made, at one rate for all limbs; the rest when it is played.
_TRIED_S = 10.0


@dataclass(frozen=True, slots=True)
class Formula:
    """What a text says, for a duration; see `skinsource.formula` for the language.

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
    return formula.played(formula.read(text), count, sample_rate_hz, shift_s, duration_s)
