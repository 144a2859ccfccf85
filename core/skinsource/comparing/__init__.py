"""Designs side by side: snapshots, alike in level, and how their levels differ."""

from skinsource.comparing.difference import (
    difference_db,
    end_db,
    gain_words,
    loudest_db,
    match_words,
    matching_gain,
)
from skinsource.comparing.limbs import (
    MOST_BESIDE,
    limbs_beside,
    mean_and_spread_over,
    same_outputs,
)
from skinsource.comparing.snapshot import (
    EDITED,
    NUMBERS,
    Snapshot,
    alike,
    brought_back,
    louder,
    name_of,
    nothing_to_compare,
    other_than,
    reference,
    shown,
    together,
)

__all__ = [
    "EDITED",
    "MOST_BESIDE",
    "NUMBERS",
    "Snapshot",
    "alike",
    "brought_back",
    "difference_db",
    "end_db",
    "gain_words",
    "limbs_beside",
    "louder",
    "loudest_db",
    "match_words",
    "matching_gain",
    "mean_and_spread_over",
    "name_of",
    "nothing_to_compare",
    "other_than",
    "reference",
    "same_outputs",
    "shown",
    "together",
]
