"""How levels of two designs differ, and what makes them alike."""

import math

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import positive_number, real_array
from skinsource.arrays import Floats
from skinsource.decibels import FLOOR_DB
from skinsource.errors import InvalidInputError

#: Levels farther below the loudest output count as so far below: what cannot be felt beside it
#: makes no difference.
DEPTH_DB = 60.0
#: Ends of scales of differences, dB.
ENDS_DB = (1.0, 2.0, 3.0, 5.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0)
#: A scale of differences tells this share of them, and all that are a third of the largest.
_TOLD, _OF_LARGEST = 0.95, 1.0 / 3.0


def loudest_db(levels_db: ArrayLike) -> float:
    """Level of the loudest output, dB; what designs are matched by."""
    levels = real_array("levels_db", levels_db, "levels in dB")
    if not levels.size:
        raise InvalidInputError("levels_db is empty, expected at least one level")
    return float(levels.max())


def matching_gain(loudest_db: float, reference_db: float) -> float:
    """Factor that brings a loudest output to the level of another one; 1 where either is silent.

    Parameters
    ----------
    loudest_db, reference_db
        Levels of both in dB, as `loudest_db` gives them.
    """
    if loudest_db <= FLOOR_DB or reference_db <= FLOOR_DB:
        return 1.0
    # The same level gives 1 exactly: the reference itself is not changed.
    return float(10.0 ** ((reference_db - loudest_db) / 20.0))


def gain_words(gain: float) -> str:
    """What a factor is in dB, "+3.2 dB"; empty where it is none to a tenth of a dB."""
    by_db = round(20.0 * math.log10(gain), 1) if gain > 0 else 0.0
    return f"{by_db:+.1f} dB".replace("-", "\N{MINUS SIGN}") if by_db else ""


def match_words(gain: float) -> str:
    """What axes say of results that are shown with a factor, "−3.2 dB, matched"; or nothing."""
    words = gain_words(gain)
    return f"{words}, matched" if words else ""


def difference_db(
    levels_db: Floats,
    other_db: Floats,
    *,
    gain: float = 1.0,
    loudest_db: float | None = None,
    depth_db: float = DEPTH_DB,
) -> Floats:
    """How much louder than another design one is, in dB, same shape.

    Parameters
    ----------
    levels_db, other_db
        Levels at the same places, any shape; NaN outside an outline stays NaN.
    gain
        Factor with which the other one is played.
    loudest_db
        The loudest level of both; the largest of these, unless given.
    depth_db
        Levels farther below the loudest count as so far below: silence is no difference of 200 dB.
    """
    positive_number("gain", gain)
    played = other_db + 20.0 * np.log10(gain)
    if loudest_db is None:
        loudest_db = float(np.nanmax([np.nanmax(levels_db), np.nanmax(played)]))
    floor = loudest_db - depth_db
    return np.maximum(levels_db, floor) - np.maximum(played, floor)


def end_db(*differences_db: ArrayLike) -> float:
    """Where a scale ends that tells these differences, or spreads, in dB: a round number.

    A few large ones would leave all others without colour: 19 of 20 lie within the scale, and it
    reaches at least to a third of the largest, so that one that stands alone is seen as it is.
    What lies beyond has the colour of the end.

    Parameters
    ----------
    differences_db
        Of any shape and sign; NaN counts as nothing.
    """
    sizes = np.concatenate([np.empty(0), *(np.abs(np.ravel(one)) for one in differences_db)])
    sizes = sizes[~np.isnan(sizes)]
    if not sizes.size:
        return ENDS_DB[0]
    told = max(float(np.quantile(sizes, _TOLD)), _OF_LARGEST * float(sizes.max()))
    return next((end for end in ENDS_DB if told <= end), ENDS_DB[-1])
