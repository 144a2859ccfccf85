"""Fourier transforms, counted; and their lengths."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from threading import Thread

import numpy as np
import scipy

from skinsource.base.arrays import Booleans, Complexes, Floats
from skinsource.base.work import tally
from skinsource.design.signal_path import Drive

#: Lengths are 9, 12 or 15 times a power of two: fast, and few, so that spectra of responses are
#: used again when a duration changes a little.
_SHORTEST_OCTAVE = 64
# Two threads pay from about a tenth of a millisecond of work on; more help no further.  Very long
# transforms take so much memory each that one after the other is better.
_WORTH_A_THREAD, _LONG = 2**14, 2**17


def transform_length(n_samples: int) -> int:
    """Shortest length of the ladder 576, 768, 960, 1152, 1536, … that holds ``n_samples``."""
    octave = _SHORTEST_OCTAVE
    while 15 * octave < n_samples:
        octave *= 2
    return next(step * octave for step in (9, 12, 15) if step * octave >= n_samples)


def forward(signals: Floats, n_fft: int) -> Complexes:
    """One-sided spectra, (..., n_fft // 2 + 1), of signals padded with zeros to ``n_fft``."""
    count = signals.size // max(signals.shape[-1], 1)
    tally(forward_transforms=count)
    spectra: Complexes = scipy.fft.rfft(signals, n_fft, workers=_workers(count, n_fft))
    return spectra


def inverse(spectra: Complexes, n_fft: int) -> Floats:
    """Signals, (..., n_fft), of one-sided spectra."""
    count = spectra.size // spectra.shape[-1]
    tally(inverse_transforms=count)
    signals: Floats = scipy.fft.irfft(spectra, n_fft, workers=_workers(count, n_fft))
    return signals


def forward_in_parts(
    signals: Floats, n_fft: int, at_once: int
) -> Iterator[tuple[slice, Complexes]]:
    """As `forward`, some signals at a time, by this thread alone; whoever wants them counts them.

    Parameters
    ----------
    signals : (n, m, n_times)
        They are padded in one piece of memory, which is used again for each part.
    at_once
        How many of the n are transformed at a time.

    Yields
    ------
    Which of the n, and their spectra, (at most at_once, m, n_fft // 2 + 1), which are the caller's.
    """
    count, each, n_times = signals.shape
    padded = np.empty((min(at_once, count), each, n_fft))
    padded[..., n_times:] = 0.0
    for low in range(0, count, at_once):
        part = slice(low, min(low + at_once, count))
        room = padded[: part.stop - low]
        room[..., :n_times] = signals[part]
        spectra: Complexes = scipy.fft.rfft(room)
        yield part, spectra


def inverse_here(spectra: Complexes, n_fft: int) -> Floats:
    """As `inverse`, by this thread alone; whoever shares work out counts it."""
    signals: Floats = scipy.fft.irfft(spectra, n_fft)
    return signals


def _workers(count: int, n_fft: int) -> int:
    return 2 if count > 1 and count * n_fft >= _WORTH_A_THREAD and n_fft < _LONG else 1


# A vibration by its spectrum, whose channels are brought back to time when they are looked at.

#: Output, 1, 2, 3, …, and axis, 0 to 2.
Channel = tuple[int, int]


def rows_of(spectrum: Complexes, channels: list[Channel]) -> Complexes:
    """Some channels of (n_outputs, 3 axes, n_bins), one in a row; a copy."""
    return np.array([spectrum[output - 1, axis] for output, axis in channels])


def driven(rows: Complexes, drive: Complexes) -> Complexes:
    """Rows times the spectrum of a drive, (n_bins,), in their place: one pass of memory less."""
    return np.multiply(rows, drive, out=rows)


class ChannelsOnDemand:
    """A vibration by its spectrum; channels are brought back to time when asked for.

    What is missing is computed together.  A transform gives the same bits alone and beside others
    (a test sees to it), so what comes out does not depend on what was asked for before.

    Parameters
    ----------
    spectra
        Function from channels to their spectra, (n_channels, n_fft // 2 + 1).
    active : (n_times,) of bool
        When the skin can move at all; elsewhere it is exactly at rest.
    exact_spectra
        Spectra of channels over exactly n_times samples, (n_channels, n_times // 2 + 1), where
        there is a shorter way to them than by their traces.
    """

    # Nothing here refers back to it, so that an old one goes at once with its megabytes.
    __slots__ = (
        "__weakref__",
        "_active",
        "_exact_spectra",
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
        self._traces = _Channels(np.empty((0, active.size)))
        self._trace_spectra = _Channels(np.empty((0, active.size // 2 + 1), np.complex128))

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        missing = self._traces.missing(outputs, axes)
        if missing:
            samples = inverse(self._spectra(missing), self._n_fft)[:, : self._active.size]
            np.copyto(samples, 0.0, where=~self._active)
            self._traces.add(missing, samples)
        return self._traces.of(outputs, axes)

    def trace_spectra(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Complexes:
        """Their spectra over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        missing = self._trace_spectra.missing(outputs, axes)
        if missing:
            if self._exact_spectra is None:
                self.traces(outputs, axes)
                traces = np.array([self._traces.known[channel] for channel in missing])
                spectra = forward(traces, self._active.size)
            else:
                spectra = self._exact_spectra(missing)
            self._trace_spectra.add(missing, spectra)
        return self._trace_spectra.of(outputs, axes)


class _Channels:
    """Remembers single channels, and the latest selection of them as one array."""

    __slots__ = ("_latest", "known")

    def __init__(self, none: np.ndarray) -> None:
        self.known: dict[Channel, np.ndarray] = {}
        self._latest: tuple[list[Channel], np.ndarray] = [], none

    def missing(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> list[Channel]:
        return [channel for channel in _all(outputs, axes) if channel not in self.known]

    def add(self, channels: list[Channel], rows: np.ndarray) -> None:
        self.known.update(zip(channels, rows, strict=True))
        self._latest = channels, rows

    def of(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> np.ndarray:
        selected = _all(outputs, axes)
        channels, rows = self._latest
        if channels != selected:
            rows = np.array([self.known[channel] for channel in selected], rows.dtype)
            rows = rows.reshape(len(selected), self._latest[1].shape[-1])
            self._latest = selected, rows
        return rows.reshape(len(outputs), len(axes), rows.shape[-1])


def _all(outputs: tuple[int, ...], axes: tuple[int, ...]) -> list[Channel]:
    return [(output, axis) for output in outputs for axis in axes]


# Two threads for work that leaves Python's lock alone: large array operations.


def run_on_two_threads(tasks: Iterable[Callable[[], None]]) -> None:
    """Run all of ``tasks``, by two threads; none may count work, which belongs to a thread.

    Each thread takes the next one that nobody took: where other programs keep the second one
    waiting, the first does it all.  What a task raises is raised here.
    """
    waiting = iter(tuple(tasks))
    failures: list[BaseException] = []

    def work() -> None:
        while not failures and (task := next(waiting, None)) is not None:
            try:
                task()
            except BaseException as error:  # noqa: BLE001  of whichever thread
                failures.append(error)

    helper = Thread(target=work)
    helper.start()
    work()
    helper.join()
    if failures:
        raise failures[0]


# Sums of vibrations, written so that memory is read once, by two threads.

#: Outputs whose spectra, at the lengths of a second, stay in a core's own cache.
OUTPUTS_AT_ONCE = 18
# A second thread pays from about a millisecond of work on.
_SUMS_WORTH_A_THREAD = 10**6


def sum_of_vibrations(responses: Sequence[Complexes], drives: Sequence[Complexes]) -> Complexes:
    """Sum over voices of the spectra of responses times that of the drive.

    Parameters
    ----------
    responses : (n_outputs, 3 axes, n_bins) each
        At least one.
    drives : (n_bins,) each
        As many.

    Returns
    -------
    (n_outputs, 3 axes, n_bins), the same bits whatever the number of threads
    """
    total = np.empty(responses[0].shape, np.complex128)

    tasks = [
        partial(add_up, [response[part] for response in responses], drives, total[part])
        for part in parts_of(len(total))
    ]
    if len(responses) * total.size < _SUMS_WORTH_A_THREAD:
        for task in tasks:
            task()
    else:
        run_on_two_threads(tasks)
    return total


def parts_of(n_outputs: int) -> list[slice]:
    """Outputs that are summed at a time: they stay in a core's own cache."""
    return [slice(low, low + OUTPUTS_AT_ONCE) for low in range(0, n_outputs, OUTPUTS_AT_ONCE)]


def add_up(responses: Sequence[Complexes], drives: Sequence[Complexes], total: Complexes) -> None:
    """Write the sum of responses times drives to ``total``, as `sum_of_vibrations` says."""
    # The total may be the first response.
    np.multiply(responses[0], drives[0], out=total)
    if len(responses) > 1:
        buffer = np.empty(total.shape, np.complex128)
        for response, drive in zip(responses[1:], drives[1:], strict=True):
            total += np.multiply(response, drive, out=buffer)


# Blocks of long drives, for overlap-save.

#: A block of so many samples of a drive, for responses of up to half its length.
BLOCK_FFT = 2048
#: Responses longer than this are computed block by block where twenty places of a limb of 216
#: channels are in use, of any where spectra of the responses take as much.
LONGEST_AT_ONCE = 6144
_MOST_BINS = LONGEST_AT_ONCE * 20 * 216
#: With few places in use there is memory for longer ones, up to this.
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
        """Samples of response that a block gives: those in which nothing wraps round."""
        return self.n_fft - self.overlap

    @property
    def overlap(self) -> int:
        """Samples of the drive that a block shares with the one before."""
        return self.n_taps - 1

    def segment(self, samples: Floats, first: int) -> Floats | None:
        """Samples that the block from sample ``first`` on needs, (n_fft,); None if silent."""
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
    """What is played at a place.

    Attributes
    ----------
    drive
        Its samples.
    start
        Sample at which the drive starts.
    weight
        What the vibration by it is multiplied with.
    location
        Input place, 1, 2, 3, …
    """

    drive: Drive
    start: int
    weight: float
    location: int


def length_at_once(response_samples: int, n_places: int, n_channels: int) -> int | None:
    """Length of the transforms of a whole design; None: it is to be computed block by block.

    Parameters
    ----------
    response_samples
        Length of the response.
    n_places
        Input places in use: spectra of the responses to them are kept.
    n_channels
        Channels of the responses, outputs times axes.
    """
    n_fft = transform_length(response_samples)
    longest = min(LONGEST_OF_FEW, _MOST_BINS // (max(n_places, 1) * n_channels))
    return n_fft if n_fft <= longest else None
