"""Spectrograms: amplitudes over time and frequency."""

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, never, stop_if

if TYPE_CHECKING:
    from scipy.signal import ShortTimeFFT

#: Most columns, as many as a screen is wide; of more windows the loudest is shown.
MOST_COLUMNS = 2000
# Steps of the window in its length: each sample of the signal then has the same weight.
_PER_WINDOW = 8
_AT_ONCE = 512


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spectrogram:
    """Amplitudes over time and frequency.

    Attributes
    ----------
    time_s : (n_columns,)
        Middles of the windows; a column of several has the loudest of each frequency.
    frequency_hz : (n_bins,)
        From 0 to half the rate.
    amplitude : (n_bins, n_columns)
        Unit of the signal: a long sine of amplitude 1 reads 1 at its frequency.
    """

    time_s: Floats
    frequency_hz: Floats
    amplitude: Floats

    def at(self, time_s: float, frequency_hz: float) -> float:
        """Return the amplitude of the nearest column and bin."""
        column = int(np.argmin(np.abs(self.time_s - time_s)))
        row = int(np.argmin(np.abs(self.frequency_hz - frequency_hz)))
        return float(self.amplitude[row, column])


def spectrogram(
    signal: Floats, sample_rate_hz: float, window_s: float, stop: Stop = never
) -> Spectrogram:
    """Return the spectrogram of a signal, with a Hann window that slides by eighths of itself.

    It is that of `scipy.signal.ShortTimeFFT`, scaled to magnitude and one-sided; beyond both ends
    of the signal there is silence.

    Parameters
    ----------
    signal : (n_times,)
        Any unit.
    sample_rate_hz
        Its rate.
    window_s
        Length of the window: 0.05 resolves 20 Hz, 0.2 resolves 5 Hz.
    stop
        Called now and then.

    Raises
    ------
    InvalidInputError
        A window of less than 8 samples.
    Stopped
        ``stop`` returned True.
    """
    rate = sample_rate_hz
    n_window = round(window_s * rate)
    if n_window < _PER_WINDOW:
        raise InvalidInputError(
            f"window_s is {window_s:g}, {n_window} samples; expected at least {_PER_WINDOW} samples"
        )
    transform = _transform(n_window, rate)
    n_times = signal.size
    if n_times < n_window:
        signal = np.pad(signal, (0, n_window - n_times))
    # From the first window whose middle is on the signal to the last one.
    last = (n_times - 1) // transform.hop + 1
    pooled = ceil(last / MOST_COLUMNS)
    amplitude = np.zeros((transform.f_pts, ceil(last / pooled)))
    for first in range(0, last, pooled * _AT_ONCE):
        stop_if(stop)
        end = min(first + pooled * _AT_ONCE, last)
        magnitude = np.abs(transform.stft(signal, p0=first, p1=end))
        column = first // pooled
        loudest = np.maximum.reduceat(magnitude, np.arange(0, end - first, pooled), axis=1)
        amplitude[:, column : column + loudest.shape[1]] = loudest
    middles = np.arange(last) * (transform.hop / rate)
    time_s = np.array([middles[k : k + pooled].mean() for k in range(0, last, pooled)])
    return Spectrogram(time_s=time_s, frequency_hz=transform.f, amplitude=amplitude)


def _transform(n_window: int, rate: float) -> "ShortTimeFFT":
    window = scipy.signal.windows.hann(n_window, sym=False)
    # Four times as many bins as the window resolves: a sine between two of them reads 1 % low.
    return scipy.signal.ShortTimeFFT(
        window,
        hop=n_window // _PER_WINDOW,
        fs=rate,
        mfft=scipy.fft.next_fast_len(4 * n_window, real=True),
        scale_to="magnitude",
        fft_mode="onesided2X",
    )
