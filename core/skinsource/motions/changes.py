"""From one motion to another."""

from dataclasses import replace
from typing import Any

from skinsource.errors import InvalidInputError
from skinsource.fields import specs_of
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

    A phantom takes the first two different places.
    """
    shared = {name: getattr(other, name) for name in _SHARED}
    path: Any = specs_of(type(motion))["path"]
    places = other.path
    if path.different:
        places = tuple(dict.fromkeys(places))[: path.most]
    recipe: Any = replace(motion, **shared)  # type: ignore[type-var]
    try:
        return replace(recipe, path=places)
    except InvalidInputError:
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
