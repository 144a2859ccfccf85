"""Matrices of whole numbers of some thousand bits: exponentials and powers without rounding.

What a matrix of doubles loses in its exponential (scaling and squaring repeat each rounding up to
2^s times) is lost far behind the last digit here; the result is rounded once, entry by entry, so
that small entries beside large ones keep all their digits.
"""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

#: A matrix whose entries are multiples of 2 ** -bits.
WholeNumbers = NDArray[np.object_]

#: Bits that are right in the end, and those that make the series short.
_RIGHT_BITS, _SHORTER = 320, 16


def bits_for(matrices: Sequence[Sequence[Sequence[Fraction]]]) -> int:
    """Bits behind the point that suffice for the exponential of any of these, and products."""
    spans = [_size(entry) for matrix in matrices for line in matrix for entry in line if entry]
    return _RIGHT_BITS + 4 * max(map(abs, spans), default=0)


def whole_numbers(matrix: Sequence[Sequence[Fraction]], bits: int) -> WholeNumbers:
    """The matrix as multiples of 2 ** -``bits``."""
    lines = [[(entry.numerator << bits) // entry.denominator for entry in line] for line in matrix]
    found = np.empty((len(lines), len(lines[0])), dtype=object)
    for place, line in enumerate(lines):
        found[place] = line
    return found


def product(one: WholeNumbers, other: WholeNumbers, bits: int) -> WholeNumbers:
    """Product of two matrices."""
    return (one @ other) >> bits


def identity(n: int, bits: int) -> WholeNumbers:
    """The matrix that changes nothing."""
    found = np.zeros((n, n), dtype=object)
    found[range(n), range(n)] = 1 << bits
    return found


def exponential(matrix: WholeNumbers, bits: int) -> WholeNumbers:
    """Exponential of a square matrix: its series at a small part of it, squared up.

    References
    ----------
    Moler and Van Loan, Nineteen dubious ways to compute the exponential of a matrix, twenty-five
    years later, SIAM Review 45(1), 2003: method 3, which rounding alone makes dubious.
    """
    n = len(matrix)
    norm = max(sum(map(abs, line)) for line in matrix) >> bits
    squarings = norm.bit_length() + _SHORTER
    more = bits + 2 * squarings
    small = (matrix << (more - bits)) >> squarings
    total, term, k = identity(n, more), identity(n, more), 0
    while term.any():
        k += 1
        # Towards zero: rounded down, a term below zero would never vanish.
        term = _towards_zero(product(term, small, more), k)
        total = total + term
    for _ in range(squarings):
        total = product(total, total, more)
    return total >> (more - bits)


def powers(matrix: WholeNumbers, n: int, bits: int) -> list[WholeNumbers]:
    """Powers 0 to ``n`` of a square matrix."""
    found = [identity(len(matrix), bits)]
    for _ in range(n):
        found.append(product(found[-1], matrix, bits))
    return found


def rounded(matrix: WholeNumbers, bits: int) -> Floats:
    """The nearest floats; what no ordinary float is near is 0.

    Raises
    ------
    InvalidInputError
        An entry is beyond all floats.
    """
    unit = 1 << bits
    try:
        found = np.array([[entry / unit for entry in line] for line in matrix], np.float64)
    except OverflowError as error:
        raise InvalidInputError(
            "the parameters of the actuator lead beyond all floating-point numbers; move them "
            "nearer to those of real actuators"
        ) from error
    # Subnormal factors cost a hundred times the time of others.
    found[np.abs(found) < np.finfo(np.float64).tiny] = 0.0
    return found.reshape(matrix.shape)


def _towards_zero(matrix: WholeNumbers, divisor: int) -> WholeNumbers:
    quotient = abs(matrix) // divisor
    return np.where(matrix < 0, -quotient, quotient)


def _size(entry: Fraction) -> int:
    """How many bits its whole part has, or lie between the point and its first digit."""
    return entry.numerator.bit_length() - entry.denominator.bit_length()
