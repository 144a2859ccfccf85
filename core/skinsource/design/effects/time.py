"""Effects on the time of samples: repeating, reversing, stretching and trimming."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, floor
from typing import ClassVar

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.design.effects.effect import ON, Effect, KeepsTime, TimedEffect, stretched_in_time
from skinsource.design.effects.playing import (
    check_duration,
    own_times,
    part_of_sample,
    samples_until,
    silent_outside,
)
from skinsource.signals.generators import sample_count
from skinsource.signals.sampling import NEAR, band_limited_delay, sample_and_rest, values_between
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

TIMES = NumberSpec(
    label="Times", minimum=1, maximum=1000, whole=True, hint="Number of times it plays"
)
GAP = NumberSpec(
    label="Gap", unit="s", minimum=0.0, maximum=60.0, step=0.005, hint="Silence between repetitions"
)


@dataclass(frozen=True, slots=True)
class Repeat(TimedEffect):
    """Plays several times, with a rest between.

    Each repetition begins exactly a duration and a gap after the one before.  One that begins
    between two samples is delayed by a band-limited filter, see `band_limited_delay`.

    Attributes
    ----------
    times
        Number of repetitions, 1 to 1000.
    gap_s
        Rest between the end of one and the beginning of the next.
    """

    title: ClassVar[str] = "Repeat"

    times: int = fields.number(2, TIMES)
    gap_s: float = fields.number(0.0, GAP)
    on: bool = fields.switch(True, ON)

    def length(self, duration_s: float) -> float:
        """Return the length of all repetitions."""
        return self.times * duration_s + (self.times - 1) * self.gap_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return the same shift, which is that of the first repetition."""
        return shift_s

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        if self.times == 1:
            return samples
        check_duration(self.length(own_s))
        period = (own_s + self.gap_s) * rate_hz
        delayed: dict[float, Floats] = {0.0: samples}
        repeated = np.zeros(round((self.times - 1) * period) + samples.size + 2)
        last = samples.size
        for number in range(self.times):
            part = round(part_of_sample(number * period), 9)
            if part not in delayed:
                delayed[part] = band_limited_delay(samples, part)
            start = round(number * period - part)
            last = start + delayed[part].size
            repeated[start:last] += delayed[part]
        return repeated[:last]


@dataclass(frozen=True, slots=True)
class Reverse(KeepsTime, TimedEffect):
    """Plays backwards: at the time t what was at the duration less t, at any rate.

    Time 0 comes at the very end.  If the end lies on a sample, there is one sample more, so that
    nothing gets lost and reversing twice restores the clip.
    """

    title: ClassVar[str] = "Reverse"

    on: bool = fields.switch(True, ON)

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return the shift with which the samples have ``shift_s`` when counted from the end."""
        return part_of_sample(-(duration_s + shift_s) * sample_rate_hz) / sample_rate_hz

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        before_s = self.shift_before(shift_s, own_s, rate_hz)
        last = round((own_s + shift_s + before_s) * rate_hz)
        n = floor((own_s + shift_s) * rate_hz + NEAR) + 1
        backwards = np.zeros(n)
        sources = last - np.arange(n)
        within = (sources >= 0) & (sources < samples.size)
        backwards[within] = samples[sources[within]]
        backwards[: samples_until(shift_s * rate_hz)] = 0.0
        return backwards


FACTOR = NumberSpec(
    label="Factor",
    minimum=0.01,
    maximum=100.0,
    step=0.02,
    logarithmic=True,
    hint="2: twice as long",
)
TO = NumberSpec(
    label="Target length",
    unit="s",
    minimum=0.0,
    maximum=600.0,
    step=0.01,
    hint="Length after stretching; 0: use the factor",
    unset="by factor",
)
PITCH = ChoiceSpec(
    label="Frequencies",
    options=(("moves", "Shift, like tape"), ("stays", "Unchanged")),
    hint="Twice as long: an octave lower like tape, or unchanged",
)


@dataclass(frozen=True, slots=True)
class Stretch(TimedEffect):
    """Makes a clip longer or shorter.

    ``"moves"``: time t becomes factor times t by band-limited interpolation, so that each frequency
    is divided by the factor; frequencies beyond half the sample rate are lost.
    ``"stays"``: overlapping pieces of 40 ms move to other times, each to where it continues the
    last one best within 20 ms (WSOLA); tones keep their frequency, but single taps may come twice
    or be left out.

    Attributes
    ----------
    factor
        Length afterwards divided by length before.
    to_s
        Length afterwards; 0: the factor gives it.
    pitch
        ``"moves"`` or ``"stays"``.

    References
    ----------
    Verhelst and Roelands, An overlap-add technique based on waveform similarity (WSOLA) for high
    quality time-scale modification of speech, ICASSP 1993.
    """

    title: ClassVar[str] = "Stretch"

    factor: float = fields.number(2.0, FACTOR)
    to_s: float = fields.number(0.0, TO)
    pitch: str = fields.choice("moves", PITCH)
    on: bool = fields.switch(True, ON)

    def factor_of(self, duration_s: float) -> float:
        """Return the factor for a clip of this length."""
        return self.to_s / duration_s if self.to_s and duration_s > 0.0 else self.factor

    def length(self, duration_s: float) -> float:
        """Return the length afterwards."""
        return self.factor_of(duration_s) * duration_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return 0, since the result is computed at any shift; or the shift for a factor of 1."""
        return shift_s if self.factor_of(duration_s) == 1.0 else 0.0

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        factor = self.factor_of(own_s)
        if factor == 1.0:
            return samples
        length_s = factor * own_s
        check_duration(length_s)
        n = sample_count(length_s, rate_hz) + (shift_s > 0.0)
        times_s = own_times(n, rate_hz, shift_s)
        if self.pitch == "stays":
            stretched = stretched_in_time(samples, rate_hz, factor, times_s)
        else:
            places = times_s * (rate_hz / factor)
            stretched = values_between(samples, places, min(1.0, factor))
        return silent_outside(stretched, rate_hz, shift_s, max(length_s, n / rate_hz))


