"""What a voice plays, written down."""

from dataclasses import dataclass, field

from skinsource.effects import Effect
from skinsource.waveforms import Waveform

Curve = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Part:
    """A waveform through its effects, somewhere in a chain.

    Attributes
    ----------
    waveform, effects
        What is played.
    start
        Sample of the chain at which its samples begin.
    shift_s
        How much later it starts itself: less than a sample.
    gain
        Factor.
    """

    waveform: Waveform
    effects: tuple[Effect, ...] = ()
    start: int = 0
    shift_s: float = 0.0
    gain: float = 1.0

    @property
    def title(self) -> str:
        """Word for what is played."""
        return self.waveform.title


@dataclass(frozen=True, slots=True)
class Chain:
    """The way from recipes to a drive: a sum of parts, times a curve.

    Equal chains play the same at one sample rate.

    Attributes
    ----------
    parts
        What sounds; the first sample of the earliest is sample 0.
    curve
        Breakpoints, s and factor, that all of it is multiplied with; none: nothing is.
    curve_start
        Sample of the curve's time at which the chain begins; 0 without a curve.
    """

    parts: tuple[Part, ...]
    curve: Curve = ()
    curve_start: int = 0
    # Looked up several times for each edit, and as long to compute as there are parts.
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_hash", hash((self.parts, self.curve, self.curve_start)))

    def __hash__(self) -> int:
        return self._hash

    @property
    def title(self) -> str:
        """Words for what is played."""
        return self.parts[0].title if len(self.parts) == 1 else f"{len(self.parts)} clips"
