"""The exact signed maximum of a unit field, from few of its 216 channels."""

import numpy as np

from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.transforms import Complexes, Floats, inverse

_FIRST_BATCH, _BATCH = 4, 12
#: Bounds are computed with rounding errors; this keeps them above the samples.
_MARGIN = 1.0 + 1e-9


def largest_sample(samples: Floats, spectrum: Complexes, response: ResponseSpectrum) -> float:
    """Signed maximum of ``samples`` convolved with all responses, over channels and times.

    No sample of channel c exceeds the sum over frequency of |F| |H_c|, nor the product of the
    norms of drive and response.  Channels are transformed in the order of their bounds, until no
    bound exceeds the maximum found: the result is that of the full search.

    Parameters
    ----------
    samples : (n_times,)
        The drive.
    spectrum : (n_fft // 2 + 1,)
        Its spectrum; ``n_fft`` holds the whole convolution.
    response
        Responses to the place of the drive.
    """
    bounds = channel_bounds(samples, spectrum, response)
    order = np.argsort(-bounds, kind="stable")
    values = response.values.reshape(-1, response.values.shape[-1])
    largest, start, batch = -np.inf, 0, _FIRST_BATCH
    while start < order.size and bounds[order[start]] > largest:
        chosen = np.sort(order[start : start + batch])
        signals = inverse(values[chosen] * spectrum, response.n_fft)
        largest = max(largest, float(signals.max()))
        start, batch = start + batch, _BATCH
    return largest


def channel_bounds(samples: Floats, spectrum: Complexes, response: ResponseSpectrum) -> Floats:
    """What no sample of each channel exceeds, (216,)."""
    magnitudes = np.sqrt(np.square(spectrum.real) + np.square(spectrum.imag))
    by_frequency = response.weighted_magnitudes @ magnitudes
    by_energy = response.energies * np.linalg.norm(samples)
    by_peak = response.absolute_sums * np.abs(samples).max(initial=0.0)
    return np.minimum(np.minimum(by_frequency, by_energy), by_peak) * _MARGIN
