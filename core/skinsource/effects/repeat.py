"""Again and again."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, own_duration_s
from skinsource.effects.places import part_of_sample, refuse_too_long
from skinsource.fields import NumberSpec
from skinsource.sampling import band_limited_delay

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
        refuse_too_long(self.length(one_s))
        period = (one_s + self.gap_s) * sample_rate_hz
        delayed: dict[float, Floats] = {0.0: samples}
        found = np.zeros(round((self.times - 1) * period) + samples.size + 2)
        last = samples.size
        for number in range(self.times):
            part = round(part_of_sample(number * period), 9)
            if part not in delayed:
                delayed[part] = band_limited_delay(samples, part)
            start = round(number * period - part)
            last = start + delayed[part].size
            found[start:last] += delayed[part]
        return found[:last]
