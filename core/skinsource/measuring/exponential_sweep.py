"""A sine whose frequency rises evenly over the logarithm: what actuators are measured with."""

from math import floor

import numpy as np

from skinsource.arguments import real_number, whole_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

# Of the sweep, at each end: a voltage that jumps would be a click.
_FADE = 0.04


def exponential_sweep(
    band_hz: tuple[float, float],
    duration_s: float,
    sample_rate_hz: int,
    clock_ratio: float = 1.0,
) -> Floats:
    """A sweep of amplitude 1, (n_times,), that begins and ends in silence.

    Each octave takes the same time, so that low frequencies, which take longest to tell from
    noise, get most of the energy.  Source: A. Farina, "Simultaneous measurement of impulse
    response and distortion with a swept-sine technique", 108th AES Convention, 2000.

    Parameters
    ----------
    band_hz
        First and last frequency, rising.
    duration_s
        From first to last sample.
    sample_rate_hz
        A whole number of hertz, more than twice the last frequency.
    clock_ratio
        Samples are taken by a clock that is so many times as quick as the one that plays: the
        sweep as a device records it that has a clock of its own.

    Raises
    ------
    InvalidInputError
        They do not go together.
    """
    rate_hz = whole_number("sample_rate_hz", sample_rate_hz, 1, 10**7)
    first_hz, last_hz = (real_number("band_hz", one) for one in band_hz)
    if not 0.0 < first_hz < last_hz < rate_hz / 2.0:
        raise InvalidInputError(
            f"band_hz is {first_hz:g} to {last_hz:g}, expected rising, above 0 and below "
            f"{rate_hz / 2:g} Hz"
        )
    long_s = real_number("duration_s", duration_s, "at least two turns of the first frequency",
                         least=2.0 / first_hz)  # fmt: skip
    n = round(long_s * rate_hz)
    # Where, in samples of the clock that plays.
    place = np.arange(floor((n - 1) * clock_ratio) + 1) / clock_ratio
    octaves = np.log(last_hz / first_hz) / long_s
    sweep: Floats = np.sin(2.0 * np.pi * first_hz * np.expm1(octaves * place / rate_hz) / octaves)
    n_fade = max(round(_FADE * n), 1)
    inside = np.minimum(np.minimum(place, n - 1 - place) / n_fade, 1.0)
    return sweep * (0.5 - 0.5 * np.cos(np.pi * inside))
