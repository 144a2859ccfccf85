"""The inside of an opened store: each part is looked at before it is read.

HDF5 can be kept busy for ever, or led into other files, by a damaged or strange file.  So
nothing is read whose type, shape and place are not those that the installation writes.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from skinsource import hdf5
from skinsource.arrays import Floats
from skinsource.dataset import layout
from skinsource.errors import DatasetError
from skinsource.quoting import quoted

if TYPE_CHECKING:
    import h5py

REINSTALL = "Install it again with 'skinsource dataset fetch' or 'skinsource dataset install PATH'."

_ROOT_NUMBERS = ("format_version", "source_bytes")
_ROOT_TEXTS = ("format", "installed_at", "source_name", "source_sha256")
# Of the first version all but these; it did not compare its source with the published files.
_LATER_TEXTS = ("unpublished",)
_DIGEST = "sha256"
#: Far above the longest name of a file.
_MAX_TEXT_BYTES = 2048


class Contents:
    """Reads the parts of one opened store, and knows its path for messages.

    Raises
    ------
    DatasetError
        By every method: the part is not what the installation writes.
    """

    def __init__(self, file: "h5py.File", path: Path) -> None:
        self._file = file
        self._path = path
        self._version = self._checked_version()
        self._check_root()

    def text(self, name: str) -> str:
        """One of the texts that tell where the data come from."""
        return str(self._attribute(self._file, name, "S").decode())

    def number(self, name: str) -> int:
        """One of the numbers that tell where the data come from."""
        return int(self._attribute(self._file, name, "i"))

    def unpublished(self) -> tuple[str, ...] | None:
        """Files that were not the published ones; None where they were not compared."""
        if self._version == 1:
            return None
        found = self.text("unpublished")
        return () if found == layout.ALL_PUBLISHED else tuple(found.split(","))

    def limbs(self) -> tuple[int, ...]:
        """Numbers of the limbs whose responses are there."""
        names = self._group("responses")
        return tuple(n for n in layout.LIMBS if layout.responses_name(n).split("/")[1] in names)

    def checksums(self, limb: int) -> tuple[str, ...]:
        """SHA-256 of the responses to each input place of one limb, as noted at installation."""
        digests = self._attribute(self._responses(limb), _DIGEST, "S", layout.RESPONSES_SHAPE[:1])
        return tuple(digest.decode("ascii") for digest in digests)

    def response(self, limb: int, location: int) -> Floats:
        """Responses to one input place of one limb, (72 outputs, 3 axes, 522 taps); unchecked."""
        return np.asarray(self._responses(limb)[location - 1], dtype=np.float64)

    def whole(self, name: str) -> tuple[NDArray[Any], str]:
        """An array of the map, or a mask, and its SHA-256 as noted at installation; unchecked."""
        dataset = self._dataset(name, layout.WHOLE_SHAPES[name], layout.whole_type(name), None)
        return np.asarray(dataset[()]), self._attribute(dataset, _DIGEST, "S").decode("ascii")

    def _checked_version(self) -> int:
        known = "format" in self._file.attrs and "format_version" in self._file.attrs
        found = self.text("format") if known else None
        if found != layout.FORMAT:
            raise DatasetError(
                f"{self._path}: is no store of the measured dataset (format {quoted(found)}, "
                f"expected {quoted(layout.FORMAT)}). Move it away. {REINSTALL}"
            )
        version = self.number("format_version")
        if not 1 <= version <= layout.FORMAT_VERSION:
            raise DatasetError(
                f"{self._path}: has format version {version}, this program reads versions "
                f"1 to {layout.FORMAT_VERSION}. Use the program that made it, or: {REINSTALL}"
            )
        return version

    def _check_root(self) -> None:
        texts = _ROOT_TEXTS if self._version == 1 else (*_ROOT_TEXTS, *_LATER_TEXTS)
        self._refuse_unknown("/", self._file.attrs, {*texts, *_ROOT_NUMBERS})
        self._refuse_unknown("/", self._file, set(layout.GROUPS))
        for name in texts:
            self.text(name)
        for name in _ROOT_NUMBERS:
            self.number(name)

    def _responses(self, limb: int) -> "h5py.Dataset":
        name = layout.responses_name(limb)
        return self._dataset(name, layout.RESPONSES_SHAPE, layout.FLOATS, layout.CHUNK)

    def _group(self, name: str) -> "h5py.Group":
        group = self._member(self._file, name, hdf5.Group)
        self._refuse_unknown(f"/{name}", group, set(layout.GROUPS[name]))
        self._refuse_unknown(f"/{name}", group.attrs, set())
        return group

    def _dataset(
        self, name: str, shape: tuple[int, ...], kind: str, chunks: tuple[int, ...] | None
    ) -> "h5py.Dataset":
        folder, own_name = name.split("/")
        dataset = self._member(self._group(folder), own_name, hdf5.Dataset)
        if dataset.shape != shape or dataset.dtype != np.dtype(kind):
            raise self._damaged(
                f"{name} is {dataset.dtype} of shape {dataset.shape}, expected {np.dtype(kind)} of "
                f"shape {shape}"
            )
        # Values that lie in other files, or that a plug-in unpacks, would be read from there.
        how = dataset.id.get_create_plist()
        usual = hdf5.h5d.CHUNKED if chunks else hdf5.h5d.CONTIGUOUS
        is_usual = how.get_layout() == usual and dataset.chunks == chunks
        if not is_usual or how.get_nfilters() or how.get_external_count():
            raise self._damaged(f"{name} is not stored as installed")
        self._refuse_unknown(name, dataset.attrs, {_DIGEST})
        return dataset

    def _attribute(self, part: Any, name: str, kind: str, shape: tuple[int, ...] = ()) -> Any:
        if name not in part.attrs:
            raise self._damaged(f"{part.name} lacks {name}")
        # HDF5 keeps texts of free length outside its checksums, and may never end reading one.
        found = part.attrs.get_id(name)
        right = found.shape == shape and found.dtype.kind == kind
        if not right or found.dtype.itemsize > _MAX_TEXT_BYTES:
            expected = "texts of fixed length" if kind == "S" else "whole numbers"
            raise self._damaged(
                f"{name} of {part.name} is {found.dtype} of shape {found.shape}, expected "
                f"{expected} of shape {shape}"
            )
        return part.attrs[name]

    def _member(self, group: "h5py.Group", name: str, kind: type) -> Any:
        # A link could lead into any other file.
        is_here = isinstance(group.get(name, getlink=True), hdf5.HardLink)
        member = group[name] if is_here else None
        if not isinstance(member, kind):
            raise self._damaged(f"{name} in {group.name} is not a {kind.__name__.lower()} of it")
        return member

    def _refuse_unknown(self, place: str, found: Any, known: set[str]) -> None:
        unknown = set(found) - known
        if unknown:
            raise self._damaged(f"{place} holds {', '.join(sorted(unknown))}, which is unknown")

    def _damaged(self, what: str) -> DatasetError:
        return DatasetError(
            f"{self._path}: the store is damaged, or of another version ({what}). {REINSTALL}"
        )
