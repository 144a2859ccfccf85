"""Levels: the only place where decibels are made."""

from math import ceil

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.arguments import positive_number, real_array, real_number
from skinsource.errors import InvalidInputError

#: What silence is shown as.  Nothing measured or predicted comes near it.
FLOOR_DB = -200.0
#: What the colours of a map span, unless another range is chosen: from the loudest output down.
MAP_RANGE_DB = 50.0
#: The level of the highest colour is a multiple of it.
MAP_ROUND_TO_DB = 5.0
#: Its highest value, and what the colours span in silence.
MAP_HIGHEST_DB = 200.0
SILENT_MAP_RANGE_DB = (-MAP_RANGE_DB, 0.0)


def decibels(
    x: ArrayLike, reference: float = 1.0, *, floor_db: float = FLOOR_DB
) -> NDArray[np.float64]:
    """Level of an amplitude, 20 log10(x / reference), in dB.

    Parameters
    ----------
    x
        Amplitudes, zero or positive, any shape.
    reference
        The amplitude of 0 dB, in the unit of ``x``.
    floor_db
        The lowest level returned: that of zero, and of all that lies below it.

    Returns
    -------
    Levels in dB, shape of ``x``, finite.

    Raises
    ------
    InvalidInputError
        An amplitude is NaN, infinite or negative, or the reference is not positive.
    """
    amplitude = real_array("amplitude", x, "finite numbers of zero or more")
    reference = positive_number("reference", reference)
    floor_db = real_number("floor_db", floor_db)
    usable = np.isfinite(amplitude) & (amplitude >= 0)
    if not usable.all():
        first = tuple(int(i) for i in np.argwhere(~usable)[0])
        raise InvalidInputError(
            f"amplitude at index {first} is {amplitude[first]}, expected a finite number of zero "
            "or more: a level in dB exists for nothing else"
        )
    level = np.full(amplitude.shape, float(floor_db))
    # Two logarithms, because the quotient of extreme amplitudes under- or overflows.
    np.log10(amplitude, out=level, where=amplitude > 0)
    level = np.where(amplitude > 0, 20.0 * (level - np.log10(reference)), floor_db)
    return np.maximum(level, floor_db)


def map_range_db(levels_db: ArrayLike) -> tuple[float, float]:
    """Levels of the lowest and the highest colour of maps that show these levels, in dB.

    The highest is the loudest level, rounded up to `MAP_ROUND_TO_DB`; in silence it is 0 dB.  They
    stay between `FLOOR_DB` and `MAP_HIGHEST_DB`.
    """
    loudest = float(np.max(real_array("levels_db", levels_db, "levels in dB"), initial=FLOOR_DB))
    if loudest <= FLOOR_DB:
        return SILENT_MAP_RANGE_DB
    # What rounding has added to a level is not worth five more decibels.
    top = ceil(loudest / MAP_ROUND_TO_DB - 1e-9) * MAP_ROUND_TO_DB
    top = min(max(top, FLOOR_DB + MAP_RANGE_DB), MAP_HIGHEST_DB)
    return top - MAP_RANGE_DB, top
