"""Blocks of long drives, for overlap-save."""

from dataclasses import dataclass

import numpy as np

from skinsource.limb import N_INPUTS, N_TAPS
from skinsource.rendering.drives import Drive
from skinsource.rendering.transforms import Floats, transform_length

#: A block of so many samples of a drive gives `BLOCK_SAMPLES` samples of response.
BLOCK_FFT = 2048
BLOCK_SAMPLES = BLOCK_FFT - (N_TAPS - 1)
#: Responses longer than this are computed block by block where all places are in use.
LONGEST_AT_ONCE = 6144
#: With few places in use there is memory for longer ones, up to this.
LONGEST_OF_FEW = 15_360


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Played:
    """An input of a scene.

    Attributes
    ----------
    drive
        What it plays.
    start
        Sample at which the drive starts.
    weight
        What its field is multiplied with.
    location
        Input place, 1 to 20.
    """

    drive: Drive
    start: int
    weight: float
    location: int

    def segment(self, first: int) -> Floats | None:
        """Drive that the block from sample ``first`` on needs, (BLOCK_FFT,); None if silent."""
        return segment_of(self.drive.samples, first - self.start)


def length_at_once(response_samples: int, n_places: int) -> int | None:
    """Length of the transforms of a whole scene; None: it is to be computed block by block.

    Parameters
    ----------
    response_samples
        Length of the response.
    n_places
        Input places in use: spectra of the responses to them are kept.
    """
    n_fft = transform_length(response_samples)
    longest = min(LONGEST_OF_FEW, LONGEST_AT_ONCE * N_INPUTS // max(n_places, 1))
    return n_fft if n_fft <= longest else None


def segment_of(samples: Floats, first: int) -> Floats | None:
    """Samples that the block from sample ``first`` on needs, (BLOCK_FFT,); None if silent."""
    begin = first - (N_TAPS - 1)
    piece = samples[max(begin, 0) : max(begin + BLOCK_FFT, 0)]
    if not piece.any():
        return None
    segment = np.zeros(BLOCK_FFT)
    offset = max(-begin, 0)
    segment[offset : offset + piece.size] = piece
    return segment
