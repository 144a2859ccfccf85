"""Wavelets: what they promise; with trains and glides, against 50 digits and what is refused."""

import json
import math

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.design import waveforms
from skinsource.design.waveforms.pulses import CentredTap, Tap
from skinsource.design.waveforms.tones import Glide
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.design.waveforms.wavelets import Chirplet, Gabor, Morlet, Ricker
from tests.core.wavelets_bench import FINE_HZ, RATE_HZ, at_all_frequencies


def tuples(value):
    """Lists of json as fields hold them."""
    return tuple(map(tuples, value)) if isinstance(value, list) else value


def test_each_is_its_formula_to_1e_12_at_any_time_rate_and_shift(references):
    kinds = set()
    with np.load(references / "wavelets.npz") as stored:
        for number, case in enumerate(json.loads(str(stored["cases"]))):
            recipe = getattr(waveforms, case["kind"])(*tuples(case["fields"]))
            samples = recipe.samples(case["rate_hz"], case["shift_s"])
            places, expected = stored[f"places_{number}"], stored[f"values_{number}"]
            assert samples.size == places[-1] + 1, case
            np.testing.assert_allclose(
                samples[places], expected, rtol=0, atol=1e-12, err_msg=str(case)[:200]
            )
            kinds.add(type(recipe))
    assert kinds == {Gabor, Ricker, Morlet, Chirplet, CentredTap, Tap, WaveletTrain, Glide}


@pytest.mark.parametrize("frequency_hz", [25.0, 100.0, 250.0, 600.0])
def test_a_gabor_wavelet_lies_about_the_middle_of_its_samples(frequency_hz):
    recipe = Gabor(frequency_hz)
    sigma_s = 4 / (2 * math.pi * frequency_hz)
    n = round(8 * sigma_s * RATE_HZ)
    time_s = (np.arange(n) - (n - 1) / 2) / RATE_HZ
    expected = np.exp(-(time_s**2) / (2 * sigma_s**2)) * np.cos(2 * np.pi * frequency_hz * time_s)
    samples = recipe.samples(RATE_HZ)
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(samples, samples[::-1], rtol=0, atol=1e-13)
    assert recipe.duration_s == pytest.approx(8 * sigma_s, rel=1e-15)


def test_a_gabor_wavelet_has_the_spectrum_of_a_gaussian():
    frequency_hz, spectrum = at_all_frequencies(Gabor(200.0, 5.0).samples(FINE_HZ), FINE_HZ)
    expected = np.exp(-(((frequency_hz - 200.0) / 40.0) ** 2) / 2)
    # Of the cut at 4 sigma, 3e-4 of the peak, some ripple is left.
    np.testing.assert_allclose(spectrum / spectrum.max(), expected, rtol=0, atol=3e-4)


def test_a_ricker_wavelet_is_highest_at_its_frequency_and_half_as_high_where_it_says():
    frequency_hz, spectrum = at_all_frequencies(Ricker(100.0).samples(FINE_HZ), FINE_HZ)
    assert frequency_hz[spectrum.argmax()] == pytest.approx(100.0, abs=0.1)
    half = frequency_hz[spectrum > spectrum.max() / 2]
    assert half.min() == pytest.approx(48.0, abs=1.0)
    assert half.max() == pytest.approx(164.0, abs=1.0)


@pytest.mark.parametrize(
    "recipe",
    [
        Ricker(100.0),
        CentredTap(0.02),
        *(Morlet(100.0, w0) for w0 in (1.0, 2.0, 3.0, 6.0, 20.0)),
    ],
    ids=repr,
)
def test_a_pulse_that_is_to_leave_no_velocity_leaves_none(recipe):
    """As an acceleration of 1 m/s², at its end, in mm/s and mm."""
    samples = recipe.samples(FINE_HZ)
    velocity = np.cumsum(samples) / FINE_HZ * 1e3
    # What is cut at 5 standard deviations, 4e-6 of the peak, has a mean of its own.
    assert abs(velocity[-1]) < 3e-5 * np.abs(velocity).max()
    displacement = np.cumsum(velocity) / FINE_HZ
    assert abs(displacement[-1]) < 2e-2 * np.abs(displacement).max()


def test_an_upstream_tap_leaves_a_velocity():
    velocity = np.cumsum(Tap().samples(FINE_HZ)) / FINE_HZ * 1e3
    assert velocity[-1] == pytest.approx(8.46, abs=0.01)


def test_a_centred_tap_has_level_ends_and_is_highest_where_it_says():
    samples = CentredTap(0.02).samples(FINE_HZ)
    assert np.abs(samples[[0, -1]]).max() < 1e-4
    assert samples.max() == pytest.approx(1.0, abs=1e-4)
    assert samples.min() == pytest.approx(-0.5625, abs=1e-4)
    frequency_hz, spectrum = at_all_frequencies(samples, FINE_HZ)
    assert frequency_hz[spectrum.argmax()] == pytest.approx(75.0, rel=0.02)


def test_a_morlet_wavelet_of_six_is_almost_a_gabor_wavelet_of_six_cycles():
    for w0, rate_hz, least, most in [(6.0, RATE_HZ, 1e-9, 4e-8), (1.0, FINE_HZ, 0.4, 0.7)]:
        samples, gabor = Morlet(90.0, w0).samples(rate_hz), Gabor(90.0, w0).samples(rate_hz)
        # It is cut later.
        longer = (samples.size - gabor.size) // 2
        assert samples.size == gabor.size + 2 * longer
        middle = samples[longer : longer + gabor.size]
        assert least < np.abs(middle - gabor).max() < most


