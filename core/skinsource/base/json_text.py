"""Trees that JSON can hold."""

import json
from typing import Any, NoReturn

from skinsource.base.errors import FileFormatError
from skinsource.base.quoting import quoted

Tree = Any


# JSON, read and written strictly: every float comes back, nothing is said twice.

#: Without samples; far above any design.
MAX_TEXT_BYTES = 8 * 2**20


def dumped(tree: Tree) -> bytes:
    """Return the tree as UTF-8 text; the same tree gives the same bytes."""
    text = json.dumps(tree, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode()


def loaded(text: bytes) -> Tree:
    """Return the tree that ``text`` holds.

    Raises
    ------
    FileFormatError
        It is no such text.
    """
    if len(text) > MAX_TEXT_BYTES:
        raise FileFormatError(f"{len(text)} bytes of text, expected at most {MAX_TEXT_BYTES}")
    try:
        return json.loads(
            text.decode(), parse_constant=_refuse_constant, object_pairs_hook=_without_doubles
        )
    except (ValueError, RecursionError) as error:
        raise FileFormatError("the text is not what SkinSource writes") from error


def _refuse_constant(name: str) -> NoReturn:
    raise FileFormatError(f"the text holds the number {name}, expected finite ones")


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    fields = dict(pairs)
    if len(fields) < len(pairs):
        raise FileFormatError(f"the text names a field twice among {quoted(list(fields))}")
    return fields
