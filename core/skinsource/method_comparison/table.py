"""The table of results: one row for each method on each scene."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from skinsource.errors import FileFormatError
from skinsource.files import write_bytes
from skinsource.limb import AXES
from skinsource.method_comparison.compared_limb import MADE_UP, ComparedLimb, limb_of_size
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
    limb
        What it was measured on.
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
    limb: ComparedLimb = MADE_UP


_INTEGERS = ("inputs_changed", "inputs", "channels", "samples", "runs", "processes")
_TEXTS = ("scene", "engine", "precision", "setting", "reference", "promise", "failure")
_COLUMNS = tuple(field.name for field in fields(Row) if field.name != "limb")
#: Follow where a limb was named; the others are what they are without it.
_LIMB_COLUMNS = (
    "limb",
    "limb_digest",
    "limb_inputs",
    "limb_outputs",
    "limb_axes",
    "limb_taps",
    "limb_rate_hz",
)


def write_table(path: Path, rows: Sequence[Row]) -> None:
    """Write ``rows``, all of one limb, as CSV with a header.

    Raises
    ------
    StorageError
        The file cannot be written.
    """
    text = io.StringIO(newline="")
    named = any(row.limb != MADE_UP for row in rows)
    columns = (*_COLUMNS, *(_LIMB_COLUMNS if named else ()))
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    for row in rows:
        values = {name: getattr(row, name) for name in _COLUMNS}
        values |= _limb_cells(row.limb) if named else {}
        writer.writerow({name: "" if v is None else v for name, v in values.items()})
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
        if tuple(reader.fieldnames or ()) not in (_COLUMNS, (*_COLUMNS, *_LIMB_COLUMNS)):
            raise FileFormatError(
                f"{path}: the columns are {reader.fieldnames}, expected {list(_COLUMNS)}. Write "
                "the table anew with: skinsource bench"
            )
        try:
            return [_row(line) for line in reader]
        except ValueError as error:
            raise FileFormatError(
                f"{path}: line {reader.line_num} cannot be read ({printable(error)}). Write the "
                "table anew with: skinsource bench"
            ) from error


def _row(line: dict[str, str]) -> Row:
    values = {name: _value(name, line[name]) for name in _COLUMNS}
    return Row(**values, limb=_limb(line) if "limb" in line else MADE_UP)


def _limb_cells(limb: ComparedLimb) -> dict[str, str | int | float]:
    sizes = limb.n_inputs, limb.n_outputs, limb.axes, limb.n_taps, limb.sample_rate_hz
    return dict(zip(_LIMB_COLUMNS, (limb.name, limb.digest, *sizes), strict=True))


def _limb(line: dict[str, str]) -> ComparedLimb:
    name, digest, n_inputs, n_outputs, axes, n_taps, rate_hz = (line[one] for one in _LIMB_COLUMNS)
    return limb_of_size(
        name=name,
        digest=digest,
        n_inputs=int(n_inputs),
        n_outputs=int(n_outputs),
        axes=AXES[tuple(map(str, AXES)).index(axes)],
        n_taps=int(n_taps),
        sample_rate_hz=float(rate_hz),
    )


def _value(name: str, cell: str) -> Any:
    if name in _TEXTS:
        return cell
    if name == "stable":
        return cell == "True"
    if cell == "":
        return None
    return int(cell) if name in _INTEGERS else float(cell)
