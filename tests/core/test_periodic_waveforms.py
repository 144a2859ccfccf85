"""Periodic waveforms: against 40 digits, their Fourier series, and what they refuse."""

import json
import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import jv

from skinsource import waveforms
from skinsource.errors import InvalidInputError
from skinsource.signals import window
from skinsource.synthesis.harmonics import harmonics_below, sum_of_harmonics
from skinsource.waveforms import (
    AmplitudeModulated,
    Chirp,
    DampedSine,
    FrequencyModulated,
    PulseTrain,
    Saw,
    Square,
    Tone,
    Triangle,
)

RATES_HZ = (1300.0, 8000.0, 44100.0, 48000.0)
FREQUENCIES_HZ = (25.0, 90.7, 250.3, 400.9, 560.7)
#: Holds whole periods of all of them.
PERIODS_S = 10.0
ALIASES = 1e-5  # -100 dB
SERIES = {
    "square": lambda f: Square(f, 0.5, PERIODS_S),
    "quarter": lambda f: Square(f, 0.25, PERIODS_S),
    "saw": lambda f: Saw(f, PERIODS_S),
    "triangle": lambda f: Triangle(f, PERIODS_S),
    "pulses": lambda f: PulseTrain(f, 0.3 / f, PERIODS_S),
}
#: Amplitude of harmonic h, and of the mean.
AMPLITUDES = {
    "square": lambda h: 4 / (math.pi * h) if h % 2 else 0.0,
    "quarter": lambda h: abs(4 / (math.pi * h) * math.sin(math.pi * h / 4)) if h else -0.5,
    "saw": lambda h: 2 / (math.pi * h) if h else 0.0,
    "triangle": lambda h: 8 / (math.pi * h) ** 2 if h % 2 else 0.0,
    "pulses": lambda h: abs(2 / (math.pi * h) * math.sin(0.3 * math.pi * h)) if h else 0.3,
}
ONE_OF_EACH = (
    Chirp(),
    DampedSine(),
    Square(),
    Saw(),
    Triangle(),
    PulseTrain(),
    AmplitudeModulated(),
    FrequencyModulated(),
)


def spectrum(samples: np.ndarray) -> np.ndarray:
    """Amplitudes of the lines, the mean with its sign."""
    lines = np.fft.rfft(samples) / samples.size
    found = 2 * np.abs(lines)
    found[0] = lines[0].real
    return found


def stored_cases(path):
    with np.load(path / "periodic_waveforms.npz") as stored:
        for number, case in enumerate(json.loads(str(stored["cases"]))):
            yield case, stored[f"places_{number}"], stored[f"values_{number}"]


def test_each_is_its_formula_to_1e_12_at_any_time_rate_and_shift(references):
    kinds = set()
    for case, places, expected in stored_cases(references):
        recipe = getattr(waveforms, case["kind"])(*case["fields"])
        if "window" in recipe.__slots__:
            assert recipe.window == "none"
        found = recipe.samples(case["rate_hz"], case["shift_s"])
        assert found.size == places[-1] + 1, case
        np.testing.assert_allclose(found[places], expected, rtol=0, atol=1e-12, err_msg=str(case))
        kinds.add(case["kind"])
    assert kinds == {type(one).__name__ for one in ONE_OF_EACH}


@pytest.mark.parametrize("rate_hz", RATES_HZ)
@pytest.mark.parametrize("shape", SERIES)
def test_a_series_holds_its_harmonics_below_half_the_rate_and_nothing_else(shape, rate_hz):
    for frequency_hz in FREQUENCIES_HZ:
        found = spectrum(SERIES[shape](frequency_hz).samples(rate_hz))
        expected = np.zeros_like(found)
        period = round(frequency_hz * PERIODS_S)
        for h in range(0, harmonics_below(rate_hz / 2, frequency_hz) + 1):
            expected[h * period] = AMPLITUDES[shape](h)
        assert expected[period] > 0.2
        assert np.abs(found - expected).max() < 1e-11 < ALIASES


def test_a_harmonic_at_half_the_rate_is_left_out():
    assert harmonics_below(650.0, 50.0) == 12
    assert harmonics_below(650.0, 649.9) == 1
    assert harmonics_below(math.nextafter(650.0, 651.0), 50.0) == 13
    assert spectrum(Saw(50.0, 1.0).samples(1300.0))[650] < 1e-12
    assert spectrum(Saw(49.0, 1.0).samples(1300.0))[637] == pytest.approx(2 / (13 * math.pi))


