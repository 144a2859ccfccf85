"""One file over HTTP, continued where it was cut."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from skinsource.dataset.published import RemoteFile
from skinsource.errors import DownloadError, StorageError
from skinsource.extras import package_of_extra
from skinsource.job import Stop, stop_if
from skinsource.quoting import printable

STOPPED = (
    "Downloading was stopped; what has arrived is kept, and 'skinsource dataset fetch' goes on "
    "from there."
)
_GO_ON = "Check the connection and run 'skinsource dataset fetch' again"
_CONNECT_S, _READ_S = 10.0, 30.0
_PIECE_BYTES = 2**16
# Below a thousand bytes per second the files would take a day.
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
        ``stop`` said so.
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
                raise DownloadError(_lost(file, part, reason))
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
        _refuse_other_answers(answer, file, have)
        have = have if answer.status_code == _PART else 0
        with _opened(part, "ab" if have else "wb") as out:
            pace = _Pace(file)
            for piece in _pieces(answer):
                stop_if(stop, STOPPED)
                pace.note(len(piece))
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


class _Pace:
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


def _refuse_other_answers(answer: Any, file: RemoteFile, have: int) -> None:
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


def _lost(file: RemoteFile, part: Path, reason: str) -> str:
    have = _size(part)
    kept = f"; {have} of {file.size_bytes} bytes have arrived and are kept" if have else ""
    return f"{file.url}: cannot be downloaded ({reason}){kept}. {_GO_ON}."


def _size(part: Path) -> int:
    return part.stat().st_size if part.exists() else 0
