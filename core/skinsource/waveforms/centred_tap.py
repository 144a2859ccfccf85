"""A tap that leaves nothing moving."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.arguments import positive_number
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.sampling import shift_of
from skinsource.signals import sample_count
from skinsource.synthesis.centred import about_middle, begun

WIDTH = NumberSpec(
    label="Width",
    unit="s",
    minimum=0.004,
    maximum=10.0,
    step=0.02,
    logarithmic=True,
    hint="Length of the whole pulse; its spectrum is highest at 1.5 / width, 75 Hz of 20 ms",
)


@dataclass(frozen=True, slots=True)
class CentredTap:
    """A tap whose mean is 0: as an acceleration it leaves neither velocity nor displacement.

    (cos(2 pi t / T) + cos(4 pi t / T)) / 2 for |t| <= T / 2: a crest of 1 and of a third of the
    width, between two troughs of -0.56, with a level start and end.  It takes n = round(T rate)
    samples, about their middle: t = (k - (n - 1) / 2) / rate.  The upstream tap (`Tap`) has half
    of its energy below 25 Hz, where nothing was measured, and leaves a velocity.

    Attributes
    ----------
    width_s
        T, 4 ms to 10 s; its second cosine, of 2 / T, has to stay below half the sample rate.
    """

    title: ClassVar[str] = "Centred tap"

    width_s: float = fields.number(0.02, WIDTH)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """The width."""
        return self.width_s

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of a formula of peak 1."""
        if 2.0 / self.width_s >= positive_number("sample_rate_hz", sample_rate_hz) / 2:
            raise InvalidInputError(
                f"width_s is {self.width_s:g}, expected more than {4.0 / sample_rate_hz:g} s at "
                f"{sample_rate_hz:g} Hz; a shorter tap would alias"
            )
        shift_s = shift_of(shift_s, sample_rate_hz)
        n = sample_count(self.width_s, sample_rate_hz)
        turn = about_middle(n, sample_rate_hz, shift_s) / self.width_s
        found = 0.5 * (np.cos(2.0 * pi * turn) + np.cos(4.0 * pi * turn))
        found[np.abs(turn) > 0.5] = 0.0
        return begun(found, shift_s)
