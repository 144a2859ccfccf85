"""Files of partial limbs, in HDF5.

``docs/limbs.md`` describes them for people::

    /            format, format_version, person, like, mounting, posture, sensor, dates, axes,
                 sample_rate_hz, pre_trigger_delay_s, inputs, outputs, sha256
    /responses   (n_inputs, n_outputs, n_axes, n_taps) float64, m/s²
"""

import json
import os
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.base import files
from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.base.errors import FileFormatError, InvalidInputError, quoted
from skinsource.base.files import path_text, replacing
from skinsource.base.run_limited import run_limited
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb_layout import (
    attribute_of,
    limb_file_error,
    number_of,
    response_blocks,
    responses_in,
    text_of,
)
from skinsource.people.partial_limb import PartialLimb

FORMAT, VERSION = "skinsource partial limb", 1
_TEXTS = ("person", "like", "mounting", "posture", "sensor")
#: What it has in common with the limb whose places it has.
_SHARED = ("axes", "sample_rate_hz", "pre_trigger_delay_s")


@checking
def save_partial(path: str | os.PathLike[str], partial: PartialLimb) -> None:
    """Write a partial limb.

    Parameters
    ----------
    path
        The file; an existing one is replaced.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "p07.h5"
    ...     ss.people.save_partial(path, ss.people.partial("synthetic-1", [9]))
    ...     print(path.exists())
    True
    """
    header = _header(partial)
    responses = np.asarray(partial.responses, "<f8")
    with replacing(Path(path)) as temporary, files.File(temporary, "w") as file:
        for name, value in header.items():
            file.attrs[name] = value
        file.attrs["format"], file.attrs["format_version"] = FORMAT, VERSION
        file.attrs["sha256"] = _checksum(header, responses)
        file.create_dataset("responses", data=responses, track_times=False)


@checking
def open_partial(path: str | os.PathLike[str]) -> PartialLimb:
    """Read a partial limb.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It holds no partial limb, is damaged, or does not fit the limb whose places it has.
    DatasetMissingError
        That limb is a measured one, and the measured dataset is not installed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "p07.h5"
    ...     ss.people.save_partial(path, ss.people.partial("synthetic-1", [9]))
    ...     print(ss.people.open_partial(path))
    <PartialLimb of synthetic-1: outputs 9>
    """
    place = Path(path)
    with files.storage_errors_of(place, reading="Check that it is there."):
        place.stat()
    function = "skinsource.people.partial_file:contents"
    header, *blocks = run_limited(function, place, expected="a partial limb")
    shape, checksum = header.pop("shape"), header.pop("sha256")
    responses = np.stack(blocks).reshape(shape)
    if _checksum(header, responses) != checksum:
        raise limb_file_error(place, "its checksum is another one", "an unchanged file")
    whole = limb_of(header["like"])
    for name in _SHARED:
        stated = header.pop(name)
        if stated != getattr(whole, name):
            raise limb_file_error(
                place, f"{name} is {quoted(stated)}", f"{getattr(whole, name)} as of {whole.name}"
            )
    header |= {name: tuple(header[name]) for name in ("inputs", "outputs")}
    header["dates"] = tuple(header["dates"].split())
    try:
        return PartialLimb(**header, responses=responses)
    except InvalidInputError as error:
        raise FileFormatError(f"{path_text(Path(place.name))}: {error}") from error


def _header(partial: PartialLimb) -> dict[str, Any]:
    whole = limb_of(partial.like)
    header: dict[str, Any] = {name: getattr(partial, name) for name in _TEXTS}
    header["dates"] = " ".join(partial.dates)
    header |= {name: list(getattr(partial, name)) for name in ("inputs", "outputs")}
    return header | {name: getattr(whole, name) for name in _SHARED}


def digest_of(partial: PartialLimb) -> str:
    """Return the SHA-256 of all that is known of a partial limb, as its file states it."""
    return _checksum(_header(partial), partial.responses)


def _checksum(header: dict[str, Any], responses: Floats) -> str:
    text = json.dumps(header, sort_keys=True, separators=(",", ":"))
    return sha256(text.encode() + np.ascontiguousarray(responses, "<f8").tobytes()).hexdigest()


def contents(path: Path) -> Iterator[Any]:
    """Yield all but the responses, and then those to each input, (n_outputs · n_axes, n_taps)."""
    with files.File(path, "r", locking=False) as file:
        kind = text_of(file, path, "format", None)
        if kind != FORMAT:
            raise limb_file_error(path, f"the attribute 'format' is {quoted(kind)}", quoted(FORMAT))
        version = number_of(file, path, "format_version", None)
        if version != VERSION:
            raise limb_file_error(path, f"format_version is {version:g}", f"{VERSION}")
        texts = (*_TEXTS, "dates", "axes", "sha256")
        header: dict[str, Any] = {name: text_of(file, path, name, None) for name in texts}
        for name in ("sample_rate_hz", "pre_trigger_delay_s"):
            header[name] = number_of(file, path, name, None)
        for name in ("inputs", "outputs"):
            places = np.atleast_1d(attribute_of(file, path, name, None))
            if places.ndim != 1 or places.dtype.kind not in "iu":
                raise limb_file_error(path, f"{name} are {quoted(places)}", "numbers of places")
            header[name] = places.tolist()
        header["shape"] = [int(n) for n in responses_in(file, path).shape]
    yield header
    yield from response_blocks(path, "", "")
