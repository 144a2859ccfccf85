"""Download the published files, each continued where it was cut, and install them."""

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

from skinsource.base.errors import DownloadError, StorageError
from skinsource.base.extras import package_of_extra
from skinsource.base.files import make_folder
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.quoting import printable
from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.published import (
    RemoteFile,
    checksum_of,
    download_folder,
    leftovers,
    published_files,
)
from skinsource.limbs.dataset.store import StoreInfo

STOPPED = (
    "Downloading was stopped; what has arrived is kept, and 'skinsource dataset fetch' goes on "
    "from there."
)
_GO_ON = "Check the connection and run 'skinsource dataset fetch' again"
_CONNECT_S, _READ_S = 10.0, 30.0
_PIECE_BYTES = 2**16
# At less than a thousand bytes per second the files would take a day.
_PACE_S, _LEAST_BYTES = 60.0, 60_000
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
        with _opened(part, "ab" if have else "wb") as out:
            speed = _SpeedCheck(file)
            for piece in _pieces(answer):
                stop_if(stop, STOPPED)
                speed.note(len(piece))
                with _explained(part):
                    out.write(piece)
                    out.flush()
                have += len(piece)
                report(have)
                if have > file.size_bytes:
                    break
    return True


def _pieces(answer: Any) -> Iterator[bytes]:
    # What has come, at once: a slow server would keep a larger piece, and the user, waiting.
    while piece := answer.raw.read1(_PIECE_BYTES, decode_content=True):
        yield piece


class _SpeedCheck:
    """Gives up on a server that sends next to nothing."""

    def __init__(self, file: RemoteFile) -> None:
        self._url = file.url
        self._since_s = time.monotonic()
        self._n_bytes = 0

    def note(self, n_bytes: int) -> None:
        """Count what has come; raise `DownloadError` where it was too little for too long."""
        self._n_bytes += n_bytes
        now_s = time.monotonic()
        if now_s - self._since_s >= _PACE_S:
            if self._n_bytes < _LEAST_BYTES:
                raise DownloadError(
                    f"{self._url}: comes too slowly ({self._n_bytes} bytes in {_PACE_S:g} s, "
                    f"expected at least {_LEAST_BYTES}); what has arrived is kept. {_GO_ON}."
                )
            self._since_s, self._n_bytes = now_s, 0


def _opened(part: Path, mode: str) -> IO[bytes]:
    with _explained(part):
        return part.open(mode)


@contextmanager
def _explained(part: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise StorageError(
            f"{part}: cannot be written ({error.strerror or error}). Free some space or choose a "
            "folder you may write to, then try again."
        ) from error


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
    progress_note = f"; {have} of {file.size_bytes} bytes have arrived and are kept" if have else ""
    return f"{file.url}: cannot be downloaded ({reason}){progress_note}. {_GO_ON}."


def _size(part: Path) -> int:
    return part.stat().st_size if part.exists() else 0


# Younger temporary files may belong to a download that runs.
_A_DAY_S = 24 * 3600.0


def fetch(
    *,
    files: tuple[RemoteFile, ...] | None = None,
    downloads: Path | None = None,
    folder: Path | None = None,
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
    downloads, folder
        Where the downloads and the store go; below the user's data folder when not given.
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
    pooch = package_of_extra("pooch", "dataset")
    for name in ("requests", "matio"):
        package_of_extra(name, "dataset")
    files = published_files() if files is None else files
    downloads = download_folder() if downloads is None else downloads
    make_folder(downloads)
    _remove_leftovers(downloads)
    # pooch would tell of each file on stderr, in the middle of the progress bar
    pooch.get_logger().setLevel(logging.WARNING)
    registry = pooch.create(
        path=downloads,
        base_url="",
        registry={file.name: file.checksum for file in files},
        urls={file.name: file.url for file in files},
    )
    total, done = sum(file.size_bytes for file in files), 0
    for file in files:
        progress(done, total, f"Downloading {file.name}")
        downloader = _OneDownload(file, downloads, _progress_of_all(progress, done, total), stop)
        _fetch_one(registry, file, downloads, downloader)
        done += file.size_bytes
    progress(total, total, "Downloaded")
    # Each file was compared with ``files`` when it came.
    return install(downloads, folder=folder, unpublished=True, progress=progress, stop=stop)


def _remove_leftovers(downloads: Path) -> None:
    for path in leftovers(downloads):
        with suppress(OSError):
            if path.stat().st_mtime < time.time() - _A_DAY_S:
                path.unlink()


class _OneDownload:
    """What pooch calls to have one file brought to a temporary path."""

    def __init__(self, file: RemoteFile, downloads: Path, progress: Progress, stop: Stop) -> None:
        self._file = file
        self._part = downloads / f"{file.name}.part"
        self._progress = progress
        self._stop = stop

    def __call__(self, _url: str, output_file: str, _pooch: Any) -> None:
        download(self._file, self._part, report=self._report, stop=self._stop)
        self._check_content()
        self._part.replace(output_file)

    def _report(self, n_bytes: int) -> None:
        self._progress(n_bytes, self._file.size_bytes, f"Downloading {self._file.name}")

    def _check_content(self) -> None:
        algorithm, _, expected = self._file.checksum.partition(":")
        digest = checksum_of(self._part, algorithm).partition(":")[2]
        if digest != expected:
            self._part.unlink()
            raise DownloadError(
                f"{self._file.url}: what was downloaded is not the published file: its "
                f"{algorithm} is {digest}, expected {expected}. It was deleted; run 'skinsource "
                "dataset fetch' again."
            )


def _progress_of_all(progress: Progress, before: int, total: int) -> Progress:
    def of_all(done: int, _: int, text: str) -> None:
        progress(before + done, total, text)

    return of_all


def _fetch_one(registry: Any, file: RemoteFile, downloads: Path, downloader: _OneDownload) -> None:
    try:
        registry.fetch(file.name, downloader=downloader)
    except OSError as error:
        raise StorageError(
            f"{downloads / file.name}: cannot be written ({error.strerror or error}). Free some "
            "space or choose a folder you may write to, then try again."
        ) from error
