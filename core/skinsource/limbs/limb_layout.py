"""Files of labs: limbs in HDF5, arrays of responses, tables of places, and outlines.

What reads them runs in a process of its own, see `skinsource.base.run_limited`.
``docs/limbs.md`` describes the layout of a limb for people::

    /                  format, format_version, name, title, note, sample_rate_hz, axes,
                       pre_trigger_delay_s, band_hz, answers, hand, hand_length_mm, synthetic
    /responses         (n_inputs, n_outputs, n_axes, n_taps) float32 or float64, m/s²
    /map               hand_length
    /map/outline       (n_vertices, 2)
    /map/inputs        (n_inputs, 2)
    /map/outputs       (n_outputs, 2), NaN where an output has no place on the back
    /names/inputs      (n_inputs,) texts, may be missing; so may outputs
"""

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from skinsource.base import files
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, RecordingError, quoted
from skinsource.base.files import path_text, read_bytes, replacing
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.own_limbs import LimbFile, OwnLimb, existing_path
from skinsource.limbs.svg_path import outline_of
from skinsource.readers import arrays
from skinsource.readers.arrays import reason_against, stated_rate
from skinsource.readers.readers import reader_of

_ADVICE = "docs/limbs.md describes the layout of a limb."


def limb_file_error(path: Path, problem: str, expected: str) -> RecordingError:
    """Return an error that names the file, the problem, what was expected, and where to look."""
    return RecordingError(
        f"{path_text(Path(path.name))}: {problem}, expected {expected}. {_ADVICE}"
    )


FORMAT, VERSION = "skinsource limb", 1
#: Attributes, texts and numbers, with their defaults; those without one must be there.
TEXTS = {"name": "", "title": "", "note": "", "axes": None}
NUMBERS = {
    "sample_rate_hz": None,
    "pre_trigger_delay_s": 0.0,
    "hand_length_mm": None,
    "synthetic": 0.0,
}
_ONLY_OF_LIMBS = ("format_version", "hand_length_mm")
#: Datasets of points, and the fields of `OwnLimb` that they fill.
POINT_FIELDS = {"outline": "outline", "inputs": "input_positions", "outputs": "output_positions"}
_NAMES = {"inputs": "input_names", "outputs": "output_names"}
_LONGEST_TEXT, _MOST_NAMES, _MOST_ROWS = 4000, 512, 20_001
_HEADER_BYTES = 2**20


def description_of(path: Path) -> dict[str, Any]:
    """Return all but the responses, for JSON: ``header`` of a file in the layout, or ``arrays``."""
    name = reader_of(path).name
    if name not in _OPENERS:
        raise limb_file_error(path, f"it is a {name} file", "NPY, NPZ, MATLAB or HDF5")
    if name in ("HDF5", "MATLAB 7.3") and _is_limb_file(path):
        return {"header": _header_of(path), "arrays": []}
    offered = arrays_of(path)
    if not offered["arrays"]:
        raise limb_file_error(
            path,
            f"it holds no array of 3 or 4 dimensions. {' '.join(offered['notes'])}".rstrip(" ."),
            "responses: inputs, outputs, axes and taps in some order",
        )
    return {"header": None, "arrays": offered["arrays"]}


def _is_limb_file(path: Path) -> bool:
    """Whether an HDF5 file says that it holds a limb.

    Raises
    ------
    RecordingError
        It says what only limbs do, but not that it is one: as an array it would lose the rest.
    """
    with files.File(path, "r", locking=False) as file:
        if "format" in file.attrs and text_of(file, path, "format", "") == FORMAT:
            return True
        if any(name in file.attrs for name in _ONLY_OF_LIMBS):
            text = text_of(file, path, "format", None)
            raise limb_file_error(path, f"the attribute 'format' is {quoted(text)}", quoted(FORMAT))
        return False


