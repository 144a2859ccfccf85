"""Runs a sweep, or the rest of it, in processes and into a folder; reads sweeps from TOML."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from skinsource.actuators.prediction import Limits
from skinsource.base.arguments import checking, integer
from skinsource.base.conventions import Axes
from skinsource.base.errors import FileFormatError, InvalidInputError, printable, quoted, sentence
from skinsource.base.files import FilePath, path_text, read_bytes
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.design.design import Design
from skinsource.design.design_file import open_design
from skinsource.lab.matching import Strengths, read_matches
from skinsource.signals.projection import Method
from skinsource.specs.models import specs_of
from skinsource.studies.sweeps.measuring import Metrics, measured_here
from skinsource.studies.sweeps.plan import LEVELS, Level, Order, Plan, Value, trials
from skinsource.studies.sweeps.table import Folder, StimulusFiles, SweepTable, table_of
from skinsource.studies.sweeps.workers import Row, measured

_MOST_PROCESSES = 256
#: Fewer stimuli are measured faster than a second process starts.
_WORTH_PROCESSES = 50


#: A design or the path of a design file, or several.
Designs = Design | FilePath | Sequence[Design | FilePath]
#: Values by the name of the variable.
Variables = Mapping[str, Iterable[Any]]
#: Yields the metrics, or errors, of some stimuli of a plan, in any order; raises
#: `skinsource.base.errors.Stopped` once the last argument says so.
Measuring = Callable[[Plan, Iterable[int], Stop], Iterator[Row]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """A sweep: its plan and its output.

    Attributes
    ----------
    plan
        Its stimuli.
    order
        Order of their presentation; None: no table of trials is written.
    files
        Format of the exported stimuli; None: they are not exported.
    parquet
        Whether the table is written as Parquet too.
    """

    plan: Plan
    order: Order | None = None
    files: StimulusFiles | None = None
    parquet: bool = False


@checking
def sweep(
    designs: Designs,
    vary: Variables | None = None,
    *,
    out: FilePath | None = None,
    outputs: Iterable[int] = (),
    axes: Axes = "xyz",
    method: Method = "pca",
    level: Level | FilePath | None = None,
    level_db: float | None = None,
    limits: Limits | None = None,
    people: bool = False,
    order: Order | None = None,
    files: StimulusFiles | None = None,
    parquet: bool = False,
    processes: int | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> SweepTable:
    """Measure all combinations of designs and of values, on all cores.

    Parameters
    ----------
    designs
        A design or the path of a design file, or several.
    vary
        Values by the name of the variable, see `skinsource.studies.sweeps.plan.varied`:
        ``{"frequency_hz": [50, 100], "location": [1, 2]}``.  The last one varies first.
    out
        Folder for all files, where a sweep that was stopped or killed continues; or None.
    outputs, axes, method, level, level_db, limits, people
        Measurement and level: see `skinsource.studies.sweeps.plan.Plan`.  A level may be the path
        of a table of matches, too.
    order, files, parquet
        Files besides ``stimuli.csv``: see `skinsource.studies.sweeps.running.Sweep`.
    processes
        Number of processes; None: as many as cores, or this one for a few stimuli.

    Returns
    -------
    One row of metrics for each stimulus; see
    `skinsource.studies.sweeps.measuring.Measurer.measure`.

    Raises
    ------
    InvalidInputError
        The sweep is not possible.  A single stimulus that fails has the error in its row.
    StorageError
        The folder cannot be written.

    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
    >>> ss.sweep(design, {"frequency_hz": [50.0, 200.0]}).column("frequency_hz")
    array([ 50., 200.])
    """
    settings: dict[str, Any] = {"outputs": tuple(outputs), "axes": axes, "method": method}
    settings |= {**level_of(level), "level_db": level_db, "limits": limits or Limits()}
    settings["people"] = people
    plan = Plan(designs=named_designs(designs), variables=variables_of(vary), **settings)
    planned = Sweep(plan=plan, order=order, files=files, parquet=parquet)
    return run(planned, out, processes=processes, progress=progress, stop=stop)


@checking
def run(
    wanted: Sweep,
    out: FilePath | None,
    *,
    processes: int | None = None,
    measuring: Measuring | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> SweepTable:
    """Run a sweep, or the rest of it; see `sweep`.

    Parameters
    ----------
    measuring
        Measures instead of processes of this computer, such as `cluster.Cluster`.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> plan = ss.sweeps.Plan(designs=(("tone", design),), variables=(("location", (7, 8)),))
    >>> print(len(ss.sweeps.run(ss.sweeps.Sweep(plan=plan), None)))
    2
    """
    plan = wanted.plan
    if out is None and (wanted.order or wanted.files or wanted.parquet):
        raise InvalidInputError(
            "order, files and parquet are written to a folder; name it with out"
        )
    if wanted.order is not None:
        trials(wanted.order, range(1, len(plan) + 1))
    with nullcontext() if out is None else Folder(Path(out), plan.digest) as folder:
        outcomes: dict[int, Metrics | str] = {} if folder is None else dict(folder.journal.rows)
        remaining = [number for number in range(1, len(plan) + 1) if number not in outcomes]
        measure = measuring or _measuring(len(remaining), processes)
        progress(len(outcomes), len(plan), "Predicting")
        for number, row in measure(plan, remaining, stop):
            outcomes[number] = row
            if folder is not None:
                folder.journal.add(number, row)
            progress(len(outcomes), len(plan), f"Predicted stimulus {number} of {len(plan)}")
        table = table_of(plan, outcomes)
        if folder is not None:
            folder.finish(wanted.plan, table, wanted.order, parquet=wanted.parquet)
            if wanted.files is not None:
                wanted.files.write(plan, table, folder.path, progress=progress, stop=stop)
    return table


def _measuring(n_left: int, processes: int | None) -> Measuring:
    if processes is None:
        processes = (os.cpu_count() or 1) if n_left >= _WORTH_PROCESSES else 1
    count = integer("processes", processes, 1, _MOST_PROCESSES)
    if count == 1:
        return measured_here
    return lambda plan, numbers, stop: measured(plan, numbers, count, stop)


def named_designs(designs: Designs) -> tuple[tuple[str, Design], ...]:
    """Return each design with a unique name: its file, its title, or a number."""
    several = [designs] if isinstance(designs, Design | str | os.PathLike) else list(designs)
    named: list[tuple[str, Design]] = []
    for number, source in enumerate(several, start=1):
        if isinstance(source, Design):
            named.append((source.title or f"design {number}", source))
        elif isinstance(source, str | os.PathLike):
            named.append((Path(source).stem, open_design(source).design))
        else:
            raise InvalidInputError(
                f"designs holds {quoted(source)}, expected designs or paths of design files"
            )
    names = [name for name, _ in named]
    return tuple(
        (name if names.count(name) == 1 else f"{name} ({number})", design)
        for number, (name, design) in enumerate(named, start=1)
    )


def variables_of(vary: Variables | None) -> tuple[tuple[str, tuple[Value, ...]], ...]:
    """Return variables and their values for a plan."""
    return tuple((name, values_of(name, values)) for name, values in (vary or {}).items())


def level_of(level: FilePath | None) -> dict[str, Any]:
    """Return the fields of a plan for a level: its name, or the strengths of a table of matches.

    Raises
    ------
    FileFormatError, StorageError
        It is the path of a file that is no table of matches, or cannot be read.
    """
    if level is None or level in LEVELS:
        return {"level": level}
    if isinstance(level, str | os.PathLike):
        path = Path(level)
        if isinstance(level, os.PathLike) or path.suffix.lower() == ".csv":
            return {"strengths": Strengths.of(read_matches(path))}
    raise InvalidInputError(
        f"level is {quoted(level)}, expected one of {', '.join(LEVELS[:-1])}, or the path of a "
        "table of matches, *.csv"
    )


def values_of(name: str, values: Iterable[Any]) -> tuple[Value, ...]:
    """Return the values of a variable as plain ones."""
    if isinstance(values, str | bytes) or not isinstance(values, Iterable):
        raise InvalidInputError(f"{quoted(name)} is {quoted(values)}, expected a list of values")
    return tuple(_value(name, value) for value in values)


def _value(name: str, value: Any) -> Value:
    """Return a plain value, also of a numpy scalar, so that the same sweep has the same digest."""
    if hasattr(value, "item") and not isinstance(value, str | bytes):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return tuple(integer(f"{name}[{k}]", number, 1, 2**31) for k, number in enumerate(value))
    # A table cannot hold other values, which would fail at the end only.
    if isinstance(value, bool | int | str) or (isinstance(value, float) and isfinite(value)):
        return value
    raise InvalidInputError(
        f"{quoted(name)} holds {quoted(value)}, expected finite numbers or texts"
    )


# Limits and keys of sweeps in TOML, see docs/sweeps.md.
_MOST_BYTES = 16 * 2**20
_KEYS = {
    "": (
        "designs",
        "outputs",
        "axes",
        "method",
        "level",
        "level_db",
        "people",
        "parquet",
        "vary",
        "limits",
        "trials",
        "stimuli",
    ),
    "limits": tuple(specs_of(Limits)),
    "trials": ("order", "participants", "blocks", "seed"),
    "stimuli": ("format", "rate_hz"),
}


@checking
def read_sweep(path: Path) -> Sweep:
    """Read a sweep and the designs that it names.

    Raises
    ------
    FileFormatError
        The file is no TOML, has an unknown name, or an invalid value.
    StorageError
        It, or a design, cannot be read.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "sweep.toml"
    ...     ss.save_design(path.with_name("a.skinsource"), design)
    ...     _ = path.write_text('designs = ["a.skinsource"]')
    ...     print(len(ss.sweeps.read_sweep(path).plan))
    1
    """
    try:
        content = _content_of(read_bytes(path, most=_MOST_BYTES))
        return _sweep(content, path.parent)
    except InvalidInputError as error:
        raise FileFormatError(f"{path_text(path)}: {sentence(str(error))}") from error


def read_variables(text: str) -> dict[str, Any]:
    """Return the variables in a text that is written as the table ``[vary]`` of a sweep."""
    return _flat(_content_of(text.encode()))


def _content_of(text: bytes) -> dict[str, Any]:
    try:
        return tomllib.loads(text.decode())
    except (ValueError, RecursionError) as error:
        raise InvalidInputError(
            f"the text is not TOML ({printable(error)}). Correct that place, and try again."
        ) from error


def _sweep(content: dict[str, Any], folder: Path) -> Sweep:
    _check_keys("", content)
    names = content.get("designs")
    if not isinstance(names, list) or not names or not all(isinstance(name, str) for name in names):
        raise InvalidInputError(
            f"designs is {quoted(names)}, expected a list of names of design files"
        )
    asked = {name: content.get(name, False) for name in ("people", "parquet")}
    for name, value in asked.items():
        if not isinstance(value, bool):
            raise InvalidInputError(f"{name} is {quoted(value)}, expected true or false")
    plan = Plan(
        designs=named_designs([folder / name for name in names]),
        variables=variables_of(_table(content, "vary")),
        outputs=tuple(_list(content, "outputs")),
        axes=content.get("axes", "xyz"),
        method=content.get("method", "pca"),
        **level_of(_level(content, folder)),
        limits=Limits(**_table(content, "limits")),
        people=asked["people"],
        level_db=content.get("level_db"),
    )
    presented = _table(content, "trials")
    order = Order(kind=presented.pop("order", "random"), **presented)
    files = StimulusFiles(**_table(content, "stimuli"))
    return Sweep(
        plan=plan,
        order=order if "trials" in content else None,
        files=files if "stimuli" in content else None,
        parquet=asked["parquet"],
    )


def _level(content: dict[str, Any], folder: Path) -> str | Path | None:
    """Return the name of a level, or the path of its table in the folder of the sweep."""
    level = content.get("level")
    if level is not None and not isinstance(level, str):
        raise InvalidInputError(f"level is {quoted(level)}, expected a text")
    return folder / level if level is not None and level.lower().endswith(".csv") else level


def _table(content: dict[str, Any], name: str) -> dict[str, Any]:
    table = content.get(name, {})
    if not isinstance(table, dict):
        raise InvalidInputError(f"{name} is {quoted(table)}, expected a table, [{name}]")
    if name in _KEYS:
        _check_keys(name, table)
    return _flat(table)


def _flat(table: dict[str, Any]) -> dict[str, Any]:
    """Return a table without inner ones: TOML reads ``2.frequency_hz = […]`` as one."""
    flat: dict[str, Any] = {}
    for name, value in table.items():
        if isinstance(value, dict):
            flat |= {f"{name}.{inner}": inner_value for inner, inner_value in value.items()}
        else:
            flat[name] = value
    return flat


def _list(content: dict[str, Any], name: str) -> list[Any]:
    values = content.get(name, [])
    if not isinstance(values, list):
        raise InvalidInputError(f"{name} is {quoted(values)}, expected a list")
    return values


def _check_keys(where: str, table: dict[str, Any]) -> None:
    unknown = [name for name in table if name not in _KEYS[where]]
    if unknown:
        raise InvalidInputError(
            f"{quoted(unknown[0])} is not known{f' in [{where}]' if where else ''}; choose one of "
            f"{', '.join(_KEYS[where])}"
        )
