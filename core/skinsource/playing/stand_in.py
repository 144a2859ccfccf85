"""A sound that stands in for the actuators, for people who have none.

All frequencies are shifted up by the same number of hertz (single sideband): 25 to 600 Hz become
325 to 900 Hz with a shift of 300 Hz, which small loudspeakers play and ears hear evenly.  Times
and envelopes stay as they are, and so do distances in hertz, as of beats; intervals do not.
"""

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats
from skinsource.resampling import resample


def analytic(rows: Floats) -> Complexes:
    """Return ``rows``, (n_channels, n_times), without their negative frequencies.

    The real part is ``rows``.  What it rings beyond the ends is cut off.
    """
    n = rows.shape[1]
    # Room for what rings, so that it does not come back at the other end.
    length = scipy.fft.next_fast_len(2 * n + 1)
    found: Complexes = scipy.signal.hilbert(rows, length, axis=1)[:, :n]
    return found


def shifted(rows: Floats, from_hz: int, to_hz: int, shift_hz: float) -> Floats:
    """Return ``rows`` with all frequencies ``shift_hz`` higher, at another rate.

    Parameters
    ----------
    rows : (n_channels, n_times)
        Samples at ``from_hz``.
    to_hz
        Rate of the result, high enough for half of ``from_hz`` plus the shift.
    shift_hz
        How far.

    Returns
    -------
    (n_channels, n_times at ``to_hz``)
    """
    whole = analytic(rows)
    real, imaginary = (resample(part, from_hz, to_hz) for part in (whole.real, whole.imag))
    # Whole turns are taken off first, so that long designs lose no accuracy.
    turns = (np.arange(real.shape[1]) * (shift_hz / to_hz)) % 1.0
    found: Floats = real * np.cos(2.0 * np.pi * turns) - imaginary * np.sin(2.0 * np.pi * turns)
    return found


def on_two_ears(rows: Floats) -> Floats:
    """Return left and right, (2, n_times), of channels spread from left to right in their order.

    The two shares of a channel add up to 1; a single channel is in the middle.
    """
    n = rows.shape[0]
    to_right = (np.arange(n) + 0.5) / max(n, 1)
    found: Floats = np.stack((1.0 - to_right, to_right)) @ rows
    return found
