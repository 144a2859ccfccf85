"""The installed measured dataset: one file in the user's data folder.

It is opened for each reading and closed again, so that it can be replaced or removed while limbs
are in use.
"""

import io
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from zipfile import BadZipFile, ZipFile

import numpy as np
from numpy.typing import NDArray

from skinsource.base.assets import user_folder
from skinsource.base.conventions import HAND_LENGTHS_MM, N_INPUTS, Floats
from skinsource.base.errors import DatasetError, DatasetMissingError, SkinSourceError, StorageError
from skinsource.base.files import is_file, is_folder, storage_errors_of
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.dataset import published
from skinsource.limbs.dataset.published import (
    MAP_FILES,
    MAP_FOLDER,
    RESPONSES_FILE,
    download_folder,
)
from skinsource.limbs.limb import Limb, LimbMap

NOT_INSTALLED = "The measured limbs are not installed."
HOW_TO_GET = (
    "Get them with 'skinsource dataset fetch' (downloads 70 MB), or, from files you already have, "
    "with 'skinsource dataset install PATH'."
)


REINSTALL = "Install it again with 'skinsource dataset fetch' or 'skinsource dataset install PATH'."
#: Tip of digit III to the middle of the wrist, on the published map.
HAND_LENGTH_PX = 398.1017


@dataclass(frozen=True, slots=True, kw_only=True)
class StoreInfo:
    """What is installed.

    Attributes
    ----------
    path, size_bytes
        The store.
    limbs
        Numbers of the limbs in it.
    installed_at
        Date and time, ISO 8601, UTC.
    source_name, source_sha256, source_bytes
        The file of impulse responses it was made from.
    unpublished
        Files it was made from that are not the published ones.
    """

    path: Path
    size_bytes: int
    limbs: tuple[int, ...]
    installed_at: str
    source_name: str
    source_sha256: str
    source_bytes: int
    unpublished: tuple[str, ...]

    @property
    def note(self) -> str:
        """What the user should know of the source; empty where all files are the published ones."""
        if not self.unpublished:
            return ""
        return f"made from files that are not the published ones: {', '.join(self.unpublished)}"


def store_path() -> Path:
    """Return the path of the store, whether or not it exists."""
    return user_folder() / published.FILE_NAME


def is_installed() -> bool:
    """Whether there is a store."""
    # Of a folder that may not be searched nothing can be used either.
    return os.path.isfile(store_path())


def describe(path: Path | None = None) -> StoreInfo:
    """Say what is installed, without reading any responses.

    Raises
    ------
    DatasetMissingError
        Nothing is installed.
    DatasetError
        The store is damaged, or of another format version.
    """
    path = store_path() if path is None else path
    with _opened(path) as store:
        return _info(store, path)


def load_measured_limb(number: int) -> Limb:
    """Open measured limb 1 to 4: its map now, its responses one input at a time when touched.

    Raises
    ------
    DatasetMissingError
        The dataset is not installed.
    DatasetError
        The store is damaged; raised by ``response_to`` too, when a checksum does not match.
    """
    path = store_path()
    with _opened(path) as store:
        outline, outputs, inputs, visibility = (
            _read(store, published.map_name(part), path) for part in published.MAP_SHAPES
        )
        checksums = _checksums(store, number)
        note = _info(store, path).note

    def read_response(location: int) -> Floats:
        with _opened(path) as store:
            if _checksums(store, number) != checksums:
                raise DatasetError(
                    f"{path}: was replaced by other data since limb measured-{number} was opened. "
                    "Open the limb again."
                )
            return _read(store, published.response_name(number, location), path)

    return Limb(
        name=f"measured-{number}",
        hand_length_mm=HAND_LENGTHS_MM[number - 1],
        synthetic=False,
        note=note,
        map=LimbMap(
            outline=outline,
            output_positions=outputs,
            input_positions=inputs,
            hand_length_px=HAND_LENGTH_PX,
            visibility=visibility,
            densify=False,
        ),
        read_response=read_response,
    )


