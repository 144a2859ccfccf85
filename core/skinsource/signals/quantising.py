"""Rounding of samples relative to full scale to integers, without wrap-around."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import finite_array, integer, one_of
from skinsource.base.conventions import Integers

_BLOCK = 2**18
_LARGEST_SEED = 2**63 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class IntegerKind:
    """A kind of integers that samples are written as.

    Attributes
    ----------
    name
        ``"int16"``.
    bits
        Number of bits, with the sign.
    zero
        The integer that means 0.
    dtype
        Type of arrays; 12 and 24 bits are the lower bits of a wider type.
    """

    name: str
    bits: int
    zero: int
    dtype: str

    @property
    def most(self) -> int:
        """Distance of full scale from ``zero``, the same on either side."""
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
    """Integers made of samples, with the errors that were made.

    Attributes
    ----------
    values : (n_channels, n_times)
        In the dtype of the kind.
    kind
        Their kind.
    full_scale
        Distance of 1.0 from the zero of the kind.
    clipped : (n_channels,)
        Number of samples beyond full scale, which were clipped.
    largest_error
        Largest difference between a sample, after clipping, and its integer, relative to full
        scale.
    """

    values: NDArray[np.integer]
    kind: IntegerKind
    full_scale: int
    clipped: Integers
    largest_error: float


def quantised(samples: ArrayLike, kind: str, *, dither_seed: int | None = None) -> Quantised:
    """Round samples to the nearest integers, halves to the even one.

    Samples beyond full scale are clipped and counted.

    Parameters
    ----------
    samples : (n_channels, n_times)
        Relative to full scale: -1 to 1.
    kind
        Name of one of `KINDS`.
    dither_seed
        Seed of dither that is added first: triangular, up to one step to either side, different
        for each channel.  Full scale is then one step lower, so that dither alone never clips.
        None: no dither.

    Raises
    ------
    InvalidInputError
        A sample is not finite, or no kind has this name.
    """
    channels = np.atleast_2d(finite_array("samples", samples))
    integer_kind = KINDS[one_of("kind", kind, tuple(KINDS))]
    seed = None
    if dither_seed is not None:
        seed = integer("dither_seed", dither_seed, 0, _LARGEST_SEED)
    full_scale = integer_kind.most if seed is None else integer_kind.most - 1
    values = np.empty(channels.shape, integer_kind.dtype)
    clipped = np.zeros(channels.shape[0], np.int64)
    largest_error = 0.0
    for row in range(channels.shape[0]):
        random = None if seed is None else np.random.default_rng((seed, row))
        for start in range(0, channels.shape[1], _BLOCK):
            part = channels[row, start : start + _BLOCK]
            inside = np.clip(part, -1.0, 1.0)
            clipped[row] += np.count_nonzero(inside != part)
            steps = inside * full_scale
            if random is not None:
                # Pairs are drawn at once, so that the numbers do not depend on the blocks.
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
