"""Read and check the published MATLAB files, v7 or v7.3: the map files and the responses.

Files of v7.3 are HDF5 of the oldest kind, whose indices nothing checks.  Where one bit of an index
has flipped, HDF5 returns zeros for the piece that it no longer finds, without an error.  So each
piece of each array is checked: once, in its place.
"""

import hashlib
import itertools
import math
import zlib
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from skinsource.base import files
from skinsource.base.conventions import (
    N_AXES,
    N_INPUTS,
    N_OUTPUTS,
    N_TAPS,
    VOLAR_OUTPUTS,
    Floats,
)
from skinsource.base.errors import DatasetError, counted, printable
from skinsource.base.extras import package_of_extra
from skinsource.base.job import Progress, Stop, stop_if
from skinsource.limbs.dataset.published import (
    ADVICE,
    LIMBS,
    MASK_FILES,
    MASK_SHAPES,
    N_VERTICES,
    map_name,
    mask_name,
)

if TYPE_CHECKING:
    import h5py


# Numbers of HDF5's filters.
_DEFLATE, _SHUFFLE = 1, 2

WHAT_TO_DO = "The download may be cut short; run 'skinsource dataset fetch' again."


class _Span(NamedTuple):
    """Where some values lie in the file."""

    first_byte: int
    size_bytes: int
    name: str


def check_contiguous(path: Path) -> None:
    """Raise if a piece of an array of a MATLAB v7.3 file is missing, misplaced or shared.

    Other files pass: those of MATLAB v7 check themselves.

    Raises
    ------
    DatasetError
        Says which array and piece.
    Exception
        Whatever HDF5 raises at a damaged file.
    """
    if not files.is_hdf5(path):
        return
    spans: list[_Span] = []

    def look_at(_: str, part: Any) -> None:
        if isinstance(part, files.Dataset):
            spans.extend(_spans_of(part, path))

    with files.File(path, "r", locking="best-effort") as file:
        file.visititems(look_at)
    for span, other in pairwise(sorted(spans)):
        if span.first_byte + span.size_bytes > other.first_byte:
            raise _damaged(path, f"{span.name} and {other.name} lie in the same place")


def _spans_of(dataset: "h5py.Dataset", path: Path) -> list[_Span]:
    """Return where the values of an array lie; none where they lie in the header."""
    name = str(dataset.name)
    kind = dataset.id.get_type()
    # What is neither a number nor a text has parts, which are numbers in files that MATLAB wrote.
    is_number = kind.get_class() in (files.h5t.INTEGER, files.h5t.FLOAT)
    if is_number and not kind.equal(files.h5t.py_create(dataset.dtype)):
        raise _damaged(path, f"{name} holds numbers of an unknown kind")
    how = dataset.id.get_create_plist()
    layout = how.get_layout()
    if layout == files.h5d.COMPACT or not dataset.size:
        return []
    if layout == files.h5d.CHUNKED:
        return _chunks_of(dataset, path)
    if layout != files.h5d.CONTIGUOUS or how.get_external_count():
        raise _damaged(path, f"{name} lies in other files")
    first_byte, size_bytes = dataset.id.get_offset(), dataset.id.get_storage_size()
    if first_byte is None or size_bytes != dataset.size * kind.get_size():
        raise _damaged(path, f"{name} is not there, or not as a whole")
    return [_Span(first_byte, size_bytes, name)]


