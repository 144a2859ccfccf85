"""What one turn of the wheel makes of a number."""

import math

from skinsource.fields import NumberSpec
from skinsource_gui.widgets.fields.units import DisplayUnit

#: Steps are counted in tenths, so that fine and plain steps add up exactly.
FINE, PLAIN, COARSE = 1, 10, 100


def clamped(value_si: float, spec: NumberSpec) -> float:
    """The allowed value nearest to ``value_si``."""
    return float(min(max(value_si, spec.minimum), spec.maximum))


def stepped(value_si: float, tenths: int, spec: NumberSpec, unit: DisplayUnit) -> float:
    """Value ``tenths`` tenths of a step away from ``value_si``, within the allowed range.

    The result is rounded to a tenth of the last digit that the step changes, so that steps make
    numbers that are short to read: 100, 102, 104, 106.1 Hz.
    """
    if tenths == 0:
        return value_si
    smallest = FINE if tenths % PLAIN else PLAIN
    if spec.logarithmic and value_si > 0:
        moved = value_si * (1.0 + spec.step) ** (tenths / PLAIN)
        size_si = value_si * spec.step * smallest / PLAIN
        spare_digits = 1
    else:
        moved = value_si + spec.step * tenths / PLAIN
        size_si = spec.step * smallest / PLAIN
        spare_digits = 3
    if spec.whole:
        return clamped(round(moved), spec)
    last_digit = math.floor(math.log10(unit.shown(size_si)) + 1e-9)
    decimals = min(max(spare_digits - last_digit, 0), 15)
    return clamped(unit.value_si(f"{unit.shown(moved):.{decimals}f}"), spec)
