"""The HDF5 file that a lab hands over: `docs/limbs.md` describes it for people.

::

    /                  format, format_version, name, title, note, sample_rate_hz, axes,
                       pre_trigger_delay_s, band_hz, answers, hand, hand_length_mm, synthetic
    /responses         (n_inputs, n_outputs, n_axes, n_taps) float32 or float64, m/s²
    /map               hand_length
    /map/outline       (n_vertices, 2)
    /map/inputs        (n_inputs, 2)
    /map/outputs       (n_outputs, 2), NaN where an output has no place on the back
    /names/inputs      (n_inputs,) texts, may be missing; so may outputs
"""

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import StorageError
from skinsource.files import hdf5, named, replacing
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.limb_import.refusing import refusal
from skinsource.own_limbs import OwnLimb
from skinsource.own_limbs.limb_file import LimbFile
from skinsource.own_limbs.store import existing_path
from skinsource.quoting import quoted
from skinsource.recordings.hdf5_file import reason_against

FORMAT, VERSION = "skinsource limb", 1
#: Attributes: texts, and numbers; those without a default must be there.
TEXTS = {"name": "", "title": "", "note": "", "axes": None, "answers": "drive", "hand": "right"}
NUMBERS = {
    "sample_rate_hz": None,
    "pre_trigger_delay_s": 0.0,
    "hand_length_mm": None,
    "synthetic": 0.0,
}
_ONLY_OF_LIMBS = ("format_version", "hand_length_mm")
_POINTS = {"outline": "outline", "inputs": "input_positions", "outputs": "output_positions"}
_NAMES = {"inputs": "input_names", "outputs": "output_names"}
_LONGEST_TEXT, _MOST_NAMES, _MOST_ROWS = 4000, 512, 20_001
_BESIDE_BYTES = 2**20


def is_limb_file(path: Path) -> bool:
    """Whether an HDF5 file says that it holds a limb; for the child process.

    Raises
    ------
    RecordingError
        It says what only limbs do, but not that it is one: as an array it would lose the rest.
    """
    with hdf5.File(path, "r", locking=False) as file:
        if "format" in file.attrs and _text(file, path, "format", "") == FORMAT:
            return True
        if any(name in file.attrs for name in _ONLY_OF_LIMBS):
            found = _text(file, path, "format", None)
            raise refusal(path, f"the attribute 'format' is {quoted(found)}", quoted(FORMAT))
        return False


def header_of(path: Path) -> dict[str, Any]:
    """All but the responses, as JSON carries it; for the child process.

    Raises
    ------
    RecordingError
        It does not have the layout.
    """
    with hdf5.File(path, "r", locking=False) as file:
        version = _number(file, path, "format_version", None)
        if version != VERSION:
            raise refusal(path, f"format_version is {version:g}", f"{VERSION}")
        header: dict[str, Any] = {name: _text(file, path, name, TEXTS[name]) for name in TEXTS}
        header |= {name: _number(file, path, name, NUMBERS[name]) for name in NUMBERS}
        header["band_hz"] = _band(file, path)
        responses = _responses(file, path)
        header["shape"] = [int(n) for n in responses.shape]
        group = hdf5.own_member(file, "map", hdf5.Group)
        if group is None:
            raise refusal(path, "it has no group 'map'", "one with outline, inputs and outputs")
        header["hand_length"] = _number(group, path, "hand_length", header["hand_length_mm"])
        for name, field in _POINTS.items():
            points = np.asarray(_dataset(group, path, name, 2, _MOST_ROWS)[()], np.float64)
            header[field] = _without_nan(points)
        names = hdf5.own_member(file, "names", hdf5.Group)
        for name, field in _NAMES.items():
            header[field] = [] if names is None else _names(names, path, name)
        return header


def response_blocks(path: Path) -> Iterator[Floats]:
    """Responses to one input after another, (n_outputs x n_axes, n_taps); for the child process."""
    with hdf5.File(path, "r", locking=False) as file:
        responses = _responses(file, path)
        for number in range(responses.shape[0]):
            found = np.asarray(responses[number], np.float64)
            yield found.reshape(-1, found.shape[-1])


