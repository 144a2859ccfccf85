"""Samples of clips: drawn once, and again through their effects once."""

from collections.abc import Hashable
from weakref import WeakValueDictionary

from skinsource.arrays import Floats
from skinsource.effects import Effect, played
from skinsource.rendering.memory import Memory
from skinsource.waveforms import Waveform
from skinsource.work import tally


class DrawnClips:
    """What waveforms play, with and without effects, in bounded memory."""

    def __init__(self, budget_bytes: int) -> None:
        self._known = Memory[Floats](budget_bytes, lambda samples: samples.nbytes)
        # Long ones exceed the budget; what a graph still holds is not drawn twice.
        self._alive: WeakValueDictionary[Hashable, Floats] = WeakValueDictionary()

    def of(
        self,
        waveform: Waveform,
        effects: tuple[Effect, ...],
        sample_rate_hz: float,
        shift_s: float,
    ) -> Floats:
        """What comes out of the last effect, (n_times,), read-only."""
        if not effects:
            return self._drawn(waveform, sample_rate_hz, shift_s)
        key = waveform, effects, sample_rate_hz, shift_s
        known = self._find(key)
        if known is not None:
            return known
        return self._kept(key, played(waveform, effects, sample_rate_hz, shift_s, draw=self._drawn))

    def _drawn(self, waveform: Waveform, sample_rate_hz: float, shift_s: float) -> Floats:
        key = waveform, sample_rate_hz, shift_s
        known = self._find(key)
        if known is not None:
            return known
        samples = waveform.samples(sample_rate_hz, shift_s)
        tally(samples_drawn=samples.size)
        return self._kept(key, samples)

    def _find(self, key: Hashable) -> Floats | None:
        known = self._known.find(key)
        if known is None:
            known = self._alive.get(key)
            if known is not None:
                self._known.add(key, known)
        return known

    def _kept(self, key: Hashable, samples: Floats) -> Floats:
        samples.flags.writeable = False
        self._alive[key] = samples
        self._known.add(key, samples)
        return samples
