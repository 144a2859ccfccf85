"""Install the dataset from files, or download them first, each continued where it was cut."""

import io
import json
from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any
from zipfile import ZipFile, ZipInfo

import numpy as np

from skinsource.base.assets import user_folder
from skinsource.base.errors import DownloadError, printable
from skinsource.base.extras import package_of_extra
from skinsource.base.files import is_file, make_folder, replacing, storage_errors_of
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.dataset import published
from skinsource.limbs.dataset.matlab_files import N_ROWS, read_map_files, read_responses
from skinsource.limbs.dataset.published import (
    RemoteFile,
    check_map_files,
    checksum_of,
    download_folder,
    find_downloaded,
    published_files,
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