def export_limb(name: str, path: Path, *, progress: Progress = silent, stop: Stop = never) -> None:
    """Write an imported limb in the layout in which labs hand them over.

    Raises
    ------
    UnknownLimbError
        No imported limb is called so.
    FileFormatError, StorageError
        It is damaged, the disk is full, or the folder cannot be written.
    Stopped
        ``stop`` said so.
    """
    held = LimbFile(existing_path(name))
    limb = held.limb
    n_bytes = 8 * int(np.prod(limb.shape)) + _BESIDE_BYTES
    free_bytes = shutil.disk_usage(path.resolve().parent).free if path.parent.is_dir() else n_bytes
    if free_bytes < n_bytes:
        # Where the disk is full, HDF5 ends the process.
        raise StorageError(
            f"{named(path)}: the limb takes {n_bytes / 1e9:.2f} GB, and {free_bytes / 1e9:.2f} GB "
            "are free there. Free some space, or choose another disk."
        )
    with replacing(path) as temporary, hdf5.File(temporary, "w") as file:
        _put_header(file, limb)
        responses = file.create_dataset("responses", limb.shape, "<f8", track_times=False)
        for number in range(1, limb.n_inputs + 1):
            stop_if(stop)
            responses[number - 1] = held.response(number)
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
    for name, field in _POINTS.items():
        group.create_dataset(name, data=getattr(limb, field), track_times=False)
    for name, field in _NAMES.items():
        if getattr(limb, field):
            texts_of = np.array([one.encode() for one in getattr(limb, field)])
            file.require_group("names").create_dataset(name, data=texts_of, track_times=False)


def _responses(file: Any, path: Path) -> Any:
    return _dataset(file, path, "responses", 4, 2**20)


def _dataset(group: Any, path: Path, name: str, n_dimensions: int, longest: int) -> Any:
    found = hdf5.own_member(group, name, hdf5.Dataset)
    if found is None:
        raise refusal(path, f"it has no dataset {quoted(name)}", "one of numbers")
    reason = reason_against(found, path.stat().st_size)
    if reason:
        raise refusal(path, f"{quoted(name)} cannot be read: {reason}", "plain numbers")
    shape = tuple(int(n) for n in found.shape)
    if len(shape) != n_dimensions or not all(1 <= n <= longest for n in shape):
        expected = "(n, 2)" if n_dimensions == 2 else "(inputs, outputs, axes, taps)"
        raise refusal(path, f"{quoted(name)} has shape {shape}", expected)
    return found


def _text(group: Any, path: Path, name: str, default: str | None) -> str:
    value = _attribute(group, path, name, default)
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    if not isinstance(value, str) or len(value) > _LONGEST_TEXT:
        raise refusal(path, f"the attribute {quoted(name)} is {quoted(value)}", "a short text")
    return value


def _number(group: Any, path: Path, name: str, default: float | None) -> float:
    value = _attribute(group, path, name, default)
    array = np.asarray(value)
    if array.size != 1 or array.dtype.kind not in "iufb" or not np.isfinite(array).all():
        raise refusal(path, f"the attribute {quoted(name)} is {quoted(value)}", "one number")
    return float(array.reshape(-1)[0])


def _band(group: Any, path: Path) -> list[float] | None:
    value = _attribute(group, path, "band_hz", False)
    if value is False:
        return None
    array = np.asarray(value)
    if array.shape != (2,) or array.dtype.kind not in "iuf" or not np.isfinite(array).all():
        raise refusal(path, f"the attribute 'band_hz' is {quoted(value)}", "two frequencies")
    return [float(one) for one in array]


def _attribute(group: Any, path: Path, name: str, default: Any) -> Any:
    if name not in group.attrs:
        if default is None:
            raise refusal(path, f"it has no attribute {quoted(name)}", "one")
        return default
    if group.attrs.get_id(name).get_storage_size() > 4 * _LONGEST_TEXT:
        raise refusal(path, f"the attribute {quoted(name)} is very long", "a text or a number")
    value = group.attrs[name]
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.reshape(-1)[0]
    # As a person reads it: 5, not np.int64(5).
    return value.item() if isinstance(value, np.generic) else value


def _names(group: Any, path: Path, name: str) -> list[str]:
    found = hdf5.own_member(group, name, hdf5.Dataset)
    if found is None:
        return []
    shape = found.shape
    if shape is None or len(shape) != 1 or shape[0] > _MOST_NAMES or found.dtype.kind not in "SO":
        raise refusal(path, f"'names/{name}' is no list of texts", "one text for each place")
    values = found[()]
    return [
        one.decode("utf-8", "replace") if isinstance(one, bytes) else str(one) for one in values
    ]


def _without_nan(points: Floats) -> list[list[float] | None]:
    return [row.tolist() if np.isfinite(row).all() else None for row in points]
