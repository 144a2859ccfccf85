"""The output of a sweep: its table, its journal and folder, and its stimuli as files.

The journal holds all stimuli measured so far.  It has one line for each stimulus, with a checksum;
a line that was cut or damaged does not count, and its stimulus is measured again.  The first line
names the plan.
"""

import json
import math
import os
from collections.abc import Iterator
from dataclasses import astuple, dataclass, fields
from hashlib import sha256
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.base.arguments import integer
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, StorageError, cell_text, csv_text, quoted
from skinsource.base.extras import package_of_extra
from skinsource.base.files import (
    make_folder,
    path_exists,
    path_text,
    read_bytes,
    replacing,
    storage_errors_of,
    write_bytes,
)
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.lock import Lock
from skinsource.design.design import Design, louder
from skinsource.export.formats import format_named
from skinsource.export.stimulus_export.export import export_stimulus
from skinsource.export.stimulus_export.options import StimulusOptions
from skinsource.export.stimulus_export.preparing import common_full_scale, prepare_stimulus
from skinsource.export.stimulus_export.sidecar import sidecar_path
from skinsource.export.tables import exact_text
from skinsource.signals.resampling import MAX_RATE_HZ
from skinsource.studies.sweeps.measuring import Metrics, columns_of
from skinsource.studies.sweeps.plan import Order, Plan, Trial, trials
from skinsource.version import __version__

Cell = bool | int | float | str
#: Name of the column with the reason why a stimulus has no metrics.
ERROR = "error"


