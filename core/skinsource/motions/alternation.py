"""Places in turn, again and again."""

from dataclasses import dataclass
from typing import ClassVar

from skinsource import fields
from skinsource.clips import Clip
from skinsource.counting import counted
from skinsource.design import Input
from skinsource.fields import NumberSpec
from skinsource.motions.fields_of_motions import (
    LEVEL,
    PATH,
    SPACING,
    START,
    WAVEFORM,
    beside,
    grouped,
    in_ms,
)
from skinsource.waveforms import Tone, Waveform

ROUNDS = NumberSpec(
    label="Rounds", minimum=1, maximum=200, whole=True, hint="How often the path is passed"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternation:
    """Bursts at each place of a path in turn, and from its beginning again.

    Burst k, counted from 0 through all rounds, starts k times the spacing after the first.

    Attributes
    ----------
    path
        Input places, in their order; two of them alternate.
    waveform
        The burst.
    spacing_s
        From the start of one burst to the start of the next.
    rounds
        How often the path is passed.
    amplitude
        Of each track.
    onset_s
        When the first burst starts.
    """

    title: ClassVar[str] = "Alternation"
    law: ClassVar[str] = "Burst k starts k × spacing after the first, at the next place in turn."
    source: ClassVar[str] = "Timing alone; no law of perception stands behind it."
    limits: ClassVar[str] = (
        "Slow turns are felt as two places; about as fast as apparent motion has it, as one that "
        "runs to and fro. On the palm vibration reaches the other place too: the levels of the "
        "skin show how far the two are apart."
    )

    path: tuple[int, ...] = fields.field(PATH, (7, 9))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.1))
    spacing_s: float = fields.number(0.2, SPACING)
    rounds: int = fields.number(4, ROUNDS)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def summary(self) -> str:
        """Its times in words."""
        n, burst_s = self.rounds * len(self.path), self.waveform.duration_s
        whole_s = (n - 1) * self.spacing_s + burst_s
        return (
            f"{counted(n, 'burst')} of {in_ms(burst_s)}, {beside(self.spacing_s, burst_s)}; "
            f"{in_ms(whole_s)} in all"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        places = self.path * self.rounds
        clips = (
            Clip(
                onset_s=self.onset_s + k * self.spacing_s,
                waveform=self.waveform,
                label=f"{self.title} {k + 1}/{len(places)}",
            )
            for k in range(len(places))
        )
        return grouped(zip(places, clips, strict=True), self.amplitude)