@given(
    st.lists(st.complex_numbers(max_magnitude=1.0), min_size=0, max_size=40),
    st.floats(-1.0, 1.0),
    st.lists(st.floats(-300.0, 300.0), min_size=1, max_size=20),
)
def test_a_sum_of_harmonics_is_the_sum(above, mean, turns):
    coefficients = np.array([mean, *above], np.complex128)
    turns = np.array(turns)
    within = turns - np.rint(turns)
    waves = np.exp(2j * np.pi * np.outer(within, np.arange(coefficients.size)))
    largest = max(np.abs(coefficients).sum(), 1e-300)
    found = sum_of_harmonics(coefficients, turns)
    assert np.abs(found - (waves @ coefficients).real).max() < 3e-14 * largest * coefficients.size


def test_a_sum_of_harmonics_takes_no_more_memory_than_a_few_of_its_results():
    coefficients = np.zeros(960, np.complex128)
    coefficients[1::2] = 1j
    turns = np.arange(1_000_000) * (25 / 48000)
    tracemalloc.start()
    sum_of_harmonics(coefficients, turns)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2 * turns.nbytes


@pytest.mark.parametrize("frequency_hz", [25.0, 40.3, 90.7, 120.1, 400.9])
def test_what_a_limited_band_adds_to_peak_1_is_as_told(frequency_hz):
    peaks = {
        rate_hz: {
            shape: np.abs(make(frequency_hz).samples(rate_hz)).max()
            for shape, make in SERIES.items()
            if shape != "quarter"
        }
        for rate_hz in (1300.0, 48000.0)
    }
    for rate_hz, of in peaks.items():
        only_one = frequency_hz * 3 >= rate_hz / 2
        assert of["square"] <= (4 / math.pi if only_one else 1.201)
        assert of["saw"] <= 1.18
        assert of["triangle"] <= 1.0
        assert of["pulses"] <= 1.18
    assert peaks[48000.0]["square"] > 1.17


@pytest.mark.parametrize("kind", [Square, Saw, Triangle])
def test_those_that_start_in_sine_phase_start_at_0_and_rise(kind):
    first, second = kind(frequency_hz=100.0).samples(48000.0)[:2]
    assert abs(first) < 1e-12 < second


def test_a_phase_is_a_time():
    for kind in (Square, Saw, Triangle):
        later = kind(frequency_hz=100.0, phase_rad=math.pi / 2).samples(48000.0)
        plain = kind(frequency_hz=100.0).samples(48000.0)
        np.testing.assert_allclose(later[:-120], plain[120:], rtol=0, atol=1e-11)
    pulses = PulseTrain(phase_rad=-math.pi).samples(48000.0)
    np.testing.assert_allclose(
        pulses[600:], PulseTrain().samples(48000.0)[:-600], rtol=0, atol=1e-11
    )


def test_levels_of_a_series_are_those_of_its_formula_on_average():
    assert Square(50.0, 0.5, 1.0).samples(48000.0).std() == pytest.approx(1.0, abs=2e-3)
    assert Saw(50.0, 1.0).samples(48000.0).std() == pytest.approx(1 / math.sqrt(3), abs=2e-3)
    assert Triangle(50.0, 1.0).samples(48000.0).std() == pytest.approx(1 / math.sqrt(3), abs=1e-6)
    assert PulseTrain(50.0, 0.005, 1.0).samples(48000.0).mean() == pytest.approx(0.25, abs=1e-12)


@pytest.mark.parametrize("recipe", ONE_OF_EACH, ids=lambda one: type(one).__name__)
@pytest.mark.parametrize("window_name", ["tukey", "hanning"])
def test_a_window_fades_the_burst(recipe, window_name):
    made = {name: getattr(recipe, name) for name in recipe.__slots__} | {"window": window_name}
    plain, faded = recipe.samples(1300.0), type(recipe)(**made).samples(1300.0)
    np.testing.assert_array_equal(faded, plain * window(window_name, plain.size))
    shifted, later = recipe.samples(1300.0, 4e-4), type(recipe)(**made).samples(1300.0, 4e-4)
    assert later.size == plain.size + 1
    assert later[0] == shifted[0] == 0.0
    assert (np.abs(later) <= np.abs(shifted)).all()


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
        found = Chirp(87.3, 87.3, 0.3, law, 0.4, "none").samples(1300.0)
        np.testing.assert_allclose(found, tone, rtol=0, atol=1e-13)


def test_amplitude_modulation_is_three_lines():
    found = spectrum(AmplitudeModulated(200.0, 20.0, 0.5, 1.0).samples(1300.0))
    expected = np.zeros_like(found)
    expected[200], expected[[180, 220]] = 1 / 1.5, 0.25 / 1.5
    assert np.abs(found - expected).max() < 1e-12
    assert np.abs(AmplitudeModulated(201.0, 20.0, 0.5, 1.0).samples(48000.0)).max() <= 1.0
    plain = AmplitudeModulated(200.0, 20.0, 0.0, 0.2).samples(1300.0)
    np.testing.assert_allclose(
        plain, Tone(200.0, duration_s=0.2, window="none").samples(1300.0), rtol=0, atol=1e-15
    )
    quiet = AmplitudeModulated(modulator_phase_rad=math.pi).samples(48000.0)
    assert np.abs(quiet[:200]).max() < 0.06


