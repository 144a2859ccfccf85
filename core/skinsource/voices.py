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
    onset_s
        When it starts.
    amplitude
        Factor; what 1 means is a matter of scaling.
    heard
        Whether it takes part: neither muted nor beside a solo one.
    chain
        What it plays.
    """

    id: int
    location: int
    onset_s: float
    amplitude: float
    heard: bool
    chain: Chain

    @property
    def unit(self) -> "UnitVoice":
        """The same without amplitude and onset."""
        return UnitVoice(self.chain, self.location)


@dataclass(frozen=True, slots=True)
class UnitVoice:
    """A voice at amplitude 1 and onset 0: what it plays, and where."""

    chain: Chain
    location: int
