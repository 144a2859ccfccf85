"""From recipes to what files and the clipboard hold, and back.

Recipes describe their fields (`skinsource.specs.fields`), so one codec carries all of them:
`encode` makes a plain tree of a recipe, `decode` a recipe of a tree.  A tree travels as the image
of an HDF5 file (`skinsource.specs.image`) or as text (`skinsource.specs.codec`); both hold samples
once however often they are used, and both are checked before anything of them is believed.
"""

import base64
import binascii
import json
from hashlib import sha256
from typing import Any

import numpy as np

from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.base.json_text import MAX_TEXT_BYTES, Tree, dumped, loaded
from skinsource.base.quoting import quoted
from skinsource.specs.samples import Samples

# The version of a format that content states, and whether it is read here.


def check_version(version: Any, *readable: int) -> None:
    """Raise `FileFormatError` unless ``version`` is one of those that are ``readable``."""
    if type(version) is int and version in readable:
        return
    is_newer = type(version) is int and version > max(readable)
    studio = "a newer SkinSource studio" if is_newer else "the SkinSource studio that wrote it"
    raise FileFormatError(
        f"it is written in version {quoted(version)} of its format, expected "
        f"{' or '.join(map(str, readable))}; open it with {studio}"
    )


# Samples in a tree are named by their digest, and held once beside it.

#: No field of a recipe can be called that.
_REFERENCE = "$samples"


def without_samples(tree: Tree) -> tuple[Tree, dict[str, Samples]]:
    """Return the tree with names in place of samples, and the samples by name."""
    samples: dict[str, Samples] = {}

    def walked(part: Tree) -> Tree:
        if isinstance(part, Samples):
            samples[part.digest] = part
            return {_REFERENCE: part.digest}
        if isinstance(part, dict):
            return {name: walked(value) for name, value in part.items()}
        return [walked(value) for value in part] if isinstance(part, list) else part

    return walked(tree), samples


def put_back(tree: Tree, samples: dict[str, Samples]) -> Tree:
    """Return the tree with samples in place of their names.

    Raises
    ------
    FileFormatError
        Samples are named that are not there, or are there and not named.
    """
    named: set[str] = set()

    def walked(part: Tree) -> Tree:
        if isinstance(part, dict):
            if _REFERENCE in part:
                named.add(_name(part, samples))
                return samples[part[_REFERENCE]]
            return {name: walked(value) for name, value in part.items()}
        return [walked(value) for value in part] if isinstance(part, list) else part

    try:
        whole = walked(tree)
    except RecursionError as error:
        raise FileFormatError("the content is nested too deep") from error
    if len(named) < len(samples):
        raise FileFormatError("the content holds samples that nothing uses")
    return whole


def _name(reference: dict[str, Any], samples: dict[str, Samples]) -> str:
    name = reference[_REFERENCE]
    if len(reference) > 1 or not isinstance(name, str) or name not in samples:
        raise FileFormatError(f"the content names samples {quoted(name)} that are not there")
    return name


# A tree as text: for the clipboard, and for presets.

#: Version of what the clipboard and presets hold; files have their own.
TEXT_VERSION = 2
_COPY_AGAIN = "Copy it again in SkinSource studio."


def to_text(tree: Tree, format: str) -> str:
    """Return ``tree`` as JSON that says what it is, with a checksum.

    Parameters
    ----------
    tree
        What `skinsource.specs.models.encode` makes, or a list or dictionary of such.
    format
        What the text holds, in a few words: ``"skinsource inputs"``.

    Raises
    ------
    InvalidInputError
        It holds so much that it could not be read again.
    """
    content, samples = without_samples(tree)
    body = {
        "content": content,
        "samples": {digest: _as_tree(signal) for digest, signal in samples.items()},
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
    fields = loaded(text.encode(errors="replace"))
    if not isinstance(fields, dict) or fields.get("format") != format:
        raise FileFormatError(f"the text does not hold {format}, but {quoted(text)}")
    check_version(fields.get("version"), TEXT_VERSION)
    body = {name: fields.get(name) for name in ("content", "samples")}
    if not _is_whole(fields.get("sha256"), body) or not isinstance(body["samples"], dict):
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
        samples = Samples(values=values, sample_rate_hz=tree["sample_rate_hz"], unit=tree["unit"])
    except (TypeError, KeyError, ValueError, binascii.Error) as error:
        raise FileFormatError(f"the samples in the text are damaged. {_COPY_AGAIN}") from error
    if samples.digest != digest:
        raise FileFormatError(f"the samples in the text are damaged. {_COPY_AGAIN}")
    return samples


# A tree as text that people read and write too: no checksum, checked all the more strictly.


def to_plain_text(tree: Tree, format: str, version: int) -> str:
    """Return ``tree``, without samples, as indented JSON that says what it is.

    Raises
    ------
    InvalidInputError
        It holds so much that it could not be read again.
    """
    whole = {"format": format, "version": version, "content": tree}
    text = json.dumps(whole, ensure_ascii=False, allow_nan=False, indent=2) + "\n"
    if len(text.encode()) > MAX_TEXT_BYTES:
        raise InvalidInputError(
            f"{len(text)} bytes are too many for a text, expected at most {MAX_TEXT_BYTES}"
        )
    return text


def from_plain_text(text: bytes, format: str, version: int) -> Tree:
    """Return the tree of a text in this version of this format.

    Raises
    ------
    FileFormatError
        The text is something else, or was written in another version.
    """
    try:
        fields = loaded(text)
    except FileFormatError as error:
        raise FileFormatError(
            f"not the text of a {format} ({error}). Correct it, or go back to an earlier copy."
        ) from error
    if not isinstance(fields, dict) or fields.get("format") != format:
        said = fields.get("format") if isinstance(fields, dict) else fields
        raise FileFormatError(f"its format is {quoted(said)}, expected {quoted(format)}")
    if set(fields) != {"format", "version", "content"}:
        raise FileFormatError(
            f"it holds {quoted(sorted(fields))}, expected format, version and content"
        )
    check_version(fields["version"], version)
    return fields["content"]
