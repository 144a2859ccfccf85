"""The table of results: one row for each method on each scene."""

import csv
import io
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

from skinsource.errors import FileFormatError
from skinsource.files import write_bytes
from skinsource.quoting import printable


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """What was measured; numbers are None where a method failed.

    Attributes
    ----------
    scene, engine, precision, setting
        Names.
    inputs_changed, inputs
        Inputs that change between two runs, and all.
    channels, samples
        Channels that come out, and samples of each.
    t_min_ms, t_median_ms, t_mad_ms, t_p95_ms
        Statistics of the run times of all processes.
    t_first_ms
        Shortest time of preparation and first run.
    runs, processes
        How many.
    peak_mb
        Memory above idle.
    err_max, err_l2, err_window, err_silence
        See `skinsource.method_comparison.accuracy.Errors`.
    ratio
        See `skinsource.method_comparison.accuracy.rounding_ratio`.
    reference
        Key of the exact values.
    promise
        ``"kept"``, ``"broken: …"``, or ``"none"`` where nothing was promised.
    stable
        Whether the times are.
    failure
        Why there are no numbers; empty where there are.
    """

    scene: str
    engine: str
    precision: str
    setting: str
    inputs_changed: int
    inputs: int
    channels: int | None = None
    samples: int
    t_min_ms: float | None = None
    t_median_ms: float | None = None
    t_mad_ms: float | None = None
    t_p95_ms: float | None = None
    t_first_ms: float | None = None
    runs: int = 0
    processes: int = 0
    peak_mb: float | None = None
    err_max: float | None = None
    err_l2: float | None = None
    err_window: float | None = None
    err_silence: float | None = None
    ratio: float | None = None
    reference: str
    promise: str = "none"
    stable: bool = True
    failure: str = ""


_INTEGERS = ("inputs_changed", "inputs", "channels", "samples", "runs", "processes")
_TEXTS = ("scene", "engine", "precision", "setting", "reference", "promise", "failure")
_COLUMNS = tuple(field.name for field in fields(Row))


def write_table(path: Path, rows: Sequence[Row]) -> None:
    """Write ``rows`` as CSV with a header.

    Raises
    ------
    StorageError
        The file cannot be written.
    """
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, _COLUMNS, lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({name: "" if v is None else v for name, v in asdict(row).items()})
    write_bytes(path, text.getvalue().encode())


def read_table(path: Path) -> list[Row]:
    """Read what `write_table` wrote; numbers come back as they were.

    Raises
    ------
    FileFormatError
        It is no such table.
    """
    with path.open(encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        if tuple(reader.fieldnames or ()) != _COLUMNS:
            raise FileFormatError(
                f"{path}: the columns are {reader.fieldnames}, expected {list(_COLUMNS)}. Write "
                "the table anew with: skinsource bench"
            )
        try:
            return [
                Row(**{name: _value(name, cell) for name, cell in line.items()}) for line in reader
            ]
        except ValueError as error:
            raise FileFormatError(
                f"{path}: line {reader.line_num} cannot be read ({printable(error)}). Write the "
                "table anew with: skinsource bench"
            ) from error


def _value(name: str, cell: str) -> Any:
    if name in _TEXTS:
        return cell
    if name == "stable":
        return cell == "True"
    if cell == "":
        return None
    return int(cell) if name in _INTEGERS else float(cell)
