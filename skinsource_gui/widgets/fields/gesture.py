"""Numbers that tell one drag, or one turn of the wheel, from the next."""

from itertools import count

_numbers = count(1)


def new_gesture() -> int:
    """Return a number that no gesture had before; edits that share it undo as one step."""
    return next(_numbers)
