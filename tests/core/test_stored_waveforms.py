"""Drawn and recorded waveforms: the samples, the signal that they describe, and delays."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import as_kind
from skinsource.design.waveforms import Drawn, Recording, Tap, Tone
from skinsource.signals.sampling import band_limited_delay
from skinsource.specs.samples import Samples

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


RATE_HZ = 1300.0
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
