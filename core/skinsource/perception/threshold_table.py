"""Thresholds that a user has measured or looked up, as a table."""

import math
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array
from skinsource.arrays import Floats
from skinsource.errors import FileFormatError
from skinsource.files.reading import read_bytes
from skinsource.quoting import quoted

#: Pairs of hertz and m/s² RMS, rising in frequency.
ThresholdTable = tuple[tuple[float, float], ...]
_MOST_BYTES, _MOST_ROWS = 100_000, 1000
_HEADS = "frequency_hz,threshold_m_per_s2 or frequency_hz,threshold_db_re_1e-6_m_per_s2"


def read_threshold_table(path: Path) -> ThresholdTable:
    """Return the table of a CSV file.

    Its header names two columns: ``frequency_hz`` and either ``threshold_m_per_s2`` (RMS) or
    ``threshold_db_re_1e-6_m_per_s2``.  Lines that begin with # say something.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It is no such table; the message says in which line.
    """
    text = read_bytes(path, most=_MOST_BYTES).decode("utf-8-sig", errors="replace")
    lines = [
        (number, line.strip())
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.startswith("#")
    ]
    if not lines:
        raise FileFormatError(f"{quoted(path.name)} is empty, expected {_HEADS}")
    head = lines[0][1].replace(" ", "").lower()
    in_db = head == "frequency_hz,threshold_db_re_1e-6_m_per_s2"
    if not in_db and head != "frequency_hz,threshold_m_per_s2":
        raise FileFormatError(
            f"{quoted(path.name)}, line {lines[0][0]}: found {quoted(lines[0][1])}, expected the "
            f"header {_HEADS}"
        )
    rows = [_row(path.name, number, line, in_db=in_db) for number, line in lines[1:]]
    if not 1 < len(rows) <= _MOST_ROWS:
        raise FileFormatError(
            f"{quoted(path.name)} has {len(rows)} rows, expected 2 to {_MOST_ROWS}"
        )
    found = tuple(sorted(rows))
    if len({frequency for frequency, _ in found}) < len(found):
        raise FileFormatError(f"{quoted(path.name)} has two rows for one frequency")
    return found


def table_threshold(table: ThresholdTable, frequency_hz: ArrayLike) -> Floats:
    """Return thresholds at frequencies, m/s² RMS; infinite outside of the table.

    Between rows straight in the logarithms of both.
    """
    frequency = finite_array("frequency_hz", frequency_hz)
    known_hz, known = np.array(table).T
    inside = (frequency >= known_hz[0]) & (frequency <= known_hz[-1])
    at = np.log(np.where(inside, frequency, known_hz[0]))
    found: Floats = np.where(inside, np.exp(np.interp(at, np.log(known_hz), np.log(known))), np.inf)
    return found


def _row(name: str, number: int, line: str, *, in_db: bool) -> tuple[float, float]:
    try:
        frequency, value = (float(part) for part in line.split(","))
        threshold = 1e-6 * 10.0 ** (value / 20.0) if in_db else value
    except (ValueError, OverflowError):
        frequency, threshold = math.nan, math.nan
    if not (0.0 < frequency < 1e6 and 0.0 < threshold < 1e12):
        raise FileFormatError(
            f"{quoted(name)}, line {number}: found {quoted(line)}, expected a frequency in Hz and "
            "a threshold, both positive"
        )
    return frequency, threshold
