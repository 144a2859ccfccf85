"""Longer or shorter."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, Effect, own_duration_s
from skinsource.effects.overlap import stretched_in_time
from skinsource.effects.places import own_times, refuse_too_long, silent_outside
from skinsource.fields import ChoiceSpec, NumberSpec
from skinsource.sampling import values_between
from skinsource.signals import sample_count

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
        refuse_too_long(length_s)
        n = sample_count(length_s, sample_rate_hz) + (shift_s > 0.0)
        times_s = own_times(n, sample_rate_hz, shift_s)
        if self.pitch == "stays":
            found = stretched_in_time(samples, sample_rate_hz, factor, times_s)
        else:
            places = times_s * (sample_rate_hz / factor)
            found = values_between(samples, places, min(1.0, factor))
        return silent_outside(found, sample_rate_hz, shift_s, max(length_s, n / sample_rate_hz))


def stretched_by(effects: Sequence[Effect], duration_s: float) -> float:
    """By what frequencies of something so long are divided by its effects; 1: they stay."""
    factor = 1.0
    for effect in effects:
        if effect.on:
            if isinstance(effect, Stretch) and effect.pitch == "moves":
                factor *= effect.factor_of(duration_s)
            duration_s = effect.length(duration_s)
    return factor
