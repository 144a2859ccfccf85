"""Import a limb from files of a lab.

Functions of `skinsource.limbs.limb_layout` read the foreign files in a process of their own; all
else runs in the process of the caller.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.errors import FileFormatError, InvalidInputError, quoted
from skinsource.base.files import is_file, path_text
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.run_limited import LimitedProcess, run_limited
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.limb_layout import POINT_FIELDS, USUAL_ORDERS, hull_around
from skinsource.limbs.own_limbs import OwnLimb, facts_of, install_limb, own_limb_path

_LAYOUT = "skinsource.limbs.limb_layout"
_EXPECTED = "responses in the layout of docs/limbs.md, or in NPY, NPZ, MATLAB or HDF5"
_HULL_NOTE = "the outline is a hull around the places, not measured"


@dataclass(frozen=True, slots=True, kw_only=True)
class LimbSource:
    """The files and values that a limb is imported from.

    Attributes
    ----------
    responses
        A file in the layout of `docs/limbs.md`, or any array of three or four dimensions in NPY,
        NPZ, MATLAB or HDF5.
    array, order
        Of such an array: its name (empty: the largest), and what its dimensions are, a letter
        each: i input, o output, a axis, t tap (empty: ``"ioat"``, or ``"iot"`` of three).
    outline, inputs, outputs
        Files of points (CSV, the outline also SVG), or points themselves, (n, 2); None: those of
        the layout; without any outline a hull is drawn around the places.
    y_down
        Whether y of these points points down, as in pictures; None: as SVG says, else up.
    values
        Fields of `OwnLimb` besides, which go before those of the layout: ``{"axes": "xz"}``.
    """

    responses: Path
    array: str = ""
    order: str = ""
    outline: Path | Floats | None = None
    inputs: Path | Floats | None = None
    outputs: Path | Floats | None = None
    y_down: bool | None = None
    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class PreparedLimb:
    """A limb whose responses have not been read yet; ``array`` and ``order`` are those to read."""

    limb: OwnLimb
    array: str
    order: str


def import_limb(
    source: LimbSource,
    *,
    replace: bool = False,
    progress: Progress = silent,
    stop: Stop = never,
) -> LimbFacts:
    """Read, check and store a limb.

    Parameters
    ----------
    source
        What it is made of.
    replace
        Whether an own limb of the same name goes; it cannot be had back.
    progress, stop
        Called with the progress; asked whether to stop.

    Raises
    ------
    FileFormatError
        A file does not hold what it should, or is damaged.
    InvalidInputError
        A value does not fit: a name that is taken, numbers of places that differ.
    StorageError
        A file cannot be read, or the limb cannot be written.
    Stopped
        ``stop`` returned true; nothing is left behind.
    """
    with LimitedProcess() as process:
        prepared = prepare_limb(source, process, stop=stop)
        if not replace:
            _check_name_free(prepared.limb.name)
        responses = _responses(source.responses, prepared, process, stop)
        try:
            install_limb(prepared.limb, responses, progress=progress, stop=stop)
        except InvalidInputError as error:
            raise FileFormatError(f"{path_text(Path(source.responses.name))}: {error}") from error
    return facts_of(prepared.limb.name)


def _check_name_free(name: str) -> None:
    """Raise if the name is in use, even by a damaged limb, which may be the only copy."""
    if is_file(own_limb_path(name)):
        raise InvalidInputError(
            f"an own limb is called {quoted(name)} already, and would be lost: give this one "
            "another name, or say that it takes its place (--replace; replace=True in Python)"
        )


def prepare_limb(
    source: LimbSource, process: LimitedProcess, *, stop: Stop = never
) -> PreparedLimb:
    """Read all but the responses, and check it; raises as `import_limb`."""
    path = source.responses
    about = read_description(path, process, stop=stop)
    shape, array, order = _array_to_read(source, about)
    values: dict[str, Any] = {
        "name": "",
        **_layout_values(about["header"] or {}),
        **{key: value for key, value in source.values.items() if value is not None},
    }
    down = False
    for part, field_name in POINT_FIELDS.items():
        part_source = getattr(source, part)
        if part_source is None:
            values.setdefault(field_name, None)
            continue
        points = (
            read_points(part_source, process, stop=stop) if isinstance(part_source, Path) else None
        )
        values[field_name] = np.array(part_source) if points is None else points.points
        down = down or (points is not None and points.y_down)
        if points is not None and points.names and part != "outline":
            values[f"{part[:-1]}_names"] = points.names
    # Turned upwards, but not the points of the layout itself.
    if down if source.y_down is None else source.y_down:
        for part, field_name in POINT_FIELDS.items():
            if getattr(source, part) is not None:
                values[field_name] = np.asarray(values[field_name]) * (1.0, -1.0)
    values["n_taps"] = shape[3]
    try:
        _complete(values, shape)
        return PreparedLimb(limb=OwnLimb(**values), array=array, order=order)
    except InvalidInputError as error:
        raise InvalidInputError(f"{path_text(Path(path.name))}: {error}") from error


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Points:
    """Points of a file, (n, 2), NaN where one is missing; names; whether y points down."""

    points: Floats
    names: tuple[str, ...]
    y_down: bool


def read_points(path: Path, process: LimitedProcess, *, stop: Stop = never) -> Points:
    """Read the places of a CSV file, or the outline of a CSV or SVG file."""
    (answer,) = run_limited(
        f"{_LAYOUT}:points_of", path, expected="a CSV or SVG file", process=process, stop=stop
    )
    rows = [(np.nan, np.nan) if row is None else row for row in answer["points"]]
    points = np.array(rows, np.float64).reshape(-1, 2)
    return Points(points=points, names=tuple(answer["names"]), y_down=answer["y_down"])


def read_description(path: Path, process: LimitedProcess, *, stop: Stop = never) -> dict[str, Any]:
    """Return what `skinsource.limbs.limb_layout.description_of` says of a file of responses."""
    (answer,) = run_limited(
        f"{_LAYOUT}:description_of", path, expected=_EXPECTED, process=process, stop=stop
    )
    return dict(answer)


def _array_to_read(
    source: LimbSource, about: dict[str, Any]
) -> tuple[tuple[int, int, int, int], str, str]:
    """Return the shape of the responses, (inputs, outputs, axes, taps), their array and order.

    Array and order are empty for a file in the layout.
    """
    if about["header"] is not None:
        inputs, outputs, axes, taps = about["header"]["shape"]
        return (inputs, outputs, axes, taps), "", ""
    arrays = [array for array in about["arrays"] if source.array in ("", array["name"])]
    if not arrays:
        names = ", ".join(quoted(array["name"]) for array in about["arrays"][:10])
        raise InvalidInputError(
            f"{path_text(Path(source.responses.name))}: it has no array {quoted(source.array)}, "
            f"expected one of {names}"
        )
    array = max(arrays, key=lambda array: prod(array["shape"]))
    order = source.order or USUAL_ORDERS[len(array["shape"])]
    if sorted(order) != sorted(USUAL_ORDERS[len(array["shape"])]):
        raise InvalidInputError(
            f"{path_text(Path(source.responses.name))}: the order of {quoted(array['name'])}, "
            f"which has {len(array['shape'])} dimensions, is {quoted(order)}, expected i, o, a and "
            "t, each once (without a where there are three)"
        )
    size = dict(zip(order, map(int, array["shape"]), strict=True))
    shape = size["i"], size["o"], size.get("a", 1), size["t"]
    return shape, array["name"], order


def _layout_values(header: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of `OwnLimb` in the header of a file."""
    values = {name: value for name, value in header.items() if name != "shape"}
    for name in POINT_FIELDS.values() if header else ():
        rows = [(np.nan, np.nan) if row is None else row for row in header[name]]
        values[name] = np.array(rows)
    return values


