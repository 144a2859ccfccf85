"""Ranges of axes: held while data change, zoomed and panned by the user."""

from copy import copy
from math import ceil, floor, isfinite, log10
from typing import Literal

from skinsource.base.decibels import FLOOR_DB

Range = tuple[float, float]
#: ``"amplitude"``: linear, includes zero; ``"level"``: dB, 80 dB from top to bottom;
#: ``"relative"``: parts of peaks, without a unit.
Kind = Literal["amplitude", "level", "relative"]

LEVEL_SPAN_DB = 80.0
_LEVEL_STEP_DB = 5.0
# A level range is left only for data that lie this far below its top (60 % are -4.4 dB).
_LEVEL_SLACK_DB = 10.0
# Tops of amplitude ranges: coarse enough that growing data seldom move the ticks.
_TOPS = (1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.4, 8.0, 10.0)
_SHRINK_BELOW = 0.6
# Curves that are relative to their peaks reach 1, and waves between samples a little more.
_RELATIVE_TOP = 1.1
_HEADROOM = 1.02


class HeldRange:
    """Range of a value axis that follows its data without flicker.

    It grows at once, and shrinks only when the data need less than 60 % of it.
    """

    def __init__(self) -> None:
        self._kind: Kind | None = None
        self._range: Range = (0.0, 1.0)

    def follow(self, low: float, high: float, kind: Kind) -> Range:
        """Range for data from ``low`` to ``high``.

        Amplitudes: ``(0, top)`` for data that are never negative, else ``(-top, top)``.
        Levels: ``(top - 80, top)``.  Silence leaves the range as it was.
        """
        wanted = _wanted(low, high, kind)
        if kind != self._kind or not self._still_fits(low, high, wanted):
            self._range = wanted
        self._kind = kind
        return self._range

    def copied(self) -> "HeldRange":
        """One that has followed the same data."""
        return copy(self)

    def let_go(self) -> None:
        """Decide the next range by its data alone."""
        self._kind, self._range = None, (0.0, 1.0)

    def _still_fits(self, low: float, high: float, wanted: Range) -> bool:
        held_low, held_high = self._range
        if self._kind == "level":
            if high <= FLOOR_DB:
                return True
            return wanted[1] <= held_high <= wanted[1] + _LEVEL_SLACK_DB
        if low == high == 0:
            return True
        if (held_low < 0) != (wanted[0] < 0):
            return False
        return max(high, -low) <= held_high and wanted[1] >= _SHRINK_BELOW * held_high


def _wanted(low: float, high: float, kind: Kind) -> Range:
    if kind == "level":
        return _level_range(high)
    if kind == "relative" and max(high, -low) <= _RELATIVE_TOP:
        return (-_RELATIVE_TOP if low < 0 else 0.0, _RELATIVE_TOP)
    return _amplitude_range(low, high)


def _amplitude_range(low: float, high: float) -> Range:
    peak = max(high, -low)
    top = _round_up(peak * _HEADROOM) if peak > 0 else 1.0
    return (-top if low < 0 else 0.0, top)


def _level_range(high: float) -> Range:
    if high <= FLOOR_DB:
        return (-LEVEL_SPAN_DB, 0.0)
    top = ceil(high / _LEVEL_STEP_DB) * _LEVEL_STEP_DB
    return (top - LEVEL_SPAN_DB, top)


def _round_up(value: float) -> float:
    decade = 10.0 ** floor(log10(value))
    # A value at the edge of the numbers has no decade that can be multiplied.
    if not isfinite(10.0 * decade) or decade == 0:
        return value
    return next((top * decade for top in _TOPS if top * decade >= value), 10.0 * decade)


def zoomed(shown: Range, anchor: float, factor: float) -> Range:
    """``shown`` made ``factor`` times narrower, with ``anchor`` staying where it is."""
    low, high = shown
    return (anchor - (anchor - low) / factor, anchor + (high - anchor) / factor)


def within(wanted: Range, extent: Range, shortest: float) -> Range | None:
    """``wanted`` moved and cut so that it lies in ``extent``; ``None`` where that is all of it.

    It becomes no shorter than ``shortest``.
    """
    low, high = wanted
    length = max(high - low, shortest)
    middle = (low + high) / 2
    if length >= (extent[1] - extent[0]) * (1 - 1e-9):
        return None
    low = min(max(middle - length / 2, extent[0]), extent[1] - length)
    return (low, low + length)
