"""Counted Fourier transforms and their lengths, two threads, and blocks of long drives."""

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy

from skinsource.base.conventions import Booleans, Complexes, Floats
from skinsource.base.work import tally
from skinsource.design.signal_path import Drive

#: Lengths are 9, 12 or 15 times a power of two, at least 9 times this one: they are fast, and so
#: few that spectra of responses are used again when a duration changes a little.
_SHORTEST_OCTAVE = 64
# Two threads pay from about half a millisecond of work on; more threads do not help.  Very
# long transforms take so much memory that one thread is better.
_WORTH_A_THREAD, _LONG = 2**16, 2**17


def transform_length(n_samples: int) -> int:
    """Return the shortest of the lengths 576, 768, 960, 1152, 1536, … that holds ``n_samples``."""
    octave = _SHORTEST_OCTAVE
    while 15 * octave < n_samples:
        octave *= 2
    return next(step * octave for step in (9, 12, 15) if step * octave >= n_samples)


def forward(signals: Floats, n_fft: int) -> Complexes:
    """Return one-sided spectra, (..., n_fft // 2 + 1), of signals padded with 0 to ``n_fft``."""
    count = signals.size // max(signals.shape[-1], 1)
    tally(forward_transforms=count)
    return scipy.fft.rfft(signals, n_fft, workers=_workers(count, n_fft))


def inverse(spectra: Complexes, n_fft: int) -> Floats:
    """Return the signals, (..., n_fft), of one-sided spectra."""
    count = spectra.size // spectra.shape[-1]
    tally(inverse_transforms=count)
    return scipy.fft.irfft(spectra, n_fft, workers=_workers(count, n_fft))


def _workers(count: int, n_fft: int) -> int:
    return 2 if count > 1 and count * n_fft >= _WORTH_A_THREAD and n_fft < _LONG else 1


#: Output, 1, 2, 3, …, and axis, 0 to 2.
Channel = tuple[int, int]


def rows_of(spectrum: Complexes, channels: list[Channel]) -> Complexes:
    """Return a copy of some channels of (n_outputs, 3 axes, n_bins), a row for each."""
    return np.array([spectrum[output - 1, axis] for output, axis in channels])


def driven(rows: list[Complexes], drive: Complexes) -> Complexes:
    """Return rows times the spectrum of a drive, (n_bins,)."""
    products = np.empty((len(rows), drive.size), np.complex128)
    for row, product in zip(rows, products, strict=True):
        np.multiply(row, drive, out=product)
    return products


class ChannelsOnDemand:
    """A vibration as a spectrum, whose channels are transformed back to time when requested.

    Missing channels are transformed in one call.  A transform gives the same bits alone and in a
    batch (a test checks it), so that results do not depend on earlier requests.

    Parameters
    ----------
    spectra
        Function from channels to their spectra, (n_channels, n_fft // 2 + 1).
    active : (n_times,) of bool
        When the skin can move at all; elsewhere samples are exactly 0.
    exact_spectra
        Function from channels to spectra over exactly n_times samples, (n_channels,
        n_times // 2 + 1), where that is quicker than transforming traces.
    """

    # Nothing in here refers back to the object, so that its memory is freed at once.
    __slots__ = (
        "__weakref__",
        "_active",
        "_exact_spectra",
        "_latest_spectra",
        "_latest_traces",
        "_n_fft",
        "_spectra",
        "_trace_spectra",
        "_traces",
    )

    def __init__(
        self,
        spectra: Callable[[list[Channel]], Complexes],
        n_fft: int,
        active: Booleans,
        exact_spectra: Callable[[list[Channel]], Complexes] | None = None,
    ) -> None:
        self._spectra = spectra
        self._n_fft = n_fft
        self._active = active
        self._exact_spectra = exact_spectra
        self._traces: dict[Channel, Floats] = {}
        self._trace_spectra: dict[Channel, Complexes] = {}
        # Those that were requested last, a row for each: mostly they are requested again.  Above
        # are views of these rows, so that nothing is in memory twice.
        self._latest_traces: tuple[list[Channel], Floats] = [], np.zeros(0)
        self._latest_spectra: tuple[list[Channel], Complexes] = [], np.zeros(0, np.complex128)

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
        """Return the acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        channels = [(output, axis) for output in outputs for axis in axes]
        if channels != self._latest_traces[0]:
            missing = [channel for channel in channels if channel not in self._traces]
            rows = np.zeros((0, self._active.size))
            if missing:
                rows = inverse(self._spectra(missing), self._n_fft)[:, : self._active.size]
                if not self._active.all():
                    np.copyto(rows, 0.0, where=~self._active)
                self._traces.update(zip(missing, rows, strict=True))
            if missing != channels:
                rows = np.array([self._traces[channel] for channel in channels])
                self._traces.update(zip(channels, rows, strict=True))
            self._latest_traces = channels, rows
        return self._latest_traces[1].reshape(len(outputs), len(axes), self._active.size)

    def trace_spectra(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Complexes:
        """Return spectra over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        channels = [(output, axis) for output in outputs for axis in axes]
        n_bins = self._active.size // 2 + 1
        if channels != self._latest_spectra[0]:
            missing = [channel for channel in channels if channel not in self._trace_spectra]
            rows = np.zeros((0, n_bins), np.complex128)
            if missing and self._exact_spectra is not None:
                rows = self._exact_spectra(missing)
            elif missing:
                self.traces(outputs, axes)
                traces = np.array([self._traces[channel] for channel in missing])
                rows = forward(traces, self._active.size)
            self._trace_spectra.update(zip(missing, rows, strict=True))
            if missing != channels:
                rows = np.array([self._trace_spectra[channel] for channel in channels])
                self._trace_spectra.update(zip(channels, rows, strict=True))
            self._latest_spectra = channels, rows
        return self._latest_spectra[1].reshape(len(outputs), len(axes), n_bins)


