"""RMS in consecutive windows."""

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array, whole_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

_MOST_SAMPLES = 2**53


def windowed_rms(signals: ArrayLike, window_samples: int, first_sample: int = 0) -> Floats:
    """Return the RMS of signals in windows that follow each other.

    Window j holds samples ``first_sample + j * window_samples`` up to those of the next one.  Only
    whole windows count: what is left at the end belongs to none.

    Parameters
    ----------
    signals : (..., n_times)
        One signal each, (72, n_times) for the outputs of a limb.
    window_samples
        Samples of a window, at least 1.
    first_sample
        Where the first one begins: about 67 leaves out the pre-trigger delay of measured responses.

    Returns
    -------
    (n_windows, ...)
        In the unit of the signals; no window where the signals are too short for one.

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
    window = whole_number("window_samples", window_samples, 1, _MOST_SAMPLES)
    first = whole_number("first_sample", first_sample, 0, _MOST_SAMPLES)
    n_windows = max(data.shape[-1] - first, 0) // window
    pieces = data[..., first : first + n_windows * window]
    pieces = pieces.reshape(*data.shape[:-1], n_windows, window)
    # By their largest sample, so that no square over- or underflows.
    largest = np.abs(pieces).max(axis=-1, keepdims=True, initial=0.0)
    scale = np.where(largest > 0.0, largest, 1.0)
    rms = scale[..., 0] * np.sqrt(np.mean(np.square(pieces / scale), axis=-1))
    return np.ascontiguousarray(np.moveaxis(rms, -1, 0))
