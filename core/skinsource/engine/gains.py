"""Gains of voices, from the exact signed maxima of their vibrations; and checks of traces.

Channels are transformed in the order of bounds of their samples, until no bound exceeds the
largest sample so far: the result is that of the full search, from few channels.
"""

import math
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain, repeat
from sys import getsizeof
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from skinsource.actuators.actuation import Actuation
from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, never, stop_if
from skinsource.base.work import tally
from skinsource.design.signal_path import Drive, SignalPath, UnitVoice, Voice, check_drive
from skinsource.engine.drives import Drives, OfTracks
from skinsource.engine.memory import GAINS_BYTES, Memory
from skinsource.engine.spectra import (
    BAND_BINS,
    RESPONSE_SPECTRA,
    ExactSpectra,
    Response,
    ResponseSpectrum,
    Stack,
)
from skinsource.engine.transforms import Blocks, forward, inverse
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling

#: Far above the rounding of a bound, so that no sample exceeds it.
_MARGIN = 1.0 + 1e-6
# Three transforms, each wrong by at most a few units in the last place per butterfly.
_ROUNDING_FACTOR = 8.0


def rounding_bound(norms: float, n_fft: int) -> float:
    """Return a bound of the error of all samples of a convolution by transforms.

    Parameters
    ----------
    norms
        Norm of the drive times that of the response; the sum of these, where several are added.
    n_fft
        Length of the transforms.
    """
    return _ROUNDING_FACTOR * sys.float_info.epsilon * math.log2(n_fft) * norms


def channel_bounds(
    samples: Floats,
    spectra: Complexes,
    responses: Sequence[ResponseSpectrum],
    *,
    tight: bool = True,
) -> Floats:
    """Return a bound of the samples of each channel, (n_pieces, n_channels), for pieces of drives.

    It is the smaller of two bounds: the sum of magnitudes over frequency (tight for tones); the sum
    over sections of the response of its norm times the largest norm of the drive in a window as
    long (tight for noise and pulses).

    Parameters
    ----------
    samples : (n_pieces, n)
        Pieces of drives; zeros after them change nothing.
    spectra : (n_pieces, n_bins)
        Their spectra at the length of those of the responses.
    responses : n_pieces of them
        Responses to the location where each piece is played.
    tight
        Whether the bound over frequency is used too, which takes long to prepare.
    """
    section_norms = np.array([response.section_norms for response in responses])
    bounds: Floats = (
        section_norms @ _largest_norms(samples, responses[0].section_lengths)[:, :, None]
    )[:, :, 0]
    if tight:
        np.minimum(bounds, _bounds_by_frequency(spectra, responses), out=bounds)
    bounds *= _MARGIN
    return bounds


def _bounds_by_frequency(spectra: Complexes, responses: Sequence[ResponseSpectrum]) -> Floats:
    starts = np.arange(0, spectra.shape[-1], BAND_BINS)
    # Drives are scaled, so that their squares neither overflow nor underflow.
    magnitudes = np.sqrt(np.square(spectra.real) + np.square(spectra.imag))
    bands = np.add.reduceat(magnitudes, starts, axis=-1)
    bounds = np.empty((len(spectra), len(responses[0].rows)))
    for row, response, band in zip(bounds, responses, bands, strict=True):
        # Threads of a matrix product would wait for each other without sleeping.
        np.vecdot(response.band_magnitudes, band, out=row)
    return bounds


def _largest_norms(samples: Floats, lengths: tuple[int, ...]) -> Floats:
    """Return the largest norm of each piece in windows of some lengths, (n_pieces, n_lengths)."""
    energy = np.zeros((samples.shape[0], samples.shape[1] + 1))
    np.cumsum(np.square(samples), axis=-1, out=energy[:, 1:])
    # A window that reaches beyond either end of the piece holds the rest of it.
    energies = {n: _largest_rise(energy, n) for n in set(lengths)}
    return np.sqrt(np.stack([energies[n] for n in lengths], axis=-1))


def _largest_rise(energy: Floats, n: int) -> Floats:
    if n >= energy.shape[-1]:
        return energy[:, -1]
    return (energy[:, n:] - energy[:, :-n]).max(axis=-1)


#: Channels of a voice that are transformed before bounds are compared again.
_BATCHES = (4, 8, 8, 16)
#: Blocks whose bounds are computed at once.
_BLOCKS_AT_ONCE = 128


