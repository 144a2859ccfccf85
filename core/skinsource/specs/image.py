"""A tree as the image of an HDF5 file: 512 bytes with a checksum, then an HDF5 file.

::

    SkinSource design, version <number>    the first bytes, then ends of lines up to 512 bytes
    SHA-256 <of all bytes behind the first 512, in hexadecimal>
    /                     format = "skinsource design", version = <number>
    /content              the tree, JSON in UTF-8
    /samples/<digest>     float64, (n_times,); rate and unit stand in the content

HDF5 readers skip the first 512 bytes (a "user block").  Their checksum is checked first, so damage
is found without HDF5; and only contiguous datasets without filters in the file itself are read, so
that even an attack costs no more memory than the size of the file.
"""

import io
import re
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from skinsource.base import files
from skinsource.base.errors import FileFormatError, InvalidInputError, quoted
from skinsource.base.json_text import MAX_TEXT_BYTES, Tree, dumped, loaded
from skinsource.specs.codec import with_samples, without_samples
from skinsource.specs.samples import Samples

if TYPE_CHECKING:
    import h5py

FORMAT = "skinsource design"
_HEADER_BYTES = 512
#: Most bytes of a file.
MAX_IMAGE_BYTES = 256 * 2**20
_FIRST_LINE = re.compile(rb"SkinSource design, version (\d{1,9})\n")
# What HDF5 needs beside the data: once, and for each dataset.
_OVERHEAD_BYTES, _OVERHEAD_EACH = 2**16, 2**12
_DAMAGED = "The file is damaged; go back to an earlier copy."


def to_image(tree: Tree, version: int) -> bytes:
    """Return the file that holds ``tree``; the same tree gives the same bytes.

    Parameters
    ----------
    tree
        What `skinsource.specs.models.encode` makes.
    version
        Version of the format.

    Raises
    ------
    InvalidInputError
        It is too large to be opened again.
    """
    content, samples = without_samples(tree)
    facts = {
        digest: {
            "count": signal.values.size,
            "sample_rate_hz": signal.sample_rate_hz,
            "unit": signal.unit,
        }
        for digest, signal in samples.items()
    }
    text = dumped({"content": content, "samples": facts})
    size = len(text) + sum(signal.values.nbytes for signal in samples.values())
    if len(text) > MAX_TEXT_BYTES or size + _allowance(len(samples)) > MAX_IMAGE_BYTES:
        raise InvalidInputError(
            f"the design is too large for a file: {len(text)} bytes, expected at most "
            f"{MAX_TEXT_BYTES}; with its samples {size}, expected at most {MAX_IMAGE_BYTES}"
        )
    # The image is built in memory: HDF5 on a full disk may end the process.
    memory = io.BytesIO()
    with files.File(memory, "w", libver=("v110", "v110"), userblock_size=_HEADER_BYTES) as file:
        # For other programs, which do not read the first bytes.
        file.attrs.create("format", FORMAT.encode(), dtype=files.string_dtype("utf-8", len(FORMAT)))
        file.attrs["version"] = version
        _write(file, "content", np.frombuffer(text, np.uint8))
        group = file.create_group("samples")
        for digest, signal in samples.items():
            _write(group, digest, signal.values.astype("<f8", copy=False))
    image = memory.getvalue()[_HEADER_BYTES:]
    return _header(image, version) + image


def version_of(image: bytes) -> int:
    """Return the version in the first line.

    Raises
    ------
    FileFormatError
        The first line is not that of a design.
    """
    first_line = _FIRST_LINE.match(image)
    if first_line is None:
        raise FileFormatError(
            "not a SkinSource design, or damaged: its first line is not 'SkinSource design, "
            "version …'. Choose a .skinsource file saved by SkinSource studio."
        )
    return int(first_line[1])


def from_image(image: bytes, version: int) -> Tree:
    """Return the tree that `to_image` wrote in this ``version``.

    Raises
    ------
    FileFormatError
        A bit of it has changed, or it was written in another version.
    """
    if image[:_HEADER_BYTES] != _header(memoryview(image)[_HEADER_BYTES:], version):
        raise FileFormatError(f"changed since it was saved: the checksum does not fit. {_DAMAGED}")
    try:
        with files.File(io.BytesIO(image), "r") as file:
            return _tree(file, len(image))
    except (OSError, RuntimeError, KeyError, ValueError, TypeError, OverflowError) as error:
        raise FileFormatError(f"not written by SkinSource studio. {_DAMAGED}") from error


def _header(image: bytes | memoryview, version: int) -> bytes:
    text = f"SkinSource design, version {version}\nSHA-256 {sha256(image).hexdigest()}\n"
    return text.encode().ljust(_HEADER_BYTES, b"\n")


def _write(group: "h5py.Group", name: str, values: NDArray[Any]) -> None:
    group.create_dataset(name, data=values, track_times=False)


def _tree(file: "h5py.File", size: int) -> Tree:
    stored_tree = loaded(_array(file, "content", np.dtype(np.uint8), size).tobytes())
    if not isinstance(stored_tree, dict) or set(stored_tree) != {"content", "samples"}:
        raise FileFormatError(f"the content is {quoted(stored_tree)}. {_DAMAGED}")
    facts = stored_tree["samples"]
    group = _member(file, "samples", files.Group)
    if not isinstance(facts, dict) or set(facts) != set(group) or len(file) != 2:
        raise FileFormatError(f"the samples are not those that the content names. {_DAMAGED}")
    samples = {digest: _samples(group, digest, each, size) for digest, each in facts.items()}
    stored = sum(signal.values.nbytes for signal in samples.values())
    if size > MAX_TEXT_BYTES + stored + _allowance(len(samples)):
        raise FileFormatError(f"{size} bytes, {stored} of them in samples. {_DAMAGED}")
    return with_samples(stored_tree["content"], samples)


def _allowance(count: int) -> int:
    return _HEADER_BYTES + _OVERHEAD_BYTES + _OVERHEAD_EACH * count


def _samples(group: "h5py.Group", digest: str, facts: Any, size: int) -> Samples:
    values = _array(group, digest, np.dtype("<f8"), size)
    stored = Samples(values=values, sample_rate_hz=facts["sample_rate_hz"], unit=facts["unit"])
    if stored.digest != digest or facts["count"] != values.size or len(facts) != 3:
        raise FileFormatError(f"samples {quoted(digest)} have changed. {_DAMAGED}")
    return stored


def _array(group: "h5py.Group", name: str, dtype: np.dtype[Any], size: int) -> NDArray[Any]:
    dataset = _member(group, name, files.Dataset)
    plist = dataset.id.get_create_plist()
    # Only data in one piece in this file is read: no filters, chunks or other files.
    plain = plist.get_layout() == files.h5d.CONTIGUOUS and plist.get_external_count() == 0
    if not plain or dataset.dtype != dtype or dataset.ndim != 1 or dataset.nbytes > size:
        raise FileFormatError(
            f"{quoted(dataset.name)} is {dataset.dtype} of shape {dataset.shape}, expected one row "
            f"of {dtype}, not larger than the file. {_DAMAGED}"
        )
    return dataset[()]


def _member(group: "h5py.Group", name: str, kind: type) -> Any:
    member = files.own_member(group, name, kind)
    if member is None:
        raise FileFormatError(
            f"{quoted(name)} is not a {kind.__name__.lower()} of this file. {_DAMAGED}"
        )
    return member
