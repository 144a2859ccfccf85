"""Bursts that seem to be one that moves."""

from dataclasses import dataclass
from typing import ClassVar

from skinsource import fields
from skinsource.clips import Clip
from skinsource.design import Input
from skinsource.motions.fields_of_motions import (
    LEVEL,
    PATH,
    START,
    WAVEFORM,
    beside,
    grouped,
    in_ms,
)
from skinsource.waveforms import Tone, Waveform

#: Part of its duration by which a burst is ahead of the next, and what is added to it.
SOA_PER_DURATION, SOA_OFFSET_S = 0.32, 0.0473


@dataclass(frozen=True, slots=True, kw_only=True)
class ApparentMotion:
    """Bursts at one place after the other that are felt as one moving smoothly.

    The next starts 0.32 d + 47.3 ms after the one before, d being the duration of a burst.

    Attributes
    ----------
    path
        Input places, in their order.
    waveform
        The burst; its duration is d.
    amplitude
        Of each track.
    onset_s
        When the first burst starts.
    """

    title: ClassVar[str] = "Apparent motion"
    law: ClassVar[str] = "From start to start 0.32 d + 47.3 ms, d the duration of a burst."
    source: ClassVar[str] = (
        "Israr and Poupyrev, Tactile Brush: drawing on skin with a tactile grid display, CHI 2011."
    )
    limits: ClassVar[str] = (
        "Found on the back, with actuators some centimetres apart. On the palm places lie closer, "
        "and vibration runs on through the skin; strokes were felt to move more evenly there with "
        "steps between the places (Park et al., EuroHaptics 2016)."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.1))
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def spacing_s(self) -> float:
        """From the start of one burst to the start of the next."""
        return SOA_PER_DURATION * self.waveform.duration_s + SOA_OFFSET_S

    @property
    def summary(self) -> str:
        """Its times in words."""
        burst_s = self.waveform.duration_s
        whole_s = (len(self.path) - 1) * self.spacing_s + burst_s
        return (
            f"{len(self.path)} bursts of {in_ms(burst_s)}, one every {in_ms(self.spacing_s)}, "
            f"{beside(self.spacing_s, burst_s)}; {in_ms(whole_s)} in all"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        n = len(self.path)
        clips = (
            Clip(
                onset_s=self.onset_s + k * self.spacing_s,
                waveform=self.waveform,
                label=f"{self.title} {k + 1}/{n}",
            )
            for k in range(n)
        )
        return grouped(zip(self.path, clips, strict=True), self.amplitude)
