"""Places from CSV, and outlines from CSV or SVG; for the child process."""

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.files import read_bytes
from skinsource.limb_import.refusing import refusal
from skinsource.limb_import.svg_path import outline_of
from skinsource.quoting import quoted

_MOST_BYTES, _MOST_ROWS = 8 * 2**20, 20_001
_MISSING = ("", "nan", "-", "none")


def points_of(path: Path) -> dict[str, Any]:
    """Points of a file as JSON carries them: ``points``, rows of x and y or None, and ``names``.

    A CSV file has a point a row: x, y and, if wanted, a name; with a header its columns are found
    by the names ``x``, ``y`` and ``name``.  Of an SVG file the largest closed line is taken.
    ``y_down`` says whether y points down, as in SVG.
    """
    content = read_bytes(path, most=_MOST_BYTES)
    if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        try:
            line = outline_of(content)
        except ValueError as error:
            raise refusal(path, str(error), "an SVG file with a path") from error
        if len(line) > _MOST_ROWS or not np.isfinite(line).all():
            raise refusal(path, f"its line has {len(line)} points", f"at most {_MOST_ROWS}")
        return {"points": line.tolist(), "names": [], "y_down": True}
    rows = _rows(path, content)
    points, names = [], []
    x, y, name, rows = _columns(rows)
    for number, row in enumerate(rows, start=1):
        points.append(_point(path, row, x, y, number))
        names.append(row[name].strip() if name is not None and name < len(row) else "")
    return {"points": points, "names": names if any(names) else [], "y_down": False}


def _rows(path: Path, content: bytes) -> list[list[str]]:
    text = content.decode("utf-8-sig", "replace")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    first = lines[0] if lines else ""
    delimiter = max(",;\t ", key=first.count) if first else ","
    skip = delimiter == " "
    read = csv.reader(io.StringIO("\n".join(lines)), delimiter=delimiter, skipinitialspace=skip)
    try:
        found = [row for row in read if row]
    except csv.Error as error:
        raise refusal(path, f"it is no table ({error})", "rows of x and y") from error
    if not 1 <= len(found) <= _MOST_ROWS:
        raise refusal(path, f"it has {len(found)} rows", f"1 to {_MOST_ROWS} rows of x and y")
    return found


def _columns(rows: list[list[str]]) -> tuple[int, int, int | None, list[list[str]]]:
    header = [one.strip().lower() for one in rows[0]]
    if "x" in header and "y" in header:
        name = header.index("name") if "name" in header else None
        return header.index("x"), header.index("y"), name, rows[1:]
    return 0, 1, 2, rows


def _point(path: Path, row: list[str], x: int, y: int, number: int) -> list[float] | None:
    cells = [row[k].strip() if k < len(row) else "" for k in (x, y)]
    if all(one.lower() in _MISSING for one in cells):
        return None
    try:
        found = [float(one) for one in cells]
    except ValueError as error:
        raise refusal(
            path, f"row {number} has {quoted(','.join(cells))}", "two numbers, x and y"
        ) from error
    if not np.isfinite(found).all():
        raise refusal(path, f"row {number} has {quoted(','.join(cells))}", "two finite numbers")
    return found
