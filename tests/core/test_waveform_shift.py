"""Waveforms that start between two samples."""

import math
from fractions import Fraction

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms import KINDS
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.signals.generators import sinusoid, tap, white_noise

RATE_HZ = 1300.0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("shift", [-1e-6, 1 / 1300, 1.0, math.nan, "0"])
def test_a_shift_of_a_sample_or_more_is_refused(kind, shift):
    with pytest.raises(InvalidInputError, match="shift_s is"):
        kind().samples(RATE_HZ, shift)


@pytest.mark.parametrize("kind", KINDS)
def test_no_shift_is_a_shift_of_zero(kind):
    np.testing.assert_array_equal(kind().samples(RATE_HZ), kind().samples(RATE_HZ, 0.0))


@pytest.mark.parametrize("window", ["none", "tukey", "hanning"])
@pytest.mark.parametrize("part", [0.25, 0.5, 0.999])
def test_a_shifted_tone_is_its_formula_at_its_own_time(window, part):
    """By math.sin and the documented windows, sample by sample."""
    n, shift_s = 130, part / RATE_HZ
    samples = Tone(87.3, 0.4, n / RATE_HZ, window).samples(RATE_HZ, shift_s)
    expected = [0.0]
    for k in range(1, n + 1):
        place = k - part
        ends = min(place / (n - 1), 1 - place / (n - 1))
        weight = {
            "none": 1.0,
            "hanning": 0.5 - 0.5 * math.cos(2 * math.pi * (place + 1) / (n + 1)),
            "tukey": 1.0 if ends >= 0.125 else 0.5 - 0.5 * math.cos(8 * math.pi * max(ends, 0.0)),
        }[window]
        expected.append(weight * math.sin(2 * math.pi * 87.3 * (k / RATE_HZ - shift_s) + 0.4))
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-12)


def test_a_tap_is_the_same_pulse_at_any_rate_and_shift():
    np.testing.assert_array_equal(Tap().samples(1300.0)[0], 0.5 * (1 - math.cos(math.pi / 11)))
    for rate_hz, shift_s in [(1300.0, 5e-4), (48000.0, 0.0), (48000.0, 1e-5), (8000.0, 1e-4)]:
        samples = Tap().samples(rate_hz, shift_s)
        assert abs(samples.size / rate_hz - 21 / 1300) <= 1.5 / rate_hz
        time_s = np.arange(samples.size) / rate_hz - shift_s
        pulse = 0.5 * (1 - np.cos(2 * np.pi * (time_s * 1300 + 1) / 22))
        expected = np.where((time_s >= 0) & (time_s < 21 / 1300), pulse, 0.0)
        np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-12)
    assert Tap.duration_s == 21 / 1300
    assert tap(0.1, sample_rate_hz=48000.0).size == 4800 + 775


def test_an_impulse_is_one_sample_at_any_rate_and_two_between_samples():
    for rate_hz in (1300.0, 8000.0, 48000.0):
        assert Impulse().samples(rate_hz).tolist() == [1.0]
        first, second = Impulse().samples(rate_hz, 0.25 / rate_hz)
        assert second / (first + second) == pytest.approx(0.25, rel=1e-3)


@pytest.mark.parametrize("n", [130, 131])
@pytest.mark.parametrize("part", [0.3, 0.8])
def test_shifted_noise_is_the_same_sum_of_waves_at_other_instants(n, part):
    """By the sum over sines and cosines written out."""
    drawn, time = np.random.default_rng(7).standard_normal(n), np.arange(n)
    samples = Noise(7, n / RATE_HZ, window="none").samples(RATE_HZ, part / RATE_HZ)
    plain, later = np.zeros(n), np.zeros(n + 1)
    for k in range(math.ceil(25 * n / 1300), math.floor(600 * n / 1300) + 1):
        turn, turn_later = (2 * np.pi * k * at / n for at in (time, np.arange(n + 1) - part))
        cosine, sine = drawn @ np.cos(turn), drawn @ np.sin(turn)
        plain += cosine * np.cos(turn) + sine * np.sin(turn)
        later += cosine * np.cos(turn_later) + sine * np.sin(turn_later)
    later[0] = 0.0
    np.testing.assert_allclose(samples, later / np.abs(plain).max(), rtol=0, atol=1e-12)


def test_shifted_noise_is_windowed_at_its_own_time():
    plain = white_noise(0.2, 4, shift_s=4e-4)
    windowed = white_noise(0.2, 4, window_name="tukey", shift_s=4e-4)
    ratio = windowed[80:180] / plain[80:180]
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-12)
    assert windowed[0] == windowed[-1] == 0.0
    assert abs(windowed[1]) < 0.01 * abs(ratio[0])


def test_noise_of_a_band_lies_in_it():
    samples = Noise(3, 1.0, 100.0, 200.0, "none").samples(RATE_HZ)
    lines = np.flatnonzero(np.abs(np.fft.rfft(samples)) > 1e-9)
    assert lines.min() == 100
    assert lines.max() == 200
    np.testing.assert_array_equal(samples, white_noise(1.0, 3, band_hz=(100.0, 200.0)))


@pytest.mark.parametrize(
    ("fields", "what"),
    [
        ({"low_hz": 300.0, "high_hz": 300.0}, "low_hz"),
        ({"low_hz": 100.0, "high_hz": 104.0, "duration_s": 0.2}, "duration_s"),
        ({"low_hz": -1.0}, "low_hz"),
        ({"high_hz": math.inf}, "high_hz"),
    ],
)
def test_a_band_that_holds_nothing_is_refused(fields, what):
    with pytest.raises(InvalidInputError, match=rf"Noise\.{what}"):
        Noise(**fields)


def test_waveforms_are_made_by_position():
    assert Tone(90.0, 0.5, 0.3, "none") == Tone(
        frequency_hz=90.0, phase_rad=0.5, duration_s=0.3, window="none"
    )
    assert Noise(4, 0.3, 50.0, 90.0, "none") == Noise(
        seed=4, duration_s=0.3, low_hz=50.0, high_hz=90.0, window="none"
    )


def test_a_shifted_burst_of_an_hour_is_exact():
    shift_s = 0.37 / RATE_HZ
    samples = sinusoid(250.1, 3600.0, shift_s=shift_s)
    k = samples.size - 2
    exact = float(Fraction(250.1) * (Fraction(k, 1300) - Fraction(shift_s)) % 1)
    assert samples[k] == pytest.approx(math.sin(2 * math.pi * exact), abs=1e-12)
