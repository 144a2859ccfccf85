"""Squares, saws, triangles and pulses: their Fourier series, and sums of harmonics."""

import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle
from skinsource.signals.synthesis import harmonics_below, sum_of_harmonics
from tests.core.lines_bench import spectrum

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


@pytest.mark.parametrize("rate_hz", RATES_HZ)
@pytest.mark.parametrize("shape", SERIES)
def test_a_series_holds_its_harmonics_below_half_the_rate_and_nothing_else(shape, rate_hz):
    for frequency_hz in FREQUENCIES_HZ:
        lines = spectrum(SERIES[shape](frequency_hz).samples(rate_hz))
        expected = np.zeros_like(lines)
        period = round(frequency_hz * PERIODS_S)
        for h in range(0, harmonics_below(rate_hz / 2, frequency_hz) + 1):
            expected[h * period] = AMPLITUDES[shape](h)
        assert expected[period] > 0.2
        assert np.abs(lines - expected).max() < 1e-11 < ALIASES


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
    samples = sum_of_harmonics(coefficients, turns)
    assert np.abs(samples - (waves @ coefficients).real).max() < 3e-14 * largest * coefficients.size


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
