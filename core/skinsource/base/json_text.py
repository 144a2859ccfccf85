"""Strict JSON: every float is read as it was written, and no field is named twice."""

import json
from typing import Any, NoReturn

from skinsource.base.errors import FileFormatError, quoted

#: Texts, numbers, True, False, None, lists of trees, and dictionaries of trees.
Tree = Any

#: Most bytes of a text; without samples, any design is far smaller.
MAX_TEXT_BYTES = 8 * 2**20


def dumped(tree: Tree) -> bytes:
    """Return the tree as UTF-8 text; the same tree gives the same bytes."""
    text = json.dumps(tree, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode()


def loaded(text: bytes) -> Tree:
    """Return the tree in ``text``.

    Raises
    ------
    FileFormatError
        It is no such JSON.
    """
    if len(text) > MAX_TEXT_BYTES:
        raise FileFormatError(f"{len(text)} bytes of text, expected at most {MAX_TEXT_BYTES}")
    try:
        return json.loads(
            text.decode(), parse_constant=_reject_constant, object_pairs_hook=_checked_fields
        )
    except (ValueError, RecursionError) as error:
        raise FileFormatError("the text is not what SkinSource writes") from error


def _reject_constant(name: str) -> NoReturn:
    raise FileFormatError(f"the text holds the number {name}, expected finite ones")


def _checked_fields(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    fields = dict(pairs)
    if len(fields) < len(pairs):
        raise FileFormatError(f"the text names a field twice among {quoted(list(fields))}")
    return fields
