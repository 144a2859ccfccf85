"""The exact signed maximum of a unit field, from few of its 216 channels.

Channels are transformed in the order of what bounds their samples, until no bound exceeds the
maximum found: the result is that of the full search.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from skinsource.graph import Stopped
from skinsource.limb import N_TAPS
from skinsource.rendering.bounds import channel_bounds
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.segments import BLOCK_FFT, BLOCK_SAMPLES, segment_of
from skinsource.rendering.transforms import Complexes, Floats, forward, inverse
from skinsource.work import tally

#: Channels of an input that are transformed before its bounds are looked at again.
_BATCHES = (5, 11, 16)
#: Blocks whose bounds are held together.
_BLOCKS_AT_ONCE = 128


class Peak(NamedTuple):
    """The signed maximum of a field: its value, channel (of 216) and sample.

    Where the field is nowhere above 0 its place means nothing.
    """

    value: float
    channel: int = 0
    time: int = 0


def peaks_of(
    drives: Sequence[Floats],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Callable[[], bool] = lambda: False,
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
    """
    if not spectra:
        pairs = zip(drives, responses, strict=True)
        return [_peak_by_blocks(drive, response, stop) for drive, response in pairs]
    padded = np.zeros((len(drives), max(drive.size for drive in drives)))
    for row, drive in zip(padded, drives, strict=True):
        row[: drive.size] = drive
    bounds = channel_bounds(padded, np.array(spectra), responses)
    searches = [
        _Search(spectrum[None], response, bound, Peak(-np.inf))
        for spectrum, response, bound in zip(spectra, responses, bounds, strict=True)
    ]
    _finish(searches, (0,), 0, stop)
    return [search.peak for search in searches]


def _peak_by_blocks(samples: Floats, response: ResponseSpectrum, stop: Callable[[], bool]) -> Peak:
    peak = Peak(-np.inf)
    starts = range(0, samples.size + N_TAPS - 1, BLOCK_SAMPLES)
    for k in range(0, len(starts), _BLOCKS_AT_ONCE):
        if stop():
            raise Stopped
        found = {first: segment_of(samples, first) for first in starts[k : k + _BLOCKS_AT_ONCE]}
        felt = {first: segment for first, segment in found.items() if segment is not None}
        if len(felt) < len(found) and peak.value < 0.0:
            peak = Peak(0.0)
        if felt:
            segments = np.array(list(felt.values()))
            spectra = forward(segments, BLOCK_FFT)
            bounds = channel_bounds(segments, spectra, [response] * len(segments))
            search = _Search(spectra, response, bounds.ravel(), peak)
            _finish([search], tuple(felt), N_TAPS - 1, stop)
            peak = search.peak
    return peak


class _Search:
    """How far the search for the maximum of a unit field has come.

    Parameters
    ----------
    spectra : (n_pieces, n_bins)
        Spectra of the pieces of the drive.
    bounds : (n_pieces * 216,)
        What no sample of a piece and channel exceeds.
    peak
        The largest found before.
    """

    def __init__(
        self, spectra: Complexes, response: ResponseSpectrum, bounds: Floats, peak: Peak
    ) -> None:
        self._spectra, self._response, self._bounds = spectra, response, bounds
        self._order = np.argsort(-bounds, kind="stable")
        self._start = self._step = 0
        self._piece = self._channel = self._order[:0]
        self.peak = peak

    def next_rows(self) -> Complexes:
        """Spectra of what is to be transformed next, (n, n_bins); none: the maximum is found."""
        batch = _BATCHES[min(self._step, len(_BATCHES) - 1)]
        chosen = self._order[self._start : self._start + batch]
        chosen = np.sort(chosen[self._bounds[chosen] > self.peak.value])
        self._start, self._step = self._start + batch, self._step + 1
        self._piece, self._channel = np.divmod(chosen, len(self._response.rows))
        return self._response.rows[self._channel] * self._spectra[self._piece]

    def note(self, signals: Floats, starts: Sequence[int]) -> None:
        """Take over what the rows are in time, (n, n_times), of pieces that start at ``starts``."""
        row, time = divmod(int(signals.argmax()), signals.shape[-1])
        value = float(signals[row, time])
        if value > self.peak.value:
            first = starts[self._piece[row]]
            self.peak = Peak(value, int(self._channel[row]), first + time)


def _finish(
    searches: list[_Search], starts: Sequence[int], skipped: int, stop: Callable[[], bool]
) -> None:
    """Transform what is needed, for all searches together; the first samples do not count."""
    while searches:
        if stop():
            raise Stopped
        chosen = [(search, search.next_rows()) for search in searches]
        unfinished = [(search, rows) for search, rows in chosen if len(rows)]
        if not unfinished:
            return
        spectra = np.concatenate([rows for _, rows in unfinished])
        signals = inverse(spectra, 2 * (spectra.shape[-1] - 1))[:, skipped:]
        tally(search_transforms=len(signals))
        end = 0
        for search, rows in unfinished:
            begin, end = end, end + len(rows)
            search.note(signals[begin:end], starts)
        searches = [search for search, _ in unfinished]
