"""A part of what plays."""

from dataclasses import dataclass
from math import ceil
from typing import ClassVar

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, own_duration_s
from skinsource.fields import NumberSpec
from skinsource.sampling import NEAR, parted

LONGEST_S = 3600.0
START = NumberSpec(
    label="Start", unit="s", minimum=0.0, maximum=LONGEST_S, step=0.005, hint="What plays first"
)
LENGTH = NumberSpec(
    label="Length",
    unit="s",
    minimum=0.0,
    maximum=LONGEST_S,
    step=0.005,
    hint="How much of it plays; more than there is: all that is left",
)


@dataclass(frozen=True, slots=True)
class Trim:
    """A part of what plays, as it is: samples before it and behind it are left out.

    The samples at a time t with ``start_s <= t < start_s + duration_s`` are in it, so that two
    parts of which one ends where the other begins are together what they were cut from; what a
    signal that is no formula has around its ends stays with them.

    Attributes
    ----------
    start_s, duration_s
        Where it begins, and its length; the clip then starts with what was at ``start_s``.
    on
        An effect that is off changes nothing.
    """

    title: ClassVar[str] = "Trim"

    start_s: float = fields.number(0.0, START)
    duration_s: float = fields.number(600.0, LENGTH)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)

    def length(self, duration_s: float) -> float:
        """How long it plays what plays ``duration_s``."""
        return min(self.duration_s, max(duration_s - self.start_s, 0.0))

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes: their time 0 lies ``start_s`` before its own."""
        del duration_s
        _, behind = parted((shift_s - self.start_s) * sample_rate_hz)
        return behind / sample_rate_hz

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the part, (n_after,)."""
        taken_s = self.shift_before(shift_s, 0.0, sample_rate_hz)
        before_s = own_duration_s(samples, sample_rate_hz, taken_s, duration_s)
        length_s = self.length(before_s)
        if length_s == 0.0:
            return samples[:0].copy()
        left_out, _ = parted((shift_s - self.start_s) * sample_rate_hz)
        part = samples[-left_out:].copy()
        if self.start_s > 0.0:
            # Between two samples it starts behind the first.
            part[: shift_s > 0.0] = 0.0
        if (before_s - self.start_s - length_s) * sample_rate_hz > NEAR:
            part = part[: ceil((length_s + shift_s) * sample_rate_hz - NEAR)]
        return part
