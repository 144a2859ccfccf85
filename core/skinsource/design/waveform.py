"""What every waveform can do."""

from collections.abc import Callable
from typing import Any, ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from skinsource.base.errors import InvalidInputError
from skinsource.base.published import BAND_HZ
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec


@runtime_checkable
class Waveform(Protocol):
    """A frozen dataclass that draws itself.

    Attributes
    ----------
    title
        What a user calls this kind.
    """

    title: ClassVar[str]

    @property
    def duration_s(self) -> float:
        """How long it plays."""

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1.

        Parameters
        ----------
        sample_rate_hz
            Any rate; frequencies at or above half of it are refused.
        shift_s
            0 up to one sample, 1 / ``sample_rate_hz``: how much later than sample 0 it starts.
            Sample k shows the recipe at its own time k / ``sample_rate_hz`` - ``shift_s``, and 0
            before its start and after its end, so that a shifted one takes one sample more.

        Raises
        ------
        InvalidInputError
            The rate, or the shift, is none; or the recipe would alias at this rate.
        """


# Which kinds of waveforms there are, for those on whom the table of kinds itself stands.
#
# Clips hold waveforms, and one kind of waveform holds clips: so the table stands above the clips,
# and tells them here what it holds.

Kinds = tuple[type[Waveform], ...]

_tables: list[Callable[[], Kinds]] = []


def tell_kinds(table: Callable[[], Kinds]) -> None:
    """Let ``table`` say from now on which kinds there are."""
    _tables[:] = [table]


def known_kinds() -> Kinds:
    """Every kind of waveform that there is now."""
    return _tables[0]() if _tables else ()


def first_kind() -> Waveform:
    """What is played where nothing is said: the first kind, as it is made."""
    return known_kinds()[0]()


# Field specifications and limits that several waveforms share.

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


def lists_to_tuples(model: object, *names: str) -> None:
    """Turn lists and arrays in these fields into tuples, as scripts may hand them over."""
    for name in names:
        object.__setattr__(model, name, _as_tuples(getattr(model, name)))


def _as_tuples(value: Any) -> Any:
    # Two levels: lists within points would be refused, and could be nested without end.
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, list | tuple):
        return value
    return tuple(tuple(part) if isinstance(part, list | np.ndarray) else part for part in value)


def check_waveform_duration(kind: str, duration_s: float, what_next: str) -> None:
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
