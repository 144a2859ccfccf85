"""Numbers as a user reads and types them: in milliseconds, degrees, hertz, and in lists.

Values are in SI units; a `DisplayUnit` says how they are shown.  `stepped` and `Ladder` give round
numbers one step apart.
"""

import math
import re
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import InvalidInputError, sentence
from skinsource.design.amplitudes import ARBITRARY_UNIT
from skinsource.design.display_units import (
    LONG_S,
    DisplayUnit,
    display_unit,
    number_text,
    value_text,
    with_unit,
)
from skinsource.design.labels import span_label
from skinsource.limbs.locations import output_name
from skinsource.specs.numbers import ListSpec, NumberSpec, PointsSpec


def minus(text: str) -> str:
    """Return ``text`` with real minus signs."""
    return text.replace("-", "−")


def level_text(level_db: float, span: str) -> str:
    """Return the text of a level, in dB and as an acceleration, and the span of its RMS."""
    if level_db <= FLOOR_DB:
        return "silent"
    acceleration = 10.0 ** (level_db / 20.0)
    if acceleration >= 0.1:
        amount = f"{acceleration:.3g} m/s²"
    elif acceleration >= 1e-4:
        amount = f"{acceleration * 1e3:.3g} mm/s²"
    else:
        amount = f"{acceleration:.2e} m/s²"
    return minus(f"{level_db:z.1f} dB re 1 m/s²  ({amount} RMS, {span_label(span)})")


def output_text(number: int, limb: str = "") -> str:
    """Return number and location of an output."""
    location = output_name(number, limb)
    if location.name == f"Output {number}":
        return location.name
    name = location.name if location.kind or limb else location.short_name
    return f"Output {number}, {name}"


#: Significant digits of a number that is being edited.
EDITED_DIGITS = 12

# A number and its unit, if any; a unit does not begin with a digit or a sign.
_NUMBER = re.compile(
    r"([+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+-]?\d+)?)\s*(|[^\s\d.,:;'’_+*/^-].*)", re.DOTALL
)
# A bound that was shown in a rounded form can be typed.
_BOUND_TOLERANCE = 1e-12
# Larger exponents are not needed, and as fractions they would take for ever.
_LARGEST_EXPONENT = 400


# Units of amplitudes, and levels of them.
_AMPLITUDES = ("m/s²", "V", "×", ARBITRARY_UNIT)
_LEVEL = NumberSpec(label="", unit="dB", minimum=-400.0, maximum=400.0)


def axis_unit(until_s: float) -> tuple[str, float]:
    """Return the unit of a time axis that ends at ``until_s``, and how many of it are a second."""
    return ("s", 1.0) if until_s >= LONG_S * (1 - 1e-9) else ("ms", 1e3)


def range_text(spec: NumberSpec) -> str:
    """Return the text of the allowed range of a number: ``"1 to 649 Hz"``."""
    kind = "whole number" if spec.whole else "number"
    low, high = math.isfinite(spec.minimum), math.isfinite(spec.maximum)
    if low and high:
        units = [display_unit(spec.unit, end).symbol for end in (spec.minimum, spec.maximum)]
        one_unit = units[0] == units[1] or spec.minimum == 0
        lowest = (number_text if one_unit else value_text)(spec.minimum, spec.unit)
        return minus(f"{lowest} to {value_text(spec.maximum, spec.unit)}")
    if low:
        return minus(f"{value_text(spec.minimum, spec.unit)} or more")
    if high:
        return minus(f"{value_text(spec.maximum, spec.unit)} or less")
    return f"any {kind}"


