"""A sound that stands in for the actuators, for people who have none.

All frequencies are shifted up by the same number of hertz (single sideband): 25 to 600 Hz become
325 to 900 Hz with a shift of 300 Hz, which small loudspeakers play and ears hear evenly.  Times
and envelopes stay as they are, and so do distances in hertz, as of beats; intervals do not.
"""

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats


def analytic(rows: Floats) -> Complexes:
    """Return ``rows``, (n_channels, n_times), without their negative frequencies.

    The real part is ``rows``.  What it rings beyond the ends is cut off.
    """
    n = rows.shape[1]
    # Room for what rings, so that it does not come back at the other end.
    length = scipy.fft.next_fast_len(2 * n + 1)
    found: Complexes = scipy.signal.hilbert(rows, length, axis=1)[:, :n]
    return found


def turned_up(parts: Floats, sample_rate_hz: int, shift_hz: float) -> Floats:
    """Return signals with all frequencies ``shift_hz`` higher.

    Parameters
    ----------
    parts : (2 n_channels, n_times)
        Real parts of all analytic signals, then their imaginary parts.
    sample_rate_hz
        Their rate, high enough for what comes out.
    shift_hz
        How far.

    Returns
    -------
    (n_channels, n_times)
    """
    n = parts.shape[0] // 2
    # Whole turns are taken off first, so that long designs lose no accuracy.
    turns = (np.arange(parts.shape[1]) * (shift_hz / sample_rate_hz)) % 1.0
    angle = 2.0 * np.pi * turns
    found: Floats = parts[:n] * np.cos(angle) - parts[n:] * np.sin(angle)
    return found


def on_two_ears(rows: Floats) -> Floats:
    """Return left and right, (2, n_times), of channels spread from left to right in their order.

    The two shares of a channel add up to 1; a single channel is in the middle.
    """
    n = rows.shape[0]
    to_right = (np.arange(n) + 0.5) / max(n, 1)
    found: Floats = np.stack((1.0 - to_right, to_right)) @ rows
    return found
