"""Round numbers, one step apart."""

import math
from fractions import Fraction

from skinsource.specs.fields import NumberSpec
from skinsource_gui.widgets.fields.units import DisplayUnit, display_unit

#: Sizes of a step, in plain steps.
FINE, PLAIN, COARSE = Fraction(1, 10), Fraction(1), Fraction(10)

# What is this near to a round number, in steps, is that number.
_TOLERANCE = 1e-9


def clamped(value_si: float, spec: NumberSpec) -> float:
    """The allowed value nearest to ``value_si``."""
    return float(min(max(value_si, spec.minimum), spec.maximum))


def stepped(value_si: float, direction: int, spec: NumberSpec, size: Fraction = PLAIN) -> float:
    """The next round number above or below, within the allowed range.

    Round are the multiples of 1, 2 or 5 times a power of ten, as shown in the display unit:
    with ``spec.logarithmic`` of the one nearest to ``spec.step`` times the value, else of the one
    nearest to ``spec.step``.  From 150 Hz steps of about 2 % go to 152, 154, …, 160, 165, 170.

    Parameters
    ----------
    value_si
        Where to start.
    direction
        1: up, -1: down.
    spec
        What is allowed.
    size
        `FINE`, `PLAIN` or `COARSE`: a tenth of a step, a step, ten steps.
    """
    unit = display_unit(spec.unit)
    step = _step_shown(value_si, spec, unit) * size
    if spec.whole:
        step = max(step, Fraction(1))
    position = Fraction(value_si) / unit.si / step
    nearest = round(position)
    if abs(position - nearest) < _TOLERANCE * max(1, abs(nearest)):
        target = nearest + direction
    else:
        target = math.ceil(position) if direction > 0 else math.floor(position)
    return clamped(unit.value_si(target * step), spec)


class Ladder:
    """Values to either side of an anchor, each one step from the next.

    The anchor itself need not be round, and is what the way back leads to.

    Parameters
    ----------
    anchor_si
        Value at position 0.
    spec, size
        See `stepped`.
    """

    def __init__(self, anchor_si: float, spec: NumberSpec, size: Fraction) -> None:
        self.size = size
        self._spec = spec
        self._values = {1: [anchor_si], -1: [anchor_si]}

    def value_si(self, position: int) -> float:
        """Value that many steps above (or, negative, below) the anchor."""
        direction = 1 if position >= 0 else -1
        values = self._values[direction]
        while len(values) <= abs(position):
            values.append(stepped(values[-1], direction, self._spec, self.size))
        return values[abs(position)]


def _step_shown(value_si: float, spec: NumberSpec, unit: DisplayUnit) -> Fraction:
    """The plain step at a value, as it is shown: 1, 2 or 5 times a power of ten."""
    size_si = spec.step * value_si if spec.logarithmic and value_si > 0 else spec.step
    wanted = unit.shown(size_si)
    decade = Fraction(10) ** math.floor(math.log10(wanted))
    return min(
        (factor * decade for factor in (1, 2, 5, 10)),
        key=lambda step: abs(math.log(wanted / step)),
    )
