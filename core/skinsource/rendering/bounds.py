"""What no sample of a channel exceeds, without computing the samples."""

import math
import sys
from collections.abc import Sequence

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.rendering.response_spectra import BAND_BINS, ResponseSpectrum

#: Far above the rounding of a bound; this keeps it above the samples.
_MARGIN = 1.0 + 1e-6
# Three transforms, each wrong by at most a few units in the last place per butterfly.
_ROUNDING_FACTOR = 8.0


def rounding_bound(norms: float, n_fft: int) -> float:
    """How wrong no sample of a convolution by transforms is.

    Parameters
    ----------
    norms
        Norm of the drive times that of the response; their sum, where several are added.
    n_fft
        Length of the transforms.
    """
    return _ROUNDING_FACTOR * sys.float_info.epsilon * math.log2(n_fft) * norms


def channel_bounds(
    samples: Floats,
    spectra: Complexes,
    responses: Sequence[ResponseSpectrum],
    *,
    tight: bool = True,
) -> Floats:
    """What no sample of each channel exceeds, for pieces of drives.

    The smallest of three: sums of magnitudes over frequency (tight for tones); sums over sections
    of the response of its norm there and the largest norm of the drive in a window as long (tight
    for noise); largest sample times sum of the response (tight for pulses).

    Parameters
    ----------
    samples : (n_pieces, n)
        Pieces of drives; zeros after them change nothing.
    spectra : (n_pieces, n_bins)
        Their spectra at the length of the responses'.
    responses : n_pieces of them
        Responses to the place where each piece is played.
    tight
        Whether by frequency too: what that needs of the responses takes long to prepare.

    Returns
    -------
    (n_pieces, n_channels)
    """
    section_norms = np.array([response.norms.sections for response in responses])
    bounds: Floats = (
        section_norms @ _largest_norms(samples, responses[0].norms.section_lengths)[:, :, None]
    )[:, :, 0]
    by_peak = np.array([response.norms.absolute_sums for response in responses])
    by_peak *= np.abs(samples).max(axis=-1, initial=0.0)[:, None]
    np.minimum(bounds, by_peak, out=bounds)
    if tight:
        np.minimum(bounds, _bounds_by_frequency(spectra, responses), out=bounds)
    bounds *= _MARGIN
    return bounds


def _bounds_by_frequency(spectra: Complexes, responses: Sequence[ResponseSpectrum]) -> Floats:
    starts = np.arange(0, spectra.shape[-1], BAND_BINS)
    # The drives are scaled: their squares are far from over- and underflow.
    magnitudes = np.sqrt(np.square(spectra.real) + np.square(spectra.imag))
    bands = np.add.reduceat(magnitudes, starts, axis=-1)
    bounds = np.empty((len(spectra), len(responses[0].rows)))
    for row, response, band in zip(bounds, responses, bands, strict=True):
        # Not a matrix product, whose threads wait for each other without sleeping.
        np.vecdot(response.band_magnitudes, band, out=row)
    return bounds


def _largest_norms(samples: Floats, lengths: tuple[int, ...]) -> Floats:
    """Largest norm of a drive in windows of some lengths, (n_pieces, n_lengths)."""
    energy = np.zeros((samples.shape[0], samples.shape[1] + 1))
    np.cumsum(np.square(samples), axis=-1, out=energy[:, 1:])
    # A window may reach beyond either end of the piece: then it holds the rest of it.
    found = {n: _largest_rise(energy, n) for n in set(lengths)}
    return np.sqrt(np.stack([found[n] for n in lengths], axis=-1))


def _largest_rise(energy: Floats, n: int) -> Floats:
    if n >= energy.shape[-1]:
        return energy[:, -1]
    return (energy[:, n:] - energy[:, :-n]).max(axis=-1)
