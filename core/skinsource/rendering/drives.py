"""Drives: drawn once per waveform, transformed once per length, delayed by a phase ramp."""

from dataclasses import dataclass
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from skinsource.design import Input
from skinsource.errors import InvalidInputError
from skinsource.rendering.memory import Memory
from skinsource.rendering.transforms import Complexes, Floats, forward
from skinsource.signals import sample_count
from skinsource.waveforms import Waveform
from skinsource.work import tally

Booleans = NDArray[np.bool_]

BUDGET_BYTES = 16 * 2**20

#: Largest sample of a drive or a response.  Far beyond it levels overflow, and NaN would come out.
LARGEST = 1e30


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """An input without its amplitude and onset: what its unit field depends on."""

    waveform: Waveform
    location: int


def source_of(one: Input) -> Source:
    """Return ``one`` without its amplitude and onset."""
    return Source(waveform=one.waveform, location=one.location)


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class Drive:
    """What an input plays, scaled by a power of two so that its peak lies between 1 and 2.

    Attributes
    ----------
    samples : (n_times,)
        Scaled samples.
    factor
        The power of two that was divided out; nothing rounds.
    """

    samples: Floats
    factor: float

    @property
    def silent(self) -> bool:
        """Whether it holds nothing but zeros."""
        return self.factor == 0.0


def drive_of(samples: Floats) -> Drive:
    """Scale ``samples`` by a power of two; all computing is then far from over- and underflow."""
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0.0:
        return Drive(samples, 0.0)
    exponent = int(np.frexp(peak)[1]) - 1
    return Drive(np.ldexp(samples, -exponent), float(np.ldexp(1.0, exponent)))


def first_unusable(samples: Floats) -> tuple[int, ...] | None:
    """Index of the first sample that is not finite or beyond `LARGEST`; None if all are sound."""
    # NaN is the maximum of whatever holds it, and not less than anything.
    if samples.size == 0 or np.abs(samples).max() <= LARGEST:
        return None
    return tuple(int(index) for index in np.argwhere(~(np.abs(samples) <= LARGEST))[0])


class Drives:
    """Drawn waveforms and their spectra, in bounded memory."""

    def __init__(self, budget_bytes: int = BUDGET_BYTES) -> None:
        self._drawn = Memory[Drive](budget_bytes, lambda drive: drive.samples.nbytes)
        self._spectra = Memory[Complexes](budget_bytes, lambda spectrum: spectrum.nbytes)
        # Long drives exceed the budget; what a scene still holds is not drawn twice.
        self._alive: WeakValueDictionary[tuple[Waveform, float], Drive] = WeakValueDictionary()

    def drawn(self, source: Source | Input, sample_rate_hz: float) -> Drive:
        """Samples of what ``source`` plays; refused where one of them is not a usable number."""
        key = source.waveform, sample_rate_hz
        drive = self._drawn.find(key)
        if drive is None:
            drive = self._alive.get(key) or _draw(source, sample_rate_hz)
            self._alive[key] = drive
            self._drawn.add(key, drive)
        return drive

    def spectrum(self, source: Source | Input, sample_rate_hz: float, n_fft: int) -> Complexes:
        """Spectrum of what ``source`` plays if it starts at time 0, (n_fft // 2 + 1,)."""
        return self._spectra.get(
            (source.waveform, sample_rate_hz, n_fft),
            lambda: forward(self.drawn(source, sample_rate_hz).samples, n_fft),
        )


def _draw(source: Source | Input, sample_rate_hz: float) -> Drive:
    waveform = source.waveform
    samples = waveform.samples(sample_rate_hz)
    bad = first_unusable(samples)
    if bad is not None:
        raise InvalidInputError(
            f"Input at place {source.location}, {waveform.title}: sample {bad[0]} is "
            f"{samples[bad]}, expected a finite number of at most {LARGEST:g}. Correct what the "
            "input plays, or mute it."
        )
    expected = sample_count(waveform.duration_s, sample_rate_hz)
    if samples.size != expected:
        raise ValueError(
            f"{waveform} has {samples.size} samples, expected {expected}: those of its duration_s"
        )
    tally(samples_drawn=samples.size)
    return drive_of(samples)


def delayed(spectrum: Complexes, delay_samples: int, n_fft: int) -> Complexes:
    """Spectrum of the same signal ``delay_samples`` later; it must not run out of ``n_fft``."""
    if delay_samples == 0:
        return spectrum
    # The turns are reduced in whole numbers, so that long delays lose no accuracy.
    turns = (np.arange(spectrum.shape[-1]) * delay_samples) % n_fft / n_fft
    return spectrum * np.exp(-2j * np.pi * turns)


def reach(played: Booleans, n_taps: int) -> Booleans:
    """When a drive can be felt at all: at and after its samples other than zero, (n_times,).

    Parameters
    ----------
    played : (n_times,) of bool
        Where the drive is not zero.
    n_taps
        Samples of the response.
    """
    counts = np.cumsum(played, dtype=np.int64)
    before = np.zeros_like(counts)
    before[n_taps:] = counts[:-n_taps]
    return counts > before
