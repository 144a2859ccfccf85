"""The installed measured dataset: one HDF5 file in the user's data folder.

A damaged or strange file can keep HDF5 busy for ever, or lead it into other files.  So nothing is
read whose type, shape and position are not those that the installation writes.  The file is opened
for each reading and closed again, so that it can be replaced or removed while limbs are in use.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from skinsource.base import files
from skinsource.base.arrays import Floats
from skinsource.base.assets import user_folder
from skinsource.base.errors import (
    DatasetError,
    DatasetMissingError,
    SkinSourceError,
    StorageError,
    UnknownLimbError,
)
from skinsource.base.files import is_file, is_folder
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.measurement_conditions import HAND_LENGTHS_MM, N_INPUTS
from skinsource.base.quoting import quoted
from skinsource.limbs.dataset import published
from skinsource.limbs.dataset.published import (
    MAP_FILES,
    MAP_FOLDER,
    RESPONSES_FILE,
    download_folder,
    leftovers,
)
from skinsource.limbs.limb import Limb, LimbMap

if TYPE_CHECKING:
    import h5py


NOT_INSTALLED = "The measured limbs are not installed."
HOW_TO_GET = (
    "Get them with 'skinsource dataset fetch' (downloads 70 MB), or, from files you already have, "
    "with 'skinsource dataset install PATH'."
)


REINSTALL = "Install it again with 'skinsource dataset fetch' or 'skinsource dataset install PATH'."
#: Name of the attribute that holds the SHA-256 of a dataset.
DIGEST = "sha256"
#: Far above the longest name of a file.
_MAX_TEXT_BYTES = 2048


class StoreParts:
    """Hands out groups, datasets and attributes of one opened store.

    Attributes
    ----------
    root
        The file itself.
    path
        Of the file, for messages.

    Raises
    ------
    DatasetError
        By every method: the part is not what the installation writes.
    """

    def __init__(self, root: "h5py.File", path: Path) -> None:
        self.root = root
        self.path = path

    def group(self, name: str) -> "h5py.Group":
        """Return a group of the root."""
        group = self._member(self.root, name, files.Group)
        self.check_names(f"/{name}", group, set(published.GROUPS[name]))
        self.check_names(f"/{name}", group.attrs, set())
        return group

    def dataset(
        self, name: str, shape: tuple[int, ...], kind: str, chunks: tuple[int, ...] | None
    ) -> "h5py.Dataset":
        """Return the dataset ``name``, "group/dataset"; in one piece where ``chunks`` is None."""
        folder, own_name = name.split("/")
        dataset = self._member(self.group(folder), own_name, files.Dataset)
        if dataset.shape != shape or dataset.dtype != np.dtype(kind):
            raise self._damaged(
                f"{name} is {dataset.dtype} of shape {dataset.shape}, expected {np.dtype(kind)} of "
                f"shape {shape}"
            )
        # Values that lie in other files, or that a plug-in unpacks, would be read from there.
        how = dataset.id.get_create_plist()
        usual = files.h5d.CHUNKED if chunks else files.h5d.CONTIGUOUS
        is_usual = how.get_layout() == usual and dataset.chunks == chunks
        if not is_usual or how.get_nfilters() or how.get_external_count():
            raise self._damaged(f"{name} is not stored as installed")
        self.check_names(name, dataset.attrs, {DIGEST})
        return dataset

    def attribute(self, part: Any, name: str, kind: str, shape: tuple[int, ...] = ()) -> Any:
        """Return an attribute of a part: texts if ``kind`` is "S", integers if it is "i"."""
        if name not in part.attrs:
            raise self._damaged(f"{part.name} lacks {name}")
        # HDF5 keeps texts of free length outside its checksums, and may never end reading one.
        attribute = part.attrs.get_id(name)
        right = attribute.shape == shape and attribute.dtype.kind == kind
        if not right or attribute.dtype.itemsize > _MAX_TEXT_BYTES:
            expected = "texts of fixed length" if kind == "S" else "whole numbers"
            raise self._damaged(
                f"{name} of {part.name} is {attribute.dtype} of shape {attribute.shape}, expected "
                f"{expected} of shape {shape}"
            )
        return part.attrs[name]

    def check_names(self, place: str, names: Any, known: set[str]) -> None:
        """Raise if a group or attributes hold names that no installation writes."""
        unknown = set(names) - known
        if unknown:
            raise self._damaged(f"{place} holds {', '.join(sorted(unknown))}, which is unknown")

    def _member(self, group: "h5py.Group", name: str, kind: type) -> Any:
        member = files.own_member(group, name, kind)
        if member is None:
            raise self._damaged(f"{name} in {group.name} is not a {kind.__name__.lower()} of it")
        return member

    def _damaged(self, what: str) -> DatasetError:
        return DatasetError(
            f"{self.path}: the store is damaged, or of another version ({what}). {REINSTALL}"
        )


_ROOT_NUMBERS = ("format_version", "source_bytes")
_ROOT_TEXTS = ("format", "installed_at", "source_name", "source_sha256", "unpublished")


class Contents:
    """Reads the parts of one opened store, and knows its path for messages.

    Raises
    ------
    DatasetError
        By every method: the part is not what the installation writes.
    """

    def __init__(self, file: "h5py.File", path: Path) -> None:
        self._parts = StoreParts(file, path)
        self._check_version()
        self._check_root()

    def text(self, name: str) -> str:
        """Return one of the texts on the origin of the data."""
        return str(self._parts.attribute(self._parts.root, name, "S").decode())

    def number(self, name: str) -> int:
        """Return one of the numbers on the origin of the data."""
        return int(self._parts.attribute(self._parts.root, name, "i"))

    def unpublished(self) -> tuple[str, ...]:
        """Return the files that were not the published ones."""
        names = self.text("unpublished")
        return () if names == published.ALL_PUBLISHED else tuple(names.split(","))

    def limbs(self) -> tuple[int, ...]:
        """Return the numbers of the limbs whose responses are there."""
        names = self._parts.group("responses")
        return tuple(
            n for n in published.LIMBS if published.responses_name(n).split("/")[1] in names
        )

    def checksums(self, limb: int) -> tuple[str, ...]:
        """Return the SHA-256 of the responses to each input place of a limb, as installed."""
        digests = self._parts.attribute(
            self._responses(limb), DIGEST, "S", published.RESPONSES_SHAPE[:1]
        )
        return tuple(digest.decode("ascii") for digest in digests)

    def response(self, limb: int, location: int) -> Floats:
        """Return the responses to one input place, (72 outputs, 3 axes, 522 taps), unchecked."""
        return np.asarray(self._responses(limb)[location - 1], dtype=np.float64)

    def whole(self, name: str) -> tuple[NDArray[Any], str]:
        """Return an array of the map, or a mask, unchecked, and its SHA-256 as installed."""
        dataset = self._parts.dataset(
            name, published.WHOLE_SHAPES[name], published.stored_type(name), None
        )
        return np.asarray(dataset[()]), self._parts.attribute(dataset, DIGEST, "S").decode("ascii")

    def _check_version(self) -> None:
        known = "format" in self._parts.root.attrs and "format_version" in self._parts.root.attrs
        kind = self.text("format") if known else None
        if kind != published.FORMAT:
            raise DatasetError(
                f"{self._parts.path}: is no store of the measured dataset (format {quoted(kind)}, "
                f"expected {quoted(published.FORMAT)}). Move it away. {REINSTALL}"
            )
        version = self.number("format_version")
        if version != published.FORMAT_VERSION:
            raise DatasetError(
                f"{self._parts.path}: has format version {version}, expected "
                f"{published.FORMAT_VERSION}. {REINSTALL}"
            )

    def _check_root(self) -> None:
        self._parts.check_names("/", self._parts.root.attrs, {*_ROOT_TEXTS, *_ROOT_NUMBERS})
        self._parts.check_names("/", self._parts.root, set(published.GROUPS))
        for name in _ROOT_TEXTS:
            self.text(name)
        for name in _ROOT_NUMBERS:
            self.number(name)

    def _responses(self, limb: int) -> "h5py.Dataset":
        name = published.responses_name(limb)
        return self._parts.dataset(
            name, published.RESPONSES_SHAPE, published.FLOATS, published.CHUNK
        )


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
            _read_checked(store, f"map/{part}", path) for part in published.MAP_SHAPES
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
    """Return the pixels of 1 mm on the skin of measured limb 1 to 4, (rows, columns).

    Row and column 0 are at the lowest y and x.  Raises what `load_measured_limb` raises.
    """
    _check_number(number)
    path = store_path()
    with open_store(path) as store:
        mask = _read_checked(store, published.mask_name(number), path)
    return np.asarray(mask, dtype=np.bool_)


@contextmanager
def open_store(path: Path) -> Iterator[Contents]:
    """Open the store for reading; explain in our own words why that is not possible."""
    if not is_file(path):
        raise DatasetMissingError(f"{NOT_INSTALLED} There is no {path}. {HOW_TO_GET}")
    try:
        with files.File(path, "r", locking="best-effort") as file:
            yield Contents(file, path)
    except SkinSourceError:
        raise
    except PermissionError as error:
        raise StorageError(f"{path}: may not be read. Change its permissions.") from error
    except (OSError, RuntimeError, LookupError, TypeError, ValueError, OverflowError) as error:
        raise DatasetError(f"{path}: the store is damaged. {REINSTALL}") from error


def _read_checked(store: Contents, name: str, path: Path) -> NDArray[Any]:
    array, expected = store.whole(name)
    _check_checksum(published.checksum(array), expected, name, path)
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
    _check_checksum(published.checksum(response), expected, f"limb {limb}, input {location}", path)
    return response


def _check_checksum(actual: str, expected: str, what: str, path: Path) -> None:
    if actual != expected:
        raise DatasetError(
            f"{path}: {what} is damaged: its checksum is {actual[:12]}…, "
            f"expected {expected[:12]}…. {REINSTALL}"
        )


def _note_on(unpublished: tuple[str, ...]) -> str:
    if not unpublished:
        return ""
    return f"made from files that are not the published ones: {', '.join(unpublished)}"


def _check_number(number: int) -> None:
    if number not in published.LIMBS:
        raise UnknownLimbError(
            f"measured limb {quoted(number)} does not exist: they are numbered "
            f"{published.LIMBS[0]} to {published.LIMBS[-1]}."
        )


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
    total = len(published.LIMBS) * N_INPUTS + len(published.WHOLE_SHAPES)
    problems = []
    path = store_path()
    with open_store(path) as store:
        for done, (what, checksum, expected) in enumerate(_checksums(store), start=1):
            stop_if(stop, "Verifying was stopped.")
            if checksum != expected:
                problems.append(f"{path}: {what}: checksum {checksum}, expected {expected}")
            progress(done, total, f"Verifying {what}")
    return tuple(problems)


def _checksums(store: Contents) -> Iterator[tuple[str, str, str]]:
    for name in published.WHOLE_SHAPES:
        array, expected = store.whole(name)
        yield name, published.checksum(array), expected
    for limb in published.LIMBS:
        for place, expected in enumerate(store.checksums(limb), start=1):
            checksum = published.checksum(store.response(limb, place))
            yield f"limb {limb}, input {place}", checksum, expected


def installed_files() -> tuple[Path, ...]:
    """Return the files that `remove` would delete: the store, downloads, and leftovers."""
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
