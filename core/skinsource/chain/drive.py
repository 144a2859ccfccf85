"""Sampled drives, far from over- and underflow."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.chain.chain import Chain, Part
from skinsource.errors import InvalidInputError

#: Largest sample of a drive or a response.  Far beyond it levels overflow, and NaN would come out.
LARGEST = 1e30


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class Drive:
    """What a voice plays, scaled by a power of two so that its peak lies between 1 and 2.

    Attributes
    ----------
    samples : (n_times,)
        Scaled samples.
    factor
        The power of two that was divided out; nothing rounds.
    """

    samples: Floats
    factor: float

    @property
    def silent(self) -> bool:
        """Whether it holds nothing but zeros."""
        return self.factor == 0.0


def drive_played(
    chain: Chain, sample_rate_hz: float, place: int, drawn: Callable[[Part], Floats]
) -> Drive:
    """Sum up what ``chain`` plays; its length is that of the samples.

    Parameters
    ----------
    drawn
        What each part plays before its gain, (n_times,).

    Raises
    ------
    InvalidInputError
        A part cannot be sampled, or a sample is not a usable number; the message names the place.
    """
    try:
        pieces = [drawn(part) for part in chain.parts]
    except InvalidInputError as error:
        raise InvalidInputError(f"Input at place {place}, {chain.title}: {error}") from error
    for part, piece in zip(chain.parts, pieces, strict=True):
        _check(piece, part.title, place)
    samples = _mixed(chain, sample_rate_hz, pieces)
    if len(pieces) != 1 or samples is not pieces[0]:
        _check(samples, chain.title, place)
    return drive_of(samples)


def _mixed(chain: Chain, sample_rate_hz: float, pieces: list[Floats]) -> Floats:
    """Sum of the pieces of a chain, times their gains and the curve, (n_times,)."""
    if len(pieces) == 1 and chain.parts[0].gain == 1.0 and not chain.curve:
        return pieces[0]
    placed = list(zip(chain.parts, pieces, strict=True))
    total = np.zeros(max((part.start + piece.size for part, piece in placed), default=0))
    for part, piece in placed:
        total[part.start : part.start + piece.size] += part.gain * piece
    if chain.curve:
        time_s, factor = np.array(chain.curve).T
        own_s = np.arange(chain.curve_start, chain.curve_start + total.size) / sample_rate_hz
        total *= np.interp(own_s, time_s, factor)
    return total


def _check(samples: Floats, title: str, place: int) -> None:
    bad = first_unusable(samples)
    if bad is not None:
        raise InvalidInputError(
            f"Input at place {place}, {title}: sample {bad[0]} is {samples[bad]}, expected a "
            f"finite number of at most {LARGEST:g}. Correct what the input plays, or mute it."
        )


def drive_of(samples: Floats) -> Drive:
    """Scale ``samples`` by a power of two; all computing is then far from over- and underflow."""
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0.0:
        return Drive(samples, 0.0)
    exponent = math.frexp(peak)[1] - 1
    return Drive(np.ldexp(samples, -exponent), math.ldexp(1.0, exponent))


def first_unusable(samples: Floats) -> tuple[int, ...] | None:
    """Index of the first sample that is not finite or beyond `LARGEST`; None if all are sound."""
    # NaN is the maximum of whatever holds it, and not less than anything.
    if samples.size == 0 or np.abs(samples).max() <= LARGEST:
        return None
    return tuple(int(index) for index in np.argwhere(~(np.abs(samples) <= LARGEST))[0])
