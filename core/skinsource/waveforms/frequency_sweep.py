"""Frequencies of a train of wavelets, one after the other."""

from typing import Literal

import numpy as np

from skinsource.arguments import one_of, positive_number, whole_number
from skinsource.errors import InvalidInputError

Spacing = Literal["linear", "logarithmic"]
Order = Literal["up", "down"]

#: Most wavelets of a train.
MOST = 1000


def frequency_sweep(
    low_hz: float,
    high_hz: float,
    count: int,
    spacing: Spacing = "logarithmic",
    order: Order = "up",
) -> tuple[float, ...]:
    """Frequencies from one to another, for `WaveletTrain`.

    >>> frequency_sweep(50.0, 400.0, 4)
    (50.0, 100.0, 200.0, 400.0)
    >>> frequency_sweep(100.0, 300.0, 3, "linear", "down")
    (300.0, 200.0, 100.0)

    Parameters
    ----------
    low_hz, high_hz
        The ends, both exactly among them; a single frequency is the lower.
    count
        How many, 1 to 1000.
    spacing
        ``"linear"``: equal steps; ``"logarithmic"``: equal factors.
    order
        ``"up"`` contracts on the skin, because high frequencies die out earlier; ``"down"``
        expands.

    Raises
    ------
    InvalidInputError
        An end is no positive number, the ends are not in order, or the count, the spacing or the
        order is none.
    """
    low, high = positive_number("low_hz", low_hz), positive_number("high_hz", high_hz)
    if low > high:
        raise InvalidInputError(
            f"low_hz is {low:g}, expected at most high_hz, {high:g}; order 'down' turns them round"
        )
    count = whole_number("count", count, 1, MOST)
    one_of("spacing", spacing, ("linear", "logarithmic"))
    one_of("order", order, ("up", "down"))
    part = np.arange(count) / max(count - 1, 1)
    found = low + (high - low) * part if spacing == "linear" else low * (high / low) ** part
    # Twelve digits are what one can read; the ends are as they were given.
    values = (low, *(float(f"{one:.12g}") for one in found[1:-1]), *(high,) * (count > 1))
    return values[::-1] if order == "down" else values