def _header_of(path: Path) -> dict[str, Any]:
    """Return all but the responses of a file in the layout: fields of `OwnLimb`, and ``shape``.

    Raises
    ------
    RecordingError
        It does not have the layout.
    """
    with files.File(path, "r", locking=False) as file:
        version = number_of(file, path, "format_version", None)
        if version != VERSION:
            raise limb_file_error(path, f"format_version is {version:g}", f"{VERSION}")
        header: dict[str, Any] = {name: text_of(file, path, name, TEXTS[name]) for name in TEXTS}
        header["note"] = " ".join(header["note"].split())
        header |= {name: number_of(file, path, name, NUMBERS[name]) for name in NUMBERS}
        header["synthetic"] = bool(header["synthetic"])
        header["per_unit_drive"] = _is(file, path, "answers", "drive", other="pulse")
        header["left"] = not _is(file, path, "hand", "right", other="left")
        header["band_hz"] = _band(file, path)
        responses = responses_in(file, path)
        header["shape"] = [int(n) for n in responses.shape]
        group = files.own_member(file, "map", files.Group)
        if group is None:
            raise limb_file_error(
                path, "it has no group 'map'", "one with outline, inputs and outputs"
            )
        header["hand_length_px"] = number_of(group, path, "hand_length", header["hand_length_mm"])
        for name, field in POINT_FIELDS.items():
            points = np.asarray(_dataset(group, path, name, 2, _MOST_ROWS)[()], np.float64)
            header[field] = [row.tolist() if np.isfinite(row).all() else None for row in points]
        names = files.own_member(file, "names", files.Group)
        for name, field in _NAMES.items():
            header[field] = [] if names is None else _names(names, path, name)
        return header


def export_limb(name: str, path: Path, *, progress: Progress = silent, stop: Stop = never) -> None:
    """Write an imported limb in the layout in which labs hand them over.

    Raises
    ------
    UnknownLimbError
        No imported limb is called so.
    FileFormatError, StorageError
        It is damaged, the disk is full, or the folder cannot be written.
    Stopped
        ``stop`` returned true.
    """
    limb_file = LimbFile(existing_path(name))
    limb = limb_file.limb
    n_bytes = 8 * int(np.prod(limb.shape)) + _HEADER_BYTES
    if path.parent.is_dir():
        # Where the disk is full, HDF5 ends the process.
        advice = "Free some space, or choose another disk."
        files.check_free_space(path, n_bytes, "the limb", advice)
    with replacing(path) as temporary, files.File(temporary, "w") as file:
        _put_header(file, limb)
        responses = file.create_dataset("responses", limb.shape, "<f8", track_times=False)
        for number in range(1, limb.n_inputs + 1):
            stop_if(stop)
            responses[number - 1] = limb_file.response(number)
            progress(number, limb.n_inputs, "Writing the responses")


def _put_header(file: Any, limb: OwnLimb) -> None:
    texts = {
        "format": FORMAT,
        "name": limb.name,
        "title": limb.title,
        "note": limb.note,
        "axes": limb.axes,
        "answers": "drive" if limb.per_unit_drive else "pulse",
        "hand": "left" if limb.left else "right",
    }
    for name, text in texts.items():
        file.attrs[name] = text
    for name in ("sample_rate_hz", "pre_trigger_delay_s", "hand_length_mm"):
        file.attrs[name] = getattr(limb, name)
    if limb.band_hz is not None:
        file.attrs["band_hz"] = limb.band_hz
    file.attrs["format_version"] = VERSION
    file.attrs["synthetic"] = int(limb.synthetic)
    group = file.create_group("map")
    group.attrs["hand_length"] = limb.hand_length_px
    for name, field in POINT_FIELDS.items():
        group.create_dataset(name, data=getattr(limb, field), track_times=False)
    for name, field in _NAMES.items():
        if getattr(limb, field):
            texts_of = np.array([name.encode() for name in getattr(limb, field)])
            file.require_group("names").create_dataset(name, data=texts_of, track_times=False)


def responses_in(file: Any, path: Path) -> Any:
    """Return the dataset of responses, which is not read yet."""
    return _dataset(file, path, "responses", 4, 2**20)


def _dataset(group: Any, path: Path, name: str, n_dimensions: int, longest: int) -> Any:
    dataset = files.own_member(group, name, files.Dataset)
    if dataset is None:
        raise limb_file_error(path, f"it has no dataset {quoted(name)}", "one of numbers")
    reason = reason_against(dataset, path.stat().st_size)
    if reason:
        raise limb_file_error(path, f"{quoted(name)} cannot be read: {reason}", "plain numbers")
    shape = tuple(int(n) for n in dataset.shape)
    if len(shape) != n_dimensions or not all(1 <= n <= longest for n in shape):
        expected = "(n, 2)" if n_dimensions == 2 else "(inputs, outputs, axes, taps)"
        raise limb_file_error(path, f"{quoted(name)} has shape {shape}", expected)
    return dataset


