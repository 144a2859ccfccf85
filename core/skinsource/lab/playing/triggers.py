"""Trigger codes: pulses on an output of their own that tell a recorder which stimulus began."""

import numpy as np

from skinsource.base.arguments import integer
from skinsource.base.conventions import Floats

#: Length of each bit: seen by any recorder at 1 kHz.
BIT_S = 0.005
BITS = 8


def trigger_of(code: int, sample_rate_hz: int) -> Floats:
    """Return the samples that tell a code: a high bit, 8 bits from the lowest on, a low one.

    Parameters
    ----------
    code
        From 0 to 255.
    sample_rate_hz
        Of the device.

    Returns
    -------
    (n_times,)
        0 and 1, ten bits of 5 ms each.

    Raises
    ------
    InvalidInputError
        The code is none.

    Examples
    --------
    >>> from skinsource.lab.playing.triggers import trigger_of
    >>> trigger_of(5, 200).astype(int).tolist()
    [1, 1, 0, 1, 0, 0, 0, 0, 0, 0]
    """
    number = integer("code", code, 0, 2**BITS - 1)
    bits = [1, *(number >> k & 1 for k in range(BITS)), 0]
    return np.repeat(np.array(bits, float), round(BIT_S * sample_rate_hz))


def code_in(samples: Floats, sample_rate_hz: int) -> tuple[int, int] | None:
    """Return the code that a recording holds, and the sample at which it begins; None: no code.

    Parameters
    ----------
    samples : (n_times,)
        Of the channel that the trigger was recorded on.
    sample_rate_hz
        Of the recording.

    Examples
    --------
    >>> import numpy as np
    >>> from skinsource.lab.playing.triggers import code_in, trigger_of
    >>> recorded = np.concatenate([np.zeros(100), trigger_of(37, 1000), np.zeros(50)])
    >>> code_in(recorded, 1000)
    (37, 100)
    """
    high = samples > 0.5 * np.max(np.abs(samples), initial=0.0)
    if not high.any():
        return None
    begin, step = int(np.argmax(high)), BIT_S * sample_rate_hz
    middles = [begin + round((k + 0.5) * step) for k in range(1, BITS + 1)]
    if middles[-1] >= high.size:
        return None
    return sum(int(high[at]) << k for k, at in enumerate(middles)), begin
