"""The parts of an opened store, each looked at before it is read.

HDF5 can be kept busy for ever, or led into other files, by a damaged or strange file.  So
nothing is read whose type, shape and place are not those that the installation writes.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from skinsource.dataset import layout
from skinsource.errors import DatasetError
from skinsource.files import hdf5

if TYPE_CHECKING:
    import h5py

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
        """A group in the root."""
        group = self._member(self.root, name, hdf5.Group)
        self.refuse_unknown(f"/{name}", group, set(layout.GROUPS[name]))
        self.refuse_unknown(f"/{name}", group.attrs, set())
        return group

    def dataset(
        self, name: str, shape: tuple[int, ...], kind: str, chunks: tuple[int, ...] | None
    ) -> "h5py.Dataset":
        """A dataset, ``name`` is "group/dataset"; in one piece where ``chunks`` is None."""
        folder, own_name = name.split("/")
        dataset = self._member(self.group(folder), own_name, hdf5.Dataset)
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
        self.refuse_unknown(name, dataset.attrs, {DIGEST})
        return dataset

    def attribute(self, part: Any, name: str, kind: str, shape: tuple[int, ...] = ()) -> Any:
        """An attribute of a part: texts where ``kind`` is "S", whole numbers where it is "i"."""
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

    def refuse_unknown(self, place: str, found: Any, known: set[str]) -> None:
        """Refuse names in a group, or among attributes, that no installation writes."""
        unknown = set(found) - known
        if unknown:
            raise self._damaged(f"{place} holds {', '.join(sorted(unknown))}, which is unknown")

    def _member(self, group: "h5py.Group", name: str, kind: type) -> Any:
        member = hdf5.own_member(group, name, kind)
        if member is None:
            raise self._damaged(f"{name} in {group.name} is not a {kind.__name__.lower()} of it")
        return member

    def _damaged(self, what: str) -> DatasetError:
        return DatasetError(
            f"{self.path}: the store is damaged, or of another version ({what}). {REINSTALL}"
        )
