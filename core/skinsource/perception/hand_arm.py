"""Weighting of hand-transmitted vibration after ISO 5349-1: for health, not for perception.

The standard measures at the surface that vibrates, near the grip: at the contact, not on the skin.
"""

import numpy as np
import scipy

from skinsource.base.arrays import Complexes, Floats

#: Frequencies and qualities of Wh (ISO 5349-1:2001, annex A): band limits, transition.
_F1_HZ, _F2_HZ, _F3_HZ, _F4_HZ = 6.310, 1258.9, 15.915, 15.915
_Q1, _Q2 = 0.71, 0.64


def hand_arm_weighting(frequency_hz: Floats) -> Complexes:
    """Return the analogue response of Wh at frequencies, same shape; 0 at 0 Hz.

    |H| is 0.954 at 10 Hz, 0.325 at 50 Hz, 0.0797 at 200 Hz.
    """
    s = 2j * np.pi * frequency_hz
    w1, w2, w3, w4 = (2.0 * np.pi * f for f in (_F1_HZ, _F2_HZ, _F3_HZ, _F4_HZ))
    band = s**2 * w2**2 / ((s**2 + s * w1 / _Q1 + w1**2) * (s**2 + s * w2 / _Q1 + w2**2))
    gain = 2.0 * np.pi * _F4_HZ**2 / _F3_HZ
    transition = (s + w3) * gain / (s**2 + s * w4 / _Q2 + w4**2)
    response: Complexes = band * transition
    return response


def weighted_rms(acceleration: Floats, sample_rate_hz: float) -> float:
    """Return the RMS of an acceleration through Wh, m/s².

    On the bins of the transform, so that no digital filter warps the response near half the rate.

    Parameters
    ----------
    acceleration : (n_times,)
        Of the surface at the contact, m/s².
    sample_rate_hz
        Its rate.
    """
    n_times = acceleration.size
    spectrum = scipy.fft.rfft(acceleration)
    frequency_hz = np.arange(spectrum.size, dtype=np.float64) * (sample_rate_hz / n_times)
    weight = np.abs(hand_arm_weighting(frequency_hz))
    power = np.square(np.abs(spectrum) * weight)
    power[1 : (n_times + 1) // 2] *= 2.0
    return float(np.sqrt(power.sum()) / n_times)
