import math
from fractions import Fraction
from itertools import pairwise

import mpmath
import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms import KINDS
from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.signals.generators import impulse, sample_count, sinusoid, tap, white_noise

RATE_HZ = 1300.0


def half_up(milliseconds: int) -> int:
    return math.floor(Fraction(milliseconds, 1000) * 1300 + Fraction(1, 2))


def test_all_durations_in_milliseconds_are_rounded_half_up():
    for milliseconds in range(1001):
        assert sample_count(milliseconds / 1000) == half_up(milliseconds), milliseconds


def test_long_durations_are_rounded_half_up_too():
    for milliseconds in range(1000, 600_001, 997):
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


def test_a_sinusoid_is_windowed_over_its_own_length():
    windowed = sinusoid(100.0, 0.1, window_name="tukey")
    plain = sinusoid(100.0, 0.1)
    assert windowed[0] == windowed[-1] == 0.0
    np.testing.assert_array_equal(windowed[20:110], plain[20:110])


@pytest.mark.parametrize("frequency_hz", [650.0, 650.1, 1300.0, -1.0, 1e300])
def test_a_tone_that_would_alias_is_refused(frequency_hz):
    with pytest.raises(InvalidInputError, match="would alias"):
        sinusoid(frequency_hz, 0.1)


@pytest.mark.parametrize("frequency_hz", [math.nan, math.inf, "100"])
def test_a_frequency_that_is_none_is_refused(frequency_hz):
    with pytest.raises(InvalidInputError, match=r"frequency_hz is .* expected a finite number"):
        sinusoid(frequency_hz, 0.1)


def test_a_tone_just_below_half_the_sample_rate_is_made():
    assert np.isfinite(sinusoid(649.999, 0.1)).all()
    assert sinusoid(0.0, 0.1, phase_rad=math.pi / 2).tolist() == [1.0] * 130


def test_frequencies_may_be_numbers_of_any_type():
    for frequency_hz in (100, np.int64(100), np.float32(100), np.float64(100)):
        np.testing.assert_array_equal(sinusoid(frequency_hz, 0.1), sinusoid(100.0, 0.1))


@pytest.mark.parametrize("phase_rad", [math.nan, math.inf])
def test_an_impossible_phase_is_refused(phase_rad):
    with pytest.raises(InvalidInputError, match="phase_rad"):
        sinusoid(100.0, phase_rad=phase_rad)


@pytest.mark.parametrize("milliseconds", [0, 1, 5, 25, 45, 100, 350, 1000])
def test_a_tap_starts_at_its_time_and_peaks_ten_samples_later(milliseconds):
    samples = tap(milliseconds / 1000)
    start = half_up(milliseconds)
    assert samples.shape == (start + 21,)
    assert not samples[:start].any()
    assert (samples[start:] > 0).all()
    assert samples.argmax() == start + 10
    assert samples[start + 10] == 1.0


def test_an_impulse_is_one_sample():
    assert impulse().tolist() == [1.0]
    samples = impulse(0.01, 0.1)
    assert samples.shape == (130,)
    assert np.flatnonzero(samples).tolist() == [13]
    assert samples[13] == 1.0
    with pytest.raises(InvalidInputError, match="after the end"):
        impulse(0.1, 0.1)