def text_of(group: Any, path: Path, name: str, default: str | None) -> str:
    """Return an attribute that is a short text; one without a default must be there."""
    value = attribute_of(group, path, name, default)
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    if not isinstance(value, str) or len(value) > _LONGEST_TEXT:
        raise limb_file_error(
            path, f"the attribute {quoted(name)} is {quoted(value)}", "a short text"
        )
    return value


def _is(group: Any, path: Path, name: str, usual: str, *, other: str) -> bool:
    """Return whether a text is the usual one, which it is where it is missing."""
    text = text_of(group, path, name, usual)
    if text not in (usual, other):
        raise limb_file_error(
            path, f"the attribute {quoted(name)} is {quoted(text)}", f"{usual} or {other}"
        )
    return text == usual


def number_of(group: Any, path: Path, name: str, default: float | None) -> float:
    """Return an attribute that is a number; one without a default must be there."""
    value = attribute_of(group, path, name, default)
    array = np.asarray(value)
    if array.size != 1 or array.dtype.kind not in "iufb" or not np.isfinite(array).all():
        raise limb_file_error(
            path, f"the attribute {quoted(name)} is {quoted(value)}", "one number"
        )
    return float(array.reshape(-1)[0])


def _band(group: Any, path: Path) -> list[float] | None:
    value = attribute_of(group, path, "band_hz", False)
    if value is False:
        return None
    array = np.asarray(value)
    if array.shape != (2,) or array.dtype.kind not in "iuf" or not np.isfinite(array).all():
        raise limb_file_error(
            path, f"the attribute 'band_hz' is {quoted(value)}", "two frequencies"
        )
    return [float(frequency) for frequency in array]


def attribute_of(group: Any, path: Path, name: str, default: Any) -> Any:
    """Return an attribute as Python has it; one without a default must be there."""
    if name not in group.attrs:
        if default is None:
            raise limb_file_error(path, f"it has no attribute {quoted(name)}", "one")
        return default
    if group.attrs.get_id(name).get_storage_size() > 4 * _LONGEST_TEXT:
        raise limb_file_error(
            path, f"the attribute {quoted(name)} is very long", "a text or a number"
        )
    value = group.attrs[name]
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.reshape(-1)[0]
    # As a person reads it: 5, not np.int64(5).
    return value.item() if isinstance(value, np.generic) else value


def _names(group: Any, path: Path, name: str) -> list[str]:
    dataset = files.own_member(group, name, files.Dataset)
    if dataset is None:
        return []
    shape = dataset.shape
    if shape is None or len(shape) != 1 or shape[0] > _MOST_NAMES or dataset.dtype.kind not in "SO":
        raise limb_file_error(
            path, f"'names/{name}' is no list of texts", "one text for each place"
        )
    values = dataset[()]
    return [
        value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
        for value in values
    ]


_OPENERS = {
    "NPY": arrays.opened_npy,
    "NPZ": arrays.opened_npz,
    "MATLAB": arrays.opened_matlab,
    "MATLAB 7.3": arrays.opened_hdf5,
    "HDF5": arrays.opened_hdf5,
}
#: Usual order of three and of four dimensions: i input, o output, a axis, t tap.
USUAL_ORDERS = {3: "iot", 4: "ioat"}
_KINDS, _MOST_ARRAYS = "iuf", 200


def arrays_of(path: Path) -> dict[str, Any]:
    """Return name, shape and rate of each array of three or four dimensions, rate and notes.

    None of tables and sound, which are read signal by signal.
    """
    if reader_of(path).name not in _OPENERS:
        return {"arrays": [], "rate_hz": None, "notes": []}
    with _OPENERS[reader_of(path).name](path) as members:
        descriptions = [
            {
                "name": member.name,
                "shape": [int(n) for n in member.array.shape],
                "rate_hz": member.rate_hz,
            }
            for member in members.members
            if len(member.array.shape) in (3, 4) and np.dtype(member.array.dtype).kind in _KINDS
        ]
        stated = stated_rate(members)
        return {
            "arrays": descriptions[:_MOST_ARRAYS],
            "rate_hz": stated[1] if stated else None,
            "notes": members.notes,
        }


