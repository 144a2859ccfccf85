"""What the map shows that is the same at any time: levels, or levels above threshold."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from skinsource.base.decibels import FLOOR_DB
from skinsource.perception.sensation import LIMITS, LIMITS_IN_SHORT
from skinsource_gui.panels.skin.map_quantity import LEVELS, SENSATION

SILENT = "Silent: nothing is driven"
#: By quantity: that of outputs, and that over the skin.
_NAMES = {
    LEVELS: ("output_levels_db", "surface_levels_db"),
    SENSATION: ("sensation_db", "surface_sensation_db"),
}


def needs_of(quantity: str) -> frozenset[str]:
    """What has to be known of outputs."""
    more = {"sensation"} if quantity == SENSATION else set()
    return frozenset({_NAMES[quantity][0]} | more)


def over_skin(quantity: str) -> str:
    """What has to be known over the skin."""
    return _NAMES[quantity][1]


def changes_of(quantity: str, results: Mapping[str, Any], *, interpolated: bool) -> dict[str, Any]:
    """What of the map's content follows from ``results``."""
    values = results[_NAMES[quantity][0]]
    if not values.size:
        return {"values": None, "field_values": None, "message": results["sensation"].problem}
    return {
        "values": values,
        "field_values": results[_NAMES[quantity][1]] if interpolated else None,
        "message": SILENT if float(np.max(values)) <= FLOOR_DB else "",
    }


def limits_and(note: str, quantity: str) -> str:
    """What is to be said below the map: what thresholds are not good for, before all else."""
    return f"{LIMITS} {note}".strip() if quantity == SENSATION else note


def in_short(note: str) -> str:
    """The note where there is little room for it."""
    return note.replace(LIMITS, LIMITS_IN_SHORT)
