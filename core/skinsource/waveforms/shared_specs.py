"""Field specifications and limits that several waveforms share."""

from typing import Any

import numpy as np

from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, NumberSpec
from skinsource.limb import BAND_HZ

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
    options=(("none", "None"), ("tukey", "Tukey, 25 % taper"), ("hanning", "Hanning")),
    hint="Fades the burst in and out; without one it starts and ends with a click",
)
#: Of a wavelet; lower ones would be longer than any waveform may be.
CENTRE = NumberSpec(
    label="Frequency",
    unit="Hz",
    minimum=0.1,
    maximum=100_000.0,
    step=0.02,
    logarithmic=True,
    below_half_rate=True,
    felt_hz=BAND_HZ,
    hint="Where its spectrum is centred",
)
CYCLES = NumberSpec(
    label="Cycles",
    minimum=0.5,
    maximum=10_000.0,
    step=0.02,
    logarithmic=True,
    hint="How many of them are seen; more last longer and hold a narrower band",
)


def take_lists(recipe: object, *names: str) -> None:
    """Turn lists and arrays in these fields into tuples, as scripts may hand them over."""
    for name in names:
        object.__setattr__(recipe, name, _as_tuples(getattr(recipe, name)))


def _as_tuples(value: Any) -> Any:
    # Two levels: lists within points would be refused, and could be nested without end.
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, list | tuple):
        return value
    return tuple(tuple(part) if isinstance(part, list | np.ndarray) else part for part in value)


def refuse_length(kind: str, duration_s: float, what_next: str) -> None:
    """Refuse a recipe that lasts longer than any waveform may.

    Raises
    ------
    InvalidInputError
        It does; the message says ``what_next``.
    """
    if duration_s > LONGEST_S:
        raise InvalidInputError(
            f"{kind} lasts {duration_s:g} s with these numbers, expected at most {LONGEST_S:g} s. "
            f"{what_next}"
        )