def response_blocks(path: Path, array: str, order: str) -> Iterator[Floats]:
    """Yield the responses to one input after another, (n_outputs x n_axes, n_taps).

    Parameters
    ----------
    array
        Name of the array; empty: the responses of a file in the layout.
    order
        A letter for each dimension of the array, in the order of the file: i input, o output,
        a axis, t tap.
    """
    if array:
        yield from _array_blocks(path, array, order)
        return
    with files.File(path, "r", locking=False) as file:
        responses = responses_in(file, path)
        for number in range(responses.shape[0]):
            response = np.asarray(responses[number], np.float64)
            yield response.reshape(-1, response.shape[-1])


def _array_blocks(path: Path, name: str, order: str) -> Iterator[Floats]:
    with _OPENERS[reader_of(path).name](path) as members:
        array = next(member.array for member in members.members if member.name == name)
        shape = tuple(int(n) for n in array.shape)
        for number in range(shape[order.index("i")]):
            at: list[Any] = [slice(None)] * len(shape)
            at[order.index("i")] = number
            response = np.asarray(array[tuple(at)], np.float64)
            rest = order.replace("i", "")
            if "a" not in rest:
                response, rest = response[..., None], f"{rest}a"
            response = response.transpose([rest.index(letter) for letter in "oat"])
            yield response.reshape(-1, response.shape[-1])


_MOST_BYTES = 8 * 2**20
_MISSING = ("", "nan", "-", "none")


def points_of(path: Path) -> dict[str, Any]:
    """Return the points of a file for JSON: ``points``, rows of x and y or None, and ``names``.

    A CSV file has a point a row: x, y and, if wanted, a name; with a header its columns are found
    by the names ``x``, ``y`` and ``name``.  Of an SVG file the largest closed line is taken.
    ``y_down`` says whether y points down, as in SVG.
    """
    content = read_bytes(path, most=_MOST_BYTES)
    if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        try:
            line = outline_of(content)
        except ValueError as error:
            raise limb_file_error(path, str(error), "an SVG file with a path") from error
        if len(line) > _MOST_ROWS or not np.isfinite(line).all():
            raise limb_file_error(path, f"its line has {len(line)} points", f"at most {_MOST_ROWS}")
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
        rows = [row for row in read if row]
    except csv.Error as error:
        raise limb_file_error(path, f"it is not a table ({error})", "rows of x and y") from error
    if not 1 <= len(rows) <= _MOST_ROWS:
        raise limb_file_error(
            path, f"it has {len(rows)} rows", f"1 to {_MOST_ROWS} rows of x and y"
        )
    return rows


def _columns(rows: list[list[str]]) -> tuple[int, int, int | None, list[list[str]]]:
    header = [cell.strip().lower() for cell in rows[0]]
    if "x" in header and "y" in header:
        name = header.index("name") if "name" in header else None
        return header.index("x"), header.index("y"), name, rows[1:]
    return 0, 1, 2, rows


def _point(path: Path, row: list[str], x: int, y: int, number: int) -> list[float] | None:
    cells = [row[k].strip() if k < len(row) else "" for k in (x, y)]
    if all(cell.lower() in _MISSING for cell in cells):
        return None
    try:
        point = [float(cell) for cell in cells]
    except ValueError as error:
        raise limb_file_error(
            path, f"row {number} has {quoted(','.join(cells))}", "two numbers, x and y"
        ) from error
    if not np.isfinite(point).all():
        raise limb_file_error(
            path, f"row {number} has {quoted(','.join(cells))}", "two finite numbers"
        )
    return point


#: How far the hull stays away from the places, in their extent.
_MARGIN = 0.12


def hull_around(places: Floats) -> Floats:
    """Return the convex hull of places, (n, 2), moved outwards; NaN where one is missing."""
    points = places[np.isfinite(places).all(axis=1)]
    if len(points) < 1:
        raise InvalidInputError("no place is known, expected some, or an outline")
    reach = _MARGIN * max(float(np.ptp(points, axis=0).max()), 1.0)
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = reach * np.column_stack((np.cos(around), np.sin(around)))
    spread = (points[:, None] + ring[None]).reshape(-1, 2)
    return np.asarray(spread[scipy.spatial.ConvexHull(spread).vertices])