def _complete(values: dict[str, Any], shape: tuple[int, int, int, int]) -> None:
    """Check that nothing is missing and that places match responses; add outline and scale."""
    known = {spec.name for spec in fields(OwnLimb)}
    missing = [
        f"{name} {is_not} ({option})"
        for name, is_not, option in (
            ("axes", "is not known", "--axes"),
            ("sample_rate_hz", "is not known", "--rate"),
            ("hand_length_mm", "is not known", "--hand-length"),
            ("input_positions", f"are not known, expected {shape[0]} places", "--inputs"),
            ("output_positions", f"are not known, expected {shape[1]} places", "--outputs"),
        )
        if values.get(name) is None
    ]
    if missing:
        raise InvalidInputError("; ".join(missing))
    unknown = sorted(set(values) - known)
    if unknown:
        raise InvalidInputError(f"{', '.join(unknown)} says nothing about a limb; remove it")
    if not isinstance(values["axes"], str) or len(values["axes"]) != shape[2]:
        raise InvalidInputError(
            f"axes is {quoted(values['axes'])}, expected {shape[2]} of x, y and z, as many as the "
            "responses have"
        )
    for name, n in (("input_positions", shape[0]), ("output_positions", shape[1])):
        points = values[name]
        if np.shape(points) != (n, 2):
            raise InvalidInputError(
                f"{name} has shape {np.shape(points)}, expected ({n}, 2): the responses have {n}"
            )
    if not np.isfinite(values["output_positions"]).all(axis=1).any():
        raise InvalidInputError("no output has a place on the map, expected at least one")
    if values["outline"] is None:
        values["outline"] = hull_around(
            np.vstack((values["input_positions"], values["output_positions"]))
        )
        note = values.get("note") or ""
        values["note"] = f"{note}; {_HULL_NOTE}" if note else _HULL_NOTE
    if values.get("hand_length_px") is None:
        values["hand_length_px"] = values["hand_length_mm"]


def _responses(
    path: Path, prepared: PreparedLimb, process: LimitedProcess, stop: Stop
) -> Iterator[Floats]:
    for block in run_limited(
        f"{_LAYOUT}:response_blocks",
        path,
        expected=_EXPECTED,
        process=process,
        most_bytes=8 * prod(prepared.limb.shape),
        stop=stop,
        array=prepared.array,
        order=prepared.order,
    ):
        rows = prepared.limb.n_outputs * len(prepared.limb.axes)
        if block.shape != (rows, prepared.limb.n_taps):
            raise FileFormatError(
                f"{path_text(Path(path.name))}: a response has shape {block.shape}, expected "
                f"{(rows, prepared.limb.n_taps)}. The file has changed, or is damaged."
            )
        yield block.reshape(prepared.limb.shape[1:])
