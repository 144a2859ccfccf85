"""The installed measured dataset: one HDF5 file in the user's data folder.

The file is opened for each reading and closed again, so that it can be replaced or removed
while limbs are in use.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.dataset import layout
from skinsource.dataset.contents import Contents
from skinsource.dataset.not_installed import HOW_TO_GET, NOT_INSTALLED
from skinsource.dataset.store_parts import REINSTALL
from skinsource.errors import (
    DatasetError,
    DatasetMissingError,
    SkinSourceError,
    StorageError,
    UnknownLimbError,
)
from skinsource.files import hdf5, is_file
from skinsource.files.assets import user_folder
from skinsource.limb import HAND_LENGTHS_MM, Limb, LimbMap
from skinsource.quoting import quoted

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
        return _note_on(self.unpublished)


def store_path() -> Path:
    """Where the store is, or would be."""
    return user_folder() / layout.FILE_NAME


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
    with open_store(path) as store:
        return StoreInfo(
            path=path,
            size_bytes=path.stat().st_size,
            limbs=store.limbs(),
            installed_at=store.text("installed_at"),
            source_name=store.text("source_name"),
            source_sha256=store.text("source_sha256"),
            source_bytes=store.number("source_bytes"),
            unpublished=store.unpublished(),
        )


def load_measured_limb(number: int) -> Limb:
    """Open measured limb 1 to 4: its map now, its responses one input at a time when touched.

    Raises
    ------
    UnknownLimbError
        There is no such limb.
    DatasetMissingError
        The dataset is not installed.
    DatasetError
        The store is damaged; raised by ``response_to`` too, when a checksum does not match.
    """
    _check_number(number)
    path = store_path()
    with open_store(path) as store:
        outline, outputs, inputs, visibility = (
            _read_checked(store, f"map/{part}", path) for part in layout.MAP_SHAPES
        )
        checksums = store.checksums(number)
        note = _note_on(store.unpublished())

    def read_response(location: int) -> Floats:
        return _read_response(path, number, location, checksums[location - 1])

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


def load_mask(number: int) -> NDArray[np.bool_]:
    """Pixels of 1 mm that lie on the skin of measured limb 1 to 4, (rows, columns).

    Row and column 0 are at the lowest y and x.  Raises what `load_measured_limb` raises.
    """
    _check_number(number)
    path = store_path()
    with open_store(path) as store:
        mask = _read_checked(store, layout.mask_name(number), path)
    return np.asarray(mask, dtype=np.bool_)


@contextmanager
def open_store(path: Path) -> Iterator[Contents]:
    """Open the store for reading; explain in our own words why that is not possible."""
    if not is_file(path):
        raise DatasetMissingError(f"{NOT_INSTALLED} There is no {path}. {HOW_TO_GET}")
    try:
        with hdf5.File(path, "r", locking="best-effort") as file:
            yield Contents(file, path)
    except SkinSourceError:
        raise
    except PermissionError as error:
        raise StorageError(f"{path}: may not be read. Change its permissions.") from error
    except (OSError, RuntimeError, LookupError, TypeError, ValueError, OverflowError) as error:
        raise DatasetError(f"{path}: the store is damaged. {REINSTALL}") from error


def _read_checked(store: Contents, name: str, path: Path) -> NDArray[Any]:
    array, expected = store.whole(name)
    _compare(layout.checksum(array), expected, name, path)
    array.flags.writeable = False
    return array


def _read_response(path: Path, limb: int, location: int, expected: str) -> Floats:
    with open_store(path) as store:
        if store.checksums(limb)[location - 1] != expected:
            raise DatasetError(
                f"{path}: was replaced by other data since limb measured-{limb} was opened. "
                "Open the limb again."
            )
        response = store.response(limb, location)
    _compare(layout.checksum(response), expected, f"limb {limb}, input {location}", path)
    return response


def _compare(found: str, expected: str, what: str, path: Path) -> None:
    if found != expected:
        raise DatasetError(
            f"{path}: {what} is damaged: its checksum is {found[:12]}…, expected {expected[:12]}…. "
            f"{REINSTALL}"
        )


def _note_on(unpublished: tuple[str, ...]) -> str:
    if not unpublished:
        return ""
    return f"made from files that are not the published ones: {', '.join(unpublished)}"


def _check_number(number: int) -> None:
    if number not in layout.LIMBS:
        raise UnknownLimbError(
            f"measured limb {quoted(number)} does not exist: they are numbered "
            f"{layout.LIMBS[0]} to {layout.LIMBS[-1]}."
        )
