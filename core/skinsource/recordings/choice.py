"""What is taken of a foreign file, and what becomes of it."""

from dataclasses import dataclass
from typing import Literal, get_args

from skinsource.arguments import one_of, positive_number, real_number
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.recordings import limits
from skinsource.recordings.found import Found, Series
from skinsource.recordings.units import UNITS

#: What becomes of the size: the largest number becomes 1, or all stays as it is.
Scale = Literal["peak", "keep"]
#: What becomes of numbers that are not there: nothing is taken, or they count as 0.
Missing = Literal["refuse", "zero"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportChoice:
    """One signal of a file, what it means, and which part of it is wanted.

    Attributes
    ----------
    series
        Key of the signal.
    rate_hz
        Samples a second; None: as the time stamps say.
    time
        Key of the time stamps; None: there are none, or they do not count.
    time_unit_s
        What one of them is in seconds.
    unit
        One of `skinsource.recordings.units.UNITS`.
    scale
        ``"peak"``: a drive of peak 1; ``"keep"``: the size it has, accelerations in m/s².  See
        `usual_scale`.
    remove_offset
        Whether the mean of the part is taken off.
    start_s, duration_s
        The part, from the first sample of the file on; at most 600 s.
    missing
        What becomes of numbers that are not there.
    others
        Keys of the two other axes of the same movement: the three become one signal, see
        `skinsource.recordings.three_axes.dft321`; none: the signal alone.
    """

    series: str
    rate_hz: float | None = None
    time: str | None = None
    time_unit_s: float = 1.0
    unit: str = "full scale"
    scale: Scale = "peak"
    remove_offset: bool = True
    start_s: float = 0.0
    duration_s: float = limits.MOST_PART_S
    missing: Missing = "refuse"
    others: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.rate_hz is not None:
            least, most = limits.LEAST_RATE_HZ, limits.MOST_RATE_HZ
            expected = f"a rate from {least:g} to {most:g} Hz"
            real_number("rate_hz", self.rate_hz, expected, least=least, most=most)
        positive_number("time_unit_s", self.time_unit_s)
        one_of("unit", self.unit, tuple(UNITS))
        one_of("scale", self.scale, get_args(Scale))
        one_of("missing", self.missing, get_args(Missing))
        real_number("start_s", self.start_s, "a time of 0 or more", least=0.0, most=1e9)
        positive_number("duration_s", self.duration_s)
        most = limits.MOST_PART_S
        real_number("duration_s", self.duration_s, f"a time of up to {most:g} s", most=most)
        three = {self.series, *self.others}
        if self.others and (len(self.others) != 2 or len(three) != 3):
            raise InvalidInputError(
                f"others are {quoted(self.others)}, expected the keys of the two other axes; name "
                "two different ones, or none"
            )


def usual_scale(unit: str) -> Scale:
    """What is likely to be wanted of a unit: a physical one keeps its size, full scale has none."""
    return "keep" if UNITS[unit].becomes else "peak"


def suggested(found: Found, series: Series | None = None) -> ImportChoice:
    """What is likely to be wanted: the first signal of a file, as far as the file describes it."""
    one = series or found.signals()[0]
    stated = found.rate_of(one)
    stamps = found.time_of(one)
    unit = one.unit or "full scale"
    return ImportChoice(
        series=one.key,
        rate_hz=stated if stamps is None else None,
        time=stamps.key if stamps else None,
        time_unit_s=stamps.time_unit_s if stamps else 1.0,
        unit=unit,
        scale=usual_scale(unit),
    )