@contextmanager
def _opened(path: Path) -> Iterator[ZipFile]:
    """Open the store for reading; explain in our own words why that is not possible."""
    if not is_file(path):
        raise DatasetMissingError(f"{NOT_INSTALLED} There is no {path}. {HOW_TO_GET}")
    try:
        with ZipFile(path) as store:
            yield store
    except SkinSourceError:
        raise
    except PermissionError as error:
        raise StorageError(f"{path}: may not be read. Change its permissions.") from error
    except Exception as error:  # on a damaged file the parser may fail in any way
        raise DatasetError(f"{path}: the store is damaged. {REINSTALL}") from error


def _info(store: ZipFile, path: Path) -> StoreInfo:
    """Return what the store says of itself."""
    about = json.loads(store.read(published.ABOUT))
    if about.pop("format") != published.FORMAT:
        raise DatasetError(
            f"{path}: is not a store of the measured dataset; move it away. {REINSTALL}"
        )
    version = about.pop("format_version")
    if version != published.FORMAT_VERSION:
        raise DatasetError(
            f"{path}: has format version {version}, expected {published.FORMAT_VERSION}. "
            f"{REINSTALL}"
        )
    unpublished = tuple(about.pop("unpublished"))
    size_bytes = path.stat().st_size
    return StoreInfo(
        path=path, size_bytes=size_bytes, limbs=published.LIMBS, unpublished=unpublished, **about
    )


def _checksums(store: ZipFile, limb: int) -> list[int]:
    """Return those of the responses of a limb."""
    names = (published.response_name(limb, location) for location in range(1, N_INPUTS + 1))
    return [store.getinfo(f"{name}.npy").CRC for name in names]


def _read(store: ZipFile, name: str, path: Path) -> NDArray[Any]:
    """Return an array, read-only, after its checksum was compared."""
    try:
        content = store.read(f"{name}.npy")
    except BadZipFile as error:
        raise DatasetError(
            f"{path}: {_label(name)} is damaged: it has another checksum. {REINSTALL}"
        ) from error
    array = np.load(io.BytesIO(content), allow_pickle=False)
    if (array.shape, array.dtype.str) != published.ARRAYS[name]:
        raise DatasetError(f"{path}: {name} is not stored as installed. {REINSTALL}")
    array.flags.writeable = False
    return np.asarray(array)


def _label(name: str) -> str:
    limb, _, location = name.removeprefix("responses/").partition("-")
    return f"limb {limb}, input {location}" if location else name


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
        ``stop`` returned true.
    """
    problems = []
    path = store_path()
    with _opened(path) as store:
        _info(store, path)
        for done, name in enumerate(published.ARRAYS, start=1):
            stop_if(stop, "Verifying was stopped.")
            try:
                _read(store, name, path)
            except DatasetError as error:
                problems.append(str(error))
            progress(done, len(published.ARRAYS), f"Verifying {_label(name)}")
    return tuple(problems)


def installed_files() -> tuple[Path, ...]:
    """Return the files that `remove` would delete: the store, downloads, and leftovers."""
    store = store_path()
    downloads = download_folder()
    if not is_folder(store.parent):
        return ()
    candidates = [store, *sorted(store.parent.glob(f".{store.name}.*.part"))]
    for name in (RESPONSES_FILE, *(f"{MAP_FOLDER}/{name}" for name in MAP_FILES)):
        candidates += [downloads / name, downloads / f"{name}.part"]
    return tuple(path for path in candidates if is_file(path))


def remove() -> None:
    """Delete the store and the downloads it was made from.

    Raises
    ------
    StorageError
        A file cannot be deleted.
    """
    for path in installed_files():
        with storage_errors_of(path):
            path.unlink(missing_ok=True)
    for folder in (download_folder() / MAP_FOLDER, download_folder()):
        # What someone else put there stays, and so does its folder.
        with suppress(OSError):
            folder.rmdir()
