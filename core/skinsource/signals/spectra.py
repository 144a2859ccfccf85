"""Levels over time and over frequency."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from skinsource.base.arguments import (
    LARGEST_SAMPLE,
    checking,
    finite_array,
    one_of,
    positive_number,
)
from skinsource.base.conventions import BAND_HZ, SAMPLE_RATE_HZ, Band, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, never, stop_if
from skinsource.signals.loudest_window import (
    HOLD_WINDOW_S,
    SPANS,
    Span,
    loudest_energy,
    window_samples,
)
from skinsource.signals.resampling import MAX_RATE_HZ
from skinsource.signals.sampling import turns

_FRAMES_AT_ONCE = 64
# Signals up to this length have their shares cached: stimuli of one length follow each other.
_SHORT = 2**14
#: Bins over which the paper averages the spectra of noise.
MEAN_OF_BINS = 10


def rms(x: ArrayLike, span: Span = "record", sample_rate_hz: float = SAMPLE_RATE_HZ) -> Floats:
    """Return the root mean square over time (the last axis), in the unit of ``x``.

    Parameters
    ----------
    x : (..., n_times)
        Signals.
    span
        ``"record"``: over all samples, as upstream; silence before and after counts.
        ``"loudest"``: the largest RMS of any window; of a signal shorter than that, over a window
        of which the rest is silent, so that silence around a signal changes nothing.
    sample_rate_hz
        Sample rate; only ``"loudest"`` needs it.

    Raises
    ------
    InvalidInputError
        There are no samples, a sample is no finite real number, or the span or rate is invalid.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(f"{ss.rms(ss.sinusoid(130.0)):.3f}")
    0.707
    """
    one_of("span", span, SPANS)
    rate = positive_number("sample_rate_hz", sample_rate_hz)
    data, scale = _scaled(_samples(x, math.inf))
    if span == "record":
        energy = np.mean(np.square(data), axis=-1)
    else:
        n_window = window_samples(rate)
        energy = loudest_energy(data, n_window) / n_window
    return np.sqrt(energy) * scale


def magnitude_spectrum(
    x: ArrayLike, sample_rate_hz: float = SAMPLE_RATE_HZ
) -> tuple[Floats, Floats]:
    """Return the one-sided amplitude spectrum over exactly the samples given.

    Parameters
    ----------
    x : (..., n_times)
        Signals.
    sample_rate_hz
        Sample rate; by default that of the published limbs.

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
        There are no samples, a sample is no finite real number, or the rate is not positive.

    Examples
    --------
    >>> import skinsource as ss
    >>> frequency_hz, magnitude = ss.magnitude_spectrum(ss.sinusoid(130.0))
    >>> print(frequency_hz[magnitude.argmax()])
    130.0
    """
    rate = positive_number("sample_rate_hz", sample_rate_hz)
    data, scale = _scaled(_samples(x, LARGEST_SAMPLE))
    frequency_hz, magnitude = one_sided_magnitude(scipy.fft.rfft(data), data.shape[-1], rate)
    return frequency_hz, magnitude * scale[..., None]


@checking
def peak_hold_spectrum(
    x: ArrayLike, sample_rate_hz: float = SAMPLE_RATE_HZ, stop: Stop = never
) -> tuple[Floats, Floats]:
    """Return the largest amplitude that each frequency reaches in any 250 ms.

    A Hann window of 250 ms slides over the signal in eighths of its length, with silence beyond
    both ends; it is transformed at each position, and each frequency keeps its largest value.
    Silence around a signal, its onset and (from 250 ms on) its length change nothing: a sine of
    amplitude 1 that lasts as long as the window or longer reads 1, shorter ones less.

    Parameters
    ----------
    x : (..., n_times)
        Signals.
    sample_rate_hz
        Sample rate; by default that of the published limbs.
    stop
        Called now and then.

    Returns
    -------
    frequency_hz : (n_bins,)
        From 0 to half the sample rate, in steps of about 1 Hz: a quarter of what 250 ms resolve.
    amplitude : (..., n_bins)
        One-sided, divided by the sum of the window: never above the largest sample's double, and
        for a sine within 1 % of its amplitude wherever it lies between the frequencies.

    Raises
    ------
    InvalidInputError
        There are no samples, a sample is no finite real number, or the rate is not positive.
    Stopped
        ``stop`` returned True.

    Examples
    --------
    >>> import skinsource as ss
    >>> frequency_hz, magnitude = ss.peak_hold_spectrum(ss.sinusoid(130.0))
    >>> print(f"{frequency_hz[magnitude.argmax()]:.0f} Hz")
    130 Hz
    """
    rate = positive_number("sample_rate_hz", sample_rate_hz)
    if rate > MAX_RATE_HZ:
        raise InvalidInputError(
            f"sample_rate_hz is {rate:g}, expected at most {MAX_RATE_HZ:g} Hz; resample it first"
        )
    data, scale = _scaled(_samples(x, LARGEST_SAMPLE))
    n_window = max(round(HOLD_WINDOW_S * rate), 4)
    window = scipy.signal.windows.hann(n_window, sym=False)
    window *= 2.0 / window.sum()
    n_fft = 2 * scipy.fft.next_fast_len(2 * n_window, real=True)
    largest = np.zeros((math.prod(data.shape[:-1]), n_fft // 2 + 1))
    for row, held in zip(data.reshape(len(largest), data.shape[-1]), largest, strict=True):
        frames = sliding_window_view(np.pad(row, n_window - 1), n_window)[:: n_window // 8 or 1]
        for first in range(0, len(frames), _FRAMES_AT_ONCE):
            stop_if(stop)
            windowed = frames[first : first + _FRAMES_AT_ONCE] * window
            np.maximum(held, np.abs(scipy.fft.rfft(windowed, n_fft)).max(axis=0), out=held)
    # The bins at 0 Hz and at half the rate have no mirror image.
    largest[:, [0, -1]] /= 2.0
    frequency_hz = np.arange(n_fft // 2 + 1, dtype=np.float64) * (rate / n_fft)
    of_each = largest.reshape(*data.shape[:-1], frequency_hz.size)
    return frequency_hz, of_each * scale[..., None]


def one_sided_magnitude(
    spectra: Complexes, n_times: int, sample_rate_hz: float
) -> tuple[Floats, Floats]:
    """Return frequencies and magnitudes of `magnitude_spectrum` from transforms of real signals."""
    magnitude = np.abs(spectra) / n_times
    magnitude[..., 1 : (n_times + 1) // 2] *= 2.0
    frequency_hz = np.arange(n_times // 2 + 1, dtype=np.float64) * (sample_rate_hz / n_times)
    return frequency_hz, magnitude


def mean_of_bins(magnitude: Floats, n: int) -> Floats:
    """Return the moving mean of a spectrum over neighbours, of fewer at the ends.

    Parameters
    ----------
    magnitude : (..., n_bins)
        Magnitudes.
    n
        Number of bins: the bin itself, ``n // 2`` below and the rest above it; 1: no change.
    """
    if n <= 1 or magnitude.shape[-1] == 0:
        return magnitude
    widths = [(0, 0)] * (magnitude.ndim - 1) + [(n // 2, (n - 1) // 2)]
    sums = sliding_window_view(np.pad(magnitude, widths), n, axis=-1).sum(axis=-1)
    ones = np.pad(np.ones(magnitude.shape[-1]), widths[-1])
    return sums / sliding_window_view(ones, n).sum(axis=-1)


def share_outside_band(samples: Floats, sample_rate_hz: float, band: Band = BAND_HZ) -> float:
    """Return the share of the energy of a signal outside a band, from 0 to 1; 0 for silence.

    It is exact for the spectrum at all frequencies, not only at multiples of 1 / duration: its
    integral over the band is a sum of the autocorrelation r(l) over all lags l, times
    (sin(2 pi high l / rate) - sin(2 pi low l / rate)) / (pi l).  The sum is computed, by Parseval,
    over the transform of samples padded to twice their length; its squares are the transform of r.

    Parameters
    ----------
    samples : (n_times,)
        The signal; silent before and after.
    sample_rate_hz
        Its rate.
    band
        Low and high, in Hz.
    """
    if not samples.any():
        return 0.0
    return share_of_scaled(_scaled(samples)[0], sample_rate_hz, band)


def share_of_scaled(data: Floats, rate_hz: float, band: Band) -> float:
    """Return the same for a signal whose largest sample is about 1."""
    low_hz, high_hz = (min(edge_hz, rate_hz / 2) for edge_hz in band)
    outside, whole = (_cached_shares if data.size <= _SHORT else _shares)(
        low_hz, high_hz, data.size, rate_hz
    )
    # numpy's transform: the clip editor calls this before scipy.fft has been imported.
    spectrum = np.fft.rfft(data, _length(2 * data.size))
    power = spectrum.real**2 + spectrum.imag**2
    return min(max(float(power @ outside) / float(power @ whole), 0.0), 1.0)


def _shares(low_hz: float, high_hz: float, n_times: int, rate_hz: float) -> tuple[Floats, Floats]:
    """Return the weights of the power at each frequency for the energy outside, and for all.

    They have (n_bins,) each, for ``n_times`` samples padded with as many zeros or more.
    """
    n = _length(2 * n_times)
    of_lags = np.zeros(n)
    of_lags[0] = (high_hz - low_hz) / rate_hz
    edges = np.sin(2.0 * np.pi * turns(high_hz, n_times, rate_hz)[1:])
    edges -= np.sin(2.0 * np.pi * turns(low_hz, n_times, rate_hz)[1:])
    # Half, because each lag is here in both directions.
    of_lags[1:n_times] = edges / (2.0 * np.pi * np.arange(1, n_times))
    of_lags[n - n_times + 1 :] = of_lags[n_times - 1 : 0 : -1]
    whole = np.ones(n // 2 + 1)
    whole[1 : (n + 1) // 2] = 2.0
    return whole * (1.0 - 2.0 * np.fft.rfft(of_lags).real), whole


def _length(n: int) -> int:
    """Return the smallest of 8, 9, 10, 12 and 15 times a power of two that is at least ``n``."""
    octave = 1 << max(n.bit_length() - 4, 0)
    return next(step * octave for step in (8, 9, 10, 12, 15, 16) if step * octave >= n)


_cached_shares = lru_cache(maxsize=8)(_shares)


def _scaled(data: Floats) -> tuple[Floats, Floats]:
    """Return signals divided by a power of two near their largest sample, and those powers.

    Squares and sums then neither over- nor underflow, and nothing rounds.
    """
    exponent = np.frexp(np.abs(data).max(axis=-1))[1] - 1
    return np.ldexp(data, -exponent[..., None]), np.ldexp(1.0, exponent)


def _samples(x: ArrayLike, largest: float) -> Floats:
    data = finite_array("signal", x, "(..., n_times)", largest)
    if data.ndim == 0 or data.shape[-1] == 0:
        raise InvalidInputError(
            f"signal has shape {data.shape}, expected (..., n_times) with at least one sample"
        )
    return data
