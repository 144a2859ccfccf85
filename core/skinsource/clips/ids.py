"""Ids that tell things of a design apart."""

from collections.abc import Sequence
from itertools import count

from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted


def numbered(ids: Sequence[int], what: str) -> tuple[int, ...]:
    """Return ``ids`` with the smallest free numbers where they are 0.

    Raises
    ------
    InvalidInputError
        Two of them are equal; ``what`` they belong to is named.
    """
    given = [one for one in ids if one]
    taken = set(given)
    if len(taken) < len(given):
        doubled = next(one for one in given if given.count(one) > 1)
        raise InvalidInputError(
            f"ids of the {what} are {quoted(given)}, {doubled} twice; expected different ones"
        )
    if len(given) == len(ids):
        return tuple(ids)
    free = (number for number in count(1) if number not in taken)
    return tuple(one or next(free) for one in ids)
