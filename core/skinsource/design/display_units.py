"""Numbers as people read them: in milliseconds, degrees, hertz; values are in SI units."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache

from skinsource.design.amplitudes import ARBITRARY_UNIT

#: Significant digits of a number that is shown.
SHOWN_DIGITS = 6

#: Time axes from this length on are in seconds.
LONG_S = 1.0
# Numbers only from this length on: who types 300 after 1200 means milliseconds again.
_LONG_NUMBER_S = 10.0


@dataclass(frozen=True, slots=True)
class DisplayUnit:
    """How values of one SI unit are shown.

    Attributes
    ----------
    symbol
        Text after the number.
    si
        The unit in SI units; rational, so that it is rounded only once.
    spellings
        Other units that can be typed, and each in SI units.
    """

    symbol: str
    si: Fraction = Fraction(1)
    spellings: Mapping[str, Fraction] = field(default_factory=dict)

    def shown(self, value_si: float) -> float:
        """Return the number to show for a value."""
        return float(Fraction(value_si) / self.si)

    def value_si(self, shown: str | float | Fraction) -> float:
        """Return the value of a number that is shown."""
        return float(Fraction(shown) * self.si)


_MILLI, _ONE = Fraction(1, 1000), Fraction(1)
_MICRO = _MILLI**2
_DEGREE, _PI = Fraction(math.pi) / 180, Fraction(math.pi)
_TIMES = {"sec": _ONE, "µs": _MICRO, "us": _MICRO, "min": Fraction(60)}
_ACCELERATIONS = {"m/s^2": _ONE, "m/s2": _ONE, "mm/s²": _MILLI, "mm/s^2": _MILLI, "mm/s2": _MILLI}
_LENGTHS = {"cm": 10 * _MILLI, "m": _ONE, "µm": _MICRO, "um": _MICRO}
_DISPLAY_UNITS = {
    "s": DisplayUnit("ms", _MILLI, {"s": _ONE, **_TIMES}),
    "rad": DisplayUnit("°", _DEGREE, {"deg": _DEGREE, "rad": _ONE, "pi": _PI, "π": _PI}),
    "m": DisplayUnit("mm", _MILLI, _LENGTHS),
    "Hz": DisplayUnit("Hz", spellings={"kHz": 1 / _MILLI}),
    "m/s²": DisplayUnit("m/s²", spellings=_ACCELERATIONS),
    "H": DisplayUnit("mH", _MILLI, {"H": _ONE, "µH": _MICRO, "uH": _MICRO}),
    "F": DisplayUnit("nF", _MILLI**3, {"F": _ONE, "µF": _MICRO, "uF": _MICRO, "pF": _MILLI**4}),
    "kg": DisplayUnit("g", _MILLI, {"kg": _ONE, "mg": _MICRO}),
    "A": DisplayUnit("mA", _MILLI, {"A": _ONE}),
    "W": DisplayUnit("mW", _MILLI, {"W": _ONE}),
    ARBITRARY_UNIT: DisplayUnit(ARBITRARY_UNIT, spellings={"au": _ONE, "a.u": _ONE}),
    "×": DisplayUnit("×", spellings={"x": _ONE}),
}
# Long times are easier to read in seconds.
_LONG_TIMES = DisplayUnit("s", spellings={"ms": _MILLI, **_TIMES})


def display_unit(unit: str, value_si: float = 0.0) -> DisplayUnit:
    """Return the display unit of values in the SI unit ``unit``; an unknown unit is its own.

    Times are shown in milliseconds, and from ten seconds on in seconds.
    """
    if unit == "s" and abs(value_si) >= _LONG_NUMBER_S:
        return _LONG_TIMES
    return _DISPLAY_UNITS.get(unit) or DisplayUnit(unit)


@lru_cache(maxsize=512)
def number_text(value_si: float, unit: str, digits: int = SHOWN_DIGITS) -> str:
    """Return the number to show for a value, without its unit, to ``digits`` significant digits.

    Digits left of the point are never rounded.
    """
    shown = display_unit(unit, value_si).shown(value_si)
    if shown == 0:
        return "0"
    magnitude = math.floor(math.log10(abs(shown)))
    if magnitude < -4:
        return f"{shown:.{digits}g}"
    text = f"{shown:.{max(0, digits - 1 - magnitude)}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def with_unit(number: str, unit: DisplayUnit) -> str:
    """Return ``number`` followed by the symbol of its unit, with a space where it is usual."""
    symbol = unit.symbol
    return f"{number}{symbol}" if symbol in ("", "°") else f"{number} {symbol}"


def value_text(value_si: float, unit: str, digits: int = SHOWN_DIGITS) -> str:
    """Return number and unit to show for a value: ``"200 ms"``."""
    return with_unit(number_text(value_si, unit, digits), display_unit(unit, value_si))
