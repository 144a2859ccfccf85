"""One door for what scripts hand to the library: arrays, numbers, choices.

What cannot be meant is refused here, with the argument's name, what was found and what was
expected: complex numbers, of which only half would be used; masked values, which would be used all
the same; texts, which would be read as numbers; what is not finite where it would pass on.
"""

import math
from collections.abc import Sequence
from numbers import Real
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import quoted

Text = TypeVar("Text", bound=str)

#: Sums of some thousand of them still are numbers.
LARGEST_SAMPLE = 1e300
_NUMBERS = "biuf"


def real_array(name: str, values: ArrayLike, expected: str = "real numbers") -> Floats:
    """Return ``values`` as float64; the same array where it is one.

    Parameters
    ----------
    name
        The argument's, for messages.
    values
        Anything that numpy makes an array of real numbers of; may hold NaN and infinities.
    expected
        What it should be, for messages.

    Raises
    ------
    InvalidInputError
        Complex or masked values, texts, whole numbers that are too large, or no array at all.
    """
    if np.ma.isMaskedArray(values):
        if np.ma.getmaskarray(values).any():
            raise InvalidInputError(
                f"{name} has masked values, expected {expected}. Fill or remove them first."
            )
        values = values.data
    try:
        array = np.asarray(values)
    except Exception as error:  # what claims to be an array may raise anything
        raise InvalidInputError(
            f"{name} cannot be read as one array of real numbers: found {quoted(values)}, expected "
            f"{expected}"
        ) from error
    if array.dtype.kind == "c":
        raise InvalidInputError(
            f"{name} holds complex numbers, expected {expected}. Take their magnitude or their "
            "real part first."
        )
    if array.dtype.kind not in _NUMBERS:
        raise InvalidInputError(
            f"{name} cannot be read as one array of real numbers: found {quoted(values)}, expected "
            f"{expected}"
        )
    return _as_floats(array)


def finite_array(
    name: str,
    values: ArrayLike,
    expected: str = "finite real numbers",
    largest: float = math.inf,
) -> Floats:
    """Return ``values`` as `real_array` does; refuse what is not finite or beyond ``largest``."""
    array = real_array(name, values, expected)
    # NaN is the maximum of whatever holds it, and not less than anything.
    if array.size and not np.abs(array).max() <= min(largest, np.finfo(np.float64).max):
        bad = ~(np.abs(array) <= min(largest, np.finfo(np.float64).max))
        place = tuple(int(k) for k in np.argwhere(bad)[0])
        limit = "" if largest == math.inf else f" of at most {largest:g}"
        raise InvalidInputError(
            f"{name} is {array[place]} at index {place}, expected finite numbers{limit}"
        )
    return array


def real_number(
    name: str,
    value: object,
    expected: str = "a finite number",
    *,
    least: float = -math.inf,
    most: float = math.inf,
) -> float:
    """Return ``value`` as a float; refuse what is no single finite number, or outside the limits.

    Raises
    ------
    InvalidInputError
        Says ``name``, the value, and what was ``expected``.
    """
    number = _single(value)
    if number is None or not (math.isfinite(number) and least <= number <= most):
        raise InvalidInputError(f"{name} is {quoted(value)}, expected {expected}")
    return number


def positive_number(name: str, value: object) -> float:
    """Return ``value`` as a float; refuse what is no finite number above 0."""
    number = real_number(name, value, "a positive number")
    if number <= 0:
        raise InvalidInputError(f"{name} is {quoted(value)}, expected a positive number")
    return number


def integer(name: str, value: object, least: int, most: int) -> int:
    """Return ``value`` as an int; 5.0 is one, True is none.

    Raises
    ------
    InvalidInputError
        It is no whole number from ``least`` to ``most``.
    """
    number = value if isinstance(value, int) and not isinstance(value, bool) else _single(value)
    # Comparing first: an int may be too large for a float, and NaN is not between anything.
    if number is not None and least <= number <= most and number == int(number):
        return int(number)
    raise InvalidInputError(
        f"{name} is {quoted(value)}, expected a whole number from {least} to {most}"
    )


def one_of(name: str, value: object, allowed: Sequence[Text]) -> Text:
    """Return the text among ``allowed`` that ``value`` is.

    Raises
    ------
    InvalidInputError
        There is none.
    """
    for text in allowed:
        if isinstance(value, str) and value == text:
            return text
    raise InvalidInputError(
        f"{name} {quoted(value)} is not known; choose from {', '.join(allowed)}"
    )


def _as_floats(array: NDArray[np.generic]) -> Floats:
    # A wider float may not fit; what becomes infinite is then seen as that.
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def _single(value: object) -> float | None:
    """The number that ``value`` is, if it is one: of Python, of numpy, or an array of one."""
    # Most are; whether something else is a real number takes far longer to find out.
    if type(value) is float:
        return value
    if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.isMaskedArray(value):
        value = value[()]
    if isinstance(value, bool | np.bool_) or not isinstance(value, Real):
        return None
    try:
        return float(value)
    except (OverflowError, ValueError, ArithmeticError):
        return None
