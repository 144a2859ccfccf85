"""A tree as text that people read and write too: no checksum, checked all the more strictly."""

import json

from skinsource.codec.format_version import check_version
from skinsource.codec.json_text import MAX_TEXT_BYTES, loaded
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.fields import Tree
from skinsource.quoting import quoted


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
        found = loaded(text)
    except FileFormatError as error:
        raise FileFormatError(
            f"not the text of a {format} ({error}). Correct it, or go back to an earlier copy."
        ) from error
    if not isinstance(found, dict) or found.get("format") != format:
        said = found.get("format") if isinstance(found, dict) else found
        raise FileFormatError(f"its format is {quoted(said)}, expected {quoted(format)}")
    if set(found) != {"format", "version", "content"}:
        raise FileFormatError(
            f"it holds {quoted(sorted(found))}, expected format, version and content"
        )
    check_version(found["version"], version)
    return found["content"]