def peaks_of(
    drives: Sequence[Floats],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Stop = never,
    *,
    tight: bool = True,
) -> list[float]:
    """Return the signed maximum, over channels and times, of each drive convolved with responses.

    Parameters
    ----------
    drives : (n_times,) each
        They may differ in length.
    spectra : (n_fft // 2 + 1,) each
        Their spectra, where ``n_fft`` holds the whole convolution; empty for drives that are
        searched block by block.
    responses
        Responses to the location of each drive, at the same ``n_fft``, or at that of blocks.
    tight
        As in `channel_bounds`; blocks are always searched with tight bounds.
    """
    if not spectra:
        pairs = zip(drives, responses, strict=True)
        return [_peak_by_blocks(drive, response, stop) for drive, response in pairs]
    padded = np.zeros((len(drives), max(drive.size for drive in drives)))
    for line, drive in zip(padded, drives, strict=True):
        line[: drive.size] = drive
    bounds = channel_bounds(padded, np.array(spectra), responses, tight=tight)

    def signals(voice: NDArray[np.int64], channel: NDArray[np.int64]) -> Floats:
        products = np.empty((channel.size, spectra[0].size), np.complex128)
        end = 0
        counts = np.bincount(voice, minlength=len(spectra)).tolist()
        for spectrum, response, count in zip(spectra, responses, counts, strict=True):
            begin, end = end, end + count
            if count:
                np.multiply(response.rows[channel[begin:end]], spectrum, out=products[begin:end])
        return inverse(products, responses[0].n_fft)

    largest: list[float] = _search(bounds, signals, -np.inf, stop).tolist()
    return largest


def _search(
    bounds: Floats,
    signals: Callable[[NDArray[np.int64], NDArray[np.int64]], Floats],
    least: float,
    stop: Stop,
) -> Floats:
    """Return the signed maximum of each vibration, (n_vibrations,), from few of its channels.

    Parameters
    ----------
    bounds : (n_vibrations, n_channels)
        Bound of the samples of each channel.
    signals
        Returns channels, (n, n_times), by vibration and channel, (n,) each, in their order.
    least
        Returned where no sample exceeds it.
    """
    order = np.argsort(-bounds, axis=-1, kind="stable")
    largest = np.full(len(bounds), least)
    begin = 0
    for batch in chain(_BATCHES, repeat(_BATCHES[-1])):
        stop_if(stop)
        chosen = order[:, begin : begin + batch]
        begin += batch
        searched = np.take_along_axis(bounds, chosen, axis=-1) > largest[:, None]
        if not searched.any():
            break
        voice, channel = np.nonzero(searched)[0], chosen[searched]
        np.maximum.at(largest, voice, signals(voice, channel).max(axis=-1))
        tally(search_transforms=channel.size)
    return largest


def _peak_by_blocks(samples: Floats, response: ResponseSpectrum, stop: Stop) -> float:
    peak = -np.inf
    cut = Blocks(response.taps.shape[-1])
    starts = range(0, samples.size + cut.overlap, cut.n_samples)
    for k in range(0, len(starts), _BLOCKS_AT_ONCE):
        stop_if(stop)
        blocks = [cut.segment(samples, first) for first in starts[k : k + _BLOCKS_AT_ONCE]]
        sounding = [segment for segment in blocks if segment is not None]
        if len(sounding) < len(blocks):
            peak = max(peak, 0.0)
        if sounding:
            segments = np.array(sounding)
            spectra = forward(segments, cut.n_fft)
            bounds = channel_bounds(segments, spectra, [response] * len(segments))
            # All blocks are channels of one vibration.
            signals = partial(_signals_of_blocks, spectra, response)
            peak = float(_search(bounds.reshape(1, -1), signals, peak, stop)[0])
    return peak


def _signals_of_blocks(
    spectra: Complexes, response: ResponseSpectrum, _: object, channels: NDArray[np.int64]
) -> Floats:
    """Return channels of blocks of a vibration by their spectra, (n_blocks, n_bins)."""
    block, channel = np.divmod(channels, len(response.rows))
    products = response.rows[channel] * spectra[block]
    return inverse(products, response.n_fft)[:, response.taps.shape[-1] - 1 :]


# The reciprocal of a smaller number overflows.
_SMALLEST = float(np.finfo(np.float64).tiny)


def unit_gains(
    drives: Sequence[Drive],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
    stop: Stop = never,
    *,
    tight: bool = True,
) -> list[float]:
    """Return the factors of vibrations by scaled samples of drives under upstream's scaling.

    A factor is one over the signed maximum; where no sample is positive nothing is divided.

    Parameters
    ----------
    drives
        Drives that are not silent.
    spectra : (n_fft // 2 + 1,) each
        Of the scaled samples, at the length of those of the responses; empty for drives that are
        searched block by block.
    responses
        Responses to the location of each drive.
    tight
        As in `channel_bounds`.
    """
    peaks = peaks_of([drive.samples for drive in drives], spectra, responses, stop, tight=tight)
    return [
        unit_gain(peak, drive, response)
        for drive, peak, response in zip(drives, peaks, responses, strict=True)
    ]


