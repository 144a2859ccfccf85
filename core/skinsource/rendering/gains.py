"""What unit fields are multiplied with, so that an amplitude means what its scaling says."""

from collections.abc import Sequence
from sys import getsizeof
from weakref import ref

import numpy as np

from skinsource.job import Stop, never
from skinsource.limb import Limb
from skinsource.rendering.bounds import rounding_bound
from skinsource.rendering.drives import Drive, Drives, Source
from skinsource.rendering.maxima import Peak, peaks_of
from skinsource.rendering.memory import Memory
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.segments import BLOCK_FFT
from skinsource.rendering.transforms import Complexes
from skinsource.response_scaling import Scaling

BUDGET_BYTES = 2**20
# Below it a reciprocal overflows.
_SMALLEST = float(np.finfo(np.float64).tiny)


def unit_gains(
    drives: Sequence[Drive],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Stop = never,
) -> list[float]:
    """What fields of the scaled samples of drives are multiplied with under upstream's scaling.

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
    """
    peaks = peaks_of([drive.samples for drive in drives], spectra, responses, stop)
    # The factor of the drive cancels: the field reaches the amplitude whatever it was.
    return [
        1.0 / peak.value if is_positive(peak, drive, response) else drive.factor
        for drive, peak, response in zip(drives, peaks, responses, strict=True)
    ]


def is_positive(peak: Peak, drive: Drive, response: ResponseSpectrum) -> bool:
    """Whether the maximum of a field is above 0 by more than the rounding of its transforms."""
    norms = float(np.linalg.norm(drive.samples) * response.energies.max())
    return peak.value >= max(_SMALLEST, rounding_bound(norms, response.n_fft))


class Gains:
    """Gains of waveforms at places, in bounded memory."""

    def __init__(self, drives: Drives) -> None:
        self._drives = drives
        self._known = Memory[float](BUDGET_BYTES, getsizeof)

    def of(
        self,
        limb: Limb,
        scaling: Scaling,
        sources: Sequence[Source],
        drives: Sequence[Drive],
        responses: Sequence[ResponseSpectrum],
        stop: Stop = never,
    ) -> list[float]:
        """Gain of each source, none of them silent; what is not known is found together.

        ``drives`` are what the sources play, ``responses`` those to their places: all of the
        length of blocks, or all of a length that holds each waveform and its response.
        """
        if scaling != "upstream":
            return [drive.factor for drive in drives]
        pairs = zip(sources, (r.n_fft for r in responses), strict=True)
        # What is remembered of a limb does not keep its responses in memory.
        keys = [(ref(limb), *pair) for pair in pairs]
        known = {key: self._known.find(key) for key in keys}
        missing = [k for k, key in enumerate(keys) if known[key] is None]
        if missing:
            n_fft = responses[0].n_fft
            spectra = [
                self._drives.spectrum(sources[k], limb.sample_rate_hz, n_fft)
                for k in missing
                if n_fft != BLOCK_FFT
            ]
            found = unit_gains(
                [drives[k] for k in missing], spectra, [responses[k] for k in missing], stop
            )
            for k, gain in zip(missing, found, strict=True):
                known[keys[k]] = gain
                self._known.add(keys[k], gain)
        return [known[key] or 0.0 for key in keys]
