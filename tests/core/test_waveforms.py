"""Single kinds of waveforms: tones, taps, noise, series, trains, and what holds samples."""

import math
import tracemalloc
from dataclasses import replace
from fractions import Fraction
from itertools import product

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import as_kind
from skinsource.design.waveforms import Drawn, Impulse, Noise, Recording, Tap, Tone
from skinsource.design.waveforms.periodic import Saw
from skinsource.design.waveforms.wavelet_train import WaveletTrain, frequency_sweep
from skinsource.signals.generators import sample_count, sinusoid, white_noise
from skinsource.signals.sampling import band_limited_delay
from skinsource.signals.synthesis import harmonics_below, sum_of_harmonics
from skinsource.specs.samples import Samples

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


def test_a_harmonic_at_half_the_rate_is_left_out():
    assert harmonics_below(650.0, 50.0) == 12
    assert harmonics_below(650.0, 649.9) == 1
    assert harmonics_below(math.nextafter(650.0, 651.0), 50.0) == 13
    lines = np.abs(np.fft.rfft(Saw(50.0, 1.0).samples(1300.0))) / 650
    assert lines[600] == pytest.approx(2 / (12 * math.pi))
    assert lines[650] < 1e-12


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
    ("make", "given", "what"),
    [
        (frequency_sweep, (400.0, 50.0, 5), "low_hz is 400"),
        (frequency_sweep, (50.0, 400.0, 0), "count is 0"),
        (frequency_sweep, (50.0, 400.0, 5, "cubic"), "spacing"),
        (frequency_sweep, (50.0, 400.0, 5, "linear", "sideways"), "order"),
        *((sample_count, (s,), "duration_s is") for s in (-1e-9, math.nan, math.inf, 1e308)),
        *((sinusoid, (hz, 0.1), "would alias") for hz in (650.0, 650.1, 1300.0, -1.0, 1e300)),
        (white_noise, (0.001,), "holds no frequency"),
    ],
)
def test_what_is_no_sweep_duration_tone_or_noise_is_refused(make, given, what):
    with pytest.raises(InvalidInputError, match=what):
        make(*given)


def test_all_durations_in_milliseconds_are_rounded_half_up():
    for milliseconds in range(1001):
        half_up = math.floor(Fraction(milliseconds, 1000) * 1300 + Fraction(1, 2))
        assert sample_count(milliseconds / 1000) == half_up, milliseconds


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


def test_noise_reaches_up_to_half_the_rate():
    highest = np.abs(np.fft.rfft(white_noise(1.0, band_hz=(25.0, 650.0))))[640:]
    assert np.median(highest) > 0.1 * highest.max()
    with pytest.raises(InvalidInputError, match=r"at most 650 Hz .*would alias"):
        white_noise(0.1, band_hz=(25.0, 650.1))
    assert white_noise(0.0).shape == (0,)


RATES_HZ = (1300.0, 8000.0, 44100.0, 48000.0)
both = pytest.mark.parametrize("kind", [Drawn, Recording])


def swelling(frequency_hz: float, time_s: np.ndarray) -> np.ndarray:
    """A tone within a bell of 1 s, silent at both ends: as good as band-limited."""
    bell = np.exp(-0.5 * ((time_s - 0.5) * 14) ** 2)
    return bell * np.sin(2 * np.pi * frequency_hz * time_s)


def stored(frequency_hz: float, rate_hz: float) -> Samples:
    values = swelling(frequency_hz, np.arange(round(rate_hz)) / rate_hz)
    return Samples(values=values, sample_rate_hz=rate_hz)


@both
@given(
    st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=200),
    st.one_of(st.sampled_from(RATES_HZ), st.floats(0.1, 1e6)),
)
def test_at_their_own_rate_the_samples_are_played_bit_by_bit(kind, values, rate_hz):
    recipe = kind(Samples(values=values, sample_rate_hz=rate_hz))
    result = recipe.samples(rate_hz)
    np.testing.assert_array_equal(result, values)
    assert recipe.duration_s == len(values) / rate_hz
    result[:] = 7.0
    np.testing.assert_array_equal(recipe.samples(rate_hz), values)


