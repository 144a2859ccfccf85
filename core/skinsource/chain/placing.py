"""From clips on a track to a chain and the sample at which it starts."""

from collections.abc import Iterable

from skinsource.chain.chain import Chain, Curve, Part
from skinsource.clips import Clip
from skinsource.effects import placed


def placed_chain(
    clips: Iterable[Clip], gain_curve: Curve, sample_rate_hz: float
) -> tuple[int, Chain]:
    """Sample at which the first clip that sounds begins, and all of them from there on.

    The order in which they are listed plays no part.
    """
    found = []
    for one in clips:
        if not one.muted:
            at, shift_s = placed(one.waveform, one.effects, one.onset_s, sample_rate_hz)
            found.append((at, shift_s, one.gain, one))
    found.sort(key=lambda entry: entry[:3])
    first = found[0][0] if found else 0
    parts = tuple(
        Part(one.waveform, tuple(effect for effect in one.effects if effect.on), at - first, *rest)
        for at, *rest, one in found
    )
    return first, Chain(parts, gain_curve, first if gain_curve else 0)
