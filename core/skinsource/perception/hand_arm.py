"""Weighting of hand-transmitted vibration after ISO 5349-1: for health, not for perception.

The standard measures at the surface that vibrates, near the grip: at the contact, not on the skin.
"""

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.base.arguments import finite_array, positive_number
from skinsource.base.arrays import Complexes, Floats
from skinsource.base.errors import InvalidInputError

#: Frequencies and qualities of Wh (ISO 5349-1:2001, annex A): band limits, transition.
_F1_HZ, _F2_HZ, _F3_HZ, _F4_HZ = 6.310, 1258.9, 15.915, 15.915
_Q1, _Q2 = 0.71, 0.64


def hand_arm_weighting(frequency_hz: ArrayLike) -> Complexes:
    """Return the analogue response of Wh at frequencies, same shape; 0 at 0 Hz.

    |H| is 0.954 at 10 Hz, 0.325 at 50 Hz, 0.0797 at 200 Hz.

    Raises
    ------
    InvalidInputError
        A frequency is negative or not finite.
    """
    frequency = finite_array("frequency_hz", frequency_hz)
    if frequency.size and frequency.min() < 0.0:
        raise InvalidInputError("frequency_hz holds negative values, expected hertz from 0 on")
    s = 2j * np.pi * frequency
    w1, w2, w3, w4 = (2.0 * np.pi * f for f in (_F1_HZ, _F2_HZ, _F3_HZ, _F4_HZ))
    band = s**2 * w2**2 / ((s**2 + s * w1 / _Q1 + w1**2) * (s**2 + s * w2 / _Q1 + w2**2))
    gain = 2.0 * np.pi * _F4_HZ**2 / _F3_HZ
    transition = (s + w3) * gain / (s**2 + s * w4 / _Q2 + w4**2)
    response: Complexes = band * transition
    return response


def weighted_rms(acceleration: ArrayLike, sample_rate_hz: float) -> Floats:
    """Return the RMS of accelerations through Wh, (...,), m/s²: the root of the sum over axes.

    On the bins of the transform, so that no digital filter warps the response near half the rate.

    Parameters
    ----------
    acceleration : (n_axes, n_times) or (n_times,)
        Of the surface at the contact, m/s².
    sample_rate_hz
        Its rate.

    Raises
    ------
    InvalidInputError
        Another shape, no samples, or samples that are not finite.
    """
    data = finite_array("acceleration", acceleration, "(n_axes, n_times) or (n_times,)")
    rate = positive_number("sample_rate_hz", sample_rate_hz)
    if data.ndim not in (1, 2) or data.shape[-1] == 0:
        raise InvalidInputError(
            f"acceleration has shape {data.shape}, expected (n_axes, n_times) or (n_times,)"
        )
    n_times = data.shape[-1]
    spectra = scipy.fft.rfft(np.atleast_2d(data), axis=-1)
    weight = np.abs(hand_arm_weighting(np.arange(spectra.shape[-1]) * (rate / n_times)))
    power = np.sum(np.square(np.abs(spectra) * weight), axis=0)
    power[1 : (n_times + 1) // 2] *= 2.0
    return np.asarray(np.sqrt(power.sum()) / n_times)
