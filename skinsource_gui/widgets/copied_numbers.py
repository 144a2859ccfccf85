"""Numbers of tables that are copied, for a spreadsheet."""

import math

from skinsource.base.decibels import in_tables


def copied(value: float) -> str:
    """Digits that read back as the same number; empty where there is none."""
    return repr(float(value)) if math.isfinite(value) else ""


def copied_level(level_db: float) -> str:
    """The same of a level in dB; empty for silence, which has none."""
    return copied(float(in_tables(level_db)))
