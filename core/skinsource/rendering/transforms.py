"""Fourier transforms, counted; and their lengths."""

from collections.abc import Iterator

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats
from skinsource.work import tally

#: Lengths are 9, 12 or 15 times a power of two: fast, and few, so that spectra of responses are
#: used again when a duration changes a little.
_SHORTEST_OCTAVE = 64
# Two threads pay from about a tenth of a millisecond of work on; more help no further.  Very long
# transforms take so much memory each that one after the other is better.
_WORTH_A_THREAD, _LONG = 2**14, 2**17


def transform_length(n_samples: int) -> int:
    """Shortest length of the ladder 576, 768, 960, 1152, 1536, … that holds ``n_samples``."""
    octave = _SHORTEST_OCTAVE
    while 15 * octave < n_samples:
        octave *= 2
    return next(step * octave for step in (9, 12, 15) if step * octave >= n_samples)


def forward(signals: Floats, n_fft: int) -> Complexes:
    """One-sided spectra, (..., n_fft // 2 + 1), of signals padded with zeros to ``n_fft``."""
    count = signals.size // max(signals.shape[-1], 1)
    tally(forward_transforms=count)
    spectra: Complexes = scipy.fft.rfft(signals, n_fft, workers=_workers(count, n_fft))
    return spectra


def inverse(spectra: Complexes, n_fft: int) -> Floats:
    """Signals, (..., n_fft), of one-sided spectra."""
    count = spectra.size // spectra.shape[-1]
    tally(inverse_transforms=count)
    signals: Floats = scipy.fft.irfft(spectra, n_fft, workers=_workers(count, n_fft))
    return signals


def forward_in_parts(
    signals: Floats, n_fft: int, at_once: int
) -> Iterator[tuple[slice, Complexes]]:
    """As `forward`, some signals at a time, by this thread alone; whoever wants them counts them.

    Parameters
    ----------
    signals : (n, m, n_times)
        They are padded in one piece of memory, which is used again for each part.
    at_once
        How many of the n are transformed at a time.

    Yields
    ------
    Which of the n, and their spectra, (at most at_once, m, n_fft // 2 + 1), which are the caller's.
    """
    count, each, n_times = signals.shape
    padded = np.empty((min(at_once, count), each, n_fft))
    padded[..., n_times:] = 0.0
    for low in range(0, count, at_once):
        part = slice(low, min(low + at_once, count))
        room = padded[: part.stop - low]
        room[..., :n_times] = signals[part]
        spectra: Complexes = scipy.fft.rfft(room)
        yield part, spectra


def inverse_here(spectra: Complexes, n_fft: int) -> Floats:
    """As `inverse`, by this thread alone; whoever shares work out counts it."""
    signals: Floats = scipy.fft.irfft(spectra, n_fft)
    return signals


def _workers(count: int, n_fft: int) -> int:
    return 2 if count > 1 and count * n_fft >= _WORTH_A_THREAD and n_fft < _LONG else 1
