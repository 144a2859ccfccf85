"""Again and again."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor
from typing import ClassVar

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.design.effects.effect import (
    ON,
    Effect,
    KeepsTime,
    own_duration_s,
    stretched_in_time,
)
from skinsource.design.effects.playing import (
    check_duration,
    own_times,
    part_of_sample,
    samples_until,
    silent_outside,
)
from skinsource.signals.generators import sample_count
from skinsource.signals.sampling import NEAR, band_limited_delay, parted, values_between
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

TIMES = NumberSpec(
    label="Times", minimum=1, maximum=1000, whole=True, hint="How often it is played"
)
GAP = NumberSpec(
    label="Gap", unit="s", minimum=0.0, maximum=60.0, step=0.005, hint="Rest between two of them"
)


@dataclass(frozen=True, slots=True)
class Repeat:
    """Plays several times, with a rest between.

    Each begins exactly a duration and a gap after the one before.  What then begins between two
    samples is delayed by a band-limited filter, see `band_limited_delay`.

    Attributes
    ----------
    times
        How often, 1 to 1000.
    gap_s
        Rest between the end of one and the beginning of the next.
    """

    title: ClassVar[str] = "Repeat"

    times: int = fields.number(2, TIMES)
    gap_s: float = fields.number(0.0, GAP)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)

    def length(self, duration_s: float) -> float:
        """How long all of them take."""
        return self.times * duration_s + (self.times - 1) * self.gap_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes: the same, that of the first one."""
        del duration_s, sample_rate_hz
        return shift_s

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return all of them, (n_after,).

        Raises
        ------
        InvalidInputError
            They would take more than an hour.
        """
        if self.times == 1 or not samples.size:
            return samples
        one_s = own_duration_s(samples, sample_rate_hz, shift_s, duration_s)
        check_duration(self.length(one_s))
        period = (one_s + self.gap_s) * sample_rate_hz
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


# Backwards.


@dataclass(frozen=True, slots=True)
class Reverse(KeepsTime):
    """Plays backwards: at the time t what was at the duration less t, at any rate.

    What was at time 0 is played at the very end, for which there is one sample more where the end
    lies on a sample; so nothing gets lost, and twice backwards is forwards.
    """

    title: ClassVar[str] = "Reverse"

    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes: such that seen from the end they have ``shift_s``."""
        return part_of_sample(-(duration_s + shift_s) * sample_rate_hz) / sample_rate_hz

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the samples from the last to the first, (n_after,)."""
        if not samples.size:
            return samples
        if duration_s is None:
            # How long they play depends on the shift they have, and that on how long they play.
            duration_s = own_duration_s(samples, sample_rate_hz, 0.0, None)
        before_s = self.shift_before(shift_s, duration_s, sample_rate_hz)
        last = round((duration_s + shift_s + before_s) * sample_rate_hz)
        n = floor((duration_s + shift_s) * sample_rate_hz + NEAR) + 1
        backwards = np.zeros(n)
        sources = last - np.arange(n)
        exists = (sources >= 0) & (sources < samples.size)
        backwards[exists] = samples[sources[exists]]
        backwards[: samples_until(shift_s * sample_rate_hz)] = 0.0
        return backwards


# Longer or shorter.

FACTOR = NumberSpec(
    label="Factor",
    minimum=0.01,
    maximum=100.0,
    step=0.02,
    logarithmic=True,
    hint="2: twice as long",
)
TO = NumberSpec(
    label="To length",
    unit="s",
    minimum=0.0,
    maximum=600.0,
    step=0.01,
    hint="Length afterwards, whatever it was before; 0: by the factor",
    unset="by factor",
)
PITCH = ChoiceSpec(
    label="Frequencies",
    options=(("moves", "Move, as of a tape"), ("stays", "Stay")),
    hint="Twice as long: an octave lower, as of a tape; or as they are",
)


@dataclass(frozen=True, slots=True)
class Stretch:
    """Makes a clip longer or shorter.

    ``"moves"``: what was at the time t comes at factor times t, so that each frequency is divided
    by the factor, by band-limited interpolation; faster than half the sample rate nothing is left.
    ``"stays"``: overlapping pieces of 40 ms are taken at other times, each where it continues
    the last one best within 20 ms (WSOLA); tones keep their frequency, single taps may come
    twice, or be left out where much is.

    Attributes
    ----------
    factor
        Length afterwards over length before.
    to_s
        Length afterwards; 0: as the factor says.
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

    def __post_init__(self) -> None:
        fields.check(self)

    def factor_of(self, duration_s: float) -> float:
        """Factor by which something of this length is stretched."""
        return self.to_s / duration_s if self.to_s and duration_s > 0.0 else self.factor

    def length(self, duration_s: float) -> float:
        """How long it is afterwards."""
        return self.factor_of(duration_s) * duration_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes: none, unless it changes nothing."""
        del sample_rate_hz
        return shift_s if self.factor_of(duration_s) == 1.0 else 0.0

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the stretched samples, (n_after,).

        Raises
        ------
        InvalidInputError
            They would play longer than an hour.
        """
        whole_s = own_duration_s(samples, sample_rate_hz, 0.0, duration_s)
        factor = self.factor_of(whole_s)
        if factor == 1.0 or not samples.size:
            return samples
        length_s = factor * whole_s
        check_duration(length_s)
        n = sample_count(length_s, sample_rate_hz) + (shift_s > 0.0)
        times_s = own_times(n, sample_rate_hz, shift_s)
        if self.pitch == "stays":
            stretched = stretched_in_time(samples, sample_rate_hz, factor, times_s)
        else:
            places = times_s * (sample_rate_hz / factor)
            stretched = values_between(samples, places, min(1.0, factor))
        return silent_outside(stretched, sample_rate_hz, shift_s, max(length_s, n / sample_rate_hz))


def stretched_by(effects: Sequence[Effect], duration_s: float) -> float:
    """By what frequencies of something so long are divided by its effects; 1: they stay."""
    factor = 1.0
    for effect in effects:
        if effect.on:
            if isinstance(effect, Stretch) and effect.pitch == "moves":
                factor *= effect.factor_of(duration_s)
            duration_s = effect.length(duration_s)
    return factor


# A part of what plays.

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
        _, shift = parted((shift_s - self.start_s) * sample_rate_hz)
        return shift / sample_rate_hz

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
