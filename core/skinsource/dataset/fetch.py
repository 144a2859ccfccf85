"""Downloading the published files and installing them."""

import logging
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

from skinsource.dataset.download import download
from skinsource.dataset.downloaded_files import download_folder, leftovers
from skinsource.dataset.install import install
from skinsource.dataset.published import RemoteFile, checksum_of, published_files
from skinsource.dataset.store import StoreInfo
from skinsource.errors import DownloadError, StorageError
from skinsource.extras import package_of_extra
from skinsource.files import make_folder
from skinsource.job import Progress, Stop, never, silent

# Younger ones may belong to a download that runs.
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
        ``stop`` said so; what has arrived is kept for the next time.
    """
    pooch = package_of_extra("pooch", "dataset")
    for name in ("requests", "matio"):
        package_of_extra(name, "dataset")
    files = published_files() if files is None else files
    downloads = download_folder() if downloads is None else downloads
    make_folder(downloads)
    _sweep(downloads)
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
        one = _OneDownload(file, downloads, _moved_on(progress, done, total), stop)
        _fetch_one(registry, file, downloads, one)
        done += file.size_bytes
    progress(total, total, "Downloaded")
    # Each file was compared with ``files`` when it came.
    return install(downloads, folder=folder, unpublished=True, progress=progress, stop=stop)


def _sweep(downloads: Path) -> None:
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
        self._refuse_other_content()
        self._part.replace(output_file)

    def _report(self, n_bytes: int) -> None:
        self._progress(n_bytes, self._file.size_bytes, f"Downloading {self._file.name}")

    def _refuse_other_content(self) -> None:
        algorithm, _, expected = self._file.checksum.partition(":")
        found = checksum_of(self._part, algorithm).partition(":")[2]
        if found != expected:
            self._part.unlink()
            raise DownloadError(
                f"{self._file.url}: what was downloaded is not the published file: its "
                f"{algorithm} is {found}, expected {expected}. It was deleted; run 'skinsource "
                "dataset fetch' again."
            )


def _moved_on(progress: Progress, before: int, total: int) -> Progress:
    def of_all(done: int, _: int, text: str) -> None:
        progress(before + done, total, text)

    return of_all


def _fetch_one(registry: Any, file: RemoteFile, downloads: Path, one: _OneDownload) -> None:
    try:
        registry.fetch(file.name, downloader=one)
    except OSError as error:
        raise StorageError(
            f"{downloads / file.name}: cannot be written ({error.strerror or error}). Free some "
            "space or choose a folder you may write to, then try again."
        ) from error
