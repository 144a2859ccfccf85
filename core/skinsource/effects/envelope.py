"""A drawn course of the level."""

from dataclasses import dataclass
from typing import ClassVar

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.breakpoints import curve_at
from skinsource.effects.effect import ON, KeepsTime
from skinsource.effects.places import own_times
from skinsource.fields import Breakpoint, BreakpointsSpec, NumberSpec

TIME = NumberSpec(label="Time", unit="s", minimum=0.0, maximum=3600.0, step=0.001)
VALUE = NumberSpec(label="Level", minimum=0.0, maximum=1000.0, step=0.05)
POINTS = BreakpointsSpec(
    label="Points", x=TIME, y=VALUE, hint="Time after the start, level, and how it goes on"
)
#: One point: as loud as it is.
UNCHANGED: tuple[Breakpoint, ...] = ((0.0, 1.0, "straight"),)


@dataclass(frozen=True, slots=True)
class Envelope(KeepsTime):
    """The level over the time: straight, smooth or held between breakpoints.

    Before the first point it has the level of that, after the last one the level of that; so one
    point is one level throughout.  Two points at one time, or closer than a nanosecond, are a
    jump: the earlier one ends what comes before, from that time on counts the last one.
    Points that go back in time are refused.  A smooth segment is the monotone cubic of Fritsch
    and Carlson: it never passes the levels of its two ends.  Its slope at a point follows from
    the points beside, or is the point's own: so a smooth segment can be split and stay as it is.

    Attributes
    ----------
    points
        (time in s, level from 0 to 1000, ``"straight"``, ``"smooth"`` or ``"held"``) each; the
        third may be left out, and a fourth, the point's own slope in levels per second, be added:
        it is then kept as a `SlopedPoint`, which unpacks as the others do.  Level 1 changes
        nothing.

    References
    ----------
    Fritsch and Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer. Anal. 17, 1980.
    """

    title: ClassVar[str] = "Envelope"

    points: tuple[Breakpoint, ...] = fields.field(POINTS, UNCHANGED)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)

    def values_at(self, times_s: Floats) -> Floats:
        """Levels at own times, of the same shape."""
        return curve_at(self.points, times_s)

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the samples at their levels, (n_times,)."""
        del duration_s
        return samples * self.values_at(own_times(samples.size, sample_rate_hz, shift_s))
