"""How wrong a computed response is, against the exact one."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats, Integers
from skinsource.method_comparison.references import Reference

#: First sample, and samples of each row.
Block = tuple[int, NDArray[np.floating]]

#: Windows quieter than this share of the channel's peak (-126 dB) are promised nothing.
QUIETEST = 5e-7
_LEAST = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, slots=True, kw_only=True)
class Errors:
    """Errors at the samples of the reference, worst over channels.

    Attributes
    ----------
    peak
        Largest error over the channel's peak.
    l2
        Norm of the errors over norm of the values.
    window
        Largest error in a window of 100 ms over the peak of that window.
    silence
        Largest sample where nothing can arrive, over the channel's peak.
    """

    peak: float
    l2: float
    window: float
    silence: float


def picked(reference: Reference, rows: Integers, blocks: Iterable[Block]) -> Floats:
    """Samples of the reference's places, (n_channels, n_windows, n_samples).

    Parameters
    ----------
    rows
        Channel of each row of the blocks.
    blocks
        The response, block by block; what no block holds is silent.

    Raises
    ------
    ValueError
        A channel of the reference is not among ``rows``.
    """
    place = np.full(1 + max(rows.max(), reference.channels.max()), -1)
    place[rows] = np.arange(rows.size)
    row = place[reference.channels]
    if (row < 0).any():
        raise ValueError("the engine leaves out channels that the reference holds")
    row = np.broadcast_to(row[:, None, None], reference.samples.shape)
    values = np.zeros(reference.samples.shape)
    for first, block in blocks:
        inside = (reference.samples >= first) & (reference.samples < first + block.shape[-1])
        values[inside] = block[row[inside], reference.samples[inside] - first]
    return values


def errors_of(reference: Reference, values: Floats) -> Errors:
    """Errors of ``values``, (n_channels, n_windows, n_samples)."""
    deviation = np.abs((values - reference.high) - reference.low)
    # A channel without a response is exactly silent: any sound there is an error beyond measure.
    channel_peak = np.maximum(reference.peaks.max(axis=1), _LEAST)
    by_window = deviation.max(axis=2)
    heard = reference.peaks >= QUIETEST * channel_peak[:, None]
    silent = reference.peaks == 0.0
    norm = np.maximum(np.sqrt(np.square(reference.high).sum(axis=(1, 2))), _LEAST)
    relative = by_window / channel_peak[:, None]
    return Errors(
        peak=float(relative.max()),
        l2=float((np.sqrt(np.square(deviation).sum(axis=(1, 2))) / norm).max()),
        window=float((by_window[heard] / reference.peaks[heard]).max()),
        silence=float(relative[silent].max(initial=0.0)),
    )


def rounding_ratio(
    deviation: Floats, scale: Floats, n_times: int, precision: type[np.floating]
) -> float:
    """Largest error in units of its a-priori bound, as LAPACK tests do.

    max |e| / (eps log2(n) sum ||x|| ||h||), worst over channels; ``deviation`` and ``scale``,
    the sum, are (n_channels,).
    """
    bound = float(np.finfo(precision).eps) * np.log2(max(n_times, 2)) * scale
    return float((deviation / np.maximum(bound, _LEAST)).max())
