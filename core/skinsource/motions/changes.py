"""From one motion to another."""

from contextlib import suppress
from dataclasses import replace
from itertools import groupby
from typing import Any

from skinsource.errors import InvalidInputError
from skinsource.motions.motion import Motion
from skinsource.quoting import quoted

#: What goes over to a motion of another kind.
_SHARED = ("amplitude", "onset_s")


def with_field(motion: Motion, name: str, value: Any) -> Motion:
    """Return ``motion`` with another value of a field.

    Raises
    ------
    InvalidInputError
        The value is not allowed, alone or beside the others.
    """
    recipe: Any = motion
    return replace(recipe, **{name: value})


def following(motion: Motion, other: Motion) -> Motion:
    """Return ``motion`` along the path of ``other``, as strong and as late.

    What it cannot do of the path is left out: a sweep does not stay at a place, and a phantom lies
    between the first two different ones.
    """
    recipe: Any = motion
    recipe = replace(recipe, **{name: getattr(other, name) for name in _SHARED})
    moving = tuple(place for place, _ in groupby(other.path))
    for path in (other.path, moving, tuple(dict.fromkeys(moving))[:2]):
        with suppress(InvalidInputError):
            return replace(recipe, path=path)
    return recipe


def path_of(text: str) -> tuple[int, ...]:
    """The path that a text means: "16, 18, 20", "16 18 20" or "16-18-20".

    Raises
    ------
    InvalidInputError
        Something in it is no number of a place.
    """
    words = text.replace(",", " ").replace(";", " ").replace("-", " ").replace("→", " ").split()
    wrong = next((word for word in words if not (word.isascii() and word.isdigit())), None)
    if wrong is not None or any(len(word) > 3 for word in words):
        found = wrong if wrong is not None else max(words, key=len)
        raise InvalidInputError(
            f"the path has {quoted(found)}, expected numbers of places, as in 16, 18, 20"
        )
    return tuple(int(word) for word in words)
