"""Lists of numbers, and points of several, as a user reads and types them."""

import re
from itertools import pairwise

from skinsource.base.errors import InvalidInputError
from skinsource.specs.fields import ListSpec, NumberSpec, PointsSpec
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.fields.units import display_unit, parse_number

_DIGITS = 12
# Times of points are shown to so many digits behind the point, milliseconds.
_TIME_DECIMALS = 2


def number_of(spec: ListSpec) -> NumberSpec:
    """What each number of a list of numbers may be."""
    if not isinstance(spec.of, NumberSpec):
        raise TypeError(f"{spec.label}: a list of {type(spec.of).__name__}, expected of numbers")
    return spec.of


def numbers_text(values: tuple[float, ...], spec: ListSpec) -> str:
    """Numbers in their display unit, between commas: ``"50, 84.1"``."""
    return ", ".join(_shown(value, number_of(spec)) for value in values)


def read_numbers(text: str, spec: ListSpec) -> tuple[float, ...]:
    """Numbers between commas, semicolons or spaces; where there are semicolons, commas are points.

    Raises
    ------
    InvalidInputError
        One of them is no number that is allowed, or there are too few or too many.
    """
    values = tuple(parse_number(one, number_of(spec)) for one in _parts(text))
    if not spec.fewest <= len(values) <= spec.most:
        raise InvalidInputError(
            f"{spec.label}: {len(values)} typed. Allowed: {spec.fewest} to {spec.most} numbers, "
            "between commas."
        )
    return values


def points_text(points: tuple[tuple[float, ...], ...], spec: PointsSpec) -> str:
    """Points in their display units, between semicolons: ``"0 60 0; 100 60 1"``.

    Times are rounded to 0.01 ms, unless two of them would be the same then; `as_known` takes that
    back.
    """
    if spec.columns[0].unit == "s":
        times_s = [point[0] for point in points]
        rounded = [_rounded(one) for one in times_s]
        if len(set(rounded)) == len(set(times_s)):
            points = tuple((time, *point[1:]) for time, point in zip(rounded, points, strict=True))
    return "; ".join(
        " ".join(_shown(value, one) for value, one in zip(point, spec.columns, strict=True))
        for point in points
    )


def read_points(text: str, spec: PointsSpec) -> tuple[tuple[float, ...], ...]:
    """Points between semicolons, their numbers between spaces or commas.

    Raises
    ------
    InvalidInputError
        One of the numbers is not allowed, a point has too few or too many, there are too few or
        too many points, or they go back.
    """
    names = ", ".join(column_words(one) for one in spec.columns)
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
    points: tuple[tuple[float, ...], ...], known: tuple[tuple[float, ...], ...]
) -> tuple[tuple[float, ...], ...]:
    """Points that were typed, with the exact times of those that were shown rounded."""
    exact = {_rounded(point[0]): point[0] for point in known}
    return tuple((exact.get(point[0], point[0]), *point[1:]) for point in points)


def column_words(spec: NumberSpec) -> str:
    """What a number of a point is, and its unit: ``"time in ms"``."""
    symbol = display_unit(spec.unit).symbol
    return f"{spec.label.lower()} in {symbol}" if symbol else spec.label.lower()


def _parts(text: str) -> list[str]:
    for separator in (";", ","):
        if separator in text:
            return [part for part in text.split(separator) if part.strip()]
    return text.split()


def _rounded(time_s: float) -> float:
    # As it is read back from the text.
    return float(f"{round(1e3 * time_s, _TIME_DECIMALS):.{_DIGITS}g}e-3")


def _shown(value_si: float, spec: NumberSpec) -> str:
    # In one unit throughout: in a list a number alone has to mean the same everywhere.
    return minus(f"{display_unit(spec.unit).shown(value_si):.{_DIGITS}g}")
