"""Numbers as a user reads and types them: milliseconds, degrees, hertz."""

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import sentence
from skinsource.design.amplitudes import ARBITRARY_UNIT
from skinsource.specs.fields import NumberSpec
from skinsource_gui.widgets.fields.level_text import minus

#: Significant digits of a number that is shown, and of one that is being edited.
SHOWN_DIGITS = 6
EDITED_DIGITS = 12

#: From this length on times are said in seconds.
LONG_S = 1.0

# A number, and its unit if any: what goes on with a digit or a sign is neither.
_NUMBER = re.compile(
    r"([+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+-]?\d+)?)\s*(|[^\s\d.,:;'’_+*/^-].*)", re.DOTALL
)
# A bound that was shown in a rounded form can be typed.
_BOUND_TOLERANCE = 1e-12
# No number of ours has an exponent beyond; to write one out as a fraction takes for ever.
_LARGEST_EXPONENT = 400


@dataclass(frozen=True, slots=True, kw_only=True)
class DisplayUnit:
    """How values of one SI unit are shown.

    Attributes
    ----------
    symbol
        What stands behind the number.
    si
        One of what is shown, in SI units; rational, so that nothing is lost twice.
    spellings
        Other units that can be typed, and one of each in SI units.
    """

    symbol: str
    si: Fraction = Fraction(1)
    spellings: tuple[tuple[str, Fraction], ...] = ()

    def shown(self, value_si: float) -> float:
        """Number to show for a value."""
        return float(Fraction(value_si) / self.si)

    def value_si(self, shown: str | float | Fraction) -> float:
        """Value of a number that is shown."""
        return float(Fraction(shown) * self.si)


_MILLI = Fraction(1, 1000)
_DEGREE = Fraction(math.pi) / 180
_DISPLAY_UNITS = {
    "s": DisplayUnit(
        symbol="ms",
        si=_MILLI,
        spellings=(
            ("s", Fraction(1)),
            ("sec", Fraction(1)),
            ("µs", _MILLI**2),
            ("us", _MILLI**2),
            ("min", Fraction(60)),
        ),
    ),
    "rad": DisplayUnit(
        symbol="°",
        si=_DEGREE,
        spellings=(
            ("deg", _DEGREE),
            ("rad", Fraction(1)),
            ("pi", Fraction(math.pi)),
            ("π", Fraction(math.pi)),
        ),
    ),
    "m": DisplayUnit(
        symbol="mm",
        si=_MILLI,
        spellings=(("cm", 10 * _MILLI), ("m", Fraction(1)), ("µm", _MILLI**2), ("um", _MILLI**2)),
    ),
    "Hz": DisplayUnit(symbol="Hz", spellings=(("kHz", 1 / _MILLI),)),
    "m/s²": DisplayUnit(
        symbol="m/s²",
        spellings=(
            ("m/s^2", Fraction(1)),
            ("m/s2", Fraction(1)),
            ("mm/s²", _MILLI),
            ("mm/s^2", _MILLI),
            ("mm/s2", _MILLI),
        ),
    ),
    "H": DisplayUnit(
        symbol="mH", si=_MILLI, spellings=(("H", Fraction(1)), ("µH", _MILLI**2), ("uH", _MILLI**2))
    ),
    "F": DisplayUnit(
        symbol="nF",
        si=_MILLI**3,
        spellings=(("F", Fraction(1)), ("µF", _MILLI**2), ("uF", _MILLI**2), ("pF", _MILLI**4)),
    ),
    "kg": DisplayUnit(symbol="g", si=_MILLI, spellings=(("kg", Fraction(1)), ("mg", _MILLI**2))),
    "A": DisplayUnit(symbol="mA", si=_MILLI, spellings=(("A", Fraction(1)),)),
    "W": DisplayUnit(symbol="mW", si=_MILLI, spellings=(("W", Fraction(1)),)),
    ARBITRARY_UNIT: DisplayUnit(
        symbol=ARBITRARY_UNIT, spellings=(("au", Fraction(1)), ("a.u", Fraction(1)))
    ),
    "×": DisplayUnit(symbol="×", spellings=(("x", Fraction(1)),)),
}


# Long times read better in whole seconds.
_LONG_TIMES = DisplayUnit(
    symbol="s",
    spellings=(("ms", _MILLI), *(pair for pair in _DISPLAY_UNITS["s"].spellings if pair[0] != "s")),
)


def display_unit(unit: str, value_si: float = 0.0) -> DisplayUnit:
    """How a value of the SI unit ``unit`` is shown; one of an unknown unit is shown as it is.

    Times are shown in milliseconds, and from one second on in seconds.
    """
    if unit == "s" and abs(value_si) >= LONG_S:
        return _LONG_TIMES
    return _DISPLAY_UNITS.get(unit) or DisplayUnit(symbol=unit)


