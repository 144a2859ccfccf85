"""The exact signed maximum of the vibration by a unit voice, from few of its channels.

Channels are transformed in the order of what bounds their samples, until no bound exceeds the
maximum found: the result is that of the full search.
"""

from collections.abc import Sequence
from itertools import chain, repeat
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Complexes, Floats
from skinsource.job import Stop, never, stop_if
from skinsource.rendering.bounds import channel_bounds
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.segments import Blocks
from skinsource.rendering.transforms import forward, inverse
from skinsource.work import tally

#: Channels of a voice that are transformed before its bounds are looked at again.
_BATCHES = (4, 8, 8, 16)
#: Blocks whose bounds are held together.
_BLOCKS_AT_ONCE = 128


class Peak(NamedTuple):
    """The signed maximum of a vibration: its value, channel and sample.

    Where the vibration is nowhere above 0 its place means nothing.
    """

    value: float
    channel: int = 0
    time: int = 0


def peaks_of(
    drives: Sequence[Floats],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Stop = never,
    *,
    tight: bool = True,
) -> list[Peak]:
    """Signed maximum of each drive convolved with its responses, over channels and times.

    Parameters
    ----------
    drives : (n_times,) each
        They may differ in length.
    spectra : (n_fft // 2 + 1,) each
        Their spectra, where ``n_fft`` holds the whole convolution; empty for drives that are
        searched block by block.
    responses
        Responses to the place of each drive, at the same ``n_fft``, or at that of blocks.
    tight
        As in `channel_bounds`; blocks are searched with tight ones.
    """
    if not spectra:
        pairs = zip(drives, responses, strict=True)
        return [_peak_by_blocks(drive, response, stop) for drive, response in pairs]
    padded = np.zeros((len(drives), max(drive.size for drive in drives)))
    for line, drive in zip(padded, drives, strict=True):
        line[: drive.size] = drive
    bounds = channel_bounds(padded, np.array(spectra), responses, tight=tight)
    order = np.argsort(-bounds, axis=-1, kind="stable")
    peaks = [Peak(-np.inf) for _ in spectra]
    largest = np.full(len(peaks), -np.inf)
    begin = 0
    for batch in chain(_BATCHES, repeat(_BATCHES[-1])):
        stop_if(stop)
        chosen = order[:, begin : begin + batch]
        begin += batch
        open_ones = np.take_along_axis(bounds, chosen, axis=-1) > largest[:, None]
        if not open_ones.any():
            return peaks
        which = np.nonzero(open_ones)[0]
        channel = chosen[open_ones]
        signals = _signals(spectra, responses, np.bincount(which, minlength=len(peaks)), channel)
        time = signals.argmax(axis=-1)
        value = signals[np.arange(time.size), time]
        for row in np.flatnonzero(value > largest[which]).tolist():
            k = int(which[row])
            if value[row] > largest[k]:
                largest[k] = value[row]
                peaks[k] = Peak(float(value[row]), int(channel[row]), int(time[row]))
    return peaks


def _signals(
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    counts: NDArray[np.int64],
    channels: NDArray[np.int64],
) -> Floats:
    """Vibrations by drives at so many channels of each, (n_channels, n_fft)."""
    found = np.empty((channels.size, spectra[0].size), np.complex128)
    end = 0
    for spectrum, response, count in zip(spectra, responses, counts.tolist(), strict=True):
        begin, end = end, end + count
        if count:
            np.multiply(response.rows[channels[begin:end]], spectrum, out=found[begin:end])
    tally(search_transforms=channels.size)
    return inverse(found, responses[0].n_fft)


def _peak_by_blocks(samples: Floats, response: ResponseSpectrum, stop: Stop) -> Peak:
    peak = Peak(-np.inf)
    cut = Blocks(response.taps.shape[-1])
    starts = range(0, samples.size + cut.overlap, cut.n_samples)
    for k in range(0, len(starts), _BLOCKS_AT_ONCE):
        stop_if(stop)
        found = {first: cut.segment(samples, first) for first in starts[k : k + _BLOCKS_AT_ONCE]}
        sounding = {first: segment for first, segment in found.items() if segment is not None}
        if len(sounding) < len(found) and peak.value < 0.0:
            peak = Peak(0.0)
        if sounding:
            segments = np.array(list(sounding.values()))
            spectra = forward(segments, cut.n_fft)
            bounds = channel_bounds(segments, spectra, [response] * len(segments))
            peak = _search(spectra, response, bounds, list(sounding), peak, stop)
    return peak


def _search(
    spectra: Complexes,
    response: ResponseSpectrum,
    bounds: Floats,
    starts: list[int],
    peak: Peak,
    stop: Stop,
) -> Peak:
    """Largest sample of blocks of a vibration, or ``peak`` if none exceeds it.

    Parameters
    ----------
    spectra : (n_blocks, n_bins)
        Spectra of the blocks of the drive.
    bounds : (n_blocks, n_channels)
        What no sample of a block and channel exceeds.
    starts
        First sample of the response in each block.
    """
    overlap = response.taps.shape[-1] - 1
    flat = bounds.ravel()
    order = np.argsort(-flat, kind="stable")
    begin = 0
    for batch in chain(_BATCHES, repeat(_BATCHES[-1])):
        stop_if(stop)
        chosen = order[begin : begin + batch]
        begin += batch
        chosen = np.sort(chosen[flat[chosen] > peak.value])
        if chosen.size == 0:
            break
        block, channel = np.divmod(chosen, bounds.shape[-1])
        signals = inverse(response.rows[channel] * spectra[block], response.n_fft)[:, overlap:]
        tally(search_transforms=chosen.size)
        row, time = divmod(int(signals.argmax()), signals.shape[-1])
        if signals[row, time] > peak.value:
            first = starts[block[row]]
            peak = Peak(float(signals[row, time]), int(channel[row]), first + time)
    return peak
