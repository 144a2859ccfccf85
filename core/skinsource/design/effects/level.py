"""Effects on the level of samples: envelopes, fades, rectifying, soft clipping, band limits."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import scipy

from skinsource.base.conventions import BAND_HZ, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.breakpoints import curve_at
from skinsource.design.effects.effect import ON, KeepsTime, TimedEffect
from skinsource.design.effects.playing import own_times, silent_outside
from skinsource.specs import fields
from skinsource.specs.breakpoints import Breakpoint, BreakpointsSpec
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

TIME = NumberSpec(label="Time", unit="s", minimum=0.0, maximum=3600.0, step=0.001)
VALUE = NumberSpec(label="Level", minimum=0.0, maximum=1000.0, step=0.05)
POINTS = BreakpointsSpec(
    label="Points", x=TIME, y=VALUE, hint="Time, level, and shape of the next segment"
)
#: An envelope that changes nothing.
UNCHANGED: tuple[Breakpoint, ...] = ((0.0, 1.0, "straight"),)


@dataclass(frozen=True, slots=True)
class Envelope(KeepsTime, TimedEffect):
    """The level over the time: straight, smooth or held between breakpoints.

    Before the first point the level is that of the first, after the last point that of the last;
    so a single point is a constant level.  Two points at one time, or closer than a nanosecond,
    are a jump: the first one ends the segment before, the last one begins the next.  Points that
    go back in time are refused.  A smooth segment is the monotone cubic of Fritsch and Carlson,
    which never passes the levels of its two ends.  Its slope at a point follows from the
    neighbouring points, or is the point's own, so that splitting a segment does not change it.

    Attributes
    ----------
    points
        (time in s, level from 0 to 1000, ``"straight"``, ``"smooth"`` or ``"held"``) each; the
        third may be left out.  A fourth is the point's own slope in levels per second; such a point
        becomes a `SlopedPoint`, which unpacks as the others do.  Level 1 changes nothing.

    References
    ----------
    Fritsch and Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer. Anal. 17, 1980.
    """

    title: ClassVar[str] = "Envelope"

    points: tuple[Breakpoint, ...] = fields.field(POINTS, UNCHANGED)
    on: bool = fields.switch(True, ON)

    def values_at(self, times_s: Floats) -> Floats:
        """Return the levels at own times, of the same shape."""
        return curve_at(self.points, times_s)

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        return samples * self.values_at(own_times(samples.size, rate_hz, shift_s))


LENGTH = NumberSpec(
    label="Fade in", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="From 0 to full level"
)
OUT = replace(LENGTH, label="Fade out", hint="To 0 at the end")
SHAPE = ChoiceSpec(
    label="Shape",
    options=(("straight", "Straight"), ("smooth", "Smooth"), ("equal power", "Equal power")),
    hint="Equal power: uncorrelated clips keep their energy in a crossfade",
)

# A shorter fade is none.
_SHORTEST_S = 1e-9


@dataclass(frozen=True, slots=True)
class Fade(KeepsTime, TimedEffect):
    """Fades in from 0 at the start, and out to 0 at the end.

    The level at the share u of a fade, 0 at its silent end, is u (``"straight"``),
    (1 - cos(pi u)) / 2 (``"smooth"``), or sin(pi u / 2) (``"equal power"``: the power of two clips
    that cross stays constant).  Fades that are together longer than the clip are shortened by the
    same factor, and meet.

    Attributes
    ----------
    in_s, out_s
        Lengths of the fades; 0: none.
    """

    title: ClassVar[str] = "Fade"

    in_s: float = fields.number(0.01, LENGTH)
    out_s: float = fields.number(0.01, OUT)
    shape: str = fields.choice("smooth", SHAPE)
    on: bool = fields.switch(True, ON)

    def values_at(self, times_s: Floats, duration_s: float) -> Floats:
        """Return the levels at own times of a clip of ``duration_s``, of the shape of the times."""
        total_s = self.in_s + self.out_s
        fits = min(1.0, duration_s / total_s) if total_s else 1.0
        levels = np.ones(np.shape(times_s))
        for length, since in (
            (self.in_s * fits, times_s),
            (self.out_s * fits, duration_s - times_s),
        ):
            if length > _SHORTEST_S:
                levels = levels * self._level(np.clip(since / length, 0.0, 1.0))
        return levels

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        return samples * self.values_at(own_times(samples.size, rate_hz, shift_s), own_s)

    def _level(self, share: Floats) -> Floats:
        if self.shape == "straight":
            return share
        if self.shape == "smooth":
            return 0.5 * (1.0 - np.cos(np.pi * share))
        return np.sin(0.5 * np.pi * share)


WAVE = ChoiceSpec(
    label="Wave",
    options=(("full", "Full wave"), ("half", "Half wave")),
    hint="Full: negative values become positive; half: they become 0",
)


@dataclass(frozen=True, slots=True)
class Rectify(KeepsTime, TimedEffect):
    """Turns up what is below 0 (``"full"``, |x|), or leaves it out (``"half"``, max(x, 0)).

    A tone gets a mean above 0 and even harmonics; a `BandLimit` after it removes what lies outside
    the measured band.

    Attributes
    ----------
    wave
        ``"full"`` or ``"half"``.
    """

    title: ClassVar[str] = "Rectify"

    wave: str = fields.choice("full", WAVE)
    on: bool = fields.switch(True, ON)

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        return np.abs(samples) if self.wave == "full" else np.maximum(samples, 0.0)


DRIVE = NumberSpec(
    label="Drive",
    minimum=0.01,
    maximum=1000.0,
    step=0.05,
    logarithmic=True,
    hint="Gain of the weak parts of the signal",
)
LEVEL = NumberSpec(
    label="Level",
    minimum=1e-6,
    maximum=1000.0,
    step=0.05,
    logarithmic=True,
    hint="Largest value after clipping",
)


@dataclass(frozen=True, slots=True)
class SoftClip(KeepsTime, TimedEffect):
    """Limits to a level without a corner: level tanh(drive x / level).

    Attributes
    ----------
    drive
        Gain of small samples.
    level
        Largest possible magnitude of the result.
    """

    title: ClassVar[str] = "Soft clip"

    drive: float = fields.number(2.0, DRIVE)
    level: float = fields.number(1.0, LEVEL)
    on: bool = fields.switch(True, ON)

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        return self.level * np.tanh(samples * (self.drive / self.level))


LOW = NumberSpec(
    label="Lowest",
    unit="Hz",
    minimum=0.0,
    maximum=20_000.0,
    step=1.0,
    hint="Lower frequencies are removed; 0: none",
)
HIGH = NumberSpec(
    label="Highest",
    unit="Hz",
    minimum=1.0,
    maximum=24_000.0,
    step=0.02,
    logarithmic=True,
    hint="Higher frequencies are removed",
)
#: The gain falls from 1 to 0 outside the band, within this share of the edge frequency.
SLOPE = 0.2
# The ringing of a slope of one hertz has died away after this time.
_TAIL_S_HZ = 6.0


@dataclass(frozen=True, slots=True)
class BandLimit(KeepsTime, TimedEffect):
    """Keeps what lies in a band, without moving it in time.

    The gain is 1 from ``low_hz`` to ``high_hz``, and falls as a raised cosine to 0 at 0.8
    ``low_hz`` and 1.2 ``high_hz``; the phase is 0.  Ringing before the start and after the end is
    cut off, so that a clip with hard ends keeps some frequencies outside the band.

    Attributes
    ----------
    low_hz, high_hz
        Edges of the band; 0 removes no low frequencies, and an upper edge above half the sample
        rate removes no high ones.
    """

    title: ClassVar[str] = "Band limit"

    # The defaults are the same for every limb, because files leave defaults out.
    low_hz: float = fields.number(BAND_HZ[0], LOW)
    high_hz: float = fields.number(BAND_HZ[1], HIGH)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)
        if self.low_hz >= self.high_hz:
            raise InvalidInputError(
                f"BandLimit.low_hz is {self.low_hz:g}, expected less than high_hz, "
                f"{self.high_hz:g} Hz"
            )

    def gains_at(self, frequencies_hz: Floats) -> Floats:
        """Return the gains at frequencies, of their shape."""
        gains = np.ones(np.shape(frequencies_hz))
        for edge_hz, over_hz in (
            (self.low_hz, self.low_hz - frequencies_hz),
            (self.high_hz, frequencies_hz - self.high_hz),
        ):
            if edge_hz > 0.0:
                share = np.clip(over_hz / (SLOPE * edge_hz), 0.0, 1.0)
                gains = gains * 0.5 * (1.0 + np.cos(np.pi * share))
        return gains

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        spectrum, size = self._spectrum(samples, rate_hz)
        gains = self.gains_at(scipy.fft.rfftfreq(size, 1.0 / rate_hz))
        limited: Floats = scipy.fft.irfft(spectrum * gains, size)[: samples.size]
        length_s = max(own_s, (samples.size - 1) / rate_hz)
        return silent_outside(limited, rate_hz, shift_s, length_s)

    def share_removed(self, samples: Floats, sample_rate_hz: float) -> float:
        """Return the share of the energy of samples, (n_times,), that lies outside the band."""
        if not samples.any():
            return 0.0
        spectrum, size = self._spectrum(samples, sample_rate_hz)
        frequencies_hz = scipy.fft.rfftfreq(size, 1.0 / sample_rate_hz)
        energy = np.abs(spectrum) ** 2
        # All bins count twice except the first, and the last if their number is even.
        energy[1 : -1 if size % 2 == 0 else None] *= 2.0
        share_inside = energy @ self.gains_at(frequencies_hz) ** 2 / energy.sum()
        return float(np.clip(1.0 - share_inside, 0.0, 1.0))

    def _spectrum(self, samples: Floats, sample_rate_hz: float) -> tuple[Complexes, int]:
        """Return a spectrum with room for the ringing, and its number of samples."""
        edges_hz = [SLOPE * edge_hz for edge_hz in (self.low_hz, self.high_hz) if edge_hz > 0.0]
        tail_s = min(_TAIL_S_HZ / min(edges_hz), 60.0)
        size = scipy.fft.next_fast_len(samples.size + int(tail_s * sample_rate_hz) + 1, real=True)
        return scipy.fft.rfft(samples, size), size
