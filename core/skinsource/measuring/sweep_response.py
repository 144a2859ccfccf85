"""The response of an actuator from a voltage and the acceleration that came of it."""

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators import MeasuredResponse
from skinsource.arguments import finite_array, positive_number
from skinsource.errors import InvalidInputError
from skinsource.measuring.bands import Bands

#: Frequencies at which the voltage has less than this part of its largest density say nothing.
_HEARD = 1e-2


def response_from_sweep(
    voltage: ArrayLike,
    acceleration: ArrayLike,
    sample_rate_hz: float,
    band_hz: tuple[float, float] = (20.0, 1000.0),
) -> MeasuredResponse:
    """Acceleration over voltage, from both at the same samples.

    H = S_ua / S_uu, cross spectrum over spectrum of the voltage, both added up over a tenth of an
    octave: noise of the accelerometer that has nothing to do with the voltage averages out.

    Parameters
    ----------
    voltage, acceleration : (n_times,)
        In V at the actuator and m/s²; a sweep or noise, and what rings after it.
    sample_rate_hz
        Of both.
    band_hz
        Lowest and highest frequency that are wanted; points at which the voltage holds next to
        nothing are left out.

    Raises
    ------
    InvalidInputError
        They do not fit together, or the voltage holds too little in the band.
    """
    driven = finite_array("voltage", voltage, "finite numbers in V, (n_times,)")
    moved = finite_array("acceleration", acceleration, "finite numbers in m/s², (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    if driven.ndim != 1 or driven.shape != moved.shape or driven.size < 2:
        raise InvalidInputError(
            f"voltage and acceleration have the shapes {driven.shape} and {moved.shape}, expected "
            "two rows of equal length"
        )
    low_hz, high_hz = (positive_number("band_hz", one) for one in band_hz)
    if not low_hz < high_hz <= rate_hz / 2.0:
        raise InvalidInputError(
            f"band_hz is {low_hz:g} to {high_hz:g}, expected rising and at most {rate_hz / 2:g} Hz"
        )
    # Silence behind, so that what rings does not come round to the beginning.
    length = scipy.fft.next_fast_len(2 * driven.size, real=True)
    source = scipy.fft.rfft(driven, length)
    bands = Bands.between((low_hz, high_hz), rate_hz / length, source.size)
    summed = bands.sums(np.abs(source) ** 2)
    density = summed / bands.counts
    heard = density > _HEARD**2 * density.max(initial=0.0)
    if density.max(initial=0.0) == 0.0 or heard.sum() < 2:
        raise InvalidInputError(
            f"the voltage holds next to nothing from {low_hz:g} to {high_hz:g} Hz; measure with a "
            "sweep over that band"
        )
    cross = bands.sums(source.conj() * scipy.fft.rfft(moved, length))
    return MeasuredResponse.of(bands.centre_hz[heard], cross[heard] / summed[heard])
