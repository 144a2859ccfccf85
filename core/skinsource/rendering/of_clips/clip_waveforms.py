"""What clips play, for pictures of them."""

from skinsource.arrays import Floats
from skinsource.clips import Clip
from skinsource.effects import placed
from skinsource.errors import InvalidInputError
from skinsource.job import Stop, stop_if
from skinsource.rendering.of_clips.drawn_clips import DrawnClips

_Known = tuple[Clip, float, Floats | None]


class ClipWaveforms:
    """Samples of the clips of a design; those of clips that did not change are not looked up."""

    def __init__(self, drawn: DrawnClips) -> None:
        self._drawn = drawn
        self._known: dict[int, _Known] = {}

    def of(
        self, tracks: tuple[tuple[Clip, ...], ...], sample_rate_hz: float, stop: Stop
    ) -> tuple[tuple[Floats | None, ...], ...]:
        """What each clip of each track plays, (n_times,), after its effects and before its gain.

        None: it cannot be sampled.
        """
        found: dict[int, _Known] = {}
        for clips in tracks:
            for one in clips:
                known = self._known.get(one.id)
                if known is None or known[0] is not one or known[1] != sample_rate_hz:
                    stop_if(stop)
                    known = one, sample_rate_hz, self._samples(one, sample_rate_hz)
                found[one.id] = known
        self._known = found
        return tuple(tuple(found[one.id][2] for one in clips) for clips in tracks)

    def _samples(self, one: Clip, sample_rate_hz: float) -> Floats | None:
        effects = tuple(effect for effect in one.effects if effect.on)
        try:
            _, shift_s = placed(one.waveform, effects, one.onset_s, sample_rate_hz)
            return self._drawn.of(one.waveform, effects, sample_rate_hz, shift_s)
        except InvalidInputError:
            return None
