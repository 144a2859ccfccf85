"""Responses of a limb at the length that a design is transformed at."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from skinsource.arrays import Complexes
from skinsource.chain import Drive
from skinsource.job import Stop, never
from skinsource.limb import Limb
from skinsource.rendering.gains import Sounding
from skinsource.rendering.remembered import Remembered
from skinsource.rendering.response_spectra import ResponseSpectrum, Stack
from skinsource.rendering.segments import Blocks
from skinsource.scaling.response_scaling import Scaling
from skinsource.voices import UnitVoice


@dataclass(frozen=True, slots=True)
class Responses:
    """Reads and transforms responses when they are asked for; remembers them.

    Attributes
    ----------
    remembered
        Where what is found is kept.
    limb, scaling
        Whose responses, and what an amplitude of 1 means.
    n_fft
        Length of the transforms; None: that of blocks.
    """

    remembered: Remembered
    limb: Limb
    scaling: Scaling
    n_fft: int | None

    @property
    def blocks(self) -> Blocks:
        """How long drives are cut."""
        return Blocks(self.limb.n_taps)

    def to(self, places: Iterable[int]) -> list[ResponseSpectrum]:
        """Responses to each of some places."""
        places = list(places)
        if self.n_fft is None:
            stack = self.stack(places)
            return [stack.responses[place] for place in places] if stack is not None else []
        spectra = self.remembered.responses
        return [spectra.of(self.limb, place, self.scaling, self.n_fft) for place in places]

    def stack(self, places: Iterable[int]) -> Stack | None:
        """Responses to some places for matrix products over blocks; None for no places."""
        used = tuple(sorted(set(places)))
        if not used:
            return None
        n_fft = self.blocks.n_fft
        return self.remembered.responses.stack(self.limb, used, self.scaling, n_fft)

    def drive_spectrum(self, unit: UnitVoice, drive: Drive) -> Complexes:
        """Spectrum of what a voice plays, from time 0 on, (n_bins,); not for blocks."""
        if self.n_fft is None:
            raise ValueError("long drives have no spectrum as a whole")
        rate = self.limb.sample_rate_hz
        return self.remembered.drives.spectrum(unit, drive, rate, self.n_fft)

    def gains(self, voices: Sequence[Sounding], stop: Stop = never) -> list[float]:
        """What vibrations by unit voices, none of them silent, are multiplied with."""
        if self.scaling != "upstream":
            return [one.drive.factor for one in voices]
        in_blocks = self.n_fft is None
        return self.remembered.gains.of(self.limb, voices, in_blocks=in_blocks, stop=stop)
