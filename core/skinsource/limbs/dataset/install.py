"""Install the dataset from files, or download them first, each continued where it was cut.

The published MATLAB files are v7 or v7.3.  Files of v7.3 are HDF5 of the oldest kind, whose indices
nothing checks.  Where one bit of an index has flipped, HDF5 returns zeros for the piece that it no
longer finds, without an error.  So each piece of each array is checked: once, in its place.
"""

import hashlib
import io
import itertools
import json
import math
import zlib
from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from zipfile import ZipFile, ZipInfo

import numpy as np

from skinsource.base import files
from skinsource.base.assets import user_folder
from skinsource.base.conventions import N_AXES, N_INPUTS, N_OUTPUTS, N_TAPS, VOLAR_OUTPUTS, Floats
from skinsource.base.errors import DatasetError, DownloadError, counted, printable
from skinsource.base.extras import package_of_extra
from skinsource.base.files import is_file, make_folder, replacing, storage_errors_of
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.dataset import published
from skinsource.limbs.dataset.published import (
    ADVICE,
    LIMBS,
    MASK_FILES,
    MASK_SHAPES,
    N_VERTICES,
    RemoteFile,
    check_map_files,
    checksum_of,
    download_folder,
    find_downloaded,
    map_name,
    mask_name,
    published_files,
    unpublished_files,
)
from skinsource.limbs.dataset.store import StoreInfo, describe

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
    return array.astype(np.float64, copy=False).transpose(1, 2, 0)


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


STOPPED = "Installing was stopped; nothing was changed."