def test_frequency_modulation_has_lines_of_bessel_functions():
    """Chowning 1973: line n beside the carrier has amplitude J_n of deviation / modulator."""
    found = spectrum(FrequencyModulated(1000.0, 20.0, 60.0, 1.0).samples(8000.0))
    for n in range(-20, 21):
        assert found[1000 + 20 * n] == pytest.approx(abs(jv(n, 3.0)), abs=1e-12)
    assert found[1010] < 1e-12


def test_a_damped_sine_falls_to_37_percent_in_its_decay():
    samples = DampedSine(100.0, 0.02, 0.2).samples(48000.0)
    crest = 120
    np.testing.assert_allclose(
        samples[crest + 960 * np.arange(5)] / samples[crest], np.exp(-np.arange(5.0)), rtol=1e-11
    )
    assert np.abs(samples).max() < 1.0


@pytest.mark.parametrize("rate_hz", [1300.0, 48000.0])
@pytest.mark.parametrize("above_hz", [0.0, 0.1])
def test_a_frequency_at_or_above_half_the_rate_is_refused(rate_hz, above_hz):
    bad_hz = rate_hz / 2 + above_hz
    for recipe, name in (
        (Chirp(100.0, bad_hz), "end_hz"),
        (Chirp(bad_hz, 100.0), "start_hz"),
        (DampedSine(bad_hz), "frequency_hz"),
        (Square(bad_hz), "frequency_hz"),
        (Saw(bad_hz), "frequency_hz"),
        (Triangle(bad_hz), "frequency_hz"),
        (PulseTrain(bad_hz, 1e-5), "rate_hz"),
        (AmplitudeModulated(bad_hz), "carrier_hz"),
        (AmplitudeModulated(bad_hz - 20.0, 20.0), r"carrier_hz \+ modulator_hz"),
        (FrequencyModulated(bad_hz), "carrier_hz"),
        (FrequencyModulated(100.0, bad_hz), "modulator_hz"),
        (FrequencyModulated(bad_hz - 50.0, 20.0, 50.0), r"carrier_hz \+ deviation_hz"),
    ):
        with pytest.raises(InvalidInputError, match=f"^{name} is .* would alias"):
            recipe.samples(rate_hz)


def test_frequencies_just_below_half_the_rate_are_played():
    for recipe in (
        Chirp(649.9, 649.8),
        Square(649.9),
        PulseTrain(649.9, 1e-4),
        AmplitudeModulated(629.9, 20.0),
        AmplitudeModulated(649.9, 20.0, 0.0),
        FrequencyModulated(599.9, 20.0, 50.0),
    ):
        assert np.isfinite(recipe.samples(1300.0)).all()


@pytest.mark.parametrize(
    ("kind", "changes"),
    [
        *((type(one), {"duration_s": bad}) for one in ONE_OF_EACH for bad in (0.0, -1.0, 601.0)),
        *((type(one), {"window": "hann"}) for one in ONE_OF_EACH),
        *((kind, {"frequency_hz": 0.0}) for kind in (DampedSine, Square, Saw, Triangle)),
        (Chirp, {"start_hz": 0.0}),
        (Chirp, {"end_hz": -25.0}),
        (Chirp, {"law": "exponential"}),
        (Chirp, {"phase_rad": math.nan}),
        (DampedSine, {"decay_s": 0.0}),
        (Square, {"duty": 0.0}),
        (Square, {"duty": 1.0}),
        (Square, {"duty": math.nan}),
        (PulseTrain, {"rate_hz": 0.5}),
        (PulseTrain, {"pulse_s": 0.0}),
        (PulseTrain, {"rate_hz": 250.0, "pulse_s": 0.004}),
        (AmplitudeModulated, {"depth": 1.01}),
        (AmplitudeModulated, {"depth": -0.1}),
        (AmplitudeModulated, {"modulator_hz": 0.0}),
        (FrequencyModulated, {"deviation_hz": -1.0}),
        (FrequencyModulated, {"deviation_hz": math.inf}),
    ],
)
def test_a_degenerate_parameter_is_named(kind, changes):
    name = "pulse_s" if len(changes) == 2 else next(iter(changes))
    with pytest.raises(InvalidInputError, match=rf"^{kind.__name__}\.{name} is .* expected"):
        kind(**changes)


@pytest.mark.parametrize("kind", [type(one) for one in ONE_OF_EACH])
def test_the_shortest_burst_is_finite(kind):
    shortest = kind(duration_s=0.001)
    for rate_hz, n in ((1300.0, 1), (48000.0, 48)):
        for shift in (0.0, 0.5):
            found = shortest.samples(rate_hz, shift / rate_hz)
            assert found.shape == (n + (shift > 0),)
            assert np.isfinite(found).all()