def parse_number(text: str, spec: NumberSpec, replaced_si: float = 0.0) -> float:
    """Return the value in SI units of a typed text: ``"250"``, ``"0,2 s"``, ``"200 ms"``.

    A number without a unit is in the display unit of ``replaced_si``, the value that it replaces.

    Raises
    ------
    InvalidInputError
        The text is not a number, has a wrong unit, or is not allowed by ``spec``; the message names
        what is allowed.
    """
    unit = display_unit(spec.unit, replaced_si)
    allowed = sentence(f"Allowed: {'whole numbers ' if spec.whole else ''}{range_text(spec)}")
    typed = text.strip().replace("−", "-")
    if not typed:
        raise InvalidInputError(f"{spec.label}: nothing typed. {allowed}")
    match = _NUMBER.fullmatch(typed)
    if match is None:
        raise InvalidInputError(f"{spec.label}: “{typed}” is not a number. {allowed}")
    factor = _factor(match[2], unit)
    if factor is None:
        symbols = ", ".join(name for name in (unit.symbol, *unit.spellings) if name)
        instead = sentence(f"Units: {symbols}") if symbols else "Type the number alone."
        raise InvalidInputError(f"{spec.label}: “{match[2]}” is not one of its units. {instead}")
    try:
        value = _at_bound(_parsed(match[1].replace(",", "."), factor), spec)
    except (OverflowError, ValueError):  # beyond all floats; more digits than Python reads
        raise InvalidInputError(f"{spec.label}: the number is too long. {allowed}") from None
    if math.isinf(value) or not spec.minimum <= value <= spec.maximum:
        side = "low" if value < spec.minimum else "high"
        written = minus(with_unit(match[1], unit) if not match[2] else typed)
        raise InvalidInputError(f"{spec.label}: {written} is too {side}. {allowed}")
    if spec.whole and value != int(value):
        raise InvalidInputError(f"{spec.label}: {typed} is not a whole number. {allowed}")
    return value


def has_level(spec: NumberSpec) -> bool:
    """Whether a number is an amplitude or a gain, which can be typed in dB of 1."""
    return spec.unit in _AMPLITUDES or (not spec.unit and "gain" in spec.label.casefold())


def parse_level(text: str, spec: NumberSpec, replaced_si: float) -> float:
    """Return the value of a typed text as `parse_number` does, and of a level: ``"-6 dB"``.

    A level leaves the polarity of the value that it replaces.
    """
    if has_level(spec) and text.rstrip().casefold().endswith("db"):
        level_db = parse_number(text, replace(_LEVEL, label=spec.label))
        text = repr(math.copysign(10.0 ** (level_db / 20.0), replaced_si))
    return parse_number(text, spec, replaced_si)


def _factor(name: str, unit: DisplayUnit) -> Fraction | None:
    spellings = {"": unit.si, unit.symbol.casefold(): unit.si}
    spellings |= {spelling.casefold(): si for spelling, si in unit.spellings.items()}
    return spellings.get(name.strip().casefold())


def _parsed(number: str, factor: Fraction) -> float:
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


#: Sizes of a step, in plain steps.
FINE, PLAIN, COARSE = Fraction(1, 10), Fraction(1), Fraction(10)

# A value this near to a round number, in steps, counts as that number.
_TOLERANCE = 1e-9


def clamped(value_si: float, spec: NumberSpec) -> float:
    """Return the allowed value nearest to ``value_si``."""
    return float(min(max(value_si, spec.minimum), spec.maximum))


def stepped(value_si: float, direction: int, spec: NumberSpec, size: Fraction = PLAIN) -> float:
    """Return the next round number above or below, within the allowed range.

    Round numbers are multiples of a step, which is 1, 2 or 5 times a power of ten in the display
    unit: the one nearest to ``spec.step``, or with ``spec.logarithmic`` to ``spec.step`` times the
    value.  From 150 Hz steps of about 2 % go to 152, 154, …, 160, 165, 170.

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
    position = value_si / float(unit.si * step)
    nearest = round(position)
    if abs(position - nearest) < _TOLERANCE * max(1, abs(nearest)):
        target = nearest + direction
    else:
        target = math.ceil(position) if direction > 0 else math.floor(position)
    return clamped(unit.value_si(target * step), spec)


class Ladder:
    """Values on both sides of an anchor, each one step from the next.

    The anchor itself need not be round; stepping back leads to it.

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
        """Return the value ``position`` steps above (or, negative, below) the anchor."""
        direction = 1 if position >= 0 else -1
        values = self._values[direction]
        while len(values) <= abs(position):
            values.append(stepped(values[-1], direction, self._spec, self.size))
        return values[abs(position)]


def _step_shown(value_si: float, spec: NumberSpec, unit: DisplayUnit) -> Fraction:
    """Return the plain step at a value, in the display unit: 1, 2 or 5 times a power of ten."""
    size_si = spec.step * value_si if spec.logarithmic and value_si > 0 else spec.step
    exact = size_si / float(unit.si)
    power = math.floor(math.log10(exact))
    digits = exact / 10.0**power
    return (
        min((1, 2, 5, 10), key=lambda digit: abs(math.log(digits / digit))) * Fraction(10) ** power
    )


_DIGITS = 12
# Times of points are shown in milliseconds with so many decimals.
_TIME_DECIMALS = 2


