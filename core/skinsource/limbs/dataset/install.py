"""Install the dataset: read the download, check it, convert it, and move the store into place."""

import io
import os
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.base import files
from skinsource.base.assets import user_folder
from skinsource.base.files import make_folder, replacing
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.dataset import published
from skinsource.limbs.dataset.matlab_files import (
    N_ROWS,
    MapFiles,
    Responses,
    read_map_files,
    read_responses,
)
from skinsource.limbs.dataset.published import (
    check_map_files,
    checksum_of,
    find_downloaded,
    unpublished_files,
)
from skinsource.limbs.dataset.store import StoreInfo, describe

STOPPED = "Installing was stopped; nothing was changed."
_PIECE_BYTES = 4 * 2**20


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
    image = _image(responses, maps, _origin(downloaded.responses, changed))
    stop_if(stop, STOPPED)
    _write(path, image, progress, stop)
    return describe(path)


def _write(path: Path, image: bytes, progress: Progress, stop: Stop) -> None:
    with replacing(path) as temporary, temporary.open("wb") as out:
        for done, piece in _pieces(image):
            stop_if(stop, STOPPED)
            out.write(piece)
            progress(N_ROWS + N_ROWS * done // len(image), 2 * N_ROWS, f"Writing {path.name}")
        # Some file systems notice only now that they are full.
        out.flush()
        os.fsync(out.fileno())


def _origin(responses: Path, unpublished: tuple[str, ...]) -> dict[str, str | int]:
    return {
        "source_name": responses.name,
        "source_sha256": checksum_of(responses, "sha256").partition(":")[2],
        "source_bytes": responses.stat().st_size,
        "unpublished": ",".join(unpublished) or published.ALL_PUBLISHED,
        "installed_at": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def _image(responses: Responses, maps: MapFiles, origin: dict[str, str | int]) -> bytes:
    # Made in memory and written by plain file calls: HDF5 itself does not fail cleanly when
    # the disk is full.
    image = io.BytesIO()  # file images of HDF5 1.14 have a wrong checksum in their head
    with files.File(image, "w", libver=("v110", "v110")) as store:
        _note(store, "format", published.FORMAT)
        _note(store, "format_version", published.FORMAT_VERSION)
        for name, value in origin.items():
            _note(store, name, value)
        for limb in published.LIMBS:
            _add_responses(store, limb, responses)
            _add(store, published.mask_name(limb), maps.masks[limb - 1])
        _add(store, "map/outline", maps.outline)
        _add(store, "map/output_positions", maps.output_positions)
        _add(store, "map/input_positions", maps.input_positions)
        _add(store, "map/visibility", maps.visibility)
    return image.getvalue()


def _add_responses(store: Any, limb: int, responses: Responses) -> None:
    dataset = store.create_dataset(
        published.responses_name(limb),
        shape=published.RESPONSES_SHAPE,
        chunks=published.CHUNK,
        dtype=published.FLOATS,
    )
    checksums = []
    for k in range(published.RESPONSES_SHAPE[0]):
        response = np.ascontiguousarray(responses[limb, k + 1])
        dataset[k] = response
        checksums.append(published.checksum(response))
    dataset.attrs["sha256"] = np.array(checksums, dtype="S64")


def _add(store: Any, name: str, array: NDArray[Any]) -> None:
    part = store.create_dataset(name, data=array, dtype=published.stored_type(name))
    _note(part, "sha256", published.checksum(array))


def _note(part: Any, name: str, value: str | int) -> None:
    if isinstance(value, int):
        part.attrs[name] = np.int64(value)
        return
    # Names of files need not be texts; what HDF5 calls UTF-8 has to be.
    text = value.encode(errors="backslashreplace")
    part.attrs.create(name, text, dtype=files.string_dtype("utf-8", max(1, len(text))))


def _pieces(image: bytes) -> Iterator[tuple[int, memoryview]]:
    view = memoryview(image)
    for start in range(0, len(image), _PIECE_BYTES):
        piece = view[start : start + _PIECE_BYTES]
        yield start + len(piece), piece
