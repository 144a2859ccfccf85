"""Levels over time and over frequency."""

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.arrays import Complexes, Floats
from skinsource.errors import InvalidInputError
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.span import Span, check_span, loudest_energy, window_samples


def rms(x: ArrayLike, span: Span = "record", sample_rate_hz: float = SAMPLE_RATE_HZ) -> Floats:
    """Root mean square over time (the last axis), in the unit of ``x``.

    Parameters
    ----------
    x : (..., n_times)
        Signals.
    span
        ``"record"``: over all samples, as upstream; silence before and after counts.
        ``"loudest"``: the largest RMS of any 100 ms; of a signal shorter than that, over 100 ms
        of which the rest is silent, so that silence around a signal changes nothing.
    sample_rate_hz
        Sample rate; only ``"loudest"`` asks for it.

    Raises
    ------
    InvalidInputError
        There are no samples, or the span or the rate is none.
    """
    check_span(span)
    data = _samples(x)
    if span == "record":
        return np.sqrt(np.mean(np.square(data), axis=-1))
    n_window = window_samples(sample_rate_hz)
    return np.sqrt(loudest_energy(data, n_window) / n_window)


def magnitude_spectrum(x: ArrayLike, sample_rate_hz: float) -> tuple[Floats, Floats]:
    """One-sided amplitude spectrum over exactly the samples given.

    Parameters
    ----------
    x : (..., n_times)
        Signals.
    sample_rate_hz
        Sample rate.

    Returns
    -------
    frequency_hz : (n_times // 2 + 1,)
        From 0 to at most half the sample rate, in steps of ``sample_rate_hz / n_times``.
    magnitude : (..., n_times // 2 + 1)
        ``|FFT| / n_times``, doubled except at 0 Hz and at half the sample rate (which only an
        even ``n_times`` has), as upstream: a sine of amplitude 1 on a bin shows 1.

    Raises
    ------
    InvalidInputError
        There are no samples, or the rate is not positive.
    """
    data = _samples(x)
    if not (np.isfinite(sample_rate_hz) and sample_rate_hz > 0):
        raise InvalidInputError(f"sample_rate_hz is {sample_rate_hz}, expected a positive number")
    return one_sided_magnitude(scipy.fft.rfft(data), data.shape[-1], sample_rate_hz)


def one_sided_magnitude(
    spectra: Complexes, n_times: int, sample_rate_hz: float
) -> tuple[Floats, Floats]:
    """Frequencies and magnitudes as in `magnitude_spectrum`, from transforms of real signals."""
    magnitude = np.abs(spectra) / n_times
    magnitude[..., 1 : (n_times + 1) // 2] *= 2.0
    frequency_hz = np.arange(n_times // 2 + 1, dtype=np.float64) * (sample_rate_hz / n_times)
    return frequency_hz, magnitude


def _samples(x: ArrayLike) -> Floats:
    data = np.asarray(x, np.float64)
    if data.ndim == 0 or data.shape[-1] == 0:
        raise InvalidInputError(
            f"signal has shape {data.shape}, expected (..., n_times) with at least one sample"
        )
    return data
