"""How a table of numbers is written: separator, decimal comma, headings, units."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from skinsource.recordings import limits
from skinsource.recordings.stated_rate import stated_rate_hz
from skinsource.recordings.units import split_heading, unit_named

#: Separators, the likelier ones first; the last is any run of blanks.
SEPARATORS = ("\t", ";", ",", "|", " ")
COMMENTS = ("#", "%", "//")
MISSING = ("", "nan", "na", "n/a", "null", "none", "-nan")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?|[+-]?inf(inity)?", re.IGNORECASE)
# Rows that have to look alike for the layout to be believed.
_ROWS = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class TextLayout:
    """How the lines of a table are cut.

    Attributes
    ----------
    separator
        Between cells; a blank stands for any run of them.
    decimal
        "." or ",".
    trailing
        Whether each line ends with a separator that separates nothing.
    header_lines
        Lines before the first row of numbers.
    names, units
        Of the columns; units as they are written, empty where there are none.
    rate_hz
        What the lines before the numbers say about the rate.
    notes
        What was a guess.
    """

    separator: str
    decimal: str
    trailing: bool
    header_lines: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    rate_hz: float | None = None
    notes: tuple[str, ...] = ()

    def cells(self, line: str) -> list[str]:
        """The cells of a line, without quotation marks."""
        return split(line, self.separator, self.trailing)


def split(line: str, separator: str, trailing: bool = False) -> list[str]:
    """Cut a line into cells."""
    line = line.strip("\r\n")
    if separator == " ":
        parts = line.split()
    else:
        line = line.rstrip(" ")
        parts = (line.removesuffix(separator) if trailing else line).split(separator)
    return [part.strip().strip('"').strip() for part in parts]


def number(cell: str, decimal: str) -> float | None:
    """The number in a cell, NaN where it says that it has none; None if it is something else."""
    if cell.lower() in MISSING:
        return float("nan")
    plain = cell.replace(",", ".") if decimal == "," else cell
    if not _NUMBER.fullmatch(plain) or (decimal == "," and "." in cell):
        return None
    return float(plain.lower().replace("d", "e"))


def is_comment(line: str) -> bool:
    """Whether a line only explains, or is empty."""
    return not line.strip() or line.lstrip().startswith(COMMENTS)


def layout_of(lines: Sequence[str]) -> TextLayout | None:
    """The layout of a table that begins with ``lines``; None if no row of numbers is found."""
    best: tuple[int, int, str, str, bool] | None = None
    for separator in SEPARATORS:
        for decimal in (".", ","):
            if decimal == separator:
                continue
            found = _rows_of_numbers(lines, separator, decimal)
            if found is None:
                continue
            first, columns, trailing = found
            # Fewer lines before the numbers, then more columns; the likelier separator wins a tie.
            if best is None or (-first, columns) > (-best[0], best[1]):
                best = (first, columns, separator, decimal, trailing)
    return None if best is None else _with_headings(lines, *best)


def _rows_of_numbers(
    lines: Sequence[str], separator: str, decimal: str
) -> tuple[int, int, bool] | None:
    """First row, columns, and whether lines end with a separator."""
    rows = [k for k, line in enumerate(lines) if not is_comment(line)]
    ends = [lines[k].rstrip("\r\n ").endswith(separator) for k in rows[-_ROWS:]]
    trailing = separator != " " and bool(ends) and all(ends)
    columns, first = 0, None
    for k in reversed(rows):
        cells = split(lines[k], separator, trailing)
        values = [number(cell, decimal) for cell in cells]
        numeric = all(value is not None for value in values) and any(
            cell.lower() not in MISSING for cell in cells
        )
        if not numeric or (first is not None and len(cells) != columns):
            break
        first, columns = k, len(cells)
    if first is None or columns > limits.MOST_SERIES:
        return None
    return first, columns, trailing


def _with_headings(
    lines: Sequence[str], first: int, columns: int, separator: str, decimal: str, trailing: bool
) -> TextLayout:
    before = [line for line in lines[:first] if line.strip()]
    headings = [
        cells
        for line in before[-3:]
        if len(cells := split(line.lstrip("#%/ "), separator, trailing)) == columns
        and not all(number(cell, ".") is not None for cell in cells)
    ]
    units: list[str] = [""] * columns
    if len(headings) > 1 and _are_units(headings[-1]):
        units = [cell.strip("[]() ") for cell in headings.pop()]
    names = [f"column {k + 1}" for k in range(columns)]
    if headings:
        for k, cell in enumerate(headings[-1]):
            name, unit = split_heading(cell)
            names[k], units[k] = name or names[k], unit or units[k]
    guess = decimal == "." and separator == "," and columns == 2 and not headings
    whole = guess and all("." not in line for line in lines[first:])
    return TextLayout(
        separator=separator,
        decimal=decimal,
        trailing=trailing,
        header_lines=first,
        names=tuple(names),
        units=tuple(units),
        rate_hz=stated_rate_hz(before, decimal),
        notes=("Commas are taken as separators, not as decimal commas.",) if whole else (),
    )


def _are_units(cells: Sequence[str]) -> bool:
    plain = [cell.strip("[]() ") for cell in cells]
    times = ("s", "ms", "us", "µs", "ns", "sec")
    known = [bool(unit_named(one)) or one.lower() in times for one in plain]
    return any(known) and all(ok or not one for ok, one in zip(known, plain, strict=True))