@pytest.mark.parametrize("slope", [-2000.0, 0.0, 2000.0])
def test_the_frequency_of_a_chirplet_rises_by_its_slope(slope):
    sigma_s = 0.03
    samples = Chirplet(200.0, slope, sigma_s).samples(FINE_HZ)
    crossings = np.flatnonzero((samples[:-1] <= 0) & (samples[1:] > 0))
    before, after = samples[crossings], samples[crossings + 1]
    crossings = (crossings + before / (before - after)) / FINE_HZ
    middle = (crossings[1:] + crossings[:-1]) / 2 - 4 * sigma_s
    inside = np.abs(middle) < 1.5 * sigma_s
    rise, at_middle = np.polyfit(middle[inside], 1 / np.diff(crossings)[inside], 1)
    assert at_middle == pytest.approx(200.0, abs=0.5)
    assert rise == pytest.approx(slope, abs=40.0)


def test_a_chirplet_without_a_slope_is_a_gabor_wavelet():
    cycles = 2 * math.pi * 100.0 * 0.01
    np.testing.assert_allclose(
        Chirplet(100.0, 0.0, 0.01).samples(RATE_HZ),
        Gabor(100.0, cycles).samples(RATE_HZ),
        rtol=0,
        atol=1e-13,
    )


@pytest.mark.parametrize(
    ("recipe", "what"),
    [
        (Gabor(650.0), "frequency_hz is 650"),
        (Ricker(650.0), "frequency_hz is 650"),
        (Morlet(700.0), "frequency_hz is 700"),
        (Chirplet(650.0, 0.0, 0.01), "frequency_hz is 650"),
        (Chirplet(600.0, 2500.0, 0.01), "reaches 650 Hz"),
        (Chirplet(600.0, -2500.0, 0.01), "reaches 650 Hz"),
        (WaveletTrain((100.0, 650.0)), "frequencies_hz is 650"),
        (Glide(((0.0, 100.0, 1.0), (1.0, 650.0, 1.0))), "frequency_hz is 650"),
    ],
    ids=repr,
)
def test_what_reaches_half_the_rate_is_refused_and_nothing_below(recipe, what):
    with pytest.raises(InvalidInputError, match=what):
        recipe.samples(1300.0)
    assert np.isfinite(recipe.samples(1500.0)).all()


def test_a_tap_too_short_for_its_rate_is_refused():
    assert CentredTap(0.004).samples(1300.0).size == 5
    with pytest.raises(InvalidInputError, match=r"more than 0\.004 s at 1000 Hz"):
        CentredTap(0.004).samples(1000.0)


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: Gabor(0.1, 50.0), "Gabor lasts"),
        (lambda: Morlet(0.1, 50.0), "Morlet lasts"),
        (lambda: WaveletTrain(slot_s=60.0, frequencies_hz=(100.0,) * 11), "WaveletTrain lasts 660"),
        (lambda: WaveletTrain((50.0, 60.0), gains_db=(0.0,)), r"has 1 gains, .* the 2 frequencies"),
        (lambda: WaveletTrain(()), r"WaveletTrain\.frequencies_hz"),
        (lambda: WaveletTrain((0.0,)), r"WaveletTrain\.frequencies_hz"),
        (lambda: WaveletTrain(family="db4"), r"WaveletTrain\.family"),
        (lambda: Gabor(math.nan), r"Gabor\.frequency_hz"),
        (lambda: Gabor(100.0, 0.0), r"Gabor\.cycles"),
        (lambda: Chirplet(sigma_s=0.0), r"Chirplet\.sigma_s"),
        (lambda: Glide(()), r"Glide\.points"),
        (lambda: Glide(((0.0, 50.0, 1.0), (0.0, 60.0, 1.0))), "end at 0 s"),
        (lambda: Glide(((0.2, 50.0, 1.0), (0.1, 60.0, 1.0))), r"Glide\.points"),
        (lambda: Glide(((0.0, 50.0, 1.5), (0.1, 60.0, 1.0))), r"Glide\.points"),
    ],
)
def test_numbers_that_mean_nothing_are_refused_by_name(make, what):
    with pytest.raises(InvalidInputError, match=what):
        make()


def test_lists_and_arrays_will_do_for_tuples():
    plain = WaveletTrain((50.0, 60.0), gains_db=(0.0, -3.0))
    assert WaveletTrain([50, 60], gains_db=np.array([0.0, -3.0])) == plain
    assert hash(WaveletTrain(np.array([50.0, 60.0]), gains_db=[0, -3])) == hash(plain)
    points = [[0.0, 50.0, 1.0], [0.1, 60.0, 1.0]]
    assert Glide(points) == Glide(np.array(points)) == Glide(tuple(map(tuple, points)))


def test_every_kind_is_reached_by_its_name():
    for kind in waveforms.KINDS:
        assert getattr(ss.waveforms, kind.__name__) is kind
    assert len(waveforms.COMMON) == 8
    assert set(waveforms.COMMON).isdisjoint(waveforms.MORE)
