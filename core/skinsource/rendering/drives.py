"""Drives: summed once per chain, transformed once per length, delayed by a phase ramp."""

from weakref import WeakValueDictionary

import numpy as np

from skinsource.arrays import Booleans, Complexes, Floats
from skinsource.chain import Chain, Drive, Part, drive_played
from skinsource.rendering.budgets import CLIPS_BYTES, DRIVES_BYTES
from skinsource.rendering.memory import Memory
from skinsource.rendering.of_clips.drawn_clips import DrawnClips
from skinsource.rendering.transforms import forward
from skinsource.voices import UnitVoice


class Drives:
    """Drawn clips, drives of chains, and their spectra, in bounded memory.

    Attributes
    ----------
    clips
        What clips play.
    """

    def __init__(self, budget_bytes: int = DRIVES_BYTES, clips_bytes: int = CLIPS_BYTES) -> None:
        self.clips = DrawnClips(clips_bytes)
        self._drawn = Memory[Drive](budget_bytes, lambda drive: drive.samples.nbytes)
        self._spectra = Memory[Complexes](budget_bytes, lambda spectrum: spectrum.nbytes)
        # Long drives exceed the budget; what a graph still holds is not drawn twice.
        self._alive: WeakValueDictionary[tuple[Chain, float], Drive] = WeakValueDictionary()

    def drawn(self, unit: UnitVoice, sample_rate_hz: float) -> Drive:
        """Samples of what a voice plays; refused where one of them is not a usable number."""
        key = unit.chain, sample_rate_hz
        drive = self._drawn.find(key)
        if drive is None:
            drive = self._alive.get(key) or self._played(unit, sample_rate_hz)
            self._alive[key] = drive
            self._drawn.add(key, drive)
        return drive

    def spectrum(
        self, unit: UnitVoice, drive: Drive, sample_rate_hz: float, n_fft: int
    ) -> Complexes:
        """Spectrum of the ``drive`` of a voice from time 0 on, (n_fft // 2 + 1,)."""
        return self._spectra.get(
            (unit.chain, sample_rate_hz, n_fft), lambda: forward(drive.samples, n_fft)
        )

    def _played(self, unit: UnitVoice, sample_rate_hz: float) -> Drive:
        def drawn(part: Part) -> Floats:
            return self.clips.of(part.waveform, part.effects, sample_rate_hz, part.shift_s)

        return drive_played(unit.chain, sample_rate_hz, unit.location, drawn)


def delayed(spectrum: Complexes, delay_samples: int, n_fft: int) -> Complexes:
    """Spectrum of the same signal ``delay_samples`` later; it must not run out of ``n_fft``."""
    if delay_samples == 0:
        return spectrum
    # The turns are reduced in whole numbers, so that long delays lose no accuracy.
    turns = (np.arange(spectrum.shape[-1]) * delay_samples) % n_fft / n_fft
    return spectrum * np.exp(-2j * np.pi * turns)


def active_samples(played: Booleans, n_taps: int) -> Booleans:
    """When the skin can move at all: at and after samples of a drive other than 0, (n_times,).

    Parameters
    ----------
    played : (n_times,) of bool
        Where the drive is not zero.
    n_taps
        Samples of the responses.
    """
    counts = np.cumsum(played, dtype=np.int64)
    before = np.zeros_like(counts)
    before[n_taps:] = counts[:-n_taps]
    return counts > before
