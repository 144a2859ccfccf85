"""Where samples of a clip lie, counted in samples."""

from math import ceil

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.sampling import NEAR, parted

#: What an effect may make of a clip; who wants more has made a mistake, or means harm.
LONGEST_S = 3600.0


def refuse_too_long(duration_s: float) -> None:
    """Refuse what would play longer than an hour, before it is made.

    Raises
    ------
    InvalidInputError
        It would.
    """
    if not duration_s <= LONGEST_S:
        raise InvalidInputError(
            f"an effect would make a clip of {duration_s:g} s, expected at most {LONGEST_S:g} s; "
            "repeat it less often, or stretch it less"
        )


def own_times(n: int, sample_rate_hz: float, shift_s: float) -> Floats:
    """Own time of the first ``n`` samples, (n,), in s; before the start it is below 0."""
    return np.arange(n) / sample_rate_hz - shift_s


def part_of_sample(samples: float) -> float:
    """How far a place lies after the last sample, 0 to less than 1; 0 where it lies on one."""
    return parted(samples)[1]


def samples_until(samples: float) -> int:
    """How many samples, from number 0 on, lie before a place; one that lies on it does not."""
    return max(ceil(samples - NEAR), 0)


def silent_outside(
    samples: Floats, sample_rate_hz: float, shift_s: float, duration_s: float
) -> Floats:
    """The samples, with 0 before own time 0 and from ``duration_s`` on; the same array if so."""
    end = samples_until((duration_s + shift_s) * sample_rate_hz)
    start = samples_until(shift_s * sample_rate_hz)
    if not samples[:start].any() and not samples[end:].any():
        return samples
    found = samples.copy()
    found[:start] = 0.0
    found[end:] = 0.0
    return found