def install(
    source: Path,
    *,
    folder: Path | None = None,
    unpublished: bool = False,
    progress: Progress = silent,
    stop: Stop = never,
) -> StoreInfo:
    """Make the store from what was downloaded, in place of an earlier one.

    Everything is checked before the first byte is written, and the store is moved into place
    whole: after any error, and after a cancel, what was there before is there still.

    Parameters
    ----------
    source
        Folder that holds ``impulseResponses.mat`` and the toolbox's folder ``visualization``,
        or the file itself with that folder beside it.
    folder
        Where the store goes; the user's data folder when not given.
    unpublished
        Whether map files may be others than the published ones.  Responses may always; the store
        keeps what was not the published content, see `StoreInfo.unpublished`.
    progress, stop
        Called with (done, total, text); asked between steps.

    Raises
    ------
    DatasetError
        A file of the download is not what it should be, or, if of the map, not the published one.
    StorageError
        No such source, full disk, folder that cannot be written.
    MissingExtraError
        mat-io is not installed.
    Stopped
        ``stop`` returned true.
    """
    downloaded = find_downloaded(source)
    changed = unpublished_files(downloaded)
    if not unpublished:
        check_map_files(downloaded, changed)
    folder = user_folder() if folder is None else folder
    make_folder(folder)
    path = folder / published.FILE_NAME
    stop_if(stop, STOPPED)
    progress(0, 2 * N_ROWS, f"Reading {downloaded.responses.name}")
    maps = read_map_files(downloaded.map_folder)
    responses = read_responses(
        downloaded.responses, lambda done, _, text: progress(done, 2 * N_ROWS, text), stop
    )
    arrays = {
        **maps,
        **{published.response_name(*place): response for place, response in responses.items()},
    }
    about = _about(downloaded.responses, changed)
    with replacing(path) as temporary, ZipFile(temporary, "w") as store:
        store.writestr(ZipInfo(published.ABOUT), json.dumps(about))
        for done, (name, (_, kind)) in enumerate(published.ARRAYS.items(), start=1):
            stop_if(stop, STOPPED)
            content = io.BytesIO()
            np.save(content, np.ascontiguousarray(arrays[name], kind), allow_pickle=False)
            store.writestr(ZipInfo(f"{name}.npy"), content.getvalue())
            total = len(published.ARRAYS)
            progress(N_ROWS + N_ROWS * done // total, 2 * N_ROWS, f"Writing {path.name}")
    return describe(path)


def _about(responses: Path, unpublished: tuple[str, ...]) -> dict[str, object]:
    return {
        "format": published.FORMAT,
        "format_version": published.FORMAT_VERSION,
        # Names of files need not be texts.
        "source_name": responses.name.encode(errors="backslashreplace").decode(),
        "source_sha256": checksum_of(responses, "sha256").partition(":")[2],
        "source_bytes": responses.stat().st_size,
        "unpublished": list(unpublished),
        "installed_at": datetime.now(UTC).isoformat(timespec="seconds"),
    }


_DOWNLOAD_STOPPED = (
    "Downloading was stopped; 'skinsource dataset fetch' continues where it stopped."
)
_GO_ON = "Check the connection and run 'skinsource dataset fetch' again"
_CONNECT_S, _READ_S = 10.0, 30.0
_PIECE_BYTES = 2**16
_ALL, _PART, _RANGE_REFUSED = 200, 206, 416


def download(file: RemoteFile, part: Path, *, report: Callable[[int], None], stop: Stop) -> None:
    """Bring ``part`` to its full length, asking only for the bytes it lacks.

    A lost connection is taken up again as long as bytes keep coming; what has arrived stays in
    ``part`` after an error or a cancel.  The content is not checked here.

    Parameters
    ----------
    report
        Called with the number of bytes in ``part``.

    Raises
    ------
    DownloadError
        No connection, an answer other than the file, or a file of another length.
    StorageError
        ``part`` cannot be written.
    Stopped
        ``stop`` returned true.
    """
    requests = package_of_extra("requests", "dataset")
    network = package_of_extra("urllib3.exceptions", "dataset")
    with requests.Session() as session:
        while (before := _size(part)) < file.size_bytes:
            reason = "the answer ended early"
            try:
                continued = _receive(session, file, part, report, stop)
            except (OSError, network.HTTPError) as error:  # requests' own errors are OSErrors
                continued, reason = True, printable(error)
            if not continued:
                part.unlink()
            elif _size(part) <= before:
                raise DownloadError(_failure_text(file, part, reason))
    if _size(part) > file.size_bytes:
        part.unlink()
        raise DownloadError(
            f"{file.url}: sent more than the {file.size_bytes} bytes expected; what came was "
            f"deleted. {_GO_ON}."
        )


def _receive(
    session: Any, file: RemoteFile, part: Path, report: Callable[[int], None], stop: Stop
) -> bool:
    """Append what the server sends; False if it cannot continue where ``part`` ends."""
    stop_if(stop, _DOWNLOAD_STOPPED)
    have = _size(part)
    # Compressed answers could not be continued at a byte of the file.
    headers = {"Accept-Encoding": "identity"} | ({"Range": f"bytes={have}-"} if have else {})
    with session.get(
        file.url, headers=headers, stream=True, timeout=(_CONNECT_S, _READ_S)
    ) as answer:
        other_bytes = answer.status_code == _PART and _first_byte(answer) != have
        if have and (other_bytes or answer.status_code == _RANGE_REFUSED):
            return False
        _check_answer(answer, file, have)
        have = have if answer.status_code == _PART else 0
        with storage_errors_of(part):
            out = part.open("ab" if have else "wb")
        with out:
            # What has come, at once: for a larger piece a slow server would keep the user waiting.
            while piece := answer.raw.read1(_PIECE_BYTES, decode_content=True):
                stop_if(stop, _DOWNLOAD_STOPPED)
                with storage_errors_of(part):
                    out.write(piece)
                    out.flush()
                have += len(piece)
                report(have)
                if have > file.size_bytes:
                    break
    return True


def _check_answer(answer: Any, file: RemoteFile, have: int) -> None:
    if answer.status_code not in (_ALL, _PART):
        raise DownloadError(
            f"{file.url}: the server answered {answer.status_code} {printable(answer.reason)}, "
            f"expected the file. {_GO_ON}, later perhaps; or download it by hand and use "
            "'skinsource dataset install PATH'."
        )
    announced = answer.headers.get("Content-Length")
    encoded = answer.headers.get("Content-Encoding", "identity") != "identity"
    missing = file.size_bytes - (have if answer.status_code == _PART else 0)
    if announced is not None and not encoded and announced != str(missing):
        raise DownloadError(
            f"{file.url}: the server offers {printable(announced)} bytes, expected {missing}. "
            "This is not the published file; download it by hand and use 'skinsource dataset "
            "install PATH'."
        )


def _first_byte(answer: Any) -> int | None:
    # Content-Range: bytes 100-199/200
    unit, _, span = answer.headers.get("Content-Range", "").partition(" ")
    first = span.partition("-")[0]
    return int(first) if unit == "bytes" and first.isdigit() else None


def _failure_text(file: RemoteFile, part: Path, reason: str) -> str:
    have = _size(part)
    progress_note = f"; {have} of {file.size_bytes} bytes are downloaded" if have else ""
    return f"{file.url}: cannot be downloaded ({reason}){progress_note}. {_GO_ON}."


def _size(part: Path) -> int:
    return part.stat().st_size if part.exists() else 0


def fetch(
    *,
    files: tuple[RemoteFile, ...] | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> StoreInfo:
    """Download the measured dataset and the toolbox's map files, check and install them.

    Files that are there already and whole are not downloaded again; a file that was cut is
    continued.

    Parameters
    ----------
    files
        What to download; the published files when not given.
    progress, stop
        Called with (done, total, text), in bytes while downloading; asked between pieces.

    Raises
    ------
    DownloadError
        The network or the server did not deliver, or a checksum does not match.
    StorageError
        Full disk, folder that cannot be written.
    MissingExtraError
        An optional package is missing; found out before anything is downloaded.
    Stopped
        ``stop`` returned true; what has arrived is kept for the next time.
    """
    for name in ("requests", "matio"):
        package_of_extra(name, "dataset")
    files = published_files() if files is None else files
    downloads = download_folder()
    total, before = sum(file.size_bytes for file in files), 0
    for file in files:
        text = f"Downloading {file.name}"
        progress(before, total, text)
        path = downloads / file.name
        make_folder(path.parent)
        if not is_file(path) or _checksum_of(path, file) != file.checksum:
            part = path.with_name(f"{path.name}.part")
            report = partial(_report_all, progress, before, total, text)
            download(file, part, report=report, stop=stop)
            _check_content(file, part)
            with storage_errors_of(path):
                part.replace(path)
        before += file.size_bytes
    progress(total, total, "Downloaded")
    # Each file was compared with ``files`` when it came.
    return install(downloads, unpublished=True, progress=progress, stop=stop)


def _report_all(progress: Progress, before: int, total: int, text: str, n_bytes: int) -> None:
    progress(before + n_bytes, total, text)


def _checksum_of(path: Path, file: RemoteFile) -> str:
    return checksum_of(path, file.checksum.partition(":")[0])


def _check_content(file: RemoteFile, part: Path) -> None:
    checksum = _checksum_of(part, file)
    if checksum != file.checksum:
        part.unlink()
        algorithm, _, expected = file.checksum.partition(":")
        raise DownloadError(
            f"{file.url}: what was downloaded is not the published file: its {algorithm} is "
            f"{checksum.partition(':')[2]}, expected {expected}. It was deleted; run 'skinsource "
            "dataset fetch' again."
        )
