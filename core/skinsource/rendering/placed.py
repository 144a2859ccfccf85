"""Voices with their drives."""

from dataclasses import dataclass

from skinsource.chain import Drive
from skinsource.rendering.gains import Sounding
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.voices import Voice


@dataclass(frozen=True, slots=True)
class Placed:
    """A voice, what it plays, and the sample at which it starts."""

    voice: Voice
    drive: Drive
    start: int

    @property
    def end(self) -> int:
        """Sample after its last one."""
        return self.start + self.drive.samples.size

    @property
    def moves(self) -> bool:
        """Whether the skin moves at all because of it."""
        return self.voice.amplitude != 0.0 and not self.drive.silent

    def sounding(self, response: ResponseSpectrum) -> Sounding:
        """The same without amplitude and start, with the responses to its place."""
        return Sounding(self.voice.unit, self.drive, response)
