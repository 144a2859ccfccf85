"""The wave through the samples of curves."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from skinsource.base.arrays import Floats
from skinsource.signals.resampling import Extremes, extremes_between, finer

#: Of so many samples that are seen at once, how far the wave reaches is found while they are drawn;
#: of more, each takes but a part of a pixel, and they are joined on the screen as in pictures.
MOST_WHILE_DRAWN = 2**16


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Wave:
    """What is known of curves between their points, which are counted from 0.

    Attributes
    ----------
    points
        Gives ``x`` and ``y`` of the wave from one point to before another, those points among
        them.
    extremes
        Gives how far it reaches from each point to the next, of those from one to before another;
        None: of so many it is not known.
    """

    points: Callable[[int, int], tuple[Floats, Floats]]
    extremes: Callable[[int, int], Extremes | None]


def wave_of(time_s: Floats, signals: Floats) -> Wave:
    """The wave of signals, (n_curves, n_times), as it is drawn."""
    return Wave(points=partial(finer, time_s, signals), extremes=partial(_extremes, signals))


def _extremes(signals: Floats, first: int, end: int) -> Extremes | None:
    if end - first > MOST_WHILE_DRAWN:
        return None
    return extremes_between(signals, first, end)
