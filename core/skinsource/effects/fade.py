"""In and out."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, KeepsTime, own_duration_s
from skinsource.effects.places import own_times
from skinsource.fields import ChoiceSpec, NumberSpec

LENGTH = NumberSpec(
    label="Fade in", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="From 0 to full level"
)
OUT = NumberSpec(
    label="Fade out", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="To 0 at the end"
)
SHAPE = ChoiceSpec(
    label="Shape",
    options=(("straight", "Straight"), ("smooth", "Smooth"), ("equal power", "Equal power")),
    hint="Equal power: two clips that cross keep their energy",
)

# Whatever is shorter is none; no clock tells it from nothing.
_SHORTEST_S = 1e-9


@dataclass(frozen=True, slots=True)
class Fade(KeepsTime):
    """Fades in from 0 at the start, and out to 0 at the end.

    With the share u of a fade, 0 at its silent end: ``"straight"`` u; ``"smooth"``
    (1 - cos(pi u)) / 2; ``"equal power"`` sin(pi u / 2), of which two that cross sum up to the
    same power.  Where both do not fit, both are shortened by the same factor, and meet.

    Attributes
    ----------
    in_s, out_s
        How long they take; 0: none.
    shape
        Of both.
    """

    title: ClassVar[str] = "Fade"

    in_s: float = fields.number(0.01, LENGTH)
    out_s: float = fields.number(0.01, OUT)
    shape: str = fields.choice("smooth", SHAPE)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)

    def values_at(self, times_s: Floats, duration_s: float) -> Floats:
        """Levels at own times of what plays for ``duration_s``, of the shape of the times."""
        both = self.in_s + self.out_s
        fits = min(1.0, duration_s / both) if both else 1.0
        found = np.ones(np.shape(times_s))
        for length, since in (
            (self.in_s * fits, times_s),
            (self.out_s * fits, duration_s - times_s),
        ):
            if length > _SHORTEST_S:
                found = found * self._level(np.clip(since / length, 0.0, 1.0))
        return found

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the samples faded in and out, (n_times,)."""
        length_s = own_duration_s(samples, sample_rate_hz, shift_s, duration_s)
        times_s = own_times(samples.size, sample_rate_hz, shift_s)
        return samples * self.values_at(times_s, length_s)

    def _level(self, share: Floats) -> Floats:
        if self.shape == "straight":
            return share
        if self.shape == "smooth":
            return 0.5 * (1.0 - np.cos(np.pi * share))
        return np.sin(0.5 * np.pi * share)
