"""What a voice plays, written down."""

from dataclasses import dataclass

from skinsource.waveforms import Waveform


@dataclass(frozen=True, slots=True)
class Chain:
    """The way from a recipe to a drive; now the recipe alone.

    Equal chains play the same.

    Attributes
    ----------
    waveform
        The recipe that samples itself.
    """

    waveform: Waveform

    @property
    def title(self) -> str:
        """Word for what is played."""
        return self.waveform.title
