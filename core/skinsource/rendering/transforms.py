"""Fourier transforms, counted; and their lengths."""

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from skinsource.work import tally

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Lengths are 9, 12 or 15 times a power of two: fast, and few, so that spectra of responses are
#: used again when a duration changes a little.
_SHORTEST_OCTAVE = 64


def transform_length(n_samples: int) -> int:
    """Shortest length of the ladder 576, 768, 960, 1152, 1536, … that holds ``n_samples``."""
    octave = _SHORTEST_OCTAVE
    while 15 * octave < n_samples:
        octave *= 2
    return next(step * octave for step in (9, 12, 15) if step * octave >= n_samples)


def forward(signals: Floats, n_fft: int) -> Complexes:
    """One-sided spectra, (..., n_fft // 2 + 1), of signals padded with zeros to ``n_fft``."""
    tally(forward_transforms=signals.size // max(signals.shape[-1], 1))
    spectra: Complexes = fft.rfft(signals, n_fft)
    return spectra


def inverse(spectra: Complexes, n_fft: int) -> Floats:
    """Signals, (..., n_fft), of one-sided spectra."""
    tally(inverse_transforms=spectra.size // spectra.shape[-1])
    signals: Floats = fft.irfft(spectra, n_fft)
    return signals
