"""Backwards."""

from dataclasses import dataclass
from math import floor
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, KeepsTime, own_duration_s
from skinsource.effects.places import part_of_sample, samples_until
from skinsource.sampling import NEAR


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
        found = np.zeros(n)
        taken = last - np.arange(n)
        there = (taken >= 0) & (taken < samples.size)
        found[there] = samples[taken[there]]
        found[: samples_until(shift_s * sample_rate_hz)] = 0.0
        return found