def number_of(spec: ListSpec) -> NumberSpec:
    """Return the specification of each number of a list."""
    if not isinstance(spec.of, NumberSpec):
        raise TypeError(f"{spec.label}: a list of {type(spec.of).__name__}, expected of numbers")
    return spec.of


def numbers_text(values: tuple[float, ...], spec: ListSpec) -> str:
    """Return numbers in their display unit, between commas: ``"50, 84.1"``."""
    return ", ".join(_shown(value, number_of(spec)) for value in values)


def read_numbers(text: str, spec: ListSpec) -> tuple[float, ...]:
    """Return numbers typed between commas, semicolons or spaces.

    Where there are semicolons, commas are decimal points.

    Raises
    ------
    InvalidInputError
        A number is not allowed, or there are too few or too many.
    """
    values = tuple(parse_number(part, number_of(spec)) for part in _parts(text))
    if not spec.fewest <= len(values) <= spec.most:
        raise InvalidInputError(
            f"{spec.label}: {len(values)} typed. Allowed: {spec.fewest} to {spec.most} numbers, "
            "between commas."
        )
    return values


def points_text(points: tuple[tuple[float, ...], ...], spec: PointsSpec) -> str:
    """Return points in their display units, between semicolons: ``"0 60 0; 100 60 1"``.

    Times are rounded to 0.01 ms, unless two of them would become equal; `as_known` restores them.
    """
    if spec.columns[0].unit == "s":
        times_s = [point[0] for point in points]
        rounded = [_rounded(time_s) for time_s in times_s]
        if len(set(rounded)) == len(set(times_s)):
            points = tuple((time, *point[1:]) for time, point in zip(rounded, points, strict=True))
    return "; ".join(
        " ".join(_shown(value, column) for value, column in zip(point, spec.columns, strict=True))
        for point in points
    )


def read_points(text: str, spec: PointsSpec) -> tuple[tuple[float, ...], ...]:
    """Return points typed between semicolons, with spaces or commas between their numbers.

    Raises
    ------
    InvalidInputError
        A number is not allowed, a point has too few or too many numbers, there are too few or too
        many points, or times decrease.
    """
    names = ", ".join(column_label(column) for column in spec.columns)
    points = []
    for row in filter(str.strip, text.split(";")):
        parts = list(filter(None, re.split(r"[,\s]+", row.strip())))
        if len(parts) != len(spec.columns):
            raise InvalidInputError(
                f"{spec.label}: “{row.strip()}” has {len(parts)} numbers. Each point has "
                f"{len(spec.columns)}: {names}."
            )
        points.append(tuple(map(parse_number, parts, spec.columns)))
    if not spec.fewest <= len(points) <= spec.most:
        raise InvalidInputError(
            f"{spec.label}: {len(points)} typed. Allowed: {spec.fewest} to {spec.most} points, "
            "between semicolons."
        )
    for before, after in pairwise(points):
        if after[0] < before[0]:
            first = spec.columns[0]
            raise InvalidInputError(
                f"{spec.label}: {_shown(after[0], first)} comes after {_shown(before[0], first)}. "
                f"Put the points in the order of their {first.label.lower()}."
            )
    return tuple(points)


def as_known(
    points: tuple[tuple[float, ...], ...], before: tuple[tuple[float, ...], ...]
) -> tuple[tuple[float, ...], ...]:
    """Return typed points, with the exact times of points ``before`` that were shown rounded."""
    exact = {_rounded(point[0]): point[0] for point in before}
    return tuple((exact.get(point[0], point[0]), *point[1:]) for point in points)


def column_label(spec: NumberSpec) -> str:
    """Return label and unit of a number of a point: ``"time in ms"``."""
    symbol = display_unit(spec.unit).symbol
    return f"{spec.label.lower()} in {symbol}" if symbol else spec.label.lower()


def _parts(text: str) -> list[str]:
    for separator in (";", ","):
        if separator in text:
            return [part for part in text.split(separator) if part.strip()]
    return text.split()


def _rounded(time_s: float) -> float:
    # The time as it is read back from the text.
    return float(f"{round(1e3 * time_s, _TIME_DECIMALS):.{_DIGITS}g}e-3")


def _shown(value_si: float, spec: NumberSpec) -> str:
    # In one unit for any value: in a list, numbers have no units.
    return minus(f"{display_unit(spec.unit).shown(value_si):.{_DIGITS}g}")
