"""Every periodic waveform: against 40 digits, its window, and what it refuses."""

import json
import math

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design import waveforms
from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle
from skinsource.design.waveforms.pulses import DampedSine
from skinsource.design.waveforms.tones import AmplitudeModulated, Chirp, FrequencyModulated
from skinsource.signals.generators import window

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
        samples = recipe.samples(case["rate_hz"], case["shift_s"])
        assert samples.size == places[-1] + 1, case
        np.testing.assert_allclose(samples[places], expected, rtol=0, atol=1e-12, err_msg=str(case))
        kinds.add(case["kind"])
    assert kinds == {type(recipe).__name__ for recipe in ONE_OF_EACH}


@pytest.mark.parametrize("recipe", ONE_OF_EACH, ids=lambda recipe: type(recipe).__name__)
@pytest.mark.parametrize("window_name", ["tukey", "hanning"])
def test_a_window_fades_the_burst(recipe, window_name):
    made = {name: getattr(recipe, name) for name in recipe.__slots__} | {"window": window_name}
    plain, faded = recipe.samples(1300.0), type(recipe)(**made).samples(1300.0)
    np.testing.assert_array_equal(faded, plain * window(window_name, plain.size))
    shifted, later = recipe.samples(1300.0, 4e-4), type(recipe)(**made).samples(1300.0, 4e-4)
    assert later.size == plain.size + 1
    assert later[0] == shifted[0] == 0.0
    assert (np.abs(later) <= np.abs(shifted)).all()


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
        *(
            (type(recipe), {"duration_s": bad})
            for recipe in ONE_OF_EACH
            for bad in (0.0, -1.0, 601.0)
        ),
        *((type(recipe), {"window": "hann"}) for recipe in ONE_OF_EACH),
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


@pytest.mark.parametrize("kind", [type(recipe) for recipe in ONE_OF_EACH])
def test_the_shortest_burst_is_finite(kind):
    shortest = kind(duration_s=0.001)
    for rate_hz, n in ((1300.0, 1), (48000.0, 48)):
        for shift in (0.0, 0.5):
            samples = shortest.samples(rate_hz, shift / rate_hz)
            assert samples.shape == (n + (shift > 0),)
            assert np.isfinite(samples).all()
