"""The vibration by all voices: whole for short designs, block by block for long ones.

Long designs use overlap-save, so that only the drives are held as a whole: a block of
``Blocks.n_fft`` samples of the drives gives ``Blocks.n_samples`` samples of response.  At each
frequency the vibrations by all voices, in some blocks, are one matrix product.  Blocks in which all
voices are silent cost nothing.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from skinsource.base.conventions import Booleans, Complexes, Floats, Indices
from skinsource.base.job import Stop, never, stop_if
from skinsource.engine.drives import active_samples, delayed
from skinsource.engine.moments import Moments, Projection
from skinsource.engine.spectra import Stack, TotalSpectrum
from skinsource.engine.transforms import (
    Blocks,
    ChannelsOnDemand,
    Played,
    forward,
    inverse,
    run_on_two_threads,
)
from skinsource.limbs.limb import Limb
from skinsource.signals.loudest_window import LoudestEnergy, loudest_energy, window_samples

# Blocks whose spectra are one matrix product: enough for it to pay.
_GROUP = 4
# Outputs that are transformed back to time at once, between two questions whether to stop.
_OUTPUTS_AT_ONCE = 18


class StreamedVibration:
    """The vibration by voices that play long.

    Methods that take long call ``stop`` before each group of blocks; once it returns True,
    `Stopped` is raised.

    Parameters
    ----------
    played
        Drives with location, start and weight.
    stack
        Responses to the locations, at the length of blocks; None where nothing is played.
    shape
        Outputs, axes, and samples of the response.
    blocks
        How drives are cut.
    """

    def __init__(
        self,
        played: Sequence[Played],
        stack: Stack | None,
        shape: tuple[int, int, int],
        blocks: Blocks,
    ) -> None:
        self._played = played
        self._stack = stack
        self._channels_shape = shape[:2]
        self.n_times = shape[2]
        self.cut = blocks
        self._moments: Moments | None = None

    def played_through(self, change: Callable[[Played], Played]) -> "StreamedVibration":
        """Return the vibration by changed drives, for example filtered ones."""
        played = [change(voice) for voice in self._played]
        shape = (*self._channels_shape, self.n_times)
        return StreamedVibration(played, self._stack, shape, self.cut)

    @property
    def every_channel(self) -> tuple[range, range]:
        """All outputs, counted from 1, and all axes, from 0."""
        n_outputs, n_axes = self._channels_shape
        return range(1, n_outputs + 1), range(n_axes)

    def moments(self, stop: Stop = never) -> Moments:
        """Return the moments over the whole response, with all products of axes."""
        if self._moments is None:
            second = np.zeros((*self._channels_shape, self._channels_shape[1]))
            total = np.zeros(self._channels_shape)
            for _, block in self.blocks_of(*self.every_channel, stop):
                second += block @ block.transpose(0, 2, 1)
                total += block.sum(axis=-1)
            self._moments = Moments(second, total)
        return self._moments

    def traces(self, outputs: Sequence[int], axes: Sequence[int], stop: Stop = never) -> Floats:
        """Return the acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        result = np.zeros((len(outputs), len(axes), self.n_times))
        if result.size == 0:
            return result
        for first, block in self.blocks_of(outputs, axes, stop):
            result[..., first : first + block.shape[-1]] = block
        return result

    def blocks_of(
        self,
        outputs: Sequence[int],
        axes: Sequence[int],
        stop: Stop = never,
        within: tuple[int, int] | None = None,
    ) -> Iterator[tuple[int, Floats]]:
        """Yield first sample and samples, (n_outputs, n_axes, n), of each block with vibration.

        For some outputs, 1, 2, …, and axes, 0 to 2; at least one of each.  With ``within``, first
        sample and end, only blocks that hold a sample between them.
        """
        if self._stack is None:
            return
        n_axes = self._channels_shape[1]
        values = self._stack.values
        channels = [(output - 1) * n_axes + axis for output in outputs for axis in axes]
        # Responses of all channels are not copied: those of a large limb take gigabytes.
        if channels != list(range(values.shape[-1])):
            values = np.ascontiguousarray(values[:, :, channels])
        cut = self.cut
        begin, end = within or (0, self.n_times)
        starts = range(begin - begin % cut.n_samples, min(end, self.n_times), cut.n_samples)
        for k in range(0, len(starts), _GROUP):
            stop_if(stop)
            segments = [self._segments(first) for first in starts[k : k + _GROUP]]
            sounding = [number for number, segment in enumerate(segments) if segment]
            if not sounding:
                continue
            spectra = self._spectra([segments[number] for number in sounding], values)
            shape = len(sounding), len(outputs), len(axes), cut.n_fft
            samples = inverse(spectra, cut.n_fft).reshape(shape)
            for block, number in zip(samples, sounding, strict=True):
                first = starts[k + number]
                inside = slice(cut.overlap, cut.overlap + min(cut.n_samples, self.n_times - first))
                active = self._active(segments[number])[inside]
                block = block[..., inside]
                yield first, block if active.all() else np.where(active, block, 0.0)

    def _segments(self, first: int) -> dict[int, Floats]:
        """Return pieces of drives for the block from sample ``first`` on, by number of the drive.

        Silent pieces are left out.
        """
        pieces = {
            number: self.cut.segment(voice.drive.samples, first - voice.start)
            for number, voice in enumerate(self._played)
        }
        return {number: piece for number, piece in pieces.items() if piece is not None}

    def _spectra(self, segments: list[dict[int, Floats]], values: Complexes) -> Complexes:
        """Return spectra of blocks, (n_blocks * n_channels, n_bins), from values of the stack."""
        n_bins, n_places, n_channels = values.shape
        rows = list(self._stack.responses) if self._stack is not None else []
        drives = np.zeros((n_bins, len(segments), n_places), np.complex128)
        for block, pieces in enumerate(segments):
            for number, piece in pieces.items():
                voice = self._played[number]
                spectrum = forward(piece, self.cut.n_fft) * voice.weight
                drives[:, block, rows.index(voice.location)] += spectrum
        spectra = np.empty((n_bins, len(segments), n_channels), np.complex128)
        half = n_bins // 2

        def multiply(part: slice) -> None:
            np.matmul(drives[part], values[part], out=spectra[part])

        parts = slice(0, half), slice(half, n_bins)
        run_on_two_threads(partial(multiply, part) for part in parts)
        return spectra.reshape(n_bins, -1).T

    def _active(self, segments: dict[int, Floats]) -> Booleans:
        played = np.any([piece != 0.0 for piece in segments.values()], axis=0)
        return active_samples(played, self.cut.n_taps)


