"""Taps along a path."""

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
    grouped,
    in_ms,
)
from skinsource.waveforms import Tap, Waveform

TAPS = NumberSpec(
    label="Taps", minimum=1, maximum=200, whole=True, hint="At each place before the next"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TapSequence:
    """The same number of taps at each place of a path, evenly spaced throughout.

    Tap k, counted from 0 through all places, starts k times the spacing after the first.

    Attributes
    ----------
    path
        Input places, in their order.
    waveform
        The tap.
    taps
        How many there are at each place.
    spacing_s
        From the start of one tap to the start of the next, at the same place and from place to
        place.
    amplitude
        Of each track.
    onset_s
        When the first tap starts.
    """

    title: ClassVar[str] = "Tap sequence"
    law: ClassVar[str] = "Tap k starts k × spacing after the first, the same number at each place."
    source: ClassVar[str] = (
        "Geldard and Sherrick, The cutaneous “rabbit”: a perceptual illusion, Science 178, 1972; "
        "range of times: Geldard, J. Invest. Dermatology 1985."
    )
    limits: ClassVar[str] = (
        "From 20 to 260 ms between taps, taps are felt between the places, as if something hopped "
        "along; slower ones stay where they are. Found on the arm: where the skin tells places "
        "apart well, as on the palm and most of all at the fingertips, hops are short."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Waveform = fields.field(WAVEFORM, Tap())
    taps: int = fields.number(3, TAPS)
    spacing_s: float = fields.number(0.06, SPACING)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def summary(self) -> str:
        """Its times in words."""
        n = self.taps * len(self.path)
        whole_s = (n - 1) * self.spacing_s + self.waveform.duration_s
        return f"{counted(n, 'tap')}, one every {in_ms(self.spacing_s)}; {in_ms(whole_s)} in all"

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        places = [place for place in self.path for _ in range(self.taps)]
        clips = (
            Clip(
                onset_s=self.onset_s + k * self.spacing_s,
                waveform=self.waveform,
                label=f"{self.title} {k + 1}/{len(places)}",
            )
            for k in range(len(places))
        )
        return grouped(zip(places, clips, strict=True), self.amplitude)
