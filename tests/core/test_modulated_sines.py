"""Sines that change: chirps, modulated amplitudes and frequencies, and decay."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import jv

from skinsource.design.waveforms.pulses import DampedSine
from skinsource.design.waveforms.tones import AmplitudeModulated, Chirp, FrequencyModulated, Tone
from tests.core.lines_bench import spectrum


@pytest.mark.parametrize(
    "recipe",
    [Chirp(), Chirp(law="logarithmic"), DampedSine(), AmplitudeModulated(), FrequencyModulated()],
    ids=str,
)
def test_half_a_sample_later_lie_the_odd_samples_of_twice_the_rate(recipe):
    between, twice = recipe.samples(1300.0, 0.5 / 1300.0), recipe.samples(2600.0)
    assert between[0] == 0.0
    np.testing.assert_allclose(between[1:], twice[1::2], rtol=0, atol=1e-12)


@given(
    st.floats(0.01, 640.0),
    st.floats(0.01, 640.0),
    st.sampled_from(["linear", "logarithmic"]),
    st.integers(2, 3000),
)
def test_a_chirp_backwards_is_the_chirp_the_other_way(start_hz, end_hz, law, n):
    duration_s = n / 1300.0
    up = Chirp(start_hz, end_hz, duration_s, law, 0.0, "none").samples(1300.0)
    if law == "linear" or start_hz == end_hz:
        total = (start_hz + end_hz) / 2 * duration_s
    else:
        total = duration_s * (end_hz - start_hz) / math.log(end_hz / start_hz)
    # The phase at its end, and from there back.
    phase = math.remainder(total, 1.0) * 2 * math.pi
    down = Chirp(end_hz, start_hz, duration_s, law, math.pi - phase, "none").samples(1300.0)
    # Where the ends are almost the same, their logarithm here has few digits.
    few = 1e-15 * duration_s * start_hz / max(abs(math.log(end_hz / start_hz)), 1e-15)
    np.testing.assert_allclose(up[1:], down[:0:-1], rtol=0, atol=1e-8 + 10 * few)


def test_a_chirp_passes_the_middle_of_its_law_in_the_middle():
    for law, middle_hz in (("linear", 325.0), ("logarithmic", math.sqrt(50.0 * 600.0))):
        samples = Chirp(50.0, 600.0, 2.0, law).samples(48000.0)
        there = samples[48000 - 480 : 48000 + 480]
        crossings = np.flatnonzero(np.diff(np.signbit(there)))
        period = 2 * (crossings[-1] - crossings[0]) / (crossings.size - 1)
        assert 48000.0 / period == pytest.approx(middle_hz, rel=0.02)


def test_a_chirp_that_stays_is_a_tone():
    tone = Tone(87.3, 0.4, 0.3, "none").samples(1300.0)
    for law in ("linear", "logarithmic"):
        samples = Chirp(87.3, 87.3, 0.3, law, 0.4, "none").samples(1300.0)
        np.testing.assert_allclose(samples, tone, rtol=0, atol=1e-13)


def test_amplitude_modulation_is_three_lines():
    lines = spectrum(AmplitudeModulated(200.0, 20.0, 0.5, 1.0).samples(1300.0))
    expected = np.zeros_like(lines)
    expected[200], expected[[180, 220]] = 1 / 1.5, 0.25 / 1.5
    assert np.abs(lines - expected).max() < 1e-12
    assert np.abs(AmplitudeModulated(201.0, 20.0, 0.5, 1.0).samples(48000.0)).max() <= 1.0
    plain = AmplitudeModulated(200.0, 20.0, 0.0, 0.2).samples(1300.0)
    np.testing.assert_allclose(
        plain, Tone(200.0, duration_s=0.2, window="none").samples(1300.0), rtol=0, atol=1e-15
    )
    quiet = AmplitudeModulated(modulator_phase_rad=math.pi).samples(48000.0)
    assert np.abs(quiet[:200]).max() < 0.06


def test_frequency_modulation_has_lines_of_bessel_functions():
    """Chowning 1973: line n beside the carrier has amplitude J_n of deviation / modulator."""
    lines = spectrum(FrequencyModulated(1000.0, 20.0, 60.0, 1.0).samples(8000.0))
    for n in range(-20, 21):
        assert lines[1000 + 20 * n] == pytest.approx(abs(jv(n, 3.0)), abs=1e-12)
    assert lines[1010] < 1e-12


def test_a_damped_sine_falls_to_37_percent_in_its_decay():
    samples = DampedSine(100.0, 0.02, 0.2).samples(48000.0)
    crest = 120
    np.testing.assert_allclose(
        samples[crest + 960 * np.arange(5)] / samples[crest], np.exp(-np.arange(5.0)), rtol=1e-11
    )
    assert np.abs(samples).max() < 1.0