def exact_transforms(signals: Floats, stop: Stop) -> Complexes:
    """Return transforms over exactly the samples of long signals, (..., n_times // 2 + 1).

    They are computed one by one: each takes much memory, and a tenth of a second.
    """
    transforms = np.empty((*signals.shape[:-1], signals.shape[-1] // 2 + 1), np.complex128)
    for channel in np.ndindex(signals.shape[:-1]):
        stop_if(stop)
        transforms[channel] = forward(signals[channel], signals.shape[-1])
    return transforms


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Vibration:
    """The vibration by all voices, as a sum of two, or as a stream.

    Attributes
    ----------
    n_times
        Samples of the response.
    others
        Vibration by all voices but the edited one.
    edited, weight, delay_samples
        Vibration by the edited voice at amplitude 1 and onset 0, its factor, and its delay.
    streamed
        Vibration by all voices, where they play too long to be transformed at once.
    """

    n_times: int
    others: ChannelsOnDemand | None
    edited: ChannelsOnDemand | None
    weight: float
    delay_samples: int
    streamed: StreamedVibration | None

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...], stop: Stop = never) -> Floats:
        """Return the acceleration of some outputs, (n_outputs, n_axes, n_times), m/s²."""
        if self.streamed is not None:
            return self.streamed.traces(outputs, axes, stop)
        others = None if self.others is None else self.others.traces(outputs, axes)
        if self.edited is None or self.weight == 0.0:
            shape = len(outputs), len(axes), self.n_times
            return np.zeros(shape) if others is None else others
        unit, start = self.edited.traces(outputs, axes), self.delay_samples
        total = np.empty(unit.shape)
        total[..., :start] = 0.0
        np.multiply(unit[..., : self.n_times - start], self.weight, out=total[..., start:])
        if others is not None:
            total += others
        return total

    def transforms(
        self, outputs: tuple[int, ...], axes: tuple[int, ...], stop: Stop = never
    ) -> Complexes:
        """Return its transforms over n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        if self.streamed is not None:
            return exact_transforms(self.streamed.traces(outputs, axes, stop), stop)
        return self._summed_spectra(outputs, axes, lambda spectra: spectra)

    def projected_transforms(self, outputs: tuple[int, ...], projection: Projection) -> Complexes:
        """Return transforms of projected signals, (n_outputs, n_times // 2 + 1).

        The projection must be linear, and the vibration not streamed.  Spectra are projected before
        they are summed, which leaves a third of the numbers.
        """
        return self._summed_spectra(outputs, projection.axis_numbers, projection.spectra)

    def _summed_spectra(
        self,
        outputs: tuple[int, ...],
        axes: tuple[int, ...],
        linear: Callable[[Complexes], Complexes],
    ) -> Complexes:
        """Return the sum over voices of ``linear``, a linear function, of their spectra."""
        total: Complexes | None = None
        if self.edited is not None and self.weight != 0.0:
            unit = linear(self.edited.trace_spectra(outputs, axes))
            total = self.weight * delayed(unit, self.delay_samples, self.n_times)
        if self.others is not None:
            others = linear(self.others.trace_spectra(outputs, axes))
            # Never into the spectra of the others, which are remembered.
            total = others if total is None else np.add(total, others, out=total)
        if total is None:
            shape = len(outputs), len(axes), self.n_times // 2 + 1
            total = linear(np.zeros(shape, np.complex128))
        return total


def output_groups(n_outputs: int) -> Iterator[Indices]:
    """Yield numbers of outputs, counted from 0, that are transformed back to time at once."""
    for first in range(0, n_outputs, _OUTPUTS_AT_ONCE):
        yield np.arange(first, min(first + _OUTPUTS_AT_ONCE, n_outputs))


def projected_signals(total: TotalSpectrum, projection: Projection, outputs: Indices) -> Floats:
    """Return the projected signals of some outputs, counted from 0, (n_outputs, n_fft)."""
    chosen = projection.at(outputs)
    spectra = total.rows(outputs, projection.axis_numbers)
    # A linear projection comes before the transform, which is quicker; a length comes after it.
    if chosen.directions is None:
        return chosen.signals(inverse(spectra, total.n_fft))
    return inverse(chosen.spectra(spectra), total.n_fft)


#: Numbers of outputs, counted from 0, first sample, and signals, (n_outputs, n).
Piece = tuple[Indices, int, Floats]


def projected_pieces(
    total: TotalSpectrum | None,
    streamed: StreamedVibration | None,
    projection: Projection,
    n_outputs: int,
    stop: Stop,
) -> Iterator[Piece]:
    """Yield projected signals piece by piece: of a stream in time, else some outputs at a time."""
    if streamed is not None:
        every = range(1, n_outputs + 1)
        for first, block in streamed.blocks_of(every, projection.axis_numbers, stop):
            yield np.arange(n_outputs), first, projection.signals(block)
    elif total is not None:
        for outputs in output_groups(n_outputs):
            stop_if(stop)
            yield outputs, 0, projected_signals(total, projection, outputs)


def loudest_energies(
    total: TotalSpectrum | None,
    streamed: StreamedVibration | None,
    projection: Projection,
    limb: Limb,
    stop: Stop,
) -> Floats:
    """Return the energy of the loudest 100 ms of each projected signal, (n_outputs,)."""
    n_window = window_samples(limb.sample_rate_hz)
    loudest = LoudestEnergy((limb.n_outputs,), n_window)
    for outputs, first, signals in projected_pieces(
        total, streamed, projection, limb.n_outputs, stop
    ):
        if streamed is not None:
            loudest.add(first, signals)
        else:
            loudest.energy[outputs] = loudest_energy(signals, n_window)
    return loudest.energy
