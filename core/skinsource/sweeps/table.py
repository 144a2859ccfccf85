"""What a sweep found: one row of metrics for each stimulus."""

import csv
import io
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.extras import package_of_extra
from skinsource.files import replacing, write_bytes
from skinsource.quoting import quoted
from skinsource.sweeps.measuring import Metrics, columns_of
from skinsource.sweeps.plan import Plan

Cell = bool | int | float | str
#: Name of the column that says why a stimulus has no metrics.
ERROR = "error"


@dataclass(frozen=True, slots=True, eq=False)
class SweepTable:
    """One row for each stimulus, in their order.

    Attributes
    ----------
    columns
        ``"stimulus"`` (a number from 1), the variables, the metrics and ``"error"``.
    rows
        As many values each.  Where a stimulus could not be measured its metrics are NaN and the
        error says why; else that is empty.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]

    def __len__(self) -> int:
        return len(self.rows)

    def column(self, name: str) -> Floats | np.ndarray:
        """Values of one column, (n_stimuli,).

        Raises
        ------
        InvalidInputError
            There is no such column.
        """
        if name not in self.columns:
            raise InvalidInputError(
                f"there is no column {quoted(name)}; choose from {', '.join(self.columns)}"
            )
        which = self.columns.index(name)
        return np.array([row[which] for row in self.rows])

    @property
    def failed(self) -> dict[int, str]:
        """Why stimuli have no metrics, by number."""
        return {int(row[0]): str(row[-1]) for row in self.rows if row[-1]}


def table_of(plan: Plan, found: dict[int, Metrics | str]) -> SweepTable:
    """The table of the stimuli of ``plan`` that were ``found`` so far."""
    metrics = columns_of(plan)
    rows = [
        (
            number,
            *(_cell(value) for value in plan.values_of(number).values()),
            *_measured(found[number], metrics),
        )
        for number in sorted(found)
    ]
    return SweepTable(("stimulus", *plan.names, *metrics, ERROR), tuple(rows))


def write_csv(table: SweepTable, path: Path) -> None:
    """Write the table as CSV: one header line; floats read back exactly, no value is empty."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.columns)
    writer.writerows(map(_as_text, row) for row in table.rows)
    write_bytes(path, text.getvalue().encode())


def write_parquet(table: SweepTable, path: Path) -> None:
    """Write the table as Parquet.

    Raises
    ------
    MissingExtraError
        The package for it is not installed.
    """
    arrow: Any = package_of_extra("pyarrow", "parquet")
    parquet: Any = package_of_extra("pyarrow.parquet", "parquet")
    columns = {name: _uniform(table.column(name)) for name in table.columns}
    with replacing(path) as temporary:
        parquet.write_table(arrow.table(columns), temporary)


def _measured(found: Metrics | str, names: tuple[str, ...]) -> Iterator[Cell]:
    if isinstance(found, str):
        yield from (math.nan for _ in names)
        yield found
        return
    yield from (found[name] for name in names)
    yield ""


def _cell(value: Any) -> Cell:
    return " ".join(map(str, value)) if isinstance(value, tuple) else value


def _as_text(value: Cell) -> str:
    if not isinstance(value, float):
        return str(value)
    # The shortest digits that read back as the same number.
    return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)


def _uniform(values: np.ndarray) -> list[Any]:
    found: list[Any] = values.tolist()
    return found
