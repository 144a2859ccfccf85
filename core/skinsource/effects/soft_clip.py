"""Limits softly."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects.effect import ON, KeepsTime
from skinsource.fields import NumberSpec

DRIVE = NumberSpec(
    label="Drive",
    minimum=0.01,
    maximum=1000.0,
    step=0.05,
    logarithmic=True,
    hint="How much stronger it becomes where it is weak",
)
LEVEL = NumberSpec(
    label="Level",
    minimum=1e-6,
    maximum=1000.0,
    step=0.05,
    logarithmic=True,
    hint="What it never passes",
)


@dataclass(frozen=True, slots=True)
class SoftClip(KeepsTime):
    """Limits to a level without a corner: level tanh(drive x / level).

    Attributes
    ----------
    drive
        Factor of what is weak.
    level
        Largest magnitude that can come out.
    """

    title: ClassVar[str] = "Soft clip"

    drive: float = fields.number(2.0, DRIVE)
    level: float = fields.number(1.0, LEVEL)
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
        """Return the limited samples, (n_times,)."""
        del sample_rate_hz, shift_s, duration_s
        return self.level * np.tanh(samples * (self.drive / self.level))
