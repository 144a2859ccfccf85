"""Install the dataset: read the download, check it, convert it, and move the store into place."""

import io
import json
from datetime import UTC, datetime
from pathlib import Path
from zipfile import ZipFile, ZipInfo

import numpy as np

from skinsource.base.assets import user_folder
from skinsource.base.files import make_folder, replacing
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.dataset import published
from skinsource.limbs.dataset.matlab_files import N_ROWS, read_map_files, read_responses
from skinsource.limbs.dataset.published import (
    check_map_files,
    checksum_of,
    find_downloaded,
    unpublished_files,
)
from skinsource.limbs.dataset.store import StoreInfo, describe

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
        **{published.map_name(part): getattr(maps, part) for part in published.MAP_SHAPES},
        **{published.mask_name(limb): maps.masks[limb - 1] for limb in published.LIMBS},
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
