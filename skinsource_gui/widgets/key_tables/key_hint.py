"""What is said of a key."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class KeyHint:
    """Keys that mean the same, or nearly so.

    Attributes
    ----------
    name
        What the widget calls it.
    words
        What a reader calls the keys.
    means
        What they do.
    keys
        All of them, as Qt writes them; the first is shown where there is room for one.
    """

    name: str
    words: str
    means: str
    keys: tuple[str, ...]
