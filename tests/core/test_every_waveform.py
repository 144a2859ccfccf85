"""What every kind of waveform keeps, a new one too: its fields say what can be tried."""

import json
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design import waveforms
from skinsource.design.waveforms import KINDS, CentredTap, DampedSine, Noise, Waveform, WaveletTrain
from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle
from skinsource.design.waveforms.samples import Drawn, Formula, Layers, Recording
from skinsource.design.waveforms.tones import AmplitudeModulated, Chirp, FrequencyModulated, Glide
from skinsource.design.waveforms.wavelets import Chirplet, Gabor, Morlet, Ricker
from skinsource.signals.generators import sample_count, window
from skinsource.signals.sampling import band_limited_delay
from skinsource.specs.models import specs_of
from tests.core.design_files.any_recipe import made, values

#: Samples of the longest ones that are held against 40 digits: those of 600 s at 48 kHz take
#: seconds, and are there at 1300 Hz too.
LONGEST = 3_000_000
#: Longer ones are made, and not played.
MOST_SAMPLES = 30_000
#: Kinds that may go beyond 1, as they say themselves: with edges cut off at half the rate; where
#: waves add up; as written, drawn or recorded.
BEYOND_ONE = {Square, Saw, PulseTrain, WaveletTrain, Formula, Drawn, Recording, Layers}

every_kind = pytest.mark.parametrize("kind", KINDS)


@st.composite
def recipes(draw, kind: type[Waveform]) -> Waveform:
    """The default, and others of which some fields are tried."""
    fields = {name: values(spec) for name, spec in specs_of(kind).items()}
    return made(kind, draw(st.fixed_dictionaries({}, optional=fields)))


def any_recipe(examples: int):
    """Draw recipes of a kind by ``data``."""
    slow = HealthCheck.too_slow
    return settings(max_examples=examples, deadline=None, suppress_health_check=[slow])


@every_kind
@any_recipe(25)
@given(data=st.data(), rate_hz=st.sampled_from([1300.0, 8000.0, 44100.0]))
def test_samples_are_finite_as_many_as_the_length_says_and_the_same_each_time(kind, data, rate_hz):
    recipe = data.draw(recipes(kind))
    if recipe.duration_s * rate_hz > MOST_SAMPLES:
        return
    try:
        samples = recipe.samples(rate_hz)
    except InvalidInputError:
        return
    expected = 1 if kind.__name__ == "Impulse" else sample_count(recipe.duration_s, rate_hz)
    assert samples.shape == (expected,)
    assert samples.dtype == np.float64
    assert np.isfinite(samples).all()
    np.testing.assert_array_equal(samples, replace(recipe).samples(rate_hz, 0.0))
    later = recipe.samples(rate_hz, 0.4 / rate_hz)
    assert later.shape == (expected + (expected > 0),)
    assert np.isfinite(later).all()
    if kind not in BEYOND_ONE:
        assert np.abs(samples).max(initial=0.0) <= 1.0 + 1e-12


def refusal_of(call: Callable[[], object]) -> str:
    """The words with which something is refused, or ""; any other error passes on."""
    try:
        call()
    except InvalidInputError as error:
        return str(error)
    return ""


@every_kind
def test_only_bad_input_is_refused_and_in_words(kind):
    """Beyond their ranges, of wrong types, at strange rates and shifts."""
    numbers = (-1.0, math.nan, math.inf, 1e308, 10**400)
    for name in specs_of(kind):
        for value in (None, "", *numbers, (), ((0.0,),), b"", object()):
            message = refusal_of(lambda name=name, value=value: replace(kind(), **{name: value}))
            assert "expected" in message or not message
    for rate_hz in (0.0, -1300.0, math.nan, math.inf, "fast", None):
        assert "expected" in refusal_of(lambda rate_hz=rate_hz: kind().samples(rate_hz))
    for shift_s in (-1e-6, 1 / 1300, 1.0, math.nan, "0"):
        assert "shift_s is" in refusal_of(lambda shift_s=shift_s: kind().samples(1300.0, shift_s))


