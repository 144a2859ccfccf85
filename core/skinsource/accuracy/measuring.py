"""Measures ways on cases: how far each is from the exact values, and how long it takes."""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from time import perf_counter

import numpy as np

from skinsource.accuracy.cases import Case
from skinsource.accuracy.ways import WAYS, Way
from skinsource.arrays import Floats
from skinsource.job import Progress, Stop, never, silent, stop_if

#: What the numbers of a row say.
MEANING = (
    "An error is the largest difference to the exact values of a case over the largest of them. It "
    "says how exactly numbers are computed, not how well responses describe another hand. A time "
    "is that of the fastest run."
)
#: Headings of `cells_of`.
COLUMNS = ("Case", "Way", "Error", "Time (ms)")
#: Runs of one way on one case: as many, unless all together take longer.
REPEATS, QUICK_REPEATS = 20, 5
_LONGEST_S = 1.0
_SMALLEST = 5e-324
_LONG_MS = 100.0
_STOPPED = "Measuring was stopped."


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One way on one case.

    Attributes
    ----------
    case, way
        Their names.
    error
        Largest difference to an exact value over the largest exact value of its row, the worst of
        all rows; infinite where the way gives what is no number.
    time_s
        Of the fastest run.
    runs
        How many there were.
    """

    case: str
    way: str
    error: float
    time_s: float
    runs: int


def measure(
    cases: Sequence[Case],
    ways: Sequence[Way] = WAYS,
    repeats: int = REPEATS,
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> Iterator[Row]:
    """Give a row for each way and each case that it computes, once it is measured.

    Parameters
    ----------
    repeats
        How often each is run at most.
    progress, stop
        Told before each row, and asked before each run.

    Raises
    ------
    Stopped
        ``stop`` said so.
    """
    pairs = [(case, way) for case in cases for way in ways if way.computes(case)]
    for k, (case, way) in enumerate(pairs):
        stop_if(stop, _STOPPED)
        progress(k, len(pairs), f"{case.name}: {way.name}")
        yield _measured(case, way, repeats, stop)


# Overflow, and what comes of it, is an error of a row, not a warning.
@np.errstate(all="ignore")
def _measured(case: Case, way: Way, repeats: int, stop: Stop) -> Row:
    run = way.prepare(case.problem)
    # Not timed: what it has to read and to import, no other has.
    error = error_of(run()[:, case.samples], case.reference)
    seconds: list[float] = []
    while not seconds or (len(seconds) < repeats and sum(seconds) < _LONGEST_S):
        stop_if(stop, _STOPPED)
        start_s = perf_counter()
        run()
        seconds.append(perf_counter() - start_s)
    return Row(case=case.name, way=way.name, error=error, time_s=min(seconds), runs=len(seconds))


def error_of(values: Floats, reference: Floats) -> float:
    """As `Row.error`, of values and reference, (n_rows, n_samples)."""
    peaks = np.maximum(np.abs(reference).max(axis=1), _SMALLEST)
    error = float((np.abs(values - reference).max(axis=1) / peaks).max())
    return math.inf if math.isnan(error) else error


def best_of(rows: Sequence[Row]) -> list[Row]:
    """Rows, of one case, that no other beats in error and time; the fastest first."""
    best: list[Row] = []
    for row in sorted(rows, key=lambda row: (row.time_s, row.error)):
        if not best or row.error < best[-1].error:
            best.append(row)
    return best


def cells_of(row: Row) -> tuple[str, ...]:
    """A row in words, by `COLUMNS`."""
    time_ms = 1e3 * row.time_s
    time = f"{time_ms:.0f}" if time_ms >= _LONG_MS else f"{time_ms:.3g}"
    return row.case, row.way, f"{row.error:.1e}", time


def table_text(rows: Sequence[Row]) -> str:
    """The rows as a table of Markdown, in columns."""
    columns = list(zip(COLUMNS, ("---", "---", "---:", "---:"), *map(cells_of, rows), strict=True))
    for k, put in enumerate((str.ljust, str.ljust, str.rjust, str.rjust)):
        columns[k] = tuple(put(cell, max(map(len, columns[k]))) for cell in columns[k])
    return "".join(f"| {' | '.join(line)} |\n" for line in zip(*columns, strict=True))


def table_csv(rows: Sequence[Row]) -> str:
    """The rows as CSV with a header; numbers are whole, not rounded."""
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, [field.name for field in fields(Row)], lineterminator="\n")
    writer.writeheader()
    writer.writerows(asdict(row) for row in rows)
    return text.getvalue()
