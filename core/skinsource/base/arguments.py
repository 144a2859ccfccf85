"""Checks of the arguments that scripts give to the library: arrays, numbers, choices.

The errors name the argument, its value and what was expected.  Refused are complex numbers, of
which only half would be used; masked values, which would be used all the same; texts, which would
be read as numbers; and numbers that are not finite, where they would spread.
"""

import inspect
import math
import re
from collections.abc import Callable, Iterable, Sequence
from functools import partial, wraps
from numbers import Real
from types import UnionType
from typing import Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, SkinSourceError, quoted

Text = TypeVar("Text", bound=str)
P = ParamSpec("P")
R = TypeVar("R")
Kind = TypeVar("Kind")

#: Largest sample: sums of some thousand of them are still finite.
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
    except Exception as error:  # an object that claims to be an array may raise anything
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
    # A wider float may not fit; it becomes infinite, which the checks that follow find.
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def finite_array(
    name: str,
    values: ArrayLike,
    expected: str = "finite real numbers",
    largest: float = math.inf,
) -> Floats:
    """Return ``values`` as `real_array` does; refuse values not finite or beyond ``largest``."""
    array = real_array(name, values, expected)
    finite = min(largest, np.finfo(np.float64).max)
    # The maximum of an array with NaN is NaN, which is not below anything.
    if array.size and not np.abs(array).max() <= finite:
        index = tuple(int(k) for k in np.argwhere(~(np.abs(array) <= finite))[0])
        limit = "" if largest == math.inf else f" of at most {largest:g}"
        raise InvalidInputError(
            f"{name} is {array[index]} at index {index}, expected finite numbers{limit}"
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
    """Return ``value`` as a float; refuse all but one finite number within the limits.

    Raises
    ------
    InvalidInputError
        Says ``name``, the value, and what was ``expected``.
    """
    number = _float_or_none(value)
    if number is None or not (math.isfinite(number) and least <= number <= most):
        raise InvalidInputError(f"{name} is {quoted(value)}, expected {expected}")
    return number


def positive_number(name: str, value: object) -> float:
    """Return ``value`` as a float; refuse all but a finite number above 0."""
    number = real_number(name, value, "a positive number")
    if number <= 0:
        raise InvalidInputError(f"{name} is {quoted(value)}, expected a positive number")
    return number


def integer(name: str, value: object, least: int, most: int) -> int:
    """Return ``value`` as an int; 5.0 is accepted, True is not.

    Raises
    ------
    InvalidInputError
        It is no whole number from ``least`` to ``most``.
    """
    number = (
        value if isinstance(value, int) and not isinstance(value, bool) else _float_or_none(value)
    )
    # Comparing first: an int may be too large for a float, and NaN is not between anything.
    if number is not None and least <= number <= most and number == int(number):
        return int(number)
    raise InvalidInputError(
        f"{name} is {quoted(value)}, expected a whole number from {least} to {most}"
    )


def one_of(name: str, value: object, allowed: Sequence[Text]) -> Text:
    """Return the text among ``allowed`` that equals ``value``.

    Raises
    ------
    InvalidInputError
        ``value`` is none of them.
    """
    for text in allowed:
        if isinstance(value, str) and value == text:
            return text
    raise InvalidInputError(
        f"{name} {quoted(value)} is not known; choose from {', '.join(allowed)}"
    )


def checking(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that names the argument of a wrong type where that makes it fail.

    Types are compared once it has failed: what works is accepted, and nothing takes longer.

    Raises
    ------
    InvalidInputError
        It failed, and an argument is not of the type that its parameter is annotated with.
    """

    @wraps(function)
    def checking_function(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return function(*args, **kwargs)
        except SkinSourceError:
            raise
        except (TypeError, AttributeError, ValueError, LookupError, ArithmeticError):
            _check_types(function, *args, **kwargs)
            raise

    checking_function.__signature__ = _shown_signature(function)  # type: ignore[attr-defined]
    return checking_function


def brief(kind: type[Kind]) -> type[Kind]:
    """Return a class whose signature in help is as short as those of functions.

    A default that is a plain number, text or truth value says its type.
    """
    kind.__signature__ = _shown_signature(kind, plain=True)  # type: ignore[attr-defined]
    return kind


class _Name(str):
    """A type as help shows it, without quotes."""

    def __repr__(self) -> str:
        return str(self)


class _NamedDefault(partial[object]):
    """A function that is a default, as help shows it: by its name."""

    def __repr__(self) -> str:
        return str(self.func.__name__)


def _shown_signature(function: Callable[..., object], *, plain: bool = False) -> inspect.Signature:
    """Return a signature for readers: types are names, and those of defaults None alone."""
    signature = inspect.signature(function)
    parameters = []
    for parameter in signature.parameters.values():
        name = parameter.annotation
        if isinstance(name, str):
            if parameter.default is None:
                name = name.removesuffix(" | None")
            said = plain and name == type(parameter.default).__name__
            parameter = parameter.replace(annotation=parameter.empty if said else _Name(name))
        if inspect.isfunction(parameter.default):
            parameter = parameter.replace(default=_NamedDefault(parameter.default))
        parameters.append(parameter)
    returned = signature.return_annotation
    shown = _Name(returned) if isinstance(returned, str) else returned
    return signature.replace(parameters=parameters, return_annotation=shown)


def _check_types(function: Callable[..., object], *args: object, **kwargs: object) -> None:
    hints, signature = get_type_hints(function), inspect.signature(function)
    for name, value in signature.bind(*args, **kwargs).arguments.items():
        if name not in hints:
            # The object of a method.
            continue
        several = signature.parameters[name].kind is inspect.Parameter.VAR_POSITIONAL
        for part in value if several else (value,):
            if not _fits(part, hints[name]):
                expected = re.sub(r"\b(\w+\.)+", "", inspect.formatannotation(hints[name]))
                raise InvalidInputError(f"{name} is {quoted(part)}, expected {expected}")


def _fits(value: Any, hint: Any) -> bool:
    """Whether a value is of a type; True where that cannot be told."""
    kind, parts = get_origin(hint) or hint, get_args(hint)
    if kind in (Union, UnionType):
        return any(_fits(value, part) for part in parts)
    if kind is Literal:
        return isinstance(value, str) and value in parts
    if kind in (int, float):
        number = _float_or_none(value)
        return number is not None and math.isfinite(number) and kind(number) == number
    if kind is Any or not isinstance(kind, type):
        return True
    if isinstance(value, str | bytes) and issubclass(kind, Iterable):
        return kind is type(value)
    if not isinstance(value, kind):
        return False
    if isinstance(value, tuple) and parts and Ellipsis not in parts:
        return len(value) == len(parts) and all(map(_fits, value, parts))
    # Others may be without end.
    return not (isinstance(value, list | tuple) and parts) or all(_fits(v, parts[0]) for v in value)


def _float_or_none(value: object) -> float | None:
    """Return a number of Python, of numpy, or of an array without dimensions; None for all else."""
    # The usual case; to check other types takes far longer.
    if type(value) is float:
        return value
    if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.isMaskedArray(value):
        value = value[()]
    if isinstance(value, bool | np.bool_ | np.timedelta64) or not isinstance(value, Real):
        return None
    try:
        return float(value)
    except (OverflowError, ValueError, ArithmeticError):
        return None
