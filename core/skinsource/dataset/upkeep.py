"""Checking and removing what is installed."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from skinsource.dataset import layout
from skinsource.dataset.contents import Contents
from skinsource.dataset.downloaded_files import (
    MAP_FILES,
    MAP_FOLDER,
    RESPONSES_FILE,
    download_folder,
    leftovers,
)
from skinsource.dataset.store import open_store, store_path
from skinsource.errors import StorageError
from skinsource.files import is_file, is_folder
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.limb import N_INPUTS


def verify(*, progress: Progress = silent, stop: Stop = never) -> tuple[str, ...]:
    """Compare every checksum in the store with the data.

    Returns
    -------
    tuple of str
        What does not match, one line each; empty when all is well.

    Raises
    ------
    DatasetMissingError
        Nothing is installed.
    DatasetError
        The store cannot be opened, or a part of it cannot be found.
    Stopped
        ``stop`` said so.
    """
    total = len(layout.LIMBS) * N_INPUTS + len(layout.WHOLE_SHAPES)
    problems = []
    path = store_path()
    with open_store(path) as store:
        for done, (what, found, expected) in enumerate(_checksums(store), start=1):
            stop_if(stop, "Verifying was stopped.")
            if found != expected:
                problems.append(f"{path}: {what}: checksum {found}, expected {expected}")
            progress(done, total, f"Verifying {what}")
    return tuple(problems)


def _checksums(store: Contents) -> Iterator[tuple[str, str, str]]:
    for name in layout.WHOLE_SHAPES:
        array, expected = store.whole(name)
        yield name, layout.checksum(array), expected
    for limb in layout.LIMBS:
        for place, expected in enumerate(store.checksums(limb), start=1):
            found = layout.checksum(store.response(limb, place))
            yield f"limb {limb}, input {place}", found, expected


def installed_files() -> tuple[Path, ...]:
    """Files that `remove` would delete: the store, downloads, remains of killed installations."""
    store = store_path()
    downloads = download_folder()
    if not is_folder(store.parent):
        return ()
    candidates = [store, *sorted(store.parent.glob(f".{store.name}.*.part"))]
    for name in (RESPONSES_FILE, *(f"{MAP_FOLDER}/{name}" for name in MAP_FILES)):
        candidates += [downloads / name, downloads / f"{name}.part"]
    candidates += leftovers(downloads)
    return tuple(path for path in candidates if is_file(path))


def remove() -> None:
    """Delete the store and the downloads it was made from.

    Raises
    ------
    StorageError
        A file cannot be deleted.
    """
    for path in installed_files():
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise StorageError(
                f"{path}: cannot be deleted ({error.strerror or error}). Close the programs that "
                "use it, then try again."
            ) from error
    for folder in (download_folder() / MAP_FOLDER, download_folder()):
        # What someone else put there stays, and so does its folder.
        with suppress(OSError):
            folder.rmdir()
