"""What sounds: all that the engine knows of a design's inputs."""

from dataclasses import dataclass

from skinsource.chain import Chain


@dataclass(frozen=True, slots=True, kw_only=True)
class Voice:
    """Something that plays at an input place.

    Attributes
    ----------
    id
        Tells voices apart.
    location
        Input place, 1, 2, 3, …
    start
        Sample at which it starts.
    amplitude
        Factor; what 1 means is a matter of scaling.
    heard
        Whether it takes part: neither muted nor beside a solo one.
    chain
        What it plays.
    """

    id: int
    location: int
    start: int
    amplitude: float
    heard: bool
    chain: Chain

    @property
    def unit(self) -> "UnitVoice":
        """The same without amplitude and start."""
        return UnitVoice(self.chain, self.location)


@dataclass(frozen=True, slots=True)
class UnitVoice:
    """A voice at amplitude 1 and start 0: what it plays, and where."""

    chain: Chain
    location: int
