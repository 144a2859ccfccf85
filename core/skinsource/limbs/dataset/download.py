"""Download the published files, each continued where it was cut, and install them."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from skinsource.base.errors import DownloadError
from skinsource.base.extras import package_of_extra
from skinsource.base.files import is_file, make_folder, storage_errors_of
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.quoting import printable
from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.published import (
    RemoteFile,
    checksum_of,
    download_folder,
    published_files,
)
from skinsource.limbs.dataset.store import StoreInfo

STOPPED = "Downloading was stopped; 'skinsource dataset fetch' continues where it stopped."
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
    stop_if(stop, STOPPED)
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
                stop_if(stop, STOPPED)
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