@dataclass(frozen=True, slots=True, eq=False)
class SweepTable:
    """One row for each stimulus, in their order.

    Attributes
    ----------
    columns
        ``"stimulus"`` (a number from 1), the variables, the metrics and ``"error"``, all different:
        where ``"duration_s"`` is varied, the metric is called ``"stimulus_duration_s"``.
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

    def to_dataframe(self) -> Any:
        """Return the table as a pandas DataFrame, whose index is the number of the stimulus.

        Raises
        ------
        MissingExtraError
            pandas is not installed.
        """
        pandas: Any = package_of_extra("pandas", "pandas")
        columns = {name: self.column(name) for name in self.columns}
        return pandas.DataFrame(columns).set_index("stimulus")

    @property
    def failed(self) -> dict[int, str]:
        """Reasons why stimuli have no metrics, by number."""
        return {int(row[0]): str(row[-1]) for row in self.rows if row[-1]}


def table_of(plan: Plan, outcomes: dict[int, Metrics | str]) -> SweepTable:
    """Return the table of the stimuli of ``plan`` that were measured so far."""
    metrics = columns_of(plan)
    rows = [
        (
            number,
            *(cell_of(value) for value in plan.values_of(number).values()),
            *_metric_cells(outcomes[number], metrics),
        )
        for number in sorted(outcomes)
    ]
    # What is varied may be called as a metric is: the duration of a clip, and of the stimulus.
    names = (f"stimulus_{name}" if name in plan.names else name for name in metrics)
    return SweepTable(("stimulus", *plan.names, *names, ERROR), tuple(rows))


def write_csv(table: SweepTable, path: Path) -> None:
    """Write the table as CSV: one header line; floats read back exactly, no value is empty."""
    rows = (map(_as_text, row) for row in table.rows)
    write_bytes(path, csv_text(table.columns, rows).encode())


def write_parquet(table: SweepTable, path: Path) -> None:
    """Write the table as Parquet.

    Raises
    ------
    MissingExtraError
        The package for it is not installed.
    """
    arrow: Any = package_of_extra("pyarrow", "parquet")
    parquet: Any = package_of_extra("pyarrow.parquet", "parquet")
    columns = {name: table.column(name).tolist() for name in table.columns}
    with replacing(path) as temporary:
        parquet.write_table(arrow.table(columns), temporary)


def _metric_cells(outcome: Metrics | str, names: tuple[str, ...]) -> Iterator[Cell]:
    if isinstance(outcome, str):
        yield from (math.nan for _ in names)
        yield outcome
        return
    # A journal of an earlier version may lack some.
    yield from (outcome.get(name, math.nan) for name in names)
    yield ""


def cell_of(value: Any) -> Cell:
    """Return a value of a variable for a table; places of several inputs become one text."""
    return " ".join(map(str, value)) if isinstance(value, tuple) else value


def _as_text(value: Cell) -> str:
    if isinstance(value, str):
        return cell_text(value)
    return exact_text(value) if isinstance(value, float) else str(value)


_MOST_BYTES = 2**32
_CHECKED = 16
# First lines of two plans differ in nearly all of their 80 digits.
_MOST_DAMAGED = 8


class Journal:
    """Lines of a file, appended and flushed one by one.

    Parameters
    ----------
    path
        The file; it is created where it does not exist.  A file that is no journal is renamed.
    digest
        Digest of the plan; a file of another plan is an error.

    Attributes
    ----------
    rows
        Metrics by number of the stimulus; the reason where it could not be measured.

    Raises
    ------
    InvalidInputError
        The file belongs to another sweep.
    StorageError
        It cannot be read or written.
    """

    def __init__(self, path: Path, digest: str) -> None:
        self.path = path
        self.rows: dict[int, Metrics | str] = {}
        first = _line({"sweep": digest})
        content = read_bytes(path, most=_MOST_BYTES) if path_exists(path) else b""
        with storage_errors_of(path):
            if first.startswith(content):
                content = b""
            elif not _is_nearly(content[: len(first)], first):
                if _content_of(content.partition(b"\n")[0]) is not None:
                    raise InvalidInputError(
                        f"{path_text(path)} belongs to another sweep. Choose another folder, or "
                        "delete the file to start again."
                    )
                names = (path.with_stem(f"{path.stem} set aside {number}") for number in count(1))
                path.rename(next(name for name in names if not path_exists(name)))
                content = b""
            # An incomplete last line is deleted.
            n_complete = max(len(first), content.rfind(b"\n") + 1) if content else 0
            for line in content[len(first) : n_complete].split(b"\n"):
                tree = _content_of(line)
                if tree is not None:
                    self.rows[int(tree["stimulus"])] = _outcome_of(tree)
            self._file = path.open("r+b" if path_exists(path) else "w+b")
            self._file.truncate(n_complete)
            self._file.seek(n_complete)
        if not content:
            self._write(first)

    def add(self, number: int, outcome: Metrics | str) -> None:
        """Store the metrics, or error, of a stimulus, from 1; a second time changes nothing."""
        if number in self.rows:
            return
        self.rows[number] = outcome
        if isinstance(outcome, str):
            self._write(_line({"stimulus": number, "error": outcome}))
        else:
            finite = {name: each if math.isfinite(each) else None for name, each in outcome.items()}
            self._write(_line({"stimulus": number, "metrics": finite}))

    def close(self) -> None:
        """Close the file; it stays."""
        self._file.close()

    def _write(self, line: bytes) -> None:
        with storage_errors_of(self.path):
            self._file.write(line)
            self._file.flush()
            os.fsync(self._file.fileno())


def _line(tree: dict[str, Any]) -> bytes:
    text = json.dumps(tree, allow_nan=False, separators=(",", ":")).encode()
    return _checksum(text) + b" " + text + b"\n"


def _checksum(text: bytes) -> bytes:
    return sha256(text).hexdigest()[:_CHECKED].encode()


def _content_of(line: bytes) -> dict[str, Any] | None:
    """Return the content of a line; None: it is damaged."""
    text = line[_CHECKED + 1 :]
    if line[:_CHECKED] != _checksum(text):
        return None
    return json.loads(text)


def _is_nearly(line: bytes, expected: bytes) -> bool:
    """Return whether ``line`` is ``expected``, perhaps with a few damaged bytes."""
    damaged = sum(a != b for a, b in zip(line, expected, strict=False))
    return len(line) == len(expected) and damaged <= _MOST_DAMAGED


def _outcome_of(tree: dict[str, Any]) -> Metrics | str:
    if "error" in tree:
        return str(tree["error"])
    return {
        name: math.nan if value is None else float(value) for name, value in tree["metrics"].items()
    }


#: The journal; it stays, so that a sweep that is run again has nothing to do.
JOURNAL = "measured.jsonl"
TABLE, PARQUET, TRIALS, ABOUT = "stimuli.csv", "stimuli.parquet", "trials.csv", "sweep.json"


class Folder:
    """The folder of a sweep; one process writes to it at a time.

    Parameters
    ----------
    path
        The folder; it is created where it does not exist.
    digest
        Digest of the plan; a folder of another plan is an error.

    Raises
    ------
    StorageError
        Another process runs a sweep there, or it cannot be written.
    InvalidInputError
        It holds another sweep.
    """

    def __init__(self, path: Path, digest: str) -> None:
        make_folder(path)
        self.path = path
        self._lock = Lock(path / JOURNAL)
        owner = self._lock.take()
        if owner is not None:
            raise StorageError(
                f"{path_text(path)}: another process ({owner.pid} on {owner.host}) runs a sweep "
                "there. Wait for its end, or choose another folder."
            )
        try:
            self.journal = Journal(path / JOURNAL, digest)
        except BaseException:
            self._lock.release()
            raise

    def __enter__(self) -> "Folder":
        return self

    def __exit__(self, *_: object) -> None:
        self.journal.close()
        self._lock.release()

    def finish(self, plan: Plan, table: SweepTable, order: Order | None, *, parquet: bool) -> None:
        """Write the tables, each whole or not at all."""
        write_csv(table, self.path / TABLE)
        if parquet:
            write_parquet(table, self.path / PARQUET)
        if order is not None:
            write_bytes(self.path / TRIALS, _trials_csv(order, table))
        about = {
            "stimuli": len(plan),
            "digest": plan.digest,
            "variables": {name: list(values) for name, values in plan.variables},
            "designs": [name for name, _ in plan.designs],
            "outputs": list(plan.outputs),
            "axes": plan.axes,
            "method": plan.method,
            "level": plan.level,
            "level_db": plan.level_db,
            "skinsource": __version__,
        }
        text = json.dumps(about, indent=2, ensure_ascii=False, allow_nan=False)
        write_bytes(self.path / ABOUT, text.encode() + b"\n")


def _trials_csv(order: Order, table: SweepTable) -> bytes:
    """Return the trials as CSV, without stimuli that could not be measured."""
    failed = table.failed
    stimuli = [number for row in table.rows if (number := int(row[0])) not in failed]
    columns = tuple(field.name for field in fields(Trial))
    return csv_text(columns, map(astuple, trials(order, stimuli))).encode()


#: Name of the folder of the stimuli as files that actuators play.
FOLDER = "stimuli"


@dataclass(frozen=True, slots=True, kw_only=True)
class StimulusFiles:
    """Format of the exported stimuli of a sweep.

    Attributes
    ----------
    format
        One of `skinsource.export_formats`.
    rate_hz
        Sample rate; None: the usual one of the format.
    """

    format: str = "wav"
    rate_hz: int | None = None

    def __post_init__(self) -> None:
        format_named(self.format)
        if self.rate_hz is not None:
            integer("rate_hz", self.rate_hz, 1, MAX_RATE_HZ)

    def write(
        self,
        plan: Plan,
        table: SweepTable,
        out: Path,
        *,
        progress: Progress = silent,
        stop: Stop = never,
    ) -> None:
        """Export each stimulus that was measured; existing files stay.

        A file of another rate is written anew.  The largest drive of all stimuli is full scale in
        every file, so that their differences stay.

        Raises
        ------
        StorageError
            The folder cannot be written.
        Stopped
            ``stop`` said so; what was written stays, and is not written again.
        """
        waiting = [
            (path, design)
            for path, design in self._files(plan, table, out / FOLDER)
            if not self._is_exported(path)
        ]
        if not waiting:
            return
        make_folder(out / FOLDER)
        # The largest drive of all stimuli, at the rate of the files; 1 for silence.
        kind, peaks = format_named(self.format), []
        for done, (_, design) in enumerate(self._files(plan, table, out / FOLDER)):
            stop_if(stop)
            progress(done, len(table), "Looking for the largest drive")
            prepared = prepare_stimulus(design, kind, self.rate_hz, StimulusOptions(), stop=stop)
            peaks.append(prepared.peak)
        options = StimulusOptions(full_scale=common_full_scale(peaks))
        for done, (path, design) in enumerate(waiting):
            stop_if(stop)
            progress(done, len(waiting), f"Exporting {path.name}")
            export_stimulus(design, path, self.format, self.rate_hz, options=options, stop=stop)

    def _is_exported(self, path: Path) -> bool:
        """Return whether a stimulus is exported in this format."""
        sidecar, kind = sidecar_path(path), format_named(self.format)
        if not (path_exists(path) and path_exists(sidecar)):
            return False
        try:
            about = json.loads(sidecar.read_text(encoding="utf-8"))
            return bool(kind.fixed_rate or about["rate_hz"] == kind.file_rate_hz(self.rate_hz))
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def _files(self, plan: Plan, table: SweepTable, folder: Path) -> Iterator[tuple[Path, Design]]:
        """Yield the path and the design of each stimulus that was measured."""
        suffix = format_named(self.format).suffix
        failed, width = table.failed, len(str(len(plan)))
        for number, factor in zip(table.column("stimulus"), table.column("factor"), strict=True):
            if int(number) not in failed:
                path = folder / f"{int(number):0{width}}{suffix}"
                yield path, louder(plan.design_of(int(number)), float(factor))
