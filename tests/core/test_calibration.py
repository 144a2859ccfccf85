"""The calibration undoes the measuring pulse: a known system, struck by the pulse, comes back."""

import numpy as np
import pytest

from skinsource.limbs.scaling import per_probe_acceleration

RATE_HZ = 1300.0
PEAK_M_PER_S2, WIDTH_S = 22.9, 1e-3


def system(n_taps: int = 522) -> np.ndarray:
    """Ringing of a band-limited system, well inside the taps."""
    time = (np.arange(n_taps) - 120) / RATE_HZ
    envelope = np.exp(-((time / 0.012) ** 2))
    return np.array([envelope * np.cos(2 * np.pi * f * time) for f in (60.0, 200.0, 480.0)])


def struck_by_the_pulse(impulse_responses: np.ndarray) -> np.ndarray:
    """Convolve with the pulse in continuous time, by Gauss and Legendre.

    The pulse is a rectangle around time 0.  Between its samples the response is band-limited.
    """
    sample = np.arange(impulse_responses.shape[-1])
    result = np.zeros_like(impulse_responses)
    for node, weight in zip(*np.polynomial.legendre.leggauss(6), strict=True):
        offset_s = node * WIDTH_S / 2
        late = np.sinc(sample[:, None] - sample[None, :] - offset_s * RATE_HZ)
        result += weight / 2 * impulse_responses @ late.T
    return result * PEAK_M_PER_S2 * RATE_HZ * WIDTH_S


def test_a_system_struck_by_the_measuring_pulse_is_recovered():
    expected = system()
    calibrated = per_probe_acceleration(struck_by_the_pulse(expected), RATE_HZ)
    np.testing.assert_allclose(calibrated, expected, rtol=0, atol=1e-5)


def test_the_gain_at_0_hz_is_one_over_the_area_of_the_pulse():
    constant = np.zeros(522)
    constant[100:400] = np.hanning(300)
    calibrated = per_probe_acceleration(constant, RATE_HZ)
    ratio = calibrated.sum() / constant.sum()
    assert ratio == pytest.approx(1 / (PEAK_M_PER_S2 * WIDTH_S * RATE_HZ), rel=1e-5)


def test_what_comes_before_the_start_does_not_come_round_to_the_end():
    early = np.zeros(522)
    early[1] = 1.0
    calibrated = np.abs(per_probe_acceleration(early, RATE_HZ))
    assert calibrated[-100:].max() < 1e-5 * calibrated.max()
