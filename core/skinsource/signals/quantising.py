"""From numbers in parts of full scale to whole numbers: the one place where that is done."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import finite_array, integer, one_of
from skinsource.base.arrays import Integers

# Rounding to whole numbers that never wraps round and counts what it cuts off.

_BLOCK = 2**18
_LARGEST_SEED = 2**63 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class IntegerKind:
    """A kind of whole numbers that samples are written as.

    Attributes
    ----------
    name
        ``"int16"``.
    bits
        Of which one is the sign.
    zero
        What stands for 0.
    dtype
        Array that holds it; 12 and 24 bits lie in the lower bits of a wider one.
    """

    name: str
    bits: int
    zero: int
    dtype: str

    @property
    def most(self) -> int:
        """What stands for full scale, counted from ``zero``; the same on either side of it."""
        return 2 ** (self.bits - 1) - 1


KINDS = {
    kind.name: kind
    for kind in (
        IntegerKind(name="int8", bits=8, zero=0, dtype="int8"),
        IntegerKind(name="uint8", bits=8, zero=128, dtype="uint8"),
        IntegerKind(name="int12", bits=12, zero=0, dtype="int16"),
        IntegerKind(name="int16", bits=16, zero=0, dtype="int16"),
        IntegerKind(name="int24", bits=24, zero=0, dtype="int32"),
        IntegerKind(name="int32", bits=32, zero=0, dtype="int32"),
    )
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Quantised:
    """Whole numbers, and what became of the others.

    Attributes
    ----------
    values : (n_channels, n_times)
        Of the kind's dtype.
    kind
        What they are.
    full_scale
        How far from the kind's zero 1.0 lies.
    clipped : (n_channels,)
        Samples beyond full scale, which were cut off there.
    largest_error
        Largest difference between what was wanted, and was not cut off, and what is written, in
        parts of full scale.
    """

    values: NDArray[np.integer]
    kind: IntegerKind
    full_scale: int
    clipped: Integers
    largest_error: float


def quantised(samples: ArrayLike, kind: str, *, dither_seed: int | None = None) -> Quantised:
    """Round samples to whole numbers, to the nearest, halves to the even one.

    What lies beyond full scale is cut off there, and counted: nothing wraps round.

    Parameters
    ----------
    samples : (n_channels, n_times)
        In parts of full scale: -1 to 1.
    kind
        Name of one of `KINDS`.
    dither_seed
        Seed of dither that is added first: triangular, up to one step to either side, other for
        each channel.  Full scale is then one step lower, so that dither alone never clips.  None:
        no dither.

    Raises
    ------
    InvalidInputError
        A sample is not finite, or no kind has this name.
    """
    wanted = np.atleast_2d(finite_array("samples", samples))
    integer_kind = KINDS[one_of("kind", kind, tuple(KINDS))]
    seed = None
    if dither_seed is not None:
        seed = integer("dither_seed", dither_seed, 0, _LARGEST_SEED)
    full_scale = integer_kind.most if seed is None else integer_kind.most - 1
    values = np.empty(wanted.shape, integer_kind.dtype)
    clipped = np.zeros(wanted.shape[0], np.int64)
    largest_error = 0.0
    for row in range(wanted.shape[0]):
        random = None if seed is None else np.random.default_rng((seed, row))
        for start in range(0, wanted.shape[1], _BLOCK):
            part = wanted[row, start : start + _BLOCK]
            inside = np.clip(part, -1.0, 1.0)
            clipped[row] += np.count_nonzero(inside != part)
            steps = inside * full_scale
            if random is not None:
                # One draw of pairs: the numbers do not depend on the size of blocks.
                steps = steps + random.random((part.size, 2)).sum(axis=1) - 1.0
            steps = np.rint(steps)
            largest_error = max(
                largest_error, float(np.abs(steps / full_scale - inside).max(initial=0.0))
            )
            values[row, start : start + _BLOCK] = steps.astype(np.int64) + integer_kind.zero
    return Quantised(
        values=values,
        kind=integer_kind,
        full_scale=full_scale,
        clipped=clipped,
        largest_error=largest_error,
    )