def _chunks_of(dataset: "h5py.Dataset", path: Path) -> list[_Span]:
    name, shape, chunk = str(dataset.name), dataset.shape, dataset.chunks
    assert chunk is not None  # noqa: S101, its layout says so
    how = dataset.id.get_create_plist()
    filters = tuple(how.get_filter(k)[0] for k in range(how.get_nfilters()))
    if filters not in ((), (_DEFLATE,), (_SHUFFLE, _DEFLATE)):
        raise _damaged(path, f"{name} is packed in an unknown way")
    size_bytes = math.prod(chunk) * dataset.dtype.itemsize
    expected = math.prod(-(-length // step) for length, step in zip(shape, chunk, strict=True))
    n_chunks = dataset.id.get_num_chunks()
    if n_chunks != expected:
        raise _damaged(path, f"{name} has {n_chunks} pieces, expected {expected}")
    spans = []
    for k in range(n_chunks):
        piece = dataset.id.get_chunk_info(k)
        spans.append(_Span(piece.byte_offset, piece.size, f"{name}, piece {k + 1}"))
    starts = (range(0, length, step) for length, step in zip(shape, chunk, strict=True))
    for place in itertools.product(*starts):
        # The index is used as it is when the array is read; a list of its entries leaves out parts.
        if _unpacked_bytes(_piece_at(dataset, place), filters) != size_bytes:
            raise _damaged(path, f"the piece of {name} at {place} is missing or damaged")
    return spans


def _piece_at(dataset: "h5py.Dataset", place: tuple[int, ...]) -> bytes:
    """Return a piece's bytes as they lie in the file; none if missing or packed otherwise."""
    try:
        mask, packed = dataset.id.read_direct_chunk(place)
    except (OSError, RuntimeError):
        return b""
    return b"" if mask else packed


def _unpacked_bytes(packed: bytes, filters: tuple[int, ...]) -> int:
    """Return the length of the values in a piece; -1 where they are damaged."""
    if not filters:
        return len(packed)
    try:
        return len(zlib.decompress(packed))
    except zlib.error:
        return -1


def _damaged(path: Path, what: str) -> DatasetError:
    return DatasetError(f"{path.name}: is damaged: {what}. {WHAT_TO_DO}")


def read_variable(path: Path, name: str) -> Any:
    """Give the variable ``name`` of a MATLAB file: an array, a table (`DataFrame`), an object.

    Raises
    ------
    MissingExtraError
        mat-io is not installed.
    StorageError
        The file cannot be opened.
    DatasetError
        It is no MATLAB file, is cut off or damaged, or does not hold the variable.
    """
    matio = package_of_extra("matio", "dataset")
    with files.storage_errors_of(path, reading=ADVICE), path.open("rb") as opened:
        opened.read(1)
    try:
        check_contiguous(path)
        variables = matio.load_from_mat(str(path))
    except DatasetError:
        raise
    except Exception as error:  # on a damaged file the parser may fail in any way
        reason = printable(error) or type(error).__name__
        raise DatasetError(
            f"{path.name}: cannot be read as a MATLAB file ({reason}), expected MAT v7 or v7.3. "
            f"{WHAT_TO_DO}"
        ) from error
    if name not in variables:
        names = ", ".join(sorted(variables)) or "nothing"
        raise DatasetError(
            f"{path.name}: holds {names}, expected a variable '{name}' (is this the right file?). "
            f"{WHAT_TO_DO}"
        )
    return variables[name]


def read_map_files(folder: Path) -> dict[str, Floats]:
    """Read and check the map files.

    Returns
    -------
    dict
        Names of the store to arrays; coordinates are outline pixels, y up.  ``visibility``
        (1505, 72): distance from outline vertex to output where the one sees the other, else NaN.
        Masks: one per limb, (rows, columns) of 1 mm, row and column 0 at the lowest y and x:
        1 on the skin, 0 elsewhere.

    Raises
    ------
    DatasetError
        A file is not what it should be.
    """
    volar = np.isin(np.arange(1, N_OUTPUTS + 1), VOLAR_OUTPUTS)
    surface = folder / "surface.mat"
    shape = read_variable(surface, "surface")
    try:
        vertices = shape.properties["any"][0, 0]["Vertices"]
    except (AttributeError, KeyError, IndexError, TypeError, ValueError) as error:
        raise DatasetError(
            f"{surface.name}: 'surface' is no polyshape with Vertices (is this the right file?). "
            f"{WHAT_TO_DO}"
        ) from error
    outline = _numbers(surface, vertices, (N_VERTICES, 2), "vertices, x and y")
    _check(surface, np.isfinite(outline).all(), "finite coordinates")

    path = folder / "outputLocations.mat"
    outputs = _read(path, "outputLocations", (N_OUTPUTS, 2), "outputs, x and y")
    _check(path, np.isfinite(outputs[~volar]).all(), "finite coordinates")
    _check(
        path,
        np.isnan(outputs[volar]).all(),
        f"NaN for the outputs {VOLAR_OUTPUTS[0]} to {VOLAR_OUTPUTS[-1]}, which lie on the other "
        "side of the hand",
    )

    path = folder / "inputLocations.mat"
    inputs = _read(path, "inputLocations", (N_INPUTS, 2), "inputs, x and y")
    _check(path, np.isfinite(inputs).all(), "finite coordinates")

    path = folder / "adjacencyMatrix.mat"
    visibility = _read(path, "adjacencyMatrix", (N_VERTICES, N_OUTPUTS), "vertices, outputs")
    seen = ~np.isnan(visibility)
    distances = visibility[seen]
    _check(
        path,
        np.isfinite(distances).all() and (distances >= 0).all() and seen.any(axis=1).all(),
        "distances of 0 px or more, NaN where a vertex does not see an output, and at least one "
        "output seen from each vertex",
    )

    masks = {}
    for limb, name, mask_shape in zip(LIMBS, MASK_FILES, MASK_SHAPES, strict=True):
        mask = _read(folder / name, "mask", mask_shape, "rows, columns of 1 mm")
        _check(folder / name, np.isin(mask, (0.0, 1.0)).all(), "a mask of zeros and ones")
        masks[mask_name(limb)] = mask
    return {
        **masks,
        map_name("outline"): outline,
        map_name("output_positions"): outputs,
        map_name("input_positions"): inputs,
        map_name("visibility"): visibility,
    }


def _read(path: Path, name: str, shape: tuple[int, ...], axes: str) -> Floats:
    return _numbers(path, read_variable(path, name), shape, axes)


def _numbers(path: Path, value: Any, shape: tuple[int, ...], axes: str) -> Floats:
    array = np.asarray(value)
    if array.shape != shape or array.dtype.kind not in "fiub":
        raise DatasetError(
            f"{path.name}: has shape {array.shape} of {array.dtype}, expected {shape} of double "
            f"({axes}). {WHAT_TO_DO}"
        )
    return np.ascontiguousarray(array, dtype=np.float64)


def _check(path: Path, right: np.bool_, expected: str) -> None:
    if not right:
        raise DatasetError(f"{path.name}: holds other numbers, expected {expected}. {WHAT_TO_DO}")


TABLE = "dataTable"
COLUMNS = ("Data", "Model", "Location")
N_LIMBS = 4
N_ROWS = N_LIMBS * N_INPUTS
SHAPE = (N_TAPS, N_OUTPUTS, N_AXES)

#: (limb, input location), both from 1, to impulse responses (72 outputs, 3 axes, 522 taps).
Responses = dict[tuple[int, int], Floats]


def read_responses(path: Path, progress: Progress, stop: Stop) -> Responses:
    """Read and check ``impulseResponses.mat``, in either MATLAB encoding.

    Returns
    -------
    dict
        (limb, input location) to views of shape (72 outputs, 3 axes, 522 taps), in m/s².

    Raises
    ------
    DatasetError
        The file or a row is not what it should be.
    """
    return check_table(read_variable(path, TABLE), path.name, progress, stop)


def check_table(table: Any, file_name: str, progress: Progress, stop: Stop) -> Responses:
    """Check every row of the table: numbers, shape, finiteness, and that each limb is complete."""
    absent = [column for column in COLUMNS if column not in getattr(table, "columns", ())]
    if absent:
        raise DatasetError(
            f"{file_name}: {TABLE} has no column {', '.join(absent)}; expected a table with the "
            f"columns {', '.join(COLUMNS)} (is this the right file?). {WHAT_TO_DO}"
        )
    responses: Responses = {}
    # Two measurements are never the same in every digit: one was put in place of the other.
    earlier: dict[bytes, str] = {}
    rows = zip(*(table[column] for column in COLUMNS), strict=True)
    for number, (data, model, location) in enumerate(rows, start=1):
        stop_if(stop, "Installing was stopped; nothing was changed.")
        where = f"{file_name}: row {number}"
        limb = _whole_number(model, N_LIMBS, f"{where} has Model")
        place = _whole_number(location, N_INPUTS, f"{where} has Location")
        where = f"{where} (model {limb}, location {place})"
        if (limb, place) in responses:
            raise DatasetError(
                f"{where} repeats an earlier row, expected each model and location once. "
                f"{WHAT_TO_DO}"
            )
        responses[limb, place] = response = _response(data, where)
        twin = earlier.setdefault(hashlib.sha256(response.tobytes()).digest(), where)
        if twin != where and response.any():
            raise DatasetError(
                f"{where} holds the values of {twin.removeprefix(f'{file_name}: ')}, expected its "
                f"own. {WHAT_TO_DO}"
            )
        progress(number, N_ROWS, f"Checking limb {limb}, input {place}")
    _check_complete(responses, file_name)
    return responses


def _response(data: Any, where: str) -> Floats:
    array = np.asarray(data)
    if array.shape != SHAPE:
        raise DatasetError(
            f"{where} has shape {array.shape}, expected {SHAPE} (taps, outputs, axes). {WHAT_TO_DO}"
        )
    if array.dtype.kind != "f":
        raise DatasetError(
            f"{where} holds values of type {array.dtype}, expected double. {WHAT_TO_DO}"
        )
    finite = np.isfinite(array)
    if not finite.all():
        tap, output, axis = (int(k) + 1 for k in np.argwhere(~finite)[0])
        not_finite = counted(int(np.count_nonzero(~finite)), "value")
        raise DatasetError(
            f"{where} holds {not_finite} not finite, the first at "
            f"tap {tap}, output {output}, axis {axis}; expected finite numbers only. {WHAT_TO_DO}"
        )
    floats: Floats = array.astype(np.float64, copy=False)
    return floats.transpose(1, 2, 0)


def _whole_number(value: Any, highest: int, what: str) -> int:
    array = np.asarray(value)
    if array.size == 1 and array.dtype.kind in "fiu":
        number = array.item()
        if 1 <= number <= highest and number == int(number):
            return int(number)
    raise DatasetError(f"{what} {value!s}, expected a whole number 1 to {highest}. {WHAT_TO_DO}")


def _check_complete(responses: Responses, file_name: str) -> None:
    expected = ((limb, place) for limb in range(1, 5) for place in range(1, N_INPUTS + 1))
    missing = [pair for pair in expected if pair not in responses]
    if missing:
        limb, place = missing[0]
        raise DatasetError(
            f"{file_name}: has {len(responses)} of {N_ROWS} rows, the first missing one is model "
            f"{limb}, location {place}; expected one row for each of the models 1 to {N_LIMBS} "
            f"and the locations 1 to {N_INPUTS}. {WHAT_TO_DO}"
        )
