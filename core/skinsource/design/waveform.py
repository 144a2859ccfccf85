"""The protocol of waveforms, and field specifications and checks that several of them share.

Clips hold waveforms, and `Layers` is a waveform that holds clips.  So the table of waveforms
imports the clips, and `known_kinds` imports the table when it is called.
"""

import importlib
from typing import Any, ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from skinsource.base.conventions import BAND_HZ
from skinsource.base.errors import InvalidInputError
from skinsource.signals.generators import OTHER_NAMES
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec


@runtime_checkable
class Waveform(Protocol):
    """A frozen dataclass that computes its samples; ``title`` names its kind for the user."""

    title: ClassVar[str]

    @property
    def duration_s(self) -> float:
        """Length of the waveform."""

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1.

        Parameters
        ----------
        sample_rate_hz
            Any rate; frequencies at or above half of it are an error.
        shift_s
            Delay of the start after sample 0, 0 up to one sample, 1 / ``sample_rate_hz``.  Sample
            k lies at the own time k / ``sample_rate_hz`` - ``shift_s``; before the start and after
            the end samples are 0, so that a shifted waveform has one sample more.

        Raises
        ------
        InvalidInputError
            The rate or the shift is not allowed, or the waveform would alias at this rate.
        """


Kinds = tuple[type[Waveform], ...]


def known_kinds() -> Kinds:
    """Return every kind of waveform."""
    return importlib.import_module("skinsource.design.waveforms").kinds()


def first_kind() -> Waveform:
    """Return the default waveform: the first kind, with its defaults."""
    return known_kinds()[0]()


#: Longest waveform, in s.
LONGEST_S = 600.0

DURATION = NumberSpec(
    label="Duration",
    unit="s",
    minimum=0.001,
    maximum=LONGEST_S,
    step=0.01,
    hint="Length of the burst",
)
WINDOW = ChoiceSpec(
    label="Window",
    options=(("none", "None"), ("tukey", "Tukey, 25 % taper"), ("hanning", "Hann")),
    other_names=tuple(OTHER_NAMES.items()),
    hint="Fades the burst in and out; without it the ends click",
)
#: Frequency of a wavelet; lower ones would be longer than the longest waveform.
CENTRE = NumberSpec(
    label="Frequency",
    unit="Hz",
    minimum=0.1,
    maximum=100_000.0,
    step=0.02,
    logarithmic=True,
    below_half_rate=True,
    measured_band_hz=BAND_HZ,
    hint="Centre of the spectrum",
)
CYCLES = NumberSpec(
    label="Cycles",
    minimum=0.5,
    maximum=10_000.0,
    step=0.02,
    logarithmic=True,
    hint="Number of visible cycles; more cycles narrow the band",
)


def lists_to_tuples(model: object, *names: str) -> None:
    """Convert lists and arrays in these fields, which scripts may pass, to tuples."""
    for name in names:
        object.__setattr__(model, name, _as_tuples(getattr(model, name)))


def _as_tuples(value: Any) -> Any:
    # Two levels are enough; deeper lists are refused later, and could be nested without end.
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, list | tuple):
        return value
    return tuple(tuple(part) if isinstance(part, list | np.ndarray) else part for part in value)


def check_waveform_duration(kind: str, duration_s: float, what_next: str) -> None:
    """Check that a waveform is not longer than the longest one allowed.

    Raises
    ------
    InvalidInputError
        It is longer; the message ends with ``what_next``.
    """
    if duration_s > LONGEST_S:
        raise InvalidInputError(
            f"{kind} lasts {duration_s:g} s with these numbers, expected at most {LONGEST_S:g} s. "
            f"{what_next}"
        )
