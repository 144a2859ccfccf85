"""Designs side by side: snapshots, alike in level, and how their levels differ."""

from skinsource.comparing.difference import difference_db, loudest_db, matching_gain
from skinsource.comparing.snapshot import (
    EDITED,
    NUMBERS,
    Snapshot,
    louder,
    nothing_to_compare,
    other_than,
    reference,
    shown,
)

__all__ = [
    "EDITED",
    "NUMBERS",
    "Snapshot",
    "difference_db",
    "louder",
    "loudest_db",
    "matching_gain",
    "nothing_to_compare",
    "other_than",
    "reference",
    "shown",
]
