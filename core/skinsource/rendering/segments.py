"""Blocks of long drives, for overlap-save."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.chain import Drive
from skinsource.rendering.transforms import transform_length

#: A block of so many samples of a drive, for responses of up to half its length.
BLOCK_FFT = 2048
#: Responses longer than this are computed block by block where twenty places of a limb of 216
#: channels are in use, of any where spectra of the responses take as much.
LONGEST_AT_ONCE = 6144
_MOST_BINS = LONGEST_AT_ONCE * 20 * 216
#: With few places in use there is memory for longer ones, up to this.
LONGEST_OF_FEW = 15_360


@dataclass(frozen=True, slots=True)
class Blocks:
    """How long drives are cut: a block of ``n_fft`` samples gives ``n_samples`` of response.

    Attributes
    ----------
    n_taps
        Samples of the responses.
    """

    n_taps: int

    @property
    def n_fft(self) -> int:
        """Length of the transforms."""
        n_fft = BLOCK_FFT
        while n_fft < 2 * self.n_taps:
            n_fft *= 2
        return n_fft

    @property
    def n_samples(self) -> int:
        """Samples of response that a block gives: those in which nothing wraps round."""
        return self.n_fft - self.overlap

    @property
    def overlap(self) -> int:
        """Samples of the drive that a block shares with the one before."""
        return self.n_taps - 1

    def segment(self, samples: Floats, first: int) -> Floats | None:
        """Samples that the block from sample ``first`` on needs, (n_fft,); None if silent."""
        begin = first - self.overlap
        piece = samples[max(begin, 0) : max(begin + self.n_fft, 0)]
        if not piece.any():
            return None
        segment = np.zeros(self.n_fft)
        offset = max(-begin, 0)
        segment[offset : offset + piece.size] = piece
        return segment


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Played:
    """What is played at a place.

    Attributes
    ----------
    drive
        Its samples.
    start
        Sample at which the drive starts.
    weight
        What the vibration by it is multiplied with.
    location
        Input place, 1, 2, 3, …
    """

    drive: Drive
    start: int
    weight: float
    location: int


def length_at_once(response_samples: int, n_places: int, n_channels: int) -> int | None:
    """Length of the transforms of a whole design; None: it is to be computed block by block.

    Parameters
    ----------
    response_samples
        Length of the response.
    n_places
        Input places in use: spectra of the responses to them are kept.
    n_channels
        Channels of the responses, outputs times axes.
    """
    n_fft = transform_length(response_samples)
    longest = min(LONGEST_OF_FEW, _MOST_BINS // (max(n_places, 1) * n_channels))
    return n_fft if n_fft <= longest else None
