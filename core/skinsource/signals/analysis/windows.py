"""Consecutive windows of a response, and the RMS in each."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import finite_array, integer
from skinsource.base.conventions import PRE_TRIGGER_DELAY_S, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.signals.sampling import NEAR

#: Most windows of one response.
MOST_WINDOWS = 60
_MOST_SAMPLES = 2**53


@dataclass(frozen=True, slots=True, kw_only=True)
class Windows:
    """Windows that follow each other, as `skinsource.windowed_rms` cuts them.

    Attributes
    ----------
    first_sample
        First sample of the first window.
    window_samples
        Samples of each.
    count
        Number of windows.
    """

    first_sample: int
    window_samples: int
    count: int

    def bounds_s(self, sample_rate_hz: float) -> list[tuple[float, float]]:
        """Return start and end of each, in s from the start of the first one."""
        length_s = self.window_samples / sample_rate_hz
        return [(j * length_s, (j + 1) * length_s) for j in range(self.count)]


def windows_over(
    stimulus_samples: int,
    response_samples: int,
    sample_rate_hz: float,
    *,
    count: int | None,
    window_s: float,
    delay_s: float = PRE_TRIGGER_DELAY_S,
) -> Windows:
    """Return the windows in which the response to a stimulus arrives.

    The first one begins after the pre-trigger delay, when the response to the start of the stimulus
    arrives.  Only whole windows count, and at most `MOST_WINDOWS`.

    Parameters
    ----------
    stimulus_samples, response_samples
        Lengths of stimulus and response.
    sample_rate_hz
        Of both.
    count
        How many windows the stimulus is cut into, each of the same number of samples; None: as
        many as overlap the stimulus.
    window_s
        How long each is, where ``count`` is None.
    delay_s
        Pre-trigger delay of the limb, `Limb.pre_trigger_delay_s`.
    """
    first = floor(delay_s * sample_rate_hz + NEAR)
    if count is None:
        length = max(floor(window_s * sample_rate_hz + 0.5), 1)
        count = min(ceil(stimulus_samples / length), MOST_WINDOWS)
    else:
        length = max(stimulus_samples // count, 1)
    n_whole = max(response_samples - first, 0) // length
    return Windows(first_sample=first, window_samples=length, count=min(count, n_whole))


def windowed_rms(signals: ArrayLike, window_samples: int, first_sample: int = 0) -> Floats:
    """Return the RMS of signals in windows that follow each other.

    Window j holds samples ``first_sample + j * window_samples`` up to those of the next one.  Only
    whole windows count: the rest at the end belongs to none.

    Parameters
    ----------
    signals : (..., n_times)
        One signal each, (72, n_times) for the outputs of a limb.
    window_samples
        Samples of a window, at least 1: ``round(0.1 * limb.sample_rate_hz)`` for 100 ms.
    first_sample
        First sample of the first window: about 67 leaves out the pre-trigger delay of measured
        responses.

    Returns
    -------
    (n_windows, ...)
        In the unit of the signals; no window where the signals are shorter than a window.

    Raises
    ------
    InvalidInputError
        A sample is not finite, or a number of samples is not a whole number.

    Examples
    --------
    >>> import skinsource as ss
    >>> ss.windowed_rms([[3.0, 4.0, 0.0, 0.0, 1.0]], 2).round(3)
    array([[3.536],
           [0.   ]])
    """
    data = finite_array("signals", signals)
    if data.ndim == 0:
        raise InvalidInputError("signals is a single number, expected signals, (..., n_times)")
    window = integer("window_samples", window_samples, 1, _MOST_SAMPLES)
    first = integer("first_sample", first_sample, 0, _MOST_SAMPLES)
    n_windows = max(data.shape[-1] - first, 0) // window
    pieces = data[..., first : first + n_windows * window]
    pieces = pieces.reshape(*data.shape[:-1], n_windows, window)
    # Divided by their largest sample, no square over- or underflows.
    largest = np.abs(pieces).max(axis=-1, keepdims=True, initial=0.0)
    scale = np.where(largest > 0.0, largest, 1.0)
    rms = scale[..., 0] * np.sqrt(np.mean(np.square(pieces / scale), axis=-1))
    return np.ascontiguousarray(np.moveaxis(rms, -1, 0))