@lru_cache(maxsize=512)
def number_text(value_si: float, unit: str, digits: int = SHOWN_DIGITS) -> str:
    """Number to show for a value, without its unit, to ``digits`` significant digits.

    Digits left of the point are never rounded away.
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
    """``number`` followed by the symbol of its unit, with the space that belongs there."""
    symbol = unit.symbol
    return f"{number}{symbol}" if symbol in ("", "°") else f"{number} {symbol}"


def axis_unit(until_s: float) -> tuple[str, float]:
    """Unit of a time axis that ends there, and how many of them are a second."""
    return ("s", 1.0) if until_s >= LONG_S * (1 - 1e-9) else ("ms", 1e3)


def value_text(value_si: float, unit: str, digits: int = SHOWN_DIGITS) -> str:
    """Number and unit to show for a value: ``"200 ms"``."""
    return with_unit(number_text(value_si, unit, digits), display_unit(unit, value_si))


def range_text(spec: NumberSpec) -> str:
    """What a number may be, in words: ``"1 to 649 Hz"``."""
    kind = "whole number" if spec.whole else "number"
    low, high = math.isfinite(spec.minimum), math.isfinite(spec.maximum)
    if low and high:
        units = [display_unit(spec.unit, end).symbol for end in (spec.minimum, spec.maximum)]
        said_once = units[0] == units[1] or spec.minimum == 0
        lowest = (number_text if said_once else value_text)(spec.minimum, spec.unit)
        return minus(f"{lowest} to {value_text(spec.maximum, spec.unit)}")
    if low:
        return minus(f"{value_text(spec.minimum, spec.unit)} or more")
    if high:
        return minus(f"{value_text(spec.maximum, spec.unit)} or less")
    return f"any {kind}"


def parse_number(text: str, spec: NumberSpec, beside_si: float = 0.0) -> float:
    """Value in SI units of what a user typed: ``"250"``, ``"0,2 s"``, ``"200 ms"``.

    A number alone is in the unit in which ``beside_si`` is shown, the value that it replaces.

    Raises
    ------
    InvalidInputError
        It is not a number, has a unit of something else, or is not allowed by ``spec``; the
        message names what is.
    """
    unit = display_unit(spec.unit, beside_si)
    allowed = sentence(f"Allowed: {'whole numbers ' if spec.whole else ''}{range_text(spec)}")
    typed = text.strip().replace("−", "-")
    if not typed:
        raise InvalidInputError(f"{spec.label}: nothing typed. {allowed}")
    match = _NUMBER.fullmatch(typed)
    if match is None:
        raise InvalidInputError(f"{spec.label}: “{typed}” is not a number. {allowed}")
    factor = _factor(match[2], unit)
    if factor is None:
        known = ", ".join(name for name in (unit.symbol, *dict(unit.spellings)) if name)
        instead = sentence(f"Units: {known}") if known else "Type the number alone."
        raise InvalidInputError(f"{spec.label}: “{match[2]}” is not one of its units. {instead}")
    try:
        value = _at_bound(_read(match[1].replace(",", "."), factor), spec)
    except (OverflowError, ValueError):  # beyond all floats; more digits than Python reads
        raise InvalidInputError(f"{spec.label}: the number is too long. {allowed}") from None
    if math.isinf(value) or not spec.minimum <= value <= spec.maximum:
        side = "low" if value < spec.minimum else "high"
        found = minus(with_unit(match[1], unit) if not match[2] else typed)
        raise InvalidInputError(f"{spec.label}: {found} is too {side}. {allowed}")
    if spec.whole and value != int(value):
        raise InvalidInputError(f"{spec.label}: {typed} is not a whole number. {allowed}")
    return value


def _factor(name: str, unit: DisplayUnit) -> Fraction | None:
    spellings = {"": unit.si, unit.symbol.casefold(): unit.si}
    spellings |= {spelling.casefold(): si for spelling, si in unit.spellings}
    return spellings.get(name.strip().casefold())


def _read(number: str, factor: Fraction) -> float:
    digits, _, exponent = number.lower().partition("e")
    if abs(int(exponent or 0)) <= _LARGEST_EXPONENT:
        return float(Fraction(number) * factor)
    mantissa = float(digits)
    return math.copysign(math.inf, mantissa) if mantissa and "-" not in exponent else 0.0


def _at_bound(value: float, spec: NumberSpec) -> float:
    for bound in (spec.minimum, spec.maximum):
        if math.isfinite(bound) and math.isclose(value, bound, rel_tol=_BOUND_TOLERANCE):
            return bound
    return value
