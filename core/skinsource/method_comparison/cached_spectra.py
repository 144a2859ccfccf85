"""One transform of everything, with the spectra of the responses kept; plainly written."""

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


def prepare(scene: ComparedScene, method: Method) -> Prepared:
    """Transform the responses."""
    rank = method.setting.rank
    n_kept = scene.limb.n_channels if rank is None else rank
    itemsize = np.dtype(method.precision).itemsize
    require_bytes(len(scene.players) * n_kept * scene.response_samples * itemsize)
    return _whole(scene, method) if rank is None else _of_low_rank(scene, method, rank)


def _whole(scene: ComparedScene, method: Method) -> Prepared:
    taps, drives = taps_of(scene, method), drives_of(scene, method)
    n_times = drives.shape[-1] + taps.shape[-1] - 1
    n_fft = fft.next_fast_len(n_times, real=True)
    responses = spectra_of(taps, n_fft)
    total = np.empty_like(responses[0])
    product = np.empty_like(total)

    def run(_: int) -> Iterator[Block]:
        np.multiply(responses[0], fft.rfft(drives[0], n_fft), out=total)
        for response, drive in zip(responses[1:], drives[1:], strict=True):
            np.multiply(response, fft.rfft(drive, n_fft), out=product)
            np.add(total, product, out=total)
        yield 0, fft.irfft(total, n_fft)[:, :n_times]

    return Prepared(rows=all_channels(scene), run=run)


def _of_low_rank(scene: ComparedScene, method: Method, rank: int) -> Prepared:
    """Each response as a combination of the ``rank`` shapes that explain most of the energy."""
    taps, drives = taps_of(scene, method), drives_of(scene, method)
    n_channels = scene.limb.n_channels
    if rank > taps.shape[-1]:
        raise Unfit(f"responses of {taps.shape[-1]} samples have no {rank} shapes")
    n_times = drives.shape[-1] + taps.shape[-1] - 1
    n_fft = fft.next_fast_len(n_times, real=True)
    flat = taps.reshape(-1, taps.shape[-1]).astype(np.float64)
    _, vectors = np.linalg.eigh(flat.T @ flat)
    basis = vectors[:, ::-1][:, :rank]
    shares = (flat @ basis).reshape(len(taps), n_channels, rank).transpose(1, 0, 2)
    shares = np.ascontiguousarray(shares.reshape(n_channels, -1), dtype=method.precision)
    shapes = fft.rfft(np.ascontiguousarray(basis.T, dtype=method.precision), n_fft)

    def run(_: int) -> Iterator[Block]:
        spectra = fft.rfft(drives, n_fft)[:, None] * shapes
        if shares.shape[1] < n_channels:
            played = fft.irfft(spectra, n_fft).reshape(shares.shape[1], -1)
            yield 0, (shares @ played)[:, :n_times]
        else:
            # Real and imaginary parts side by side, so that the product is one of real matrices.
            total = shares @ spectra.reshape(shares.shape[1], -1).view(shares.dtype)
            yield 0, fft.irfft(total.view(spectra.dtype), n_fft)[:, :n_times]

    return Prepared(rows=all_channels(scene), run=run)
