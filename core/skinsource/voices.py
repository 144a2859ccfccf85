"""What sounds: all that the engine knows of a design's inputs."""

from collections.abc import Sequence
from dataclasses import dataclass

from skinsource.chain import Chain
from skinsource.quoting import first_sentence


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


@dataclass(frozen=True, slots=True)
class UnplayableInput:
    """An input that is heard and cannot be played.

    Attributes
    ----------
    id
        Tells inputs apart.
    problem
        Why, and what to do, as the error says it.
    """

    id: int
    problem: str

    @property
    def sentence(self) -> str:
        """Which input, and why."""
        return first_sentence(self.problem)


def unplayable_words(unplayable: Sequence[UnplayableInput]) -> str:
    """One sentence on inputs that cannot be played; empty where there are none."""
    if not unplayable:
        return ""
    words, more = unplayable[0].sentence, len(unplayable) - 1
    if more == 0:
        return words
    others = "1 more input" if more == 1 else f"{more} more inputs"
    return f"{words.removesuffix('.')}; {others} cannot be played either."