@checking
def stretched_by(effects: Sequence[Effect], duration_s: float) -> float:
    """Return the factor by which effects divide the frequencies of a waveform of this length.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.effects.stretched_by((ss.effects.Stretch(factor=2.0),), 0.1))
    2.0
    """
    factor = 1.0
    for effect in effects:
        if effect.on:
            if isinstance(effect, Stretch) and effect.pitch == "moves":
                factor *= effect.factor_of(duration_s)
            duration_s = effect.length(duration_s)
    return factor


LONGEST_S = 3600.0
START = NumberSpec(
    label="Start", unit="s", minimum=0.0, maximum=LONGEST_S, step=0.005, hint="Start of the part"
)
LENGTH = replace(START, label="Length", hint="Length of the part that plays; longer: up to the end")


@dataclass(frozen=True, slots=True)
class Trim(TimedEffect):
    """A part of what plays, as it is: samples before it and behind it are left out.

    The part has the samples at times t with ``start_s <= t < start_s + duration_s``, so that two
    parts, one of which ends where the other begins, add up to the whole.  Samples around the ends
    of a resampled signal stay with the ends.

    Attributes
    ----------
    start_s, duration_s
        Begin and length of the part; the clip then starts with what was at ``start_s``.
    """

    title: ClassVar[str] = "Trim"

    start_s: float = fields.number(0.0, START)
    duration_s: float = fields.number(600.0, LENGTH)
    on: bool = fields.switch(True, ON)

    def length(self, duration_s: float) -> float:
        """Return the length of the part of a clip of ``duration_s``."""
        return min(self.duration_s, max(duration_s - self.start_s, 0.0))

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return the shift of the samples before, whose time 0 lies ``start_s`` earlier."""
        _, shift = sample_and_rest((shift_s - self.start_s) * sample_rate_hz)
        return shift / sample_rate_hz

    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        length_s = self.length(own_s)
        if length_s == 0.0:
            return samples[:0].copy()
        left_out, _ = sample_and_rest((shift_s - self.start_s) * rate_hz)
        part = samples[-left_out:].copy()
        if self.start_s > 0.0:
            # A part that starts between two samples has none at the first of them.
            part[: shift_s > 0.0] = 0.0
        if (own_s - self.start_s - length_s) * rate_hz > NEAR:
            part = part[: ceil((length_s + shift_s) * rate_hz - NEAR)]
        return part
