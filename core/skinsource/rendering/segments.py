"""Blocks of long drives, for overlap-save."""

from dataclasses import dataclass

import numpy as np

from skinsource.limb import N_TAPS
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.transforms import Floats

#: A block of so many samples of a drive gives `BLOCK_SAMPLES` samples of response.
BLOCK_FFT = 4096
BLOCK_SAMPLES = BLOCK_FFT - (N_TAPS - 1)
#: Responses longer than this are computed block by block.
LONGEST_AT_ONCE = 6144


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Played:
    """An input of a long scene.

    Attributes
    ----------
    samples : (n,)
        Its drive.
    start
        Sample at which the drive starts.
    weight
        What its field is multiplied with.
    response
        Responses to its place, transformed at ``BLOCK_FFT``.
    """

    samples: Floats
    start: int
    weight: float
    response: ResponseSpectrum

    def segment(self, first: int) -> Floats | None:
        """Drive that the block from sample ``first`` on needs, (BLOCK_FFT,); None if silent."""
        begin = first - (N_TAPS - 1) - self.start
        end = begin + BLOCK_FFT
        piece = self.samples[max(begin, 0) : max(end, 0)]
        if not piece.any():
            return None
        segment = np.zeros(BLOCK_FFT)
        offset = max(-begin, 0)
        segment[offset : offset + piece.size] = piece
        return segment