@every_kind
@pytest.mark.parametrize("part", [0.25, 0.5, 0.9])
def test_a_shifted_waveform_is_the_same_one_a_little_later(kind, part):
    """As a band-limited delay of it is, where neither its edges nor half the rate matter."""
    rate_hz = 8000.0
    plain, samples = kind().samples(rate_hz), kind().samples(rate_hz, part / rate_hz)
    if kind.__name__ == "Impulse":
        assert samples == pytest.approx(band_limited_delay(plain, part))
        return
    inside = slice(plain.size // 8, -plain.size // 8)
    later, sooner = (band_limited_delay(plain, delay)[inside] for delay in (part, 1 - part))
    error = np.sqrt(np.mean((samples[inside] - later) ** 2) / np.mean(later**2))
    # Edges of squares hold all harmonics up to half the rate, where the delay ends.
    assert error < (0.05 if kind in (Square, Saw, PulseTrain) else 2e-3)
    if part != 0.5:
        assert error < np.sqrt(np.mean((sooner - later) ** 2) / np.mean(later**2))


def tuples(value):
    """Lists of json as fields hold them."""
    return tuple(map(tuples, value)) if isinstance(value, list) else value


@pytest.mark.parametrize(("name", "n_kinds"), [("periodic_waveforms", 8), ("wavelets", 8)])
def test_each_is_its_formula_to_1e_12_at_any_time_rate_and_shift(references, name, n_kinds):
    """Against 40 digits and more."""
    kinds = set()
    with np.load(references / f"{name}.npz") as stored:
        for number, case in enumerate(json.loads(str(stored["cases"]))):
            places, expected = stored[f"places_{number}"], stored[f"values_{number}"]
            if places[-1] > LONGEST:
                continue
            recipe = getattr(waveforms, case["kind"])(*tuples(case["fields"]))
            samples = recipe.samples(case["rate_hz"], case["shift_s"])
            assert samples.size == places[-1] + 1, case
            np.testing.assert_allclose(
                samples[places], expected, rtol=0, atol=1e-12, err_msg=str(case)[:200]
            )
            kinds.add(type(recipe))
    assert len(kinds) == n_kinds


@pytest.mark.parametrize("kind", [kind for kind in KINDS if "window" in specs_of(kind)])
@pytest.mark.parametrize("name", ["tukey", "hanning"])
def test_a_window_fades_the_burst(kind, name):
    recipe, windowed = kind(window="none"), kind(window=name)
    plain, faded = recipe.samples(1300.0), windowed.samples(1300.0)
    weighted = plain * window(name, plain.size)
    if kind is Noise:  # its largest sample is 1 afterwards
        weighted /= np.abs(weighted).max()
        assert windowed.samples(1300.0, 4e-4)[0] == 0.0
    np.testing.assert_allclose(faded, weighted, rtol=0, atol=1e-15)
    if kind is Noise:
        return
    shifted, later = recipe.samples(1300.0, 4e-4), windowed.samples(1300.0, 4e-4)
    assert later[0] == shifted[0] == 0.0
    assert (np.abs(later) <= np.abs(shifted)).all()


@pytest.mark.parametrize(
    ("recipe", "name"),
    [
        (Chirp(100.0, 650.0), "end_hz is 650"),
        (Chirp(650.0, 100.0), "start_hz is 650"),
        (DampedSine(650.0), "frequency_hz is 650"),
        (Square(650.0), "frequency_hz is 650"),
        (Saw(650.0), "frequency_hz is 650"),
        (Triangle(650.0), "frequency_hz is 650"),
        (PulseTrain(650.0, 1e-5), "rate_hz is 650"),
        (AmplitudeModulated(650.0, depth=0.0), "carrier_hz is 650"),
        (AmplitudeModulated(630.0, 20.0), r"carrier_hz \+ modulator_hz is 650"),
        (FrequencyModulated(650.0, deviation_hz=0.0), "carrier_hz is 650"),
        (FrequencyModulated(100.0, 650.0), "modulator_hz is 650"),
        (FrequencyModulated(600.0, 20.0, 50.0), r"carrier_hz \+ deviation_hz is 650"),
        (Gabor(650.0), "frequency_hz is 650"),
        (Ricker(650.0), "frequency_hz is 650"),
        (Morlet(650.0), "frequency_hz is 650"),
        (Chirplet(650.0, 0.0, 0.01), "frequency_hz is 650"),
        (Chirplet(600.0, 2500.0, 0.01), "reaches 650 Hz"),
        (Chirplet(600.0, -2500.0, 0.01), "reaches 650 Hz"),
        (WaveletTrain((100.0, 650.0)), "frequencies_hz is 650"),
        (Glide(((0.0, 100.0, 1.0), (1.0, 650.0, 1.0))), "frequency_hz is 650"),
        (CentredTap(4.0 / 1300.0 + 0.001), r"more than 0\.005 s at 800 Hz"),
    ],
    ids=repr,
)
def test_what_reaches_half_the_rate_is_refused_and_nothing_below(recipe, name):
    with pytest.raises(InvalidInputError, match=name):
        recipe.samples(800.0 if isinstance(recipe, CentredTap) else 1300.0)
    assert np.isfinite(recipe.samples(1300.2)).all()


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: PulseTrain(250.0, 0.004), r"PulseTrain\.pulse_s is .* expected less than"),
        (lambda: Noise(low_hz=300.0, high_hz=300.0), r"Noise\.low_hz"),
        (lambda: Noise(low_hz=100.0, high_hz=104.0, duration_s=0.2), r"Noise\.duration_s"),
        (lambda: Gabor(0.1, 50.0), "Gabor lasts"),
        (lambda: Morlet(0.1, 50.0), "Morlet lasts"),
        (lambda: WaveletTrain(slot_s=60.0, frequencies_hz=(100.0,) * 11), "WaveletTrain lasts 660"),
        (lambda: WaveletTrain((50.0, 60.0), gains_db=(0.0,)), r"has 1 gain, .* its 2 frequencies"),
        (lambda: Glide(((0.0, 50.0, 1.0), (0.0, 60.0, 1.0))), "end at 0 s"),
    ],
)
def test_fields_that_do_not_go_together_are_refused_by_name(make, what):
    with pytest.raises(InvalidInputError, match=what):
        make()


def test_lists_and_arrays_will_do_for_tuples():
    plain = WaveletTrain((50.0, 60.0), gains_db=(0.0, -3.0))
    assert WaveletTrain([50, 60], gains_db=np.array([0.0, -3.0])) == plain
    assert hash(WaveletTrain(np.array([50.0, 60.0]), gains_db=[0, -3])) == hash(plain)
    points = [[0.0, 50.0, 1.0], [0.1, 60.0, 1.0]]
    assert Glide(points) == Glide(np.array(points)) == Glide(tuple(map(tuple, points)))
