"""From clips on a track to a chain, the sample at which it starts, and what it plays."""

from collections.abc import Iterable

from skinsource.arrays import Floats
from skinsource.chain.chain import Chain, Curve, Part
from skinsource.chain.drive import Drive, drive_played
from skinsource.clips import Clip
from skinsource.effects import placed, played


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
    _put_in_order(found)
    first = found[0][0] if found else 0
    parts = tuple(
        Part(one.waveform, tuple(effect for effect in one.effects if effect.on), at - first, *rest)
        for at, *rest, one in found
    )
    return first, Chain(parts, gain_curve, first if gain_curve else 0)


def drive_of_clips(
    clips: Iterable[Clip], gain_curve: Curve, sample_rate_hz: float, place: int
) -> tuple[int, Drive]:
    """Sample at which the first clip that sounds begins, and what all play from there on.

    Raises
    ------
    InvalidInputError
        See `drive_played`, which names ``place``.
    """
    first, chain = placed_chain(clips, gain_curve, sample_rate_hz)

    def drawn(part: Part) -> Floats:
        return played(part.waveform, part.effects, sample_rate_hz, part.shift_s)

    return first, drive_played(chain, sample_rate_hz, place, drawn)


def _put_in_order(found: list[tuple[int, float, float, Clip]]) -> None:
    """Sort by place and gain; what is alike in both by what it plays, in words.

    Sums of three numbers depend on their order in the last digit.
    """
    found.sort(key=_where)
    alike = len(found) - len(set(map(_where, found)))
    if alike:
        found.sort(key=lambda entry: (*_where(entry), repr(entry[3])))


def _where(entry: tuple[int, float, float, Clip]) -> tuple[int, float, float]:
    return entry[:3]