def unit_gain(largest: float, drive: Drive, response: Response) -> float:
    """Return the factor of the vibration by the scaled samples of a drive from its signed maximum.

    The factor of the drive cancels: the vibration reaches the amplitude in any case.  It is left as
    it is where no sample is above 0 by more than the rounding of the transforms.
    """
    norms = float(np.linalg.norm(drive.samples) * response.norms.max())
    is_positive = largest >= max(_SMALLEST, rounding_bound(norms, response.n_fft))
    return 1.0 / largest if is_positive else drive.factor


@dataclass(frozen=True, slots=True, eq=False)
class Sounding:
    """A unit voice that is not silent, its drive, and the responses to its location."""

    unit: UnitVoice
    drive: Drive
    response: ResponseSpectrum


class EngineMemory:
    """What rules remember beyond their latest result: drives, spectra of responses, and gains.

    It changes no result.  It belongs to one thread, whose graphs may share it.  Spectra of
    responses, which take most, have one budget for the process.
    """

    def __init__(self) -> None:
        self.responses = RESPONSE_SPECTRA
        self.signal_paths = OfTracks[tuple[int, SignalPath]]()
        self.drives = Drives()
        self.clip_waveforms = OfTracks[tuple[Floats | None, ...]]()
        self.gains = Memory[float](GAINS_BYTES, getsizeof)
        self.exact_spectra = ExactSpectra()


@dataclass(frozen=True, slots=True)
class Placed:
    """A voice, its drive, and the sample at which it starts."""

    voice: Voice
    drive: Drive
    start: int

    @property
    def end(self) -> int:
        """Sample after the last sample of the drive."""
        return self.start + self.drive.samples.size

    @property
    def moves(self) -> bool:
        """Whether it moves the skin at all."""
        return self.voice.amplitude != 0.0 and not self.drive.silent


@dataclass(frozen=True, slots=True, eq=False)
class CheckedVoice:
    """The drive of a voice, or why the voice cannot be played.

    Attributes
    ----------
    drive
        None where the voice cannot be sampled.
    problem
        Message of the error where it cannot be played, otherwise empty.
    """

    drive: Drive | None
    problem: str = ""

    @property
    def played(self) -> Drive | None:
        """The drive, unless the voice cannot be played."""
        return None if self.problem else self.drive


def checked_voice(
    remembered: EngineMemory,
    unit: UnitVoice,
    limb: Limb,
    actuation: Actuation | None,
    *,
    leave_out: bool,
) -> CheckedVoice:
    """Return the drive of a voice, checked.

    Parameters
    ----------
    leave_out
        Whether a voice that cannot be played is returned with the reason, instead of an error.

    Raises
    ------
    InvalidInputError
        The voice cannot be sampled, the limb does not have its location, no actuator is there, or
        the actuator cannot follow the drive.
    """
    drive = None
    try:
        drive = remembered.drives.drawn(unit, limb.sample_rate_hz)
        if not drive.silent:
            limb.check_place(unit.location)
            if actuation is not None:
                actuation.at(unit.location)
        check_drive(actuation, drive, limb.sample_rate_hz, limb.band_hz, unit.location)
    except InvalidInputError as error:
        if not leave_out:
            raise
        return CheckedVoice(drive, str(error))
    return CheckedVoice(drive)


