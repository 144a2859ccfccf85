"""Trees as text: for the clipboard, for presets, and for people to edit.

`skinsource.specs.models.encode` makes a tree of a model, ``decode`` a model of a tree.  Files hold
a tree as text or as the image of an HDF5 file (`skinsource.specs.image`).  Samples are named by
their digest in a tree, and stored once beside it.  Whatever is read is checked: texts for machines
by a checksum, texts for people, which have none, by their form.
"""

import base64
import binascii
import json
from hashlib import sha256
from typing import Any

import numpy as np

from skinsource.base.errors import FileFormatError, InvalidInputError, quoted
from skinsource.base.json_text import MAX_TEXT_BYTES, Tree, dumped, loaded
from skinsource.specs.samples import Samples

#: Key in a tree of the digest of samples; no field of a model has this name.
_REFERENCE = "$samples"
#: Version of texts for the clipboard and of presets; files have their own.
_TEXT_VERSION = 2
_COPY_AGAIN = "Copy it again in SkinSource studio."


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


def without_samples(tree: Tree) -> tuple[Tree, dict[str, Samples]]:
    """Return the tree with digests in place of samples, and the samples by digest."""
    samples: dict[str, Samples] = {}

    def converted(part: Tree) -> Tree:
        if isinstance(part, Samples):
            samples[part.digest] = part
            return {_REFERENCE: part.digest}
        if isinstance(part, dict):
            return {name: converted(value) for name, value in part.items()}
        return [converted(value) for value in part] if isinstance(part, list) else part

    return converted(tree), samples


def with_samples(tree: Tree, samples: dict[str, Samples]) -> Tree:
    """Return the tree with samples in place of their digests.

    Raises
    ------
    FileFormatError
        Samples are missing, or some are not used.
    """
    used: set[str] = set()

    def converted(part: Tree) -> Tree:
        if isinstance(part, dict):
            if _REFERENCE in part:
                used.add(_digest_in(part, samples))
                return samples[part[_REFERENCE]]
            return {name: converted(value) for name, value in part.items()}
        return [converted(value) for value in part] if isinstance(part, list) else part

    try:
        content = converted(tree)
    except RecursionError as error:
        raise FileFormatError("the content is nested too deep") from error
    if len(used) < len(samples):
        raise FileFormatError("the content holds samples that nothing uses")
    return content


def _digest_in(reference: dict[str, Any], samples: dict[str, Samples]) -> str:
    digest = reference[_REFERENCE]
    if len(reference) > 1 or not isinstance(digest, str) or digest not in samples:
        raise FileFormatError(f"the content names samples {quoted(digest)} that are not there")
    return digest


def to_text(tree: Tree, format: str) -> str:
    """Return ``tree`` as JSON that names its format, with a checksum.

    Parameters
    ----------
    tree
        What `skinsource.specs.models.encode` makes, or a list or dictionary of such.
    format
        Name of the format: ``"skinsource inputs"``.

    Raises
    ------
    InvalidInputError
        It is too large to be read again.
    """
    content, samples = without_samples(tree)
    body = {
        "content": content,
        "samples": {digest: _samples_tree(signal) for digest, signal in samples.items()},
    }
    text = dumped({"format": format, "version": _TEXT_VERSION, "sha256": _checksum(body), **body})
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
    check_version(fields.get("version"), _TEXT_VERSION)
    body = {name: fields.get(name) for name in ("content", "samples")}
    if not _fits(fields.get("sha256"), body) or not isinstance(body["samples"], dict):
        raise FileFormatError(f"the text was changed on its way. {_COPY_AGAIN}")
    samples = {digest: _samples_of(digest, tree) for digest, tree in body["samples"].items()}
    return with_samples(body["content"], samples)


def _fits(checksum: Any, body: dict[str, Any]) -> bool:
    try:
        return bool(checksum == _checksum(body))
    except (ValueError, RecursionError):
        # Not all that can be read can be written: numbers beyond all floats, half characters.
        return False


def _checksum(body: dict[str, Any]) -> str:
    return sha256(dumped(body)).hexdigest()


def _samples_tree(samples: Samples) -> Tree:
    values = base64.b64encode(samples.values.astype("<f8").tobytes()).decode()
    return {"sample_rate_hz": samples.sample_rate_hz, "unit": samples.unit, "values": values}


def _samples_of(digest: str, tree: Tree) -> Samples:
    try:
        values = np.frombuffer(base64.b64decode(tree["values"], validate=True), "<f8")
        samples = Samples(values=values, sample_rate_hz=tree["sample_rate_hz"], unit=tree["unit"])
    except (TypeError, KeyError, ValueError, binascii.Error) as error:
        raise FileFormatError(f"the samples in the text are damaged. {_COPY_AGAIN}") from error
    if samples.digest != digest:
        raise FileFormatError(f"the samples in the text are damaged. {_COPY_AGAIN}")
    return samples


def to_plain_text(tree: Tree, format: str, version: int) -> str:
    """Return ``tree``, which holds no samples, as indented JSON for people to edit.

    Raises
    ------
    InvalidInputError
        It is too large to be read again.
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
        stated = fields.get("format") if isinstance(fields, dict) else fields
        raise FileFormatError(f"its format is {quoted(stated)}, expected {quoted(format)}")
    if set(fields) != {"format", "version", "content"}:
        raise FileFormatError(
            f"it holds {quoted(sorted(fields))}, expected format, version and content"
        )
    check_version(fields["version"], version)
    return fields["content"]
