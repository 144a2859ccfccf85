"""Samples of clips, signal paths of tracks, and drives with their spectra, all computed once."""

from collections.abc import Callable, Hashable
from typing import Any, Generic

import numpy as np

from skinsource.base.conventions import Booleans, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, stop_if
from skinsource.base.work import tally
from skinsource.design.clips import Clip
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.playing import placed, played
from skinsource.design.signal_path import Drive, Part, UnitVoice, drive_played
from skinsource.design.waveform import Waveform
from skinsource.engine.memory import CLIPS_BYTES, DRIVES_BYTES, Memory, MemoryOfHeld, V
from skinsource.engine.transforms import forward


class DrawnClips:
    """Samples of waveforms, with and without effects, in bounded memory."""

    def __init__(self, budget_bytes: int) -> None:
        # Long samples exceed the budget, but while a graph holds them they are not drawn again.
        self._known = MemoryOfHeld[Floats](budget_bytes, lambda samples: samples.nbytes)

    def of(
        self,
        waveform: Waveform,
        effects: tuple[Effect, ...],
        sample_rate_hz: float,
        shift_s: float,
    ) -> Floats:
        """Return the samples after the last effect, (n_times,), read-only."""
        if not effects:
            return self._drawn(waveform, sample_rate_hz, shift_s)
        return self._get(
            (waveform, effects, sample_rate_hz, shift_s),
            lambda: played(waveform, effects, sample_rate_hz, shift_s, draw=self._drawn),
        )

    def of_clips(
        self, clips: tuple[Clip, ...], sample_rate_hz: float, stop: Stop
    ) -> tuple[Floats | None, ...]:
        """Return the samples of each clip, (n_times,), after its effects and before its gain.

        None for a clip that cannot be sampled.
        """
        every: list[Floats | None] = []
        for clip in clips:
            stop_if(stop)
            effects = tuple(effect for effect in clip.effects if effect.on)
            try:
                _, shift_s = placed(clip.waveform, effects, clip.onset_s, sample_rate_hz)
                every.append(self.of(clip.waveform, effects, sample_rate_hz, shift_s))
            except InvalidInputError:
                every.append(None)
        return tuple(every)

    def _drawn(self, waveform: Waveform, sample_rate_hz: float, shift_s: float) -> Floats:
        def draw() -> Floats:
            samples = waveform.samples(sample_rate_hz, shift_s)
            tally(samples_drawn=samples.size)
            return samples

        return self._get((waveform, sample_rate_hz, shift_s), draw)

    def _get(self, key: Hashable, compute: Callable[[], Floats]) -> Floats:
        samples = self._known.get(key, compute)
        samples.flags.writeable = False
        return samples


class OfTracks(Generic[V]):
    """The latest value of each track, made anew where what it is made from has changed."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[tuple[Any, ...], V]] = {}

    def of(self, made_from: dict[int, tuple[Any, ...]], make: Callable[..., V]) -> list[V]:
        """Return the values of tracks, given by id with the arguments of ``make``."""
        latest = {}
        for id, given in made_from.items():
            known = self._known.get(id)
            latest[id] = known if known and known[0] == given else (given, make(*given))
        self._known = latest
        return [value for _, value in latest.values()]


class Drives:
    """Samples of clips, drives and their spectra, in bounded memory.

    A drive is summed once for each signal path, and transformed once for each length.
    """

    def __init__(self, budget_bytes: int = DRIVES_BYTES, clips_bytes: int = CLIPS_BYTES) -> None:
        self.clips = DrawnClips(clips_bytes)
        # Long drives exceed the budget, but while a graph holds them they are not drawn again.
        self._drawn = MemoryOfHeld[Drive](budget_bytes, lambda drive: drive.samples.nbytes)
        self._spectra = Memory[Complexes](budget_bytes, lambda spectrum: spectrum.nbytes)

    def drawn(self, unit: UnitVoice, sample_rate_hz: float) -> Drive:
        """Return the drive of a voice.

        Raises
        ------
        InvalidInputError
            It cannot be sampled, or a sample is not a usable number.
        """

        def drawn(part: Part) -> Floats:
            return self.clips.of(part.waveform, part.effects, sample_rate_hz, part.shift_s)

        return self._drawn.get(
            (unit.signal_path, sample_rate_hz),
            lambda: drive_played(unit.signal_path, sample_rate_hz, unit.location, drawn),
        )

    def spectrum(
        self, unit: UnitVoice, drive: Drive, sample_rate_hz: float, n_fft: int
    ) -> Complexes:
        """Return the spectrum of the ``drive`` of a voice from time 0 on, (n_fft // 2 + 1,)."""
        return self._spectra.get(
            (unit.signal_path, sample_rate_hz, n_fft), lambda: forward(drive.samples, n_fft)
        )


def delayed(spectrum: Complexes, delay_samples: int, n_fft: int) -> Complexes:
    """Return the spectrum of the signal ``delay_samples`` later, still within ``n_fft`` samples."""
    if delay_samples == 0:
        return spectrum
    # Turns are reduced as integers, so that long delays lose no accuracy.
    turns = (np.arange(spectrum.shape[-1]) * delay_samples) % n_fft / n_fft
    return spectrum * np.exp(-2j * np.pi * turns)


def active_samples(played: Booleans, n_taps: int) -> Booleans:
    """Return where the skin can move at all, (n_times,): up to ``n_taps`` after a sample not 0.

    Parameters
    ----------
    played : (n_times,) of bool
        Where the drive is not 0.
    n_taps
        Samples of the responses.
    """
    counts = np.cumsum(played, dtype=np.int64)
    before = np.zeros_like(counts)
    before[n_taps:] = counts[:-n_taps]
    return counts > before
