import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.signals.generators import sample_count, sinusoid, white_noise


def half_up(milliseconds: int) -> int:
    return math.floor(Fraction(milliseconds, 1000) * 1300 + Fraction(1, 2))


def test_all_durations_in_milliseconds_are_rounded_half_up():
    for milliseconds in range(1001):
        assert sample_count(milliseconds / 1000) == half_up(milliseconds), milliseconds


@pytest.mark.parametrize("duration_s", [-1e-9, math.nan, math.inf, -math.inf, 1e308])
def test_an_impossible_duration_is_refused(duration_s):
    with pytest.raises(InvalidInputError, match="duration_s is"):
        sample_count(duration_s)


@pytest.mark.parametrize("duration_s", [1, 60, 3600])
@pytest.mark.parametrize(("frequency_hz", "phase_rad"), [(250.1, 0.0), (649.9, -1.0), (0.3, 6.0)])
def test_a_sinusoid_is_exact_to_1e_12_for_an_hour(duration_s, frequency_hz, phase_rad):
    samples = sinusoid(frequency_hz, duration_s, phase_rad=phase_rad)
    assert samples.shape == (1300 * duration_s,)
    seed = 17
    places = np.random.default_rng(seed).integers(0, samples.size, 200)
    places = np.concatenate((places, np.arange(20), samples.size - 1 - np.arange(20)))
    with mpmath.workdps(40):
        turn = 2 * mpmath.pi
        expected = [
            float(mpmath.sin(turn * mpmath.mpf(frequency_hz) * int(k) / 1300 + phase_rad))
            for k in places
        ]
    np.testing.assert_allclose(samples[places], expected, rtol=0, atol=1e-12, err_msg=f"{seed=}")


@pytest.mark.parametrize("frequency_hz", [650.0, 650.1, 1300.0, -1.0, 1e300])
def test_a_tone_that_would_alias_is_refused(frequency_hz):
    with pytest.raises(InvalidInputError, match="would alias"):
        sinusoid(frequency_hz, 0.1)


def test_noise_reaches_up_to_half_the_rate():
    highest = np.abs(np.fft.rfft(white_noise(1.0, band_hz=(25.0, 650.0))))[640:]
    assert np.median(highest) > 0.1 * highest.max()
    with pytest.raises(InvalidInputError, match=r"at most 650 Hz .*would alias"):
        white_noise(0.1, band_hz=(25.0, 650.1))


def test_noise_too_short_for_its_band_is_refused():
    with pytest.raises(InvalidInputError, match="holds no frequency"):
        white_noise(0.001)
    assert white_noise(0.0).shape == (0,)
