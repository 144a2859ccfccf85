"""How far a tone has turned, and by how much a recipe starts between two samples."""

import numpy as np

from skinsource.arguments import positive_number, real_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

_BLOCK = 256


def shift_of(shift_s: float, sample_rate_hz: float) -> float:
    """Return ``shift_s``; refuse what is not between 0 and one sample.

    Raises
    ------
    InvalidInputError
        It is negative, or a sample or longer.
    """
    period_s = 1.0 / positive_number("sample_rate_hz", sample_rate_hz)
    shift = real_number("shift_s", shift_s)
    if not 0.0 <= shift < period_s:
        raise InvalidInputError(
            f"shift_s is {shift:g}, expected 0 to {period_s:g} (one sample at {sample_rate_hz:g} "
            "Hz); move the rest by whole samples"
        )
    return shift


def turns(frequency_hz: float, n: int, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
    """Turns of a tone at the first ``n`` instants of its recipe, (n,), less whole ones.

    They are reduced in exact arithmetic, so that the error does not grow with time: below 1e-12
    at one hour.
    """
    frequency = real_number("frequency_hz", frequency_hz)
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    # Turns per sample as a fraction of whole numbers; dividing those rounds once.
    (hz, per_hz), (rate, per_rate) = (value.as_integer_ratio() for value in (frequency, rate_hz))
    above, below = hz * per_rate, per_hz * rate
    starts = [k * above % below / below for k in range(0, n, _BLOCK)]
    within = np.arange(_BLOCK) * (above / below)
    found = np.add.outer(np.array(starts), within).ravel()[:n]
    return found - frequency * shift_s if shift_s else found