@pytest.mark.parametrize(("own_hz", "rate_hz"), [*product(RATES_HZ, RATES_HZ), (1300.7, 1300.0)])
@pytest.mark.parametrize("part", [0.0, 0.37])
def test_at_any_rate_and_between_samples_it_is_the_signal(own_hz, rate_hz, part):
    for frequency_hz in (25.0, 590.0):
        shift_s = part / rate_hz
        samples = Recording(stored(frequency_hz, own_hz)).samples(rate_hz, shift_s)
        assert abs(samples.size - (rate_hz + (part > 0))) <= (own_hz == 1300.7)
        time_s = np.arange(samples.size) / rate_hz - shift_s
        # 0.001 dB are 1.2e-4.
        np.testing.assert_allclose(
            samples, swelling(frequency_hz, time_s), rtol=0, atol=1.2e-4, err_msg=frequency_hz
        )


@both
def test_a_list_or_an_array_is_taken_as_samples_at_1300_hz(kind):
    for values in ([0.0, 1.0, -0.5], (0.0, 1.0, -0.5), np.array([0.0, 1.0, -0.5])):
        recipe = kind(values)
        assert recipe == kind(samples=Samples(values=values, sample_rate_hz=1300.0))
        assert recipe.samples(1300.0).tolist() == [0.0, 1.0, -0.5]
        assert hash(recipe) == hash(kind(values))


def test_what_is_drawn_has_no_unit_and_what_is_recorded_any():
    metres = Samples(values=[1.0], sample_rate_hz=1300.0, unit="m/s²")
    with pytest.raises(InvalidInputError, match="Samples in no unit"):
        Drawn(metres)
    assert Recording(metres).samples.unit == "m/s²"


@both
def test_a_waveform_that_becomes_samples_plays_on_as_it_did(kind):
    for waveform in (Tone(90.0, duration_s=0.3), Tap(), Drawn([0.5, 1.0])):
        converted = as_kind(waveform, kind, 1300.0)
        assert type(converted) is kind
        np.testing.assert_array_equal(converted.samples(1300.0), waveform.samples(1300.0))
    metres = Samples(values=[1.0, 2.0], sample_rate_hz=48000.0, unit="m/s²")
    assert as_kind(Recording(metres), Drawn, 1300.0).samples == replace(metres, unit="")
    assert as_kind(Tone(frequency_hz=700.0), kind, 1300.0) == kind()


DELAYS = [1e-9, 0.1, 0.25, 0.5, 0.75, 0.999]


def burst(frequency_hz: float, time_s: np.ndarray) -> np.ndarray:
    """A tone within a Gaussian of 60 ms that is below 1e-14 at its ends, 0.5 s away."""
    return np.exp(-((time_s / 0.06) ** 2) / 2) * np.cos(2 * np.pi * frequency_hz * time_s + 0.3)


@pytest.mark.parametrize("delay", DELAYS)
@pytest.mark.parametrize("frequency_hz", [0.0, 25.0, 250.0, 500.0, 590.0])
def test_a_burst_is_delayed_as_its_formula_is(frequency_hz, delay):
    time_s = np.arange(1301) / RATE_HZ - 0.5
    delayed = band_limited_delay(burst(frequency_hz, time_s), delay)
    assert delayed.shape == (1302,)
    expected = burst(frequency_hz, (np.arange(1302) - delay) / RATE_HZ - 0.5)
    np.testing.assert_allclose(delayed, expected, rtol=0, atol=1e-6)


def test_no_delay_changes_nothing_and_nothing_stays_nothing():
    samples = np.random.default_rng(3).standard_normal(40)
    assert band_limited_delay(samples, 0.0) is samples
    assert band_limited_delay(np.zeros(0), 0.5).size == 0
    assert not band_limited_delay(np.zeros(5), 0.5).any()
