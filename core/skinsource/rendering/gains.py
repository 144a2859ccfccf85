"""What vibrations by unit voices are multiplied with, so that an amplitude means what it should."""

from collections.abc import Sequence
from dataclasses import dataclass
from sys import getsizeof
from weakref import ref

import numpy as np

from skinsource.arrays import Complexes
from skinsource.chain import Drive
from skinsource.job import Stop, never
from skinsource.limb import Limb
from skinsource.rendering.bounds import rounding_bound
from skinsource.rendering.budgets import GAINS_BYTES
from skinsource.rendering.drives import Drives
from skinsource.rendering.maxima import Peak, peaks_of
from skinsource.rendering.memory import Memory
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.voices import UnitVoice

# Below it a reciprocal overflows.
_SMALLEST = float(np.finfo(np.float64).tiny)


def unit_gains(
    drives: Sequence[Drive],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Stop = never,
    *,
    tight: bool = True,
) -> list[float]:
    """What vibrations by scaled samples of drives are multiplied with under upstream's scaling.

    One over their signed maxima, or no division where no sample is positive.

    Parameters
    ----------
    drives
        None of them silent.
    spectra : (n_fft // 2 + 1,) each
        Of the scaled samples, at the length of the responses'; empty for drives that are searched
        block by block.
    responses
        Responses to the place of each drive.
    tight
        As in `channel_bounds`.
    """
    samples = [drive.samples for drive in drives]
    peaks = peaks_of(samples, spectra, responses, stop, tight=tight)
    # The factor of the drive cancels: the vibration reaches the amplitude whatever it was.
    return [
        1.0 / peak.value if is_positive(peak, drive, response) else drive.factor
        for drive, peak, response in zip(drives, peaks, responses, strict=True)
    ]


def is_positive(peak: Peak, drive: Drive, response: ResponseSpectrum) -> bool:
    """Whether the maximum of a vibration is above 0 by more than the rounding of its transforms."""
    return exceeds_rounding(peak.value, drive, response.norms.energies.max(), response.n_fft)


def exceeds_rounding(largest: float, drive: Drive, energy: float, n_fft: int) -> bool:
    """Whether a sample is above the rounding of transforms of ``drive`` and of a response.

    ``energy`` is the norm of that response, or more.
    """
    norms = float(np.linalg.norm(drive.samples) * energy)
    return largest >= max(_SMALLEST, rounding_bound(norms, n_fft))


@dataclass(frozen=True, slots=True, eq=False)
class Sounding:
    """A unit voice that is not silent, its drive, and the responses to its place."""

    unit: UnitVoice
    drive: Drive
    response: ResponseSpectrum


class Gains:
    """Gains of unit voices under upstream's scaling, in bounded memory."""

    def __init__(self, drives: Drives) -> None:
        self._drives = drives
        self._known = Memory[float](GAINS_BYTES, getsizeof)

    def of(
        self, limb: Limb, voices: Sequence[Sounding], *, in_blocks: bool, stop: Stop = never
    ) -> list[float]:
        """Gain of each voice; what is not known is found together.

        With ``in_blocks`` the responses are of the length of blocks, else all of one length that
        holds each drive and its response.
        """
        # What is remembered of a limb does not keep its responses in memory.
        keys = [(ref(limb), one.unit, one.response.n_fft, in_blocks) for one in voices]
        known = {key: gain for key in keys if (gain := self._known.find(key)) is not None}
        pairs = zip(keys, voices, strict=True)
        missing = {key: one for key, one in pairs if key not in known}
        if missing:
            rate, new = limb.sample_rate_hz, list(missing.values())
            spectra = [
                self._drives.spectrum(one.unit, one.drive, rate, one.response.n_fft)
                for one in new
                if not in_blocks
            ]
            drives, responses = [one.drive for one in new], [one.response for one in new]
            found = unit_gains(drives, spectra, responses, stop)
            for key, gain in zip(missing, found, strict=True):
                known[key] = gain
                self._known.add(key, gain)
        return [known[key] for key in keys]
