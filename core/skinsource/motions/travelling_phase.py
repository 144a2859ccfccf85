"""One tone at all places, later and later in its phase."""

from dataclasses import dataclass, replace
from math import degrees, pi, remainder
from typing import ClassVar

from skinsource import fields
from skinsource.clips import Clip
from skinsource.design import Input
from skinsource.fields import NumberSpec, RecipeSpec
from skinsource.motions.fields_of_motions import LEVEL, PATH, START, grouped, in_ms
from skinsource.waveforms import Saw, Square, Tone, Triangle

#: Waveforms with one frequency and a phase.
_PERIODIC = (Tone, Square, Saw, Triangle)

PERIODIC = RecipeSpec(
    label="Waveform", kinds=lambda: _PERIODIC, hint="What plays at all places, with its phase"
)
DISTANCE = NumberSpec(
    label="Distance",
    unit="m",
    minimum=0.0001,
    maximum=1.0,
    step=0.001,
    hint="From one place to the next, as if all were equally far apart",
)
SPEED = NumberSpec(
    label="Speed",
    unit="m/s",
    minimum=0.01,
    maximum=1000.0,
    step=0.05,
    logarithmic=True,
    hint="How fast the phase runs along the path",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TravellingPhase:
    """The same steady tone at all places at once, the phase lagging from place to place.

    At place k it starts with the phase of the waveform less 2 pi frequency k distance / speed:
    what a wave of this speed would have, that passes the places in their order.

    Attributes
    ----------
    path
        Input places, in their order.
    waveform
        A tone, square, saw or triangle wave.
    distance_m
        From one place to the next.
    speed_m_s
        Of the wave.
    amplitude
        Of each track.
    onset_s
        When all of them start.
    """

    title: ClassVar[str] = "Travelling phase"
    law: ClassVar[str] = "At place k the phase lags by 2π × frequency × k × distance / speed."
    source: ClassVar[str] = "Phase of a plane wave; the phased array of acoustics."
    limits: ClassVar[str] = (
        "The skin adds waves of its own, of 5 to 20 m/s and fading within centimetres, to the "
        "phases of the actuators; whether a direction is felt is not known for the palm. Look at "
        "the animation to see what runs where."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Tone | Square | Saw | Triangle = fields.field(PERIODIC, Tone(100.0, duration_s=0.5))
    distance_m: float = fields.number(0.02, DISTANCE)
    speed_m_s: float = fields.number(5.0, SPEED)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def lag_turns(self) -> float:
        """Turns by which the tone lags from one place to the next."""
        return self.waveform.frequency_hz * self.distance_m / self.speed_m_s

    @property
    def summary(self) -> str:
        """Its times in words."""
        return (
            f"{len(self.path)} places at once for {in_ms(self.waveform.duration_s)}, each "
            f"{degrees(2 * pi * self.lag_turns):.4g}° behind the one before"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        n = len(self.path)
        clips = (
            Clip(
                onset_s=self.onset_s,
                waveform=replace(self.waveform, phase_rad=self._phase_rad(k)),
                label=f"{self.title} {k + 1}/{n}",
            )
            for k in range(n)
        )
        return grouped(zip(self.path, clips, strict=True), self.amplitude)

    def _phase_rad(self, k: int) -> float:
        if k == 0:
            return self.waveform.phase_rad
        lag = 2.0 * pi * remainder(k * self.lag_turns, 1.0)
        return remainder(self.waveform.phase_rad - lag, 2.0 * pi)
