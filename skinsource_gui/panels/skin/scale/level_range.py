"""The range of levels that the colours span."""

import math

from skinsource.base.decibels import FLOOR_DB
from skinsource.signals.map_range import MAP_HIGHEST_DB, SILENT_MAP_RANGE_DB

Range = tuple[float, float]

#: What the range can reach, and its smallest span, dB.
LOWEST_DB, HIGHEST_DB = FLOOR_DB, MAP_HIGHEST_DB
SMALLEST_SPAN_DB = 1.0
#: The automatic range in silence.
SILENT_RANGE: Range = SILENT_MAP_RANGE_DB

_TICK_STEPS_DB = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)


def with_low(range_db: Range, low_db: float) -> Range:
    """The range with its lower end dragged, as far as the upper one allows."""
    high = range_db[1]
    return min(max(low_db, LOWEST_DB), high - SMALLEST_SPAN_DB), high


def with_high(range_db: Range, high_db: float) -> Range:
    """The range with its upper end dragged, as far as the lower one allows."""
    low = range_db[0]
    return low, max(min(high_db, HIGHEST_DB), low + SMALLEST_SPAN_DB)


def pushed_low(range_db: Range, low_db: float) -> Range:
    """The range with another lower end; an upper end in its way goes along with it."""
    low, high = range_db
    if low_db > high - SMALLEST_SPAN_DB:
        high = min(low_db + (high - low), HIGHEST_DB)
    return low_db, high


def pushed_high(range_db: Range, high_db: float) -> Range:
    """The range with another upper end; a lower end in its way goes along with it."""
    low, high = range_db
    if high_db < low + SMALLEST_SPAN_DB:
        low = max(high_db - (high - low), LOWEST_DB)
    return low, high_db


def moved(range_db: Range, by_db: float) -> Range:
    """The range shifted, with its span unchanged."""
    low, high = range_db
    by = min(max(by_db, LOWEST_DB - low), HIGHEST_DB - high)
    return low + by, high + by


def tick_levels(low_db: float, high_db: float, room_px: float, spacing_px: float) -> list[float]:
    """Round levels from ``low_db`` to ``high_db``, at least ``spacing_px`` apart."""
    span = high_db - low_db
    fitting = (step for step in _TICK_STEPS_DB if step * room_px >= spacing_px * span)
    step = next(fitting, _TICK_STEPS_DB[-1])
    first, last = math.ceil(low_db / step - 1e-9), math.floor(high_db / step + 1e-9)
    return [step * k for k in range(first, last + 1)]
