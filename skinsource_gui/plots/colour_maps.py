"""Colour maps: tables of colours, and the colours of levels."""

from functools import cache

import numpy as np
import pyqtgraph
from numpy.typing import NDArray
from PySide6 import QtGui

#: Number of colours in a table.
N_COLOURS = 256
#: The usual map: perceptually uniform, and safe for colour-vision deficiencies.
VIRIDIS = "viridis"
#: For values with a sign: blue is negative and red positive, safe for colour-vision deficiencies.
DIVERGING = "CET-D1A"


@cache
def colour_table(name: str = VIRIDIS) -> NDArray[np.uint32]:
    """Return the colours of a map as ``0xffrrggbb``, lowest first, (256,).

    Parameters
    ----------
    name
        Any colour map that comes with pyqtgraph, such as ``"viridis"`` or ``"CET-L20"``.
    """
    rgb = pyqtgraph.colormap.get(name).getLookupTable(nPts=N_COLOURS, alpha=False)
    red, green, blue = rgb.astype(np.uint32).T
    table = np.uint32(0xFF000000) | (red << 16) | (green << 8) | blue
    table.flags.writeable = False
    return table


def colour_indices(
    levels_db: NDArray[np.float64], range_db: tuple[float, float]
) -> NDArray[np.uint8]:
    """Return the row of the colour table of each level, uint8, shape of ``levels_db``.

    Levels outside the range take the colour of its nearer end, NaN that of the lower end.
    """
    low, high = range_db
    within = np.clip(levels_db, low, high, out=np.empty_like(levels_db))
    within[np.isnan(within)] = low
    within -= low
    within *= (N_COLOURS - 1) / (high - low)
    within += 0.5
    return within.astype(np.uint8)


def level_colours(
    levels_db: NDArray[np.float64], range_db: tuple[float, float], table: NDArray[np.uint32]
) -> list[QtGui.QColor]:
    """Return the colour of each level, (n_levels,)."""
    return [QtGui.QColor(int(argb)) for argb in table[colour_indices(levels_db, range_db)]]


def is_light(colour: QtGui.QColor) -> bool:
    """Return whether black text on ``colour`` is easier to read than white text."""
    return 0.299 * colour.redF() + 0.587 * colour.greenF() + 0.114 * colour.blueF() > 0.5
