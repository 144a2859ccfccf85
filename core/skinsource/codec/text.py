"""A tree as text: for the clipboard, and for presets."""

import base64
import binascii
from hashlib import sha256
from typing import Any

import numpy as np

from skinsource.codec.format_version import check_version
from skinsource.codec.json_text import MAX_TEXT_BYTES, dumped, loaded
from skinsource.codec.references import put_back, taken_out
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.fields import Tree
from skinsource.quoting import quoted
from skinsource.samples import Samples

#: Version of what the clipboard and presets hold; files have their own.
TEXT_VERSION = 2
_COPY_AGAIN = "Copy it again in SkinSource studio."


def to_text(tree: Tree, format: str) -> str:
    """Return ``tree`` as JSON that says what it is, with a checksum.

    Parameters
    ----------
    tree
        What `skinsource.codec.encode` makes, or a list or dictionary of such.
    format
        What the text holds, in a few words: ``"skinsource inputs"``.

    Raises
    ------
    InvalidInputError
        It holds so much that it could not be read again.
    """
    content, samples = taken_out(tree)
    body = {
        "content": content,
        "samples": {digest: _as_tree(one) for digest, one in samples.items()},
    }
    text = dumped({"format": format, "version": TEXT_VERSION, "sha256": _checksum(body), **body})
    if len(text) > MAX_TEXT_BYTES:
        raise InvalidInputError(
            f"{len(text)} bytes are too many for a text, expected at most {MAX_TEXT_BYTES}; save "
            "a design file instead"
        )
    return text.decode()


def from_text(text: str, format: str) -> Tree:
    """Return the tree that `to_text` wrote.

    Raises
    ------
    FileFormatError
        The text is something else, is damaged, or was written in another version.
    """
    found = loaded(text.encode(errors="replace"))
    if not isinstance(found, dict) or found.get("format") != format:
        raise FileFormatError(f"the text does not hold {format}, but {quoted(text)}")
    check_version(found.get("version"), TEXT_VERSION)
    body = {name: found.get(name) for name in ("content", "samples")}
    if not _is_whole(found.get("sha256"), body) or not isinstance(body["samples"], dict):
        raise FileFormatError(f"the text was changed on its way. {_COPY_AGAIN}")
    samples = {digest: _samples(digest, tree) for digest, tree in body["samples"].items()}
    return put_back(body["content"], samples)


def _is_whole(checksum: Any, body: dict[str, Any]) -> bool:
    try:
        return bool(checksum == _checksum(body))
    except (ValueError, RecursionError):
        # Numbers beyond all floats, halves of characters: what can be read need not be writable.
        return False


def _checksum(body: dict[str, Any]) -> str:
    return sha256(dumped(body)).hexdigest()


def _as_tree(samples: Samples) -> Tree:
    values = base64.b64encode(samples.values.astype("<f8").tobytes()).decode()
    return {"sample_rate_hz": samples.sample_rate_hz, "unit": samples.unit, "values": values}


def _samples(digest: str, tree: Tree) -> Samples:
    try:
        values = np.frombuffer(base64.b64decode(tree["values"], validate=True), "<f8")
        found = Samples(values=values, sample_rate_hz=tree["sample_rate_hz"], unit=tree["unit"])
    except (TypeError, KeyError, ValueError, binascii.Error) as error:
        raise FileFormatError(f"the samples in the text are damaged. {_COPY_AGAIN}") from error
    if found.digest != digest:
        raise FileFormatError(f"the samples in the text are damaged. {_COPY_AGAIN}")
    return found
