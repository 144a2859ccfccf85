"""Single kinds of waveforms: tones, taps and noise between samples, series, and trains."""

import math
import tracemalloc

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms import CentredTap, Impulse, Morlet, Noise, Ricker, Tone
from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle
from skinsource.design.waveforms.wavelet_train import WaveletTrain, frequency_sweep
from skinsource.signals.generators import white_noise
from skinsource.signals.synthesis import harmonics_below, sum_of_harmonics

RATE_HZ = 1300.0
FINE_HZ = 48000.0


@pytest.mark.parametrize("window", ["none", "tukey", "hanning"])
@pytest.mark.parametrize("part", [0.25, 0.999])
def test_a_shifted_tone_is_its_formula_at_its_own_time(window, part):
    n = 130
    place = np.arange(1, n + 1) - part
    nearer_end = np.minimum(place, n - 1 - place) / (n - 1)
    weight = {
        "none": 1.0,
        "hanning": 0.5 - 0.5 * np.cos(2 * np.pi * (place + 1) / (n + 1)),
        "tukey": 0.5 - 0.5 * np.cos(8 * np.pi * np.clip(nearer_end, 0.0, 0.125)),
    }[window]
    samples = Tone(87.3, 0.4, n / RATE_HZ, window).samples(RATE_HZ, part / RATE_HZ)
    expected = weight * np.sin(2 * np.pi * 87.3 * place / RATE_HZ + 0.4)
    np.testing.assert_allclose(samples, [0.0, *expected], rtol=0, atol=1e-12)


def test_an_impulse_is_one_sample_at_any_rate_and_two_between_samples():
    for rate_hz in (1300.0, 8000.0, 48000.0):
        assert Impulse().samples(rate_hz).tolist() == [1.0]
        first, second = Impulse().samples(rate_hz, 0.25 / rate_hz)
        assert second / (first + second) == pytest.approx(0.25, rel=1e-3)


@pytest.mark.parametrize("n", [52, 130, 131])  # of 52 samples both edges are frequencies
def test_shifted_noise_is_the_same_sum_of_waves_at_other_instants(n):
    drawn, part = np.random.default_rng(7).standard_normal(n), 0.3
    lines = np.arange(math.ceil(25 * n / 1300), math.floor(600 * n / 1300) + 1)

    def waves(at):
        return np.exp(2j * np.pi * np.outer(lines, at) / n)

    found = waves(np.arange(n)).conj() @ drawn
    plain, later = ((found @ waves(np.arange(n + k) - k * part)).real for k in (0, 1))
    later[0] = 0.0
    samples = Noise(7, n / RATE_HZ, window="none").samples(RATE_HZ, part / RATE_HZ)
    largest = np.abs(plain).max()
    np.testing.assert_allclose(samples, later / largest, rtol=0, atol=1e-12)
    np.testing.assert_allclose(white_noise(n / RATE_HZ, 7), plain / largest, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    "recipe", [Ricker(100.0), CentredTap(0.02), Morlet(100.0, 1.0), Morlet(100.0, 6.0)], ids=repr
)
def test_a_pulse_that_is_to_leave_no_velocity_leaves_none(recipe):
    """As an acceleration of 1 m/s², at its end, in mm/s and mm."""
    samples = recipe.samples(FINE_HZ)
    velocity = np.cumsum(samples) / FINE_HZ * 1e3
    # What is cut at 5 standard deviations, 4e-6 of the peak, has a mean of its own.
    assert abs(velocity[-1]) < 3e-5 * np.abs(velocity).max()
    displacement = np.cumsum(velocity) / FINE_HZ
    assert abs(displacement[-1]) < 2e-2 * np.abs(displacement).max()


def test_a_harmonic_at_half_the_rate_is_left_out():
    assert harmonics_below(650.0, 50.0) == 12
    assert harmonics_below(650.0, 649.9) == 1
    assert harmonics_below(math.nextafter(650.0, 651.0), 50.0) == 13
    lines = np.abs(np.fft.rfft(Saw(50.0, 1.0).samples(1300.0))) / 650
    assert lines[600] == pytest.approx(2 / (12 * math.pi))
    assert lines[650] < 1e-12


@pytest.mark.parametrize(
    ("kind", "most"), [(Square, 1.201), (Saw, 1.18), (Triangle, 1.0), (PulseTrain, 1.18)]
)
def test_what_a_limited_band_adds_to_peak_1_is_as_told(kind, most):
    for frequency_hz, rate_hz in ((40.3, 1300.0), (90.7, 1300.0), (90.7, 48000.0)):
        assert np.abs(kind(frequency_hz).samples(rate_hz)).max() <= most


def test_a_sum_of_harmonics_takes_no_more_memory_than_a_few_of_its_results():
    coefficients = np.zeros(960, np.complex128)
    coefficients[1::2] = 1j
    turns = np.arange(1_000_000) * (25 / 48000)
    tracemalloc.start()
    sum_of_harmonics(coefficients, turns)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2 * turns.nbytes


FIVE_HZ = (50.0, 84.1, 141.4, 237.8, 400.0)


@pytest.mark.parametrize("family", ["gabor", "ricker", "hann"])
def test_wavelets_of_a_train_have_equal_energies_where_that_is_asked(family):
    recipe = WaveletTrain(equalise="energy", family=family)
    energies = (recipe.samples(FINE_HZ).reshape(5, -1) ** 2).sum(axis=1)
    np.testing.assert_allclose(energies, energies[0], rtol=1e-5)
    assert max(recipe.gains()) == 1.0
    unequal = (WaveletTrain(family=family).samples(FINE_HZ).reshape(5, -1) ** 2).sum(axis=1)
    np.testing.assert_allclose(unequal * FIVE_HZ, unequal[0] * 50.0, rtol=1e-5)


def test_a_sweep_of_frequencies_has_equal_steps_or_factors_and_both_ends():
    assert frequency_sweep(50.0, 400.0, 4) == (50.0, 100.0, 200.0, 400.0)
    assert frequency_sweep(50.0, 400.0, 4, order="down") == (400.0, 200.0, 100.0, 50.0)
    assert frequency_sweep(100.0, 300.0, 3, "linear") == (100.0, 200.0, 300.0)
    assert frequency_sweep(70.0, 300.0, 1) == (70.0,)
    assert frequency_sweep(70.0, 70.0, 2) == (70.0, 70.0)
    for spacing in ("linear", "logarithmic"):
        rising = frequency_sweep(0.1, 0.1 * 700.3, 60, spacing)
        assert (rising[0], rising[-1], list(rising)) == (0.1, 0.1 * 700.3, sorted(rising))
    assert np.round(frequency_sweep(50.0, 400.0, 5), 1).tolist() == list(FIVE_HZ)
    WaveletTrain(frequency_sweep(25.0, 600.0, 1000), slot_s=0.01)


@pytest.mark.parametrize(
    ("given", "what"),
    [
        ((400.0, 50.0, 5), "low_hz is 400"),
        ((50.0, 400.0, 0), "count is 0"),
        ((50.0, 400.0, 5, "cubic"), "spacing"),
        ((50.0, 400.0, 5, "linear", "sideways"), "order"),
    ],
)
def test_a_sweep_that_is_none_is_refused(given, what):
    with pytest.raises(InvalidInputError, match=what):
        frequency_sweep(*given)
