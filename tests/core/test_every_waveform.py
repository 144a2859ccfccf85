"""What every kind of waveform keeps, a new one too: its fields say what can be tried."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms import KINDS
from skinsource.signals.generators import sample_count
from skinsource.signals.sampling import band_limited_delay
from skinsource.specs import image
from skinsource.specs.models import decode, encode, specs_of
from skinsource.specs.numbers import (
    ListSpec,
    ModelSpec,
    NumberSpec,
    OptionalSpec,
    PointsSpec,
    SamplesSpec,
)
from skinsource.specs.samples import Samples
from skinsource.specs.spec import Address, ChoiceSpec, Spec, SwitchSpec, TextSpec, made_for

RATES_HZ = (1300.0, 8000.0, 44100.0)
#: Longer ones are made, and not played.
MOST_SAMPLES = 30_000
N_RECIPES = 40
#: Largest image of a file of a waveform that holds no samples, in bytes.
LARGEST = 100_000
#: Kinds that may go beyond 1, as they say themselves: with edges cut off at half the rate; where
#: waves add up; as written, drawn or recorded.
BEYOND_ONE = {
    "Square",
    "Saw",
    "PulseTrain",
    "WaveletTrain",
    "Formula",
    "Drawn",
    "Recording",
    "Layers",
}


def number(spec: NumberSpec, rng: np.random.Generator) -> float:
    """Any number that fits: an end, one near 0, or one between."""
    low, high = max(spec.minimum, -1e6), min(spec.maximum, 1e6)
    value = rng.choice([low, high, rng.uniform(low, high), rng.uniform(low, high)])
    if low > 0 and rng.random() < 0.8:
        value = np.exp(rng.uniform(np.log(low), np.log(high)))
    value = float(np.clip(value, low, high))
    return int(value) if spec.whole else value


def several(spec: ListSpec, rng: np.random.Generator) -> tuple[Any, ...]:
    count = rng.integers(spec.fewest, min(spec.most, spec.fewest + 5) + 1)
    return tuple(any_value(spec.of, rng) for _ in range(count))


def points(spec: PointsSpec, rng: np.random.Generator) -> tuple[tuple[float, ...], ...]:
    count = rng.integers(spec.fewest, spec.fewest + 6)
    made = [tuple(number(column, rng) for column in spec.columns) for _ in range(count)]
    return tuple(sorted(made))


def sound(spec: SamplesSpec, rng: np.random.Generator) -> Samples:
    values = rng.standard_normal(rng.integers(1, 300))
    return Samples(values=values, sample_rate_hz=float(rng.choice(RATES_HZ)), unit=spec.unit or "")


#: What is not here keeps its default.
VALUES = {
    NumberSpec: number,
    ChoiceSpec: lambda spec, rng: str(rng.choice([option for option, _ in spec.options])),
    SwitchSpec: lambda spec, rng: bool(rng.random() < 0.5),
    TextSpec: lambda spec, rng: "".join(rng.choice(list("t123.+-*/^(), sin"), rng.integers(12))),
    ListSpec: several,
    PointsSpec: points,
    SamplesSpec: sound,
    OptionalSpec: lambda spec, rng: None if rng.random() < 0.5 else any_value(spec.of, rng),
    ModelSpec: lambda spec, rng: None,
    Spec: lambda spec, rng: None,
}


def any_value(spec: Spec, rng: np.random.Generator) -> Any:
    return made_for(spec, VALUES)(spec, rng)


def any_recipes(kind: type[Waveform]) -> list[Waveform]:
    """The default, and others of which some fields are tried at random."""
    rng = np.random.default_rng(sum(map(ord, kind.__name__)))
    made: list[Waveform] = [kind()]
    for _ in range(N_RECIPES if specs_of(kind) else 0):
        changed = {}
        for name, spec in specs_of(kind).items():
            value = any_value(spec, rng)
            if rng.random() < 0.6 and value is not None:
                changed[name] = value
        with suppress(InvalidInputError):
            made.append(replace(kind(), **changed))
    return made


def played(recipe: Waveform, rate_hz: float, shift_s: float = 0.0) -> np.ndarray | None:
    """Samples, or None where they would be too many, or are refused."""
    if recipe.duration_s * rate_hz > MOST_SAMPLES:
        return None
    try:
        return recipe.samples(rate_hz, shift_s)
    except InvalidInputError:
        return None


@pytest.mark.parametrize("kind", KINDS)
def test_samples_are_finite_as_many_as_the_length_says_and_the_same_each_time(kind):
    n_audible = 0
    for number_of, recipe in enumerate(any_recipes(kind)):
        rate_hz = RATES_HZ[number_of % len(RATES_HZ)]
        samples = played(recipe, rate_hz)
        if samples is None:
            continue
        n_audible += 1
        expected = 1 if kind.__name__ == "Impulse" else sample_count(recipe.duration_s, rate_hz)
        assert samples.shape == (expected,), recipe
        assert samples.dtype == np.float64
        assert np.isfinite(samples).all(), recipe
        np.testing.assert_array_equal(samples, replace(recipe).samples(rate_hz, 0.0))
        later = played(recipe, rate_hz, 0.4 / rate_hz)
        assert later is not None, recipe
        assert later.shape == (expected + 1,), recipe
        assert np.isfinite(later).all(), recipe
        if kind.__name__ not in BEYOND_ONE:
            assert np.abs(samples).max(initial=0.0) <= 1.0 + 1e-12, recipe
    assert n_audible >= (5 if len(any_recipes(kind)) > 1 else 1)


@pytest.mark.parametrize("kind", KINDS)
def test_only_bad_input_is_refused_and_in_words(kind):
    """Beyond their ranges, of wrong types, at strange rates and shifts."""
    wrong = (
        None,
        "",
        -1.0,
        float("nan"),
        float("inf"),
        1e308,
        10**400,
        (),
        ((0.0,),),
        b"",
        object(),
    )
    for name in specs_of(kind):
        for value in wrong:
            message = refusal_of(lambda name=name, value=value: replace(kind(), **{name: value}))
            assert "expected" in message or not message
    for rate_hz in (0.0, -1300.0, float("nan"), float("inf"), "fast", None):
        assert "expected" in refusal_of(lambda rate_hz=rate_hz: kind().samples(rate_hz))


def refusal_of(call: Callable[[], object]) -> str:
    """The words with which something is refused, or ""; any other error passes on."""
    try:
        call()
    except InvalidInputError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("kind", KINDS)
def test_equal_recipes_are_equal_and_come_back_from_files_as_such(kind):
    for recipe in any_recipes(kind):
        again = replace(recipe)
        assert again == recipe
        assert again is not recipe
        assert hash(again) == hash(recipe)
        tree = encode(recipe)
        bytes_ = image.to_image(tree, version=2)
        assert len(bytes_) < LARGEST
        decoded = decode(image.from_image(bytes_, version=2), KINDS, Address())
        assert decoded == recipe
        assert repr(decoded) == repr(recipe)


@pytest.mark.parametrize("kind", KINDS)
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
    assert error < (0.05 if kind.__name__ in {"Square", "Saw", "PulseTrain"} else 2e-3)
    if part != 0.5:
        assert error < np.sqrt(np.mean((sooner - later) ** 2) / np.mean(later**2))
