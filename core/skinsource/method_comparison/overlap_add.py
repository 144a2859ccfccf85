"""Blocks of the drives, transformed one after the other; their responses overlap and add."""

from collections.abc import Iterator

import numpy as np
from scipy import fft

from skinsource.method_comparison.accuracy import Block
from skinsource.method_comparison.method import (
    Method,
    Prepared,
    Unfit,
    all_channels,
    drives_of,
    require_bytes,
    spectra_of,
    taps_of,
)
from skinsource.method_comparison.scenes import ComparedScene

#: Transforms are no shorter than that where none are asked for, nor than four responses.
_LEAST_BLOCK = 4096
#: With less of each block that is new, nearly all that is computed is computed again.
_LEAST_STEPS = 4


def prepare(scene: ComparedScene, method: Method) -> Prepared:
    """Transform the responses at the length of a block."""
    taps, drives = taps_of(scene, method), drives_of(scene, method)
    overlap = taps.shape[-1] - 1
    n_fft = method.setting.block or max(_LEAST_BLOCK, fft.next_fast_len(4 * overlap, real=True))
    step = n_fft - overlap
    if _LEAST_STEPS * step < overlap:
        raise Unfit(
            f"blocks of {n_fft} samples are hardly longer than responses of {overlap + 1} samples"
        )
    require_bytes(taps[..., 0].size * n_fft * taps.itemsize)
    n_times = drives.shape[-1] + overlap
    responses = spectra_of(taps, n_fft)

    def run(_: int) -> Iterator[Block]:
        tail = np.zeros((taps.shape[1], overlap), drives.dtype)
        total = np.empty_like(responses[0])
        product = np.empty_like(total)
        for first in range(0, n_times, step):
            total[:] = 0.0
            spectra = fft.rfft(drives[:, first : first + step], n_fft)
            for response, spectrum in zip(responses, spectra, strict=True):
                np.multiply(response, spectrum, out=product)
                np.add(total, product, out=total)
            samples = fft.irfft(total, n_fft)
            samples[:, :overlap] += tail
            tail = samples[:, step:].copy()
            yield first, samples[:, : min(step, n_times - first)]

    return Prepared(rows=all_channels(scene), run=run)
