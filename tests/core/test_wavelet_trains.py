"""Trains of wavelets, and the sweeps of frequencies that they are made of."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms.wavelet_train import EQUALISE, WaveletTrain, frequency_sweep
from tests.core.wavelets_bench import FINE_HZ, RATE_HZ, at_all_frequencies

FIVE_HZ = (50.0, 84.1, 141.4, 237.8, 400.0)


def test_a_train_starts_with_five_frequencies_in_slots_of_their_own():
    recipe = WaveletTrain()
    assert recipe.frequencies_hz == FIVE_HZ
    assert recipe.duration_s == pytest.approx(0.6)
    assert recipe.middles_s() == pytest.approx((0.06, 0.18, 0.30, 0.42, 0.54))
    slots = recipe.samples(RATE_HZ).reshape(5, 156)
    for frequency_hz, slot in zip(FIVE_HZ, slots, strict=True):
        assert np.abs(slot).argmax() == 78
        found_hz, spectrum = at_all_frequencies(slot, RATE_HZ)
        assert found_hz[spectrum.argmax()] == pytest.approx(frequency_hz, rel=5e-3)


@pytest.mark.parametrize("family", ["gabor", "ricker", "hann"])
def test_wavelets_of_a_train_have_equal_energies_where_that_is_asked(family):
    recipe = WaveletTrain(equalise="energy", family=family)
    slots = recipe.samples(FINE_HZ).reshape(5, -1)
    energies = (slots**2).sum(axis=1)
    np.testing.assert_allclose(energies, energies[0], rtol=1e-5)
    assert max(recipe.gains()) == 1.0
    unequal = (WaveletTrain(family=family).samples(FINE_HZ).reshape(5, -1) ** 2).sum(axis=1)
    np.testing.assert_allclose(unequal * FIVE_HZ, unequal[0] * 50.0, rtol=1e-5)


def test_wavelets_longer_than_their_slot_overlap_and_none_is_cut():
    """The whole is the sum of trains of one wavelet, each as long as itself."""
    recipe = WaveletTrain((50.0, 80.0, 60.0), cycles=6.0, slot_s=0.02)
    assert recipe.duration_s > 3 * 0.02
    samples = recipe.samples(FINE_HZ)
    expected = np.zeros_like(samples)
    for frequency_hz, middle_s in zip(recipe.frequencies_hz, recipe.middles_s(), strict=True):
        sigma_s = 6.0 / (2 * math.pi * frequency_hz)
        time_s = np.arange(samples.size) / FINE_HZ - middle_s
        wavelet = np.exp(-0.5 * (time_s / sigma_s) ** 2) * np.cos(2 * np.pi * frequency_hz * time_s)
        expected += np.where(np.abs(time_s) <= 4 * sigma_s, wavelet, 0.0)
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-12)
    assert np.diff(recipe.middles_s()) == pytest.approx([0.02, 0.02])
    assert np.abs(samples[[0, -1]]).max() < 1e-3


def test_gains_of_a_train_are_those_of_its_wavelets():
    plain = WaveletTrain().samples(RATE_HZ).reshape(5, 156)
    gains_db = (0.0, -6.0, 3.0, -120.0, 40.0)
    louder = WaveletTrain(gains_db=gains_db).samples(RATE_HZ).reshape(5, 156)
    for wavelet, other, gain_db in zip(plain, louder, gains_db, strict=True):
        np.testing.assert_allclose(other, wavelet * 10 ** (gain_db / 20), rtol=1e-12)


def test_a_sweep_of_frequencies_has_equal_steps_or_factors_and_both_ends():
    assert frequency_sweep(50.0, 400.0, 4) == (50.0, 100.0, 200.0, 400.0)
    assert frequency_sweep(50.0, 400.0, 4, order="down") == (400.0, 200.0, 100.0, 50.0)
    assert frequency_sweep(100.0, 300.0, 3, "linear") == (100.0, 200.0, 300.0)
    assert frequency_sweep(70.0, 300.0, 1) == (70.0,)
    assert np.round(frequency_sweep(50.0, 400.0, 5), 1).tolist() == list(FIVE_HZ)
    WaveletTrain(frequency_sweep(25.0, 600.0, 1000), slot_s=0.01)


@given(
    st.floats(0.1, 1e4),
    st.floats(1.0, 1e3),
    st.integers(2, 60),
    st.sampled_from(["linear", "logarithmic"]),
)
def test_a_sweep_never_turns_back(low_hz, factor, count, spacing):
    frequencies_hz = frequency_sweep(low_hz, low_hz * factor, count, spacing)
    assert (frequencies_hz[0], frequencies_hz[-1], len(frequencies_hz)) == (
        low_hz,
        low_hz * factor,
        count,
    )
    assert (np.diff(frequencies_hz) >= -1e-11 * low_hz * factor).all()
    steps = np.diff(frequencies_hz) if spacing == "linear" else np.diff(np.log(frequencies_hz))
    np.testing.assert_allclose(steps, steps.mean(), rtol=1e-6, atol=1e-10 * low_hz * factor)


@pytest.mark.parametrize(
    ("given", "what"),
    [
        ((400.0, 50.0, 5), "low_hz is 400"),
        ((0.0, 50.0, 5), "low_hz is 0"),
        ((50.0, math.nan, 5), "high_hz"),
        ((50.0, 400.0, 0), "count is 0"),
        ((50.0, 400.0, 5, "cubic"), "spacing"),
        ((50.0, 400.0, 5, "linear", "sideways"), "order"),
    ],
)
def test_a_sweep_that_is_none_is_refused(given, what):
    with pytest.raises(InvalidInputError, match=what):
        frequency_sweep(*given)


def test_what_is_equalised_has_the_same_word_in_the_window_and_in_files():
    page = (Path(__file__).parents[2] / "docs" / "words.md").read_text("utf-8")
    row = next(line for line in page.splitlines() if line.startswith("| equalise |"))
    for name, title in EQUALISE.options:
        assert title.lower() == name
        assert f"*{title}*" in row or f"*{name}*" in row
