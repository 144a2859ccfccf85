"""The installed measured dataset: one HDF5 file in the user's data folder.

The file is opened for each reading and closed again, so that it can be replaced or removed
while limbs are in use.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from skinsource.assets import user_folder
from skinsource.dataset import layout
from skinsource.errors import (
    DatasetError,
    DatasetMissingError,
    SkinSourceError,
    StorageError,
    UnknownLimbError,
)
from skinsource.limb import HAND_LENGTHS_MM, Floats, Limb, LimbMap

#: Hand lengths of limbs 1 to 4: tip of digit III to the middle of the wrist.

HAND_LENGTH_PX = 398.1017
HOW_TO_GET = (
    "Get it with 'skinsource dataset fetch' (downloads 70 MB), or, from files you already have, "
    "with 'skinsource dataset install PATH'."
)
REINSTALL = "Install it again with 'skinsource dataset fetch' or 'skinsource dataset install PATH'."


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
    """

    path: Path
    size_bytes: int
    limbs: tuple[int, ...]
    installed_at: str
    source_name: str
    source_sha256: str
    source_bytes: int


def store_path() -> Path:
    """Where the store is, or would be."""
    return user_folder() / layout.FILE_NAME


def is_installed() -> bool:
    """Whether there is a store."""
    return store_path().is_file()


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
            limbs=tuple(n for n in layout.LIMBS if layout.responses_name(n) in store),
            installed_at=str(store.attrs["installed_at"]),
            source_name=str(store.attrs["source_name"]),
            source_sha256=str(store.attrs["source_sha256"]),
            source_bytes=int(store.attrs["source_bytes"]),
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
            read_checked(store, f"map/{part}", path) for part in layout.MAP_PARTS
        )
        checksums = stored_checksums(store, number)

    def read_response(location: int) -> Floats:
        return _read_response(path, number, location, checksums[location - 1])

    return Limb(
        name=f"measured-{number}",
        hand_length_mm=HAND_LENGTHS_MM[number - 1],
        synthetic=False,
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
        mask = read_checked(store, layout.mask_name(number), path)
    return np.asarray(mask, dtype=np.bool_)


@contextmanager
def open_store(path: Path) -> Iterator[Any]:
    """Open the store for reading; explain in our own words why that is not possible."""
    try:
        with h5py.File(path, "r", locking="best-effort") as store:
            _check_format(store, path)
            yield store
    except SkinSourceError:
        raise
    except FileNotFoundError as error:
        raise DatasetMissingError(
            f"the measured dataset is not installed (no {path}). {HOW_TO_GET}"
        ) from error
    except PermissionError as error:
        raise StorageError(f"{path}: may not be read. Change its permissions.") from error
    except (OSError, RuntimeError, LookupError, TypeError, ValueError) as error:
        raise DatasetError(f"{path}: the store is damaged ({error}). {REINSTALL}") from error


def stored_checksums(store: Any, limb: int) -> tuple[str, ...]:
    """SHA-256 of the responses to each input place of one limb, as noted at installation."""
    return tuple(
        digest.decode("ascii") for digest in store[layout.responses_name(limb)].attrs["sha256"]
    )


def read_checked(store: Any, name: str, path: Path) -> NDArray[Any]:
    """Read a whole array that has its checksum beside it."""
    array = np.asarray(store[name][()])
    _compare(layout.checksum(array), str(store[name].attrs["sha256"]), name, path)
    array.flags.writeable = False
    return array


def _read_response(path: Path, limb: int, location: int, expected: str) -> Floats:
    with open_store(path) as store:
        if stored_checksums(store, limb)[location - 1] != expected:
            raise DatasetError(
                f"{path}: was replaced by other data since limb measured-{limb} was opened. "
                "Open the limb again."
            )
        response = np.asarray(store[layout.responses_name(limb)][location - 1], dtype=np.float64)
    _compare(layout.checksum(response), expected, f"limb {limb}, input {location}", path)
    return response


def _compare(found: str, expected: str, what: str, path: Path) -> None:
    if found != expected:
        raise DatasetError(
            f"{path}: {what} is damaged: its checksum is {found[:12]}…, expected {expected[:12]}…. "
            f"{REINSTALL}"
        )


def _check_format(store: Any, path: Path) -> None:
    found = store.attrs.get("format")
    if found != layout.FORMAT:
        raise DatasetError(
            f"{path}: is no store of the measured dataset (format {found!r}, expected "
            f"{layout.FORMAT!r}). Move it away. {REINSTALL}"
        )
    version = int(store.attrs["format_version"])
    if version != layout.FORMAT_VERSION:
        raise DatasetError(
            f"{path}: has format version {version}, this program reads version "
            f"{layout.FORMAT_VERSION}. Use the program that made it, or: {REINSTALL}"
        )


def _check_number(number: int) -> None:
    if number not in layout.LIMBS:
        raise UnknownLimbError(
            f"measured limb {number!r} does not exist: they are numbered {layout.LIMBS[0]} to "
            f"{layout.LIMBS[-1]}."
        )
