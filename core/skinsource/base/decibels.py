"""Levels in decibels."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import positive_number, real_array, real_number
from skinsource.base.errors import InvalidInputError

#: The level of silence.  Nothing measured or predicted comes near it.
FLOOR_DB = -200.0
# Maps of silence are interpolated between such levels, which rounds.
_ROUNDING_DB = 1e-6


def decibels(
    x: ArrayLike, reference: float = 1.0, *, floor_db: float = FLOOR_DB
) -> NDArray[np.float64]:
    """Return the level of amplitudes, 20 log10(x / reference), in dB.

    Parameters
    ----------
    x
        Amplitudes, zero or positive, any shape.
    reference
        The amplitude of 0 dB, in the unit of ``x``.
    floor_db
        The lowest level returned: that of zero and of all amplitudes below it.

    Returns
    -------
    Levels in dB, shape of ``x``, finite.

    Raises
    ------
    InvalidInputError
        An amplitude is NaN, infinite or negative, or the reference is not positive.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.decibels([1.0, 0.1, 0.0]))
    [   0.  -20. -200.]
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
    # Two logarithms, because the quotient of extreme amplitudes under- or overflows.
    with np.errstate(divide="ignore"):
        level = 20.0 * (np.log10(amplitude) - np.log10(reference))
    return np.maximum(level, floor_db)


def levels_for_tables(levels_db: ArrayLike) -> NDArray[np.float64]:
    """Return levels for tables: NaN for silence, which has none.

    In files that is ``nan``, which NumPy, pandas, MATLAB and R read as no number; a table that is
    copied for a spreadsheet has an empty field.
    """
    levels = real_array("levels_db", levels_db, "levels in dB")
    return np.where(levels <= FLOOR_DB + _ROUNDING_DB, np.nan, levels)
