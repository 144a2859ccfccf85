"""One polarity only."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, KeepsTime
from skinsource.fields import ChoiceSpec

WAVE = ChoiceSpec(
    label="Wave",
    options=(("full", "Full wave"), ("half", "Half wave")),
    hint="Full: what is below 0 is turned up. Half: it is left out",
)


@dataclass(frozen=True, slots=True)
class Rectify(KeepsTime):
    r"""Turns up what is below 0 (``"full"``, \\|x\\|), or leaves it out (``"half"``, max(x, 0)).

    A tone gets a mean above 0 and even harmonics; `BandLimit` after it removes what the skin does
    not get.

    Attributes
    ----------
    wave
        ``"full"`` or ``"half"``.
    """

    title: ClassVar[str] = "Rectify"

    wave: str = fields.choice("full", WAVE)
    on: bool = fields.switch(True, ON)

    def __post_init__(self) -> None:
        fields.check(self)

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the rectified samples, (n_times,)."""
        del sample_rate_hz, shift_s, duration_s
        return np.abs(samples) if self.wave == "full" else np.maximum(samples, 0.0)
