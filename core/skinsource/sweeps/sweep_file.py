"""Sweeps written down in TOML.

designs = ["train.skinsource"]     # beside this file
outputs = [19, 21]                 # measured beside the loudest one
axes = "xyz"                       # as in the studio, and so is:
method = "pca"
level = "loudest_100ms"            # or "above_threshold", "drive", or a table: "matches.csv"
level_db = 0.0                     # where that is predicted: dB re 1 m/s², or above threshold
parquet = false

[vary]                             # all combinations; the last one varies first
frequency_hz = [50, 100, 200]
location = [3, 7]

[limits]                           # of actuators that are varied
peak_voltage_v = 5.0

[trials]                           # writes trials.csv
order = "counterbalanced"          # or "random", "given"
participants = 12
blocks = 2
seed = 1

[stimuli]                          # exports each stimulus
format = "wav"
rate_hz = 48000
"""

import tomllib
from pathlib import Path
from typing import Any

from skinsource.actuators import Limits
from skinsource.arguments import one_of, real_number, whole_number
from skinsource.design_file import open_design
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.fields import specs_of
from skinsource.files import named, read_bytes
from skinsource.projection import AXES, METHODS
from skinsource.quoting import printable, quoted, sentence
from skinsource.resampling import MAX_RATE_HZ
from skinsource.sweeps.ordering import KINDS, Order
from skinsource.sweeps.plan import HIGHEST_DB, LOWEST_DB, Plan
from skinsource.sweeps.running import Sweep, level_of, named_designs, variables_of
from skinsource.sweeps.stimulus_files import StimulusFiles

_MOST_BYTES = 16 * 2**20
_MOST = 2**31 - 1
_KNOWN = {
    "": (
        "designs",
        "outputs",
        "axes",
        "method",
        "level",
        "level_db",
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


def read_sweep(path: Path) -> Sweep:
    """Read a sweep and the designs that it names.

    Raises
    ------
    FileFormatError
        The file is no TOML, names what there is not, or holds a value that cannot be.
    StorageError
        It, or a design, cannot be read.
    """
    try:
        found = tomllib.loads(read_bytes(path, most=_MOST_BYTES).decode())
    except (ValueError, RecursionError) as error:
        raise FileFormatError(
            f"{named(path)}: is no TOML text ({printable(error)}). Correct that place, and try "
            "again."
        ) from error
    try:
        return _sweep(found, path.parent)
    except InvalidInputError as error:
        raise FileFormatError(f"{named(path)}: {sentence(str(error))}") from error


def _sweep(found: dict[str, Any], folder: Path) -> Sweep:
    _refuse_unknown("", found)
    names = found.get("designs")
    if not isinstance(names, list) or not names or not all(isinstance(one, str) for one in names):
        raise InvalidInputError(
            f"designs is {quoted(names)}, expected a list of names of design files"
        )
    files = [folder / one for one in names]
    for one in files:
        open_design(one)
    level_db = found.get("level_db")
    parquet = found.get("parquet", False)
    if not isinstance(parquet, bool):
        raise InvalidInputError(f"parquet is {quoted(parquet)}, expected true or false")
    plan = Plan(
        designs=named_designs(files),
        variables=variables_of(_table(found, "vary")),
        outputs=tuple(whole_number("an output", one, 1, _MOST) for one in _list(found, "outputs")),
        axes=one_of("axes", found.get("axes", "xyz"), AXES),
        method=one_of("method", found.get("method", "pca"), METHODS),
        **level_of(_level(found, folder)),
        limits=_limits(found),
        level_db=None
        if level_db is None
        else real_number("level_db", level_db, least=LOWEST_DB, most=HIGHEST_DB),
    )
    return Sweep(plan=plan, order=_order(found), files=_files(found), parquet=parquet)


def _level(found: dict[str, Any], folder: Path) -> str | Path | None:
    """Name of a level, or where its table is: beside the sweep."""
    level = found.get("level")
    if level is not None and not isinstance(level, str):
        raise InvalidInputError(f"level is {quoted(level)}, expected a text")
    return folder / level if level is not None and level.lower().endswith(".csv") else level


def _limits(found: dict[str, Any]) -> Limits:
    table = _table(found, "limits")
    _refuse_unknown("limits", table)
    return Limits(**table)


def _order(found: dict[str, Any]) -> Order | None:
    if "trials" not in found:
        return None
    table = _table(found, "trials")
    _refuse_unknown("trials", table)
    return Order(
        kind=one_of("order", table.get("order", "random"), KINDS),
        seed=table.get("seed", 0),
        participants=table.get("participants", 1),
        blocks=table.get("blocks", 1),
    )


def _files(found: dict[str, Any]) -> StimulusFiles | None:
    if "stimuli" not in found:
        return None
    table = _table(found, "stimuli")
    _refuse_unknown("stimuli", table)
    rate_hz = table.get("rate_hz")
    return StimulusFiles(
        format=table.get("format", "wav"),
        rate_hz=None if rate_hz is None else whole_number("rate_hz", rate_hz, 1, MAX_RATE_HZ),
    )


def _table(found: dict[str, Any], name: str) -> dict[str, Any]:
    table = found.get(name, {})
    if not isinstance(table, dict):
        raise InvalidInputError(f"{name} is {quoted(table)}, expected a table, [{name}]")
    return _flat(table)


def _flat(table: dict[str, Any]) -> dict[str, Any]:
    """TOML reads ``2.frequency_hz = […]`` as a table within the table."""
    flat: dict[str, Any] = {}
    for name, value in table.items():
        if isinstance(value, dict):
            flat |= {f"{name}.{inner}": one for inner, one in value.items()}
        else:
            flat[name] = value
    return flat


def _list(found: dict[str, Any], name: str) -> list[Any]:
    values = found.get(name, [])
    if not isinstance(values, list):
        raise InvalidInputError(f"{name} is {quoted(values)}, expected a list")
    return values


def _refuse_unknown(where: str, table: dict[str, Any]) -> None:
    unknown = [name for name in table if name not in _KNOWN[where]]
    if unknown:
        raise InvalidInputError(
            f"{quoted(unknown[0])} is not known{f' in [{where}]' if where else ''}; there are "
            f"{', '.join(_KNOWN[where])}"
        )
