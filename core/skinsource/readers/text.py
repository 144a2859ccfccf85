"""Tables of numbers in text, such as CSV: their layout, and their columns as signals.

The separator, the decimal mark, headings and units are recognised; a table is read line by line.
"""

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.errors import counted, printable, quoted
from skinsource.readers import limits
from skinsource.readers.reader import Block, Found, Series, reading_error, unknown_series_error
from skinsource.readers.timestamps import stated_rate_hz
from skinsource.readers.units import split_heading, time_unit_s, unit_named

# The likelier separators come first; the last one is any run of blanks.
_SEPARATORS = ("\t", ";", ",", "|", " ")
_COMMENTS = ("#", "%", "//")
_MISSING = ("", "nan", "na", "n/a", "null", "none", "-nan")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?|[+-]?inf(inity)?", re.IGNORECASE)
# Last rows that must end with a separator for it to separate nothing.
_ROWS = 40
_HEAD_BYTES = 2**16
_LONGEST_LINE = 2**20
_ADVICE = "Save it as text with one row of numbers for each sample."


@dataclass(frozen=True, slots=True, kw_only=True)
class TextLayout:
    """How the lines of a table are cut.

    Attributes
    ----------
    separator
        Separator of cells; a blank means any run of blanks.
    decimal
        Decimal mark, "." or ",".
    trailing
        Whether each line ends with a separator that separates nothing.
    header_lines
        Lines before the first row of numbers.
    names, units
        Of the columns; units as in the file, empty where there are none.
    rate_hz
        Sample rate that the lines before the numbers state.
    notes
        Sentences on what was guessed.
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
        """Return the cells of a line, without quotation marks."""
        return _split(line, self.separator, self.trailing)


def _split(line: str, separator: str, trailing: bool = False) -> list[str]:
    """Cut a line into cells."""
    line = line.strip("\r\n")
    if separator == " ":
        parts = line.split()
    else:
        line = line.rstrip(" ")
        parts = (line.removesuffix(separator) if trailing else line).split(separator)
    return [part.strip().strip('"').strip() for part in parts]


def _number(cell: str, decimal: str) -> float | None:
    """Return the number in a cell, NaN for a missing one; None if the cell holds no number."""
    if cell.lower() in _MISSING:
        return float("nan")
    plain = cell.replace(",", ".") if decimal == "," else cell
    if not _NUMBER.fullmatch(plain) or (decimal == "," and "." in cell):
        return None
    return float(plain.lower().replace("d", "e"))


def _is_comment(line: str) -> bool:
    """Whether a line is a comment or empty."""
    return not line.strip() or line.lstrip().startswith(_COMMENTS)


def layout_of(lines: Sequence[str]) -> TextLayout | None:
    """Return the layout of a table that begins with ``lines``; None if it has no row of numbers."""
    best: tuple[int, int, str, str, bool] | None = None
    for separator in _SEPARATORS:
        for decimal in (".", ","):
            if decimal == separator:
                continue
            layout = _rows_of_numbers(lines, separator, decimal)
            if layout is None:
                continue
            first, columns, trailing = layout
            # Fewer lines before the numbers, then more columns; the likelier separator wins a tie.
            if best is None or (-first, columns) > (-best[0], best[1]):
                best = (first, columns, separator, decimal, trailing)
    return None if best is None else _with_headings(lines, *best)


def _rows_of_numbers(
    lines: Sequence[str], separator: str, decimal: str
) -> tuple[int, int, bool] | None:
    """Return the first row, the columns, and whether lines end with a separator; None: no rows."""
    rows = [k for k, line in enumerate(lines) if not _is_comment(line)]
    ends = [lines[k].rstrip("\r\n ").endswith(separator) for k in rows[-_ROWS:]]
    trailing = separator != " " and bool(ends) and all(ends)
    columns, first, has_number = 0, None, False
    for k in reversed(rows):
        cells = _split(lines[k], separator, trailing)
        values = [_number(cell, decimal) for cell in cells]
        numeric = all(value is not None for value in values)
        if not numeric or (first is not None and len(cells) != columns):
            break
        has_number = has_number or any(cell.lower() not in _MISSING for cell in cells)
        first, columns = k, len(cells)
    if first is None or not has_number or columns > limits.MOST_SERIES:
        return None
    return first, columns, trailing


def _with_headings(
    lines: Sequence[str], first: int, columns: int, separator: str, decimal: str, trailing: bool
) -> TextLayout:
    before = [line for line in lines[:first] if line.strip()]
    headings = [
        cells
        for line in before[-3:]
        if len(cells := _split(line.lstrip("#%/ "), separator, trailing)) == columns
        and not all(_number(cell, ".") is not None for cell in cells)
    ]
    units: list[str] = [""] * columns
    if len(headings) > 1 and _are_units(headings[-1]):
        units = [cell.strip("[]() ") for cell in headings.pop()]
    names = [f"column {k + 1}" for k in range(columns)]
    if headings:
        for k, cell in enumerate(headings[-1]):
            name, unit = split_heading(cell)
            names[k], units[k] = name or names[k], unit or units[k]
    is_guess = decimal == "." and separator == "," and columns == 2 and not headings
    is_guess = is_guess and all("." not in line for line in lines[first:])
    return TextLayout(
        separator=separator,
        decimal=decimal,
        trailing=trailing,
        header_lines=first,
        names=tuple(names),
        units=tuple(units),
        rate_hz=stated_rate_hz(before, decimal),
        notes=("Commas are taken as separators, not as decimal commas.",) if is_guess else (),
    )


def _are_units(cells: Sequence[str]) -> bool:
    plain = [cell.strip("[]() ") for cell in cells]
    times = ("s", "ms", "us", "µs", "ns", "sec")
    known = [bool(unit_named(cell)) or cell.lower() in times for cell in plain]
    return any(known) and all(ok or not cell for ok, cell in zip(known, plain, strict=True))


def look(path: Path) -> Found:
    """Return the columns of a table."""
    with _opened(path) as (file, layout):
        rows, cut_off = _count(path, file, layout)
    if not rows:
        raise reading_error(path, "no row of numbers", "at least one", _ADVICE)
    names = [printable(name) for name in layout.names]
    times = [time_unit_s(*pair) for pair in zip(layout.names, layout.units, strict=True)]
    series = tuple(
        Series(
            key=str(k),
            name=name,
            n_samples=rows,
            dtype="text",
            shape=(rows, len(names)),
            unit=unit_named(layout.units[k]),
            is_time=times[k] is not None,
            time_unit_s=times[k] or 1.0,
        )
        for k, name in enumerate(names)
    )
    left_out = ("Left out: the last line, which is cut off.",) if cut_off else ()
    return Found(
        format="text",
        series=series,
        rate_hz=layout.rate_hz,
        rate_from="the lines before the numbers" if layout.rate_hz else "",
        notes=(*layout.notes, *left_out),
    )


def blocks(path: Path, keys: Sequence[str], start: int, stop: int) -> Iterator[Block]:
    """Give some columns; missing numbers are NaN."""
    with _opened(path) as (file, layout):
        columns = len(layout.names)
        for key in keys:
            if not (key.isdecimal() and int(key) < columns):
                raise unknown_series_error(path, key)
        chosen = [int(key) for key in keys]
        at_once = max(limits.BLOCK // columns, 1)
        lines: list[str] = []
        first_line = 0
        for row, (line_number, line) in enumerate(_rows(path, file, layout)):
            if row >= stop:
                break
            if row < start:
                if row % limits.BLOCK == 0:
                    yield np.empty((len(chosen), 0))  # tells the parent that the process is alive
                continue
            first_line = first_line if lines else line_number
            lines.append(line)
            if len(lines) == at_once:
                yield _parsed(path, lines, first_line, layout)[chosen]
                lines = []
        if lines:
            yield _parsed(path, lines, first_line, layout)[chosen]


@contextmanager
def _opened(path: Path) -> Iterator[tuple[TextIO, TextLayout]]:
    """Open a table, and skip the lines before its numbers."""
    size = path.stat().st_size
    if size > limits.MOST_TEXT_BYTES:
        raise reading_error(
            path,
            f"{size} bytes of text",
            f"at most {limits.MOST_TEXT_BYTES}",
            "Save it as WAV, NPY or HDF5.",
        )
    with path.open("rb") as raw:
        head = raw.read(_HEAD_BYTES)
    encoding = _encoding(head)
    is_whole = len(head) == size
    text = head.decode(encoding, "replace")
    # ``splitlines`` would end lines at more characters than reading a file does.
    lines = list(io.StringIO(text, newline=None))
    if "\0" in text:
        raise reading_error(path, "it is not text", "a table of numbers", "Choose another file.")
    layout = layout_of(
        lines if is_whole and len(lines) < 2 else lines[: -1 if len(lines) > 1 else 1]
    )
    if layout is None:
        raise reading_error(path, "no rows of numbers were found", "a table of numbers", _ADVICE)
    with path.open(encoding=encoding, errors="replace") as file:
        for _ in range(layout.header_lines):
            _line(path, file)
        yield file, layout


def _encoding(head: bytes) -> str:
    if head.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "utf-16"
    try:
        head[:-4].decode("utf-8")
    except UnicodeDecodeError:
        return "cp1252" if b"\x81" not in head else "latin-1"
    return "utf-8-sig"


def _line(path: Path, file: TextIO) -> str:
    line = file.readline(_LONGEST_LINE)
    if len(line) >= _LONGEST_LINE:
        raise reading_error(
            path, f"a line of more than {_LONGEST_LINE} characters", "a row of numbers", _ADVICE
        )
    return line


def _rows(path: Path, file: TextIO, layout: TextLayout) -> Iterator[tuple[int, str]]:
    """Give each row and the number of its line."""
    line_number = layout.header_lines
    while line := _line(path, file):
        line_number += 1
        if not _is_comment(line):
            yield line_number, line


def _count(path: Path, file: TextIO, layout: TextLayout) -> tuple[int, bool]:
    """Return the number of rows, and whether a last one is cut off and not counted."""
    rows, last = 0, ""
    for _, line in _rows(path, file, layout):
        rows, last = rows + 1, line
    cells = layout.cells(last)
    is_whole = len(cells) == len(layout.names) and all(
        _number(cell, layout.decimal) is not None for cell in cells
    )
    cut_off = rows > 1 and not last.endswith("\n") and not is_whole
    return rows - cut_off, cut_off


def _parsed(path: Path, lines: list[str], first_line: int, layout: TextLayout) -> Floats:
    """Return the numbers of some rows, (n_columns, n_rows)."""
    columns = len(layout.names)
    if not layout.trailing:
        text = (line.replace(",", ".") for line in lines) if layout.decimal == "," else lines
        separator = None if layout.separator == " " else layout.separator
        try:
            table = np.loadtxt(text, delimiter=separator, ndmin=2, comments=None)
        except ValueError:
            pass  # cells that are empty, quoted or wrong are read one by one below
        else:
            if table.shape == (len(lines), columns):
                return table.T
    rows = np.empty((columns, len(lines)))
    for k, line in enumerate(lines):
        cells = layout.cells(line)
        values = [_number(cell, layout.decimal) for cell in cells]
        if len(cells) != columns or None in values:
            wrong = [cell for cell, value in zip(cells, values, strict=True) if value is None]
            content = quoted(wrong[0]) if wrong else counted(len(cells), "cell")
            raise reading_error(
                path,
                f"about line {first_line + k} holds {content}",
                f"{columns} numbers",
                "Mend or remove the line.",
            )
        rows[:, k] = values
    return rows