def run_on_two_threads(tasks: Iterable[Callable[[], None]]) -> None:
    """Run all of ``tasks``, large array operations, on two threads.

    Each thread takes the next task, so that the first one does all where other programs keep the
    second one waiting.  No task may count work, which belongs to a thread.  What a task raises is
    raised here.
    """
    tasks = tuple(tasks)
    waiting = iter(tasks)
    failures: list[BaseException] = []
    helper = None

    def work() -> None:
        while not failures and (task := next(waiting, None)) is not None:
            try:
                task()
            except BaseException as error:  # noqa: BLE001  either thread may fail
                failures.append(error)

    if len(tasks) > 1:
        with suppress(RuntimeError):  # the system has no more threads, or the program ends
            helper = _second_thread().submit(work)
    work()
    if helper is not None and not helper.cancel():
        helper.result()
    if failures:
        raise failures[0]


@cache
def _second_thread() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(1, thread_name_prefix="skinsource-sums")


# Complex numbers of which a few arrays stay in the cache of a core.
_NUMBERS_AT_ONCE = 2**15


def parts_of(n_outputs: int, numbers_each: int) -> list[slice]:
    """Return slices of outputs that are computed at once, by how many numbers each output has."""
    at_once = min(max(_NUMBERS_AT_ONCE // numbers_each, 1), n_outputs)
    return [slice(low, min(low + at_once, n_outputs)) for low in range(0, n_outputs, at_once)]


#: Samples of a block of a drive, for responses of up to half as many.
BLOCK_FFT = 2048
#: Longer vibrations are computed block by block where 20 locations of a limb of 216 channels are in
#: use, or where spectra of the responses take as much memory.
LONGEST_AT_ONCE = 6144
_MOST_BINS = LONGEST_AT_ONCE * 20 * 216
#: With fewer locations in use there is memory for longer vibrations, up to this length.
LONGEST_OF_FEW = 15_360


@dataclass(frozen=True, slots=True)
class Blocks:
    """How long drives are cut: a block of ``n_fft`` samples gives ``n_samples`` of response.

    Attributes
    ----------
    n_taps
        Samples of the responses.
    """

    n_taps: int

    @property
    def n_fft(self) -> int:
        """Length of the transforms."""
        n_fft = BLOCK_FFT
        while n_fft < 2 * self.n_taps:
            n_fft *= 2
        return n_fft

    @property
    def n_samples(self) -> int:
        """Samples of response that a block gives: those into which nothing wraps round."""
        return self.n_fft - self.overlap

    @property
    def overlap(self) -> int:
        """Samples of the drive that a block shares with the one before."""
        return self.n_taps - 1

    def segment(self, samples: Floats, first: int) -> Floats | None:
        """Return samples for the block from sample ``first`` on, (n_fft,); None if silent."""
        begin = first - self.overlap
        piece = samples[max(begin, 0) : max(begin + self.n_fft, 0)]
        if not piece.any():
            return None
        segment = np.zeros(self.n_fft)
        offset = max(-begin, 0)
        segment[offset : offset + piece.size] = piece
        return segment


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Played:
    """A drive at an input location, counted from 1.

    It starts at sample ``start``; its vibration is multiplied with ``weight``.
    """

    drive: Drive
    start: int
    weight: float
    location: int


def length_at_once(response_samples: int, n_places: int, n_channels: int) -> int | None:
    """Return the length of the transforms of a whole design; None for block by block.

    Parameters
    ----------
    response_samples
        Length of the vibration.
    n_places
        Input locations in use, whose spectra of responses are remembered.
    n_channels
        Channels of the responses, outputs times axes.
    """
    n_fft = transform_length(response_samples)
    longest = min(LONGEST_OF_FEW, _MOST_BINS // (max(n_places, 1) * n_channels))
    return n_fft if n_fft <= longest else None
