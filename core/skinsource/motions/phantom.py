"""Something between two places."""

from dataclasses import dataclass, replace
from math import sqrt
from typing import ClassVar

from skinsource import fields
from skinsource.clips import Clip
from skinsource.design import Input
from skinsource.fields import NumberSpec
from skinsource.motions.fields_of_motions import LEVEL, PATH, START, WAVEFORM, in_ms
from skinsource.waveforms import Tone, Waveform

TWO_PLACES = replace(PATH, most=2, different=True, label="Places", hint="The two places")
POSITION = NumberSpec(
    label="Position",
    minimum=0.0,
    maximum=1.0,
    step=0.01,
    hint="β: 0 is at the first place, 1 at the second",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Phantom:
    """The same at two places, as strong as if it lay between them.

    At the position β from the first place (0) to the second (1), the first plays with sqrt(1 - β)
    and the second with sqrt(β) of the amplitude, so that the sum of their energies stays.

    Attributes
    ----------
    path
        Two input places.
    waveform
        What both play.
    position
        β, 0 to 1.
    amplitude
        That of a single actuator where it is felt.
    onset_s
        When both start.
    """

    title: ClassVar[str] = "Phantom"
    law: ClassVar[str] = "Amplitudes √(1-β) and √β at once: the sum of the energies stays."
    source: ClassVar[str] = (
        "Israr and Poupyrev, Tactile Brush, CHI 2011; first Alles, Information transmission by "
        "phantom sensations, IEEE Trans. Man-Machine Systems 11, 1970."
    )
    limits: ClassVar[str] = (
        "Both must be felt alike strong alone: places differ, and the scaling decides what the "
        "amplitudes mean. On the hand the two also meet in the skin, where they add with their "
        "phases; farther apart than a few centimetres they are felt as two."
    )

    path: tuple[int, ...] = fields.field(TWO_PLACES, (17, 19))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.3))
    position: float = fields.number(0.5, POSITION)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def shares(self) -> tuple[float, float]:
        """Parts of the amplitude: sqrt(1 - β) and sqrt(β)."""
        return sqrt(1.0 - self.position), sqrt(self.position)

    @property
    def summary(self) -> str:
        """Its amplitudes in words."""
        first, second = self.shares
        return (
            f"{first:.3g} and {second:.3g} of the amplitude at once, for "
            f"{in_ms(self.waveform.duration_s)}"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each of both places; one that is silent is there all the same."""
        # As amplitudes of tracks they count under every scaling; gains of single clips do not.
        return tuple(
            Input(
                location=place,
                clips=(
                    Clip(
                        onset_s=self.onset_s,
                        waveform=self.waveform,
                        label=f"{self.title} {k + 1}/2",
                    ),
                ),
                amplitude=share * self.amplitude,
            )
            for k, (place, share) in enumerate(zip(self.path, self.shares, strict=True))
        )