#: Samples that are computed again, and the factor from their largest error to the estimate.
N_SAMPLES, ESTIMATE_FACTOR = 64, 4.0
# Random positions that are drawn to find enough samples other than 0, and how many are checked
# wherever they are.
_N_DRAWN, _N_ANYWHERE = 4096, 16


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceError:
    """Error of the traces, relative to their largest sample.

    Attributes
    ----------
    estimate
        Four times the largest error among 64 samples that were computed again, as sums of products
        in extended precision.
    bound
        Error that no sample exceeds.
    """

    estimate: float
    bound: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExactVoice:
    """A voice whose vibration can be computed exactly, sample by sample.

    ``weight`` is the factor of the vibration by the scaled samples.
    """

    drive: Drive
    delay_samples: int
    weight: float
    response: ResponseSpectrum

    def exact(self, output: int, axis: int, time: int) -> np.longdouble:
        """Return one sample of the vibration, computed by its definition."""
        taps = self.response.taps[output - 1, axis]
        last = time - self.delay_samples
        first = max(last - taps.size + 1, 0)
        piece = self.drive.samples[first : max(last + 1, 0)].astype(np.longdouble)
        products = piece * taps[last - first - piece.size + 1 : last - first + 1][::-1]
        return np.longdouble(self.weight) * products.sum()

    def rounding(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> float:
        """Return what rounding is proportional to: norms of drive and strongest response."""
        strongest = self.response.norms[[output - 1 for output in outputs]][:, list(axes)].max()
        return float(abs(self.weight) * np.linalg.norm(self.drive.samples) * strongest)


def _checked_positions(samples: Floats) -> list[int]:
    """Return random positions, most of them where samples are not 0: long designs rest a lot."""
    drawn = np.random.default_rng(0).integers(0, samples.size, _N_DRAWN)
    sounding = drawn[samples[drawn] != 0.0][: N_SAMPLES - _N_ANYWHERE]
    return [*sounding.tolist(), *drawn[: N_SAMPLES - sounding.size].tolist()]


def trace_error_of(
    traces: Floats, outputs: tuple[int, ...], axes: tuple[int, ...], voices: list[ExactVoice]
) -> TraceError | None:
    """Return the error of ``traces``, (n_outputs, n_axes, n_times); None where all are silent."""
    peak = float(np.abs(traces).max(initial=0.0))
    if peak == 0.0 or not voices:
        return None
    worst = np.longdouble(0.0)
    for position in _checked_positions(traces.reshape(-1)):
        row, column, time = np.unravel_index(int(position), traces.shape)
        exact = sum(
            (voice.exact(outputs[row], axes[column], int(time)) for voice in voices),
            np.longdouble(0.0),
        )
        worst = max(worst, abs(exact - np.longdouble(traces[row, column, time])))
    n_fft = max(voice.response.n_fft for voice in voices)
    norms = sum(voice.rounding(outputs, axes) for voice in voices)
    return TraceError(
        estimate=float(ESTIMATE_FACTOR * worst / peak),
        bound=rounding_bound(norms, n_fft) / peak,
    )


@dataclass(frozen=True, slots=True)
class Responses:
    """Responses of a limb at the length of the transforms of a design.

    They are read and transformed when they are used first, and remembered.  ``n_fft`` is None where
    transforms have the length of blocks.
    """

    remembered: EngineMemory
    limb: Limb
    scaling: Scaling
    n_fft: int | None

    def to(self, locations: Iterable[int]) -> list[ResponseSpectrum]:
        """Return the responses to each of some locations."""
        locations = list(locations)
        if self.n_fft is None:
            stack = self.stack(locations)
            return (
                [stack.responses[location] for location in locations] if stack is not None else []
            )
        if not locations:
            return []
        return self.remembered.responses.of(self.limb, locations, self.scaling, self.n_fft)

    def stack(self, locations: Iterable[int]) -> Stack | None:
        """Return the responses to some locations for products over blocks; None for none."""
        used = tuple(sorted(set(locations)))
        if not used:
            return None
        n_fft = Blocks(self.limb.n_taps).n_fft
        return self.remembered.responses.stack(self.limb, used, self.scaling, n_fft)

    def drive_spectrum(self, unit: UnitVoice, drive: Drive) -> Complexes:
        """Return the spectrum of a drive from time 0 on, (n_bins,); there is none for blocks."""
        if self.n_fft is None:
            raise ValueError("long drives have no spectrum as a whole")
        rate = self.limb.sample_rate_hz
        return self.remembered.drives.spectrum(unit, drive, rate, self.n_fft)

    def moving(
        self, placed: Sequence[Placed], stop: Stop
    ) -> list[tuple[Placed, ResponseSpectrum, float]]:
        """Return voices that move the skin, with the responses to their locations and gains."""
        voices = [player for player in placed if player.moves]
        responses = self.to(player.voice.location for player in voices)
        sounding = [
            Sounding(player.voice.unit, player.drive, response)
            for player, response in zip(voices, responses, strict=True)
        ]
        return list(zip(voices, responses, self.gains(sounding, stop), strict=True))

    def gains(self, voices: Sequence[Sounding], stop: Stop = never) -> list[float]:
        """Return the gains of unit voices that are not silent."""
        if self.scaling != "upstream":
            return [voice.drive.factor for voice in voices]
        in_blocks = self.n_fft is None
        # A weak reference in the key does not keep the responses of the limb in memory.
        keys = [(ref(self.limb), voice.unit, voice.response.n_fft, in_blocks) for voice in voices]

        memory = self.remembered.gains
        known = {key: gain for key in keys if (gain := memory.find(key)) is not None}
        new = {key: voice for key, voice in zip(keys, voices, strict=True) if key not in known}
        if new:
            drives = [voice.drive for voice in new.values()]
            responses = [voice.response for voice in new.values()]
            spectra = [
                self.drive_spectrum(voice.unit, voice.drive)
                for voice in new.values()
                if not in_blocks
            ]
            for key, gain in zip(new, unit_gains(drives, spectra, responses, stop), strict=True):
                known[key] = gain
                memory.add(key, gain)
        return [known[key] for key in keys]
