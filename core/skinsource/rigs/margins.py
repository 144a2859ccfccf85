"""How far what is sent to a rig may be turned up."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.limits import limit_words
from skinsource.rigs.checking import limits_of, rig_breaches
from skinsource.rigs.rig import Rig

#: Limits that no gain has a part in.
_OF_TIME = frozenset({"duration_s", "duty"})
# So much louder every limit is passed; a power of two, so that nothing rounds.
_LOUDER = 2.0**40


@dataclass(frozen=True, slots=True)
class Margin:
    """The highest gain that a rig allows.

    Attributes
    ----------
    factor
        0: none; infinity: the rig knows no limit.
    words
        The limit that would be passed first, "" where there is none.
    """

    factor: float = inf
    words: str = ""


def highest_gain(
    rig: Rig,
    places: Sequence[int],
    samples: ArrayLike,
    sample_rate_hz: int,
    *,
    repeated: bool = False,
) -> Margin:
    """How far samples may be turned up before they pass a limit of a rig.

    All figures but those of time grow as the samples do.

    Parameters
    ----------
    places, samples, sample_rate_hz
        As of `rig_breaches`.
    repeated
        Whether they are sent again and again: no limit of the duration allows that.

    Raises
    ------
    InvalidInputError
        As `rig_breaches`.
    """
    rows = np.asarray(samples, np.float64)
    found = Margin()
    for one in rig_breaches(rig, places, rows * _LOUDER, sample_rate_hz):
        breach = one.breach
        allowed = 0.0 if breach.name in _OF_TIME else _LOUDER * breach.limit / breach.found
        if allowed < found.factor:
            found = Margin(allowed, f"place {one.place}: {limit_words(breach.name)}")
    if repeated:
        for place in places:
            channel = rig.channel_of(place)
            if channel is not None and limits_of(channel).duration_s is not None:
                return Margin(0.0, f"place {place}: duration, repeated without end")
    return found
