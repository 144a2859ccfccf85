"""The version of a format that content states, and whether it is read here."""

from typing import Any

from skinsource.errors import FileFormatError
from skinsource.quoting import quoted


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