@pytest.mark.parametrize("duration_s", [0.01, 0.1, 0.2, 1.0, 7.3])
def test_noise_lies_in_its_band_and_nowhere_else(duration_s):
    samples = white_noise(duration_s, seed=3)
    assert np.abs(samples).max() == 1.0
    n = samples.size
    time = np.arange(n) / RATE_HZ
    frequency_hz = np.arange(n // 2 + 1) * RATE_HZ / n
    outside = (frequency_hz < 25) | (frequency_hz > 600)
    chosen = np.concatenate((np.flatnonzero(outside)[:40], np.flatnonzero(outside)[-40:]))
    leak = np.exp(-2j * np.pi * np.outer(frequency_hz[chosen], time)) @ samples / n
    assert np.abs(leak).max() < 1e-14


def test_noise_is_about_as_strong_in_every_third_of_its_band():
    samples = white_noise(20.0, seed=5)
    power = np.abs(np.fft.rfft(samples)) ** 2
    frequency_hz = np.fft.rfftfreq(samples.size, 1 / RATE_HZ)
    edges = np.linspace(25, 600, 4)
    mean = [
        power[(frequency_hz >= low) & (frequency_hz < high)].mean() for low, high in pairwise(edges)
    ]
    np.testing.assert_allclose(mean / np.mean(mean), 1.0, atol=0.1)


def test_noise_of_one_seed_is_always_the_same_and_of_two_seeds_is_not():
    np.testing.assert_array_equal(white_noise(0.5, 0), white_noise(0.5, 0))
    first, second = white_noise(0.5, 0), white_noise(0.5, 1)
    assert abs(np.corrcoef(first, second)[0, 1]) < 0.3


def test_noise_can_be_windowed_and_keeps_its_peak():
    samples = white_noise(0.2, 4, window_name="tukey")
    assert samples[0] == samples[-1] == 0.0
    assert np.abs(samples).max() == 1.0


def test_noise_reaches_up_to_half_the_rate():
    highest = np.abs(np.fft.rfft(white_noise(1.0, band_hz=(25.0, 650.0))))[640:]
    assert np.median(highest) > 0.1 * highest.max()
    with pytest.raises(InvalidInputError, match=r"at most 650 Hz .*would alias"):
        white_noise(0.1, band_hz=(25.0, 650.1))


@pytest.mark.parametrize("band_hz", [(600.0, 25.0), (25.0, 651.0), (-1.0, 600.0), (math.nan, 1.0)])
def test_an_impossible_band_is_refused(band_hz):
    with pytest.raises(InvalidInputError, match="band_hz"):
        white_noise(0.1, band_hz=band_hz)


@pytest.mark.parametrize("seed", [-1, 1.5, math.nan])
def test_an_impossible_seed_is_refused(seed):
    with pytest.raises(InvalidInputError, match="seed"):
        white_noise(0.1, seed)


def test_noise_too_short_for_its_band_is_refused():
    with pytest.raises(InvalidInputError, match="holds no frequency"):
        white_noise(0.001)
    assert white_noise(0.0).shape == (0,)


@pytest.mark.parametrize("kind", KINDS)
def test_every_waveform_is_as_long_as_it_says_and_about_one_at_its_peak(kind):
    recipe = kind()
    samples = recipe.samples(RATE_HZ)
    assert samples.shape == (sample_count(recipe.duration_s),)
    assert samples.dtype == np.float64
    # With edges cut off at half the rate, it may miss its peak, or pass it.
    least, most = (0.79, 1.2) if kind in (Square, Saw, PulseTrain) else (0.9, 1.0)
    assert least < np.abs(samples).max() <= most
    np.testing.assert_array_equal(samples, kind().samples(RATE_HZ))


def test_waveforms_are_the_signals_they_are_named_after():
    tone = Tone(frequency_hz=90.0, phase_rad=0.5, duration_s=0.3, window="hanning")
    expected = sinusoid(90.0, 0.3, phase_rad=0.5, window_name="hanning")
    np.testing.assert_array_equal(tone.samples(RATE_HZ), expected)
    noise = Noise(seed=8, duration_s=0.3, window="none")
    np.testing.assert_array_equal(noise.samples(RATE_HZ), white_noise(0.3, 8))
    np.testing.assert_array_equal(Tap().samples(RATE_HZ), tap())
    np.testing.assert_array_equal(Impulse().samples(RATE_HZ), [1.0])


@pytest.mark.parametrize(("n", "first", "last"), [(52, 1, 24), (104, 2, 48), (130, 3, 60)])
def test_noise_is_the_sum_of_all_waves_of_its_band_edges_included(n, first, last):
    """By sums over sines and cosines; with 52 samples both edges are frequencies of the noise."""
    drawn, time = np.random.default_rng(7).standard_normal(n), np.arange(n)
    expected = np.zeros(n)
    for k in range(first, last + 1):
        assert 25 <= k * 1300 / n <= 600
        turn = 2 * np.pi * k * time / n
        expected += (drawn @ np.cos(turn)) * np.cos(turn) + (drawn @ np.sin(turn)) * np.sin(turn)
    assert (first - 1) * 1300 / n < 25
    assert (last + 1) * 1300 / n > 600
    expected /= np.abs(expected).max()
    np.testing.assert_allclose(white_noise(n / 1300, 7), expected, atol=1e-12)
