"""What an opened store holds."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.dataset import layout
from skinsource.dataset.store_parts import DIGEST, REINSTALL, StoreParts
from skinsource.errors import DatasetError
from skinsource.quoting import quoted

if TYPE_CHECKING:
    import h5py

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
        """One of the texts that tell where the data come from."""
        return str(self._parts.attribute(self._parts.root, name, "S").decode())

    def number(self, name: str) -> int:
        """One of the numbers that tell where the data come from."""
        return int(self._parts.attribute(self._parts.root, name, "i"))

    def unpublished(self) -> tuple[str, ...]:
        """Files that were not the published ones."""
        found = self.text("unpublished")
        return () if found == layout.ALL_PUBLISHED else tuple(found.split(","))

    def limbs(self) -> tuple[int, ...]:
        """Numbers of the limbs whose responses are there."""
        names = self._parts.group("responses")
        return tuple(n for n in layout.LIMBS if layout.responses_name(n).split("/")[1] in names)

    def checksums(self, limb: int) -> tuple[str, ...]:
        """SHA-256 of the responses to each input place of one limb, as noted at installation."""
        digests = self._parts.attribute(
            self._responses(limb), DIGEST, "S", layout.RESPONSES_SHAPE[:1]
        )
        return tuple(digest.decode("ascii") for digest in digests)

    def response(self, limb: int, location: int) -> Floats:
        """Responses to one input place of one limb, (72 outputs, 3 axes, 522 taps); unchecked."""
        return np.asarray(self._responses(limb)[location - 1], dtype=np.float64)

    def whole(self, name: str) -> tuple[NDArray[Any], str]:
        """An array of the map, or a mask, and its SHA-256 as noted at installation; unchecked."""
        dataset = self._parts.dataset(
            name, layout.WHOLE_SHAPES[name], layout.whole_type(name), None
        )
        return np.asarray(dataset[()]), self._parts.attribute(dataset, DIGEST, "S").decode("ascii")

    def _check_version(self) -> None:
        known = "format" in self._parts.root.attrs and "format_version" in self._parts.root.attrs
        found = self.text("format") if known else None
        if found != layout.FORMAT:
            raise DatasetError(
                f"{self._parts.path}: is no store of the measured dataset (format {quoted(found)}, "
                f"expected {quoted(layout.FORMAT)}). Move it away. {REINSTALL}"
            )
        version = self.number("format_version")
        if version != layout.FORMAT_VERSION:
            raise DatasetError(
                f"{self._parts.path}: has format version {version}, expected "
                f"{layout.FORMAT_VERSION}. {REINSTALL}"
            )

    def _check_root(self) -> None:
        self._parts.refuse_unknown("/", self._parts.root.attrs, {*_ROOT_TEXTS, *_ROOT_NUMBERS})
        self._parts.refuse_unknown("/", self._parts.root, set(layout.GROUPS))
        for name in _ROOT_TEXTS:
            self.text(name)
        for name in _ROOT_NUMBERS:
            self.number(name)

    def _responses(self, limb: int) -> "h5py.Dataset":
        name = layout.responses_name(limb)
        return self._parts.dataset(name, layout.RESPONSES_SHAPE, layout.FLOATS, layout.CHUNK)
