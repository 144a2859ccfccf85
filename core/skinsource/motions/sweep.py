"""One waveform that moves along a path."""

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from skinsource import fields
from skinsource.clips import Clip
from skinsource.design import Input
from skinsource.effects import Fade, Trim
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.motions.fields_of_motions import LEVEL, PATH, START, WAVEFORM, grouped, in_ms
from skinsource.waveforms import Tone, Waveform

OVERLAP = NumberSpec(
    label="Overlap",
    minimum=0.0,
    maximum=1.0,
    step=0.05,
    hint="Part of the way between two places on which both play; 0 jumps, 1 glides all the time",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """One waveform that runs along a path while it plays.

    Each leg of the path takes the same time.  On the middle part of it, the overlap, the place
    behind fades out with cos(pi u / 2) and the one ahead fades in with sin(pi u / 2), u going
    evenly from 0 to 1: the phantom's √(1-β) and √β with β = sin²(pi u / 2).  The sum of the
    energies stays throughout, and what plays goes on without a break.

    Attributes
    ----------
    path
        Input places, in their order; no two after each other are the same.
    waveform
        What moves; its duration is that of the whole sweep.
    overlap
        Part of each leg on which both places play, 0 to 1.
    amplitude
        Of each track.
    onset_s
        When it starts.
    """

    title: ClassVar[str] = "Sweep"
    law: ClassVar[str] = "Neighbours cross with √(1-β) and √β, each leg in the same time."
    source: ClassVar[str] = (
        "Energy of phantom sensations: Israr and Poupyrev, Tactile Brush, CHI 2011; equal legs "
        "are this studio's choice."
    )
    limits: ClassVar[str] = (
        "Legs of different length are passed at different speed. Between places of the palm the "
        "waves of both meet in the skin, and add with their phases, not their energies; places "
        "that feel it differently strong make it swell."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.6))
    overlap: float = fields.number(1.0, OVERLAP)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)
        for here, there in pairwise(self.path):
            if here == there:
                raise InvalidInputError(
                    f"Sweep.path goes from place {here} to {there}, expected another place; "
                    "leave one of them out"
                )

    @property
    def leg_s(self) -> float:
        """From one place to the next."""
        return self.waveform.duration_s / (len(self.path) - 1)

    @property
    def summary(self) -> str:
        """Its times in words."""
        return (
            f"{len(self.path)} places in {in_ms(self.waveform.duration_s)}, {in_ms(self.leg_s)} "
            f"from one to the next; two play for {in_ms(self.overlap * self.leg_s)} of that"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        n = len(self.path)
        return grouped(((self.path[k], self._clip(k, n)) for k in range(n)), self.amplitude)

    def _clip(self, k: int, n: int) -> Clip:
        cross_s = self.overlap * self.leg_s
        begin_s = 0.0 if k == 0 else (k - 0.5) * self.leg_s - cross_s / 2
        end_s = self.waveform.duration_s if k == n - 1 else (k + 0.5) * self.leg_s + cross_s / 2
        return Clip(
            onset_s=self.onset_s + begin_s,
            waveform=self.waveform,
            effects=(
                Trim(start_s=begin_s, duration_s=end_s - begin_s),
                Fade(
                    in_s=cross_s if k > 0 else 0.0,
                    out_s=cross_s if k < n - 1 else 0.0,
                    shape="equal power",
                ),
            ),
            label=f"{self.title} {k + 1}/{n}",
        )
