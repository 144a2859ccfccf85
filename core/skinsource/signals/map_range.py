"""The default range of the colours of a map."""

from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import real_array
from skinsource.base.decibels import FLOOR_DB

#: Width of the range.
MAP_RANGE_DB = 50.0
#: The level of the highest colour is a multiple of this.
MAP_ROUND_TO_DB = 5.0
#: The highest level of the highest colour, and the range in silence.
MAP_HIGHEST_DB = 200.0
SILENT_MAP_RANGE_DB = (-MAP_RANGE_DB, 0.0)


def map_range_db(levels_db: ArrayLike) -> tuple[float, float]:
    """Return the levels of the lowest and the highest colour of maps of these levels, in dB.

    The highest is the loudest level, rounded up to `MAP_ROUND_TO_DB`; in silence it is 0 dB.  Both
    stay between `FLOOR_DB` and `MAP_HIGHEST_DB`.
    """
    loudest = float(np.max(real_array("levels_db", levels_db, "levels in dB"), initial=FLOOR_DB))
    if loudest <= FLOOR_DB:
        return SILENT_MAP_RANGE_DB
    # A rounding error of a level must not add five decibels.
    top = ceil(loudest / MAP_ROUND_TO_DB - 1e-9) * MAP_ROUND_TO_DB
    top = min(max(top, FLOOR_DB + MAP_RANGE_DB), MAP_HIGHEST_DB)
    return top - MAP_RANGE_DB, top
