"""The exact signed maximum of a unit field, from few of its 216 channels."""

from collections.abc import Callable

import numpy as np

from skinsource.graph import Stopped
from skinsource.limb import N_TAPS
from skinsource.rendering.drives import Drive
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.segments import BLOCK_FFT, BLOCK_SAMPLES, Played
from skinsource.rendering.transforms import Complexes, Floats, forward, inverse
from skinsource.response_scaling import Scaling

_FIRST_BATCH, _BATCH = 4, 12
#: Bounds are computed in single precision; this keeps them above the samples.
_MARGIN = 1.0 + 1e-4
# Below it a reciprocal overflows.
_SMALLEST = float(np.finfo(np.float64).tiny)


def unit_gain(
    drive: Drive,
    spectrum: Complexes | None,
    response: ResponseSpectrum,
    scaling: Scaling,
    stop: Callable[[], bool] = lambda: False,
) -> float:
    """What the field of the scaled samples of ``drive`` is multiplied with at amplitude 1.

    Under ``"upstream"`` scaling one over its signed maximum, or no division where no sample is
    positive; else the factor that the samples were divided by.

    ``spectrum`` is that of the samples, at the length of the response's; None for a drive too long
    for it, which is searched block by block.
    """
    if drive.silent or scaling != "upstream":
        return drive.factor
    if spectrum is None:
        largest = largest_sample_by_blocks(drive.samples, response, stop)
    else:
        largest = largest_sample(drive.samples, spectrum, response)
    # The factor of the drive cancels: the field reaches the amplitude whatever it was.
    return 1.0 / largest if largest >= _SMALLEST else drive.factor


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
    # The scale keeps the squares of single precision from over- and underflow.
    scale = magnitudes.max(initial=0.0) or 1.0
    by_frequency = response.weighted_magnitudes @ (magnitudes / scale).astype(np.float32)
    by_energy = response.energies * np.linalg.norm(samples)
    by_peak = response.absolute_sums * np.abs(samples).max(initial=0.0)
    return np.minimum(np.minimum(by_frequency * scale, by_energy), by_peak) * _MARGIN


def largest_sample_by_blocks(
    samples: Floats, response: ResponseSpectrum, stop: Callable[[], bool] = lambda: False
) -> float:
    """Signed maximum of a long drive convolved with all responses, as `largest_sample`."""
    one = Played(samples=samples, start=0, weight=1.0, response=response)
    values = response.values.reshape(-1, response.values.shape[-1])
    largest = -np.inf
    for first in range(0, samples.size + N_TAPS - 1, BLOCK_SAMPLES):
        if stop():
            raise Stopped
        segment = one.segment(first)
        if segment is None:
            largest = max(largest, 0.0)
            continue
        spectrum = forward(segment, BLOCK_FFT)
        bounds = channel_bounds(segment, spectrum, response)
        order = np.argsort(-bounds, kind="stable")
        for start in range(0, order.size, _BATCH):
            if bounds[order[start]] <= largest:
                break
            chosen = np.sort(order[start : start + _BATCH])
            block = inverse(values[chosen] * spectrum, BLOCK_FFT)[:, N_TAPS - 1 :]
            largest = max(largest, float(block.max()))
    return largest
