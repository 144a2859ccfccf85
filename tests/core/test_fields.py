import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms import KINDS
from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.tones import Tone
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Recipe:
    size: float = fields.number(1.0, NumberSpec(label="Size", unit="mm", minimum=-2.0, maximum=3.0))
    count: int = fields.number(4, NumberSpec(label="Count", minimum=0, maximum=9, whole=True))
    free: float = fields.number(0.0, NumberSpec(label="Free"))
    shape: str = fields.choice(
        "round", ChoiceSpec(label="Shape", options=(("round", "Round"), ("flat", "Flat")))
    )
    note: str = ""

    def __post_init__(self):
        fields.check(self)


def test_specifications_are_listed_in_order_for_recipes_and_their_classes():
    assert list(fields.specs_of(Recipe)) == ["size", "count", "free", "shape"]
    assert fields.specs_of(Recipe()) == fields.specs_of(Recipe)


@pytest.mark.parametrize("size", [-2.0, -1, 0, 3, 3.0, np.float32(1.5), np.int64(2)])
def test_values_within_the_range_are_stored_as_plain_floats(size):
    recipe = Recipe(size=size)
    assert type(recipe.size) is float
    assert recipe.size == size
    assert recipe == Recipe(size=float(size))


@pytest.mark.parametrize("count", [0, 9, 4.0, np.int64(4), np.float64(9)])
def test_whole_numbers_are_stored_as_plain_integers(count):
    assert type(Recipe(count=count).count) is int


@pytest.mark.parametrize(
    "size", [-2.0000001, 3.1, math.nan, math.inf, -math.inf, True, "1", None, 1j, [1.0], 10**400]
)
def test_other_numbers_are_refused_with_the_range_and_the_unit(size):
    with pytest.raises(InvalidInputError, match=r"Recipe\.size is .*from -2 to 3 mm"):
        Recipe(size=size)


@pytest.mark.parametrize("count", [1.5, -1, 10, math.nan, False])
def test_numbers_that_are_not_whole_are_refused_where_whole_ones_are_wanted(count):
    with pytest.raises(InvalidInputError, match=r"Recipe\.count is .*a whole number from 0 to 9"):
        Recipe(count=count)


@pytest.mark.parametrize("free", [math.nan, math.inf, -math.inf])
def test_a_number_without_a_range_is_finite_all_the_same(free):
    with pytest.raises(InvalidInputError, match=r"Recipe\.free"):
        Recipe(free=free)


@pytest.mark.parametrize("shape", ["Round", "", None, 1, ["round"]])
def test_a_choice_that_is_not_offered_is_refused_with_those_that_are(shape):
    with pytest.raises(InvalidInputError, match=r"Recipe\.shape is .*expected one of round, flat"):
        Recipe(shape=shape)


#: What other fields have to be for one to reach both ends of its range.
BESIDE = {
    ("Noise", "low_hz"): {"high_hz": 100_000.0, "duration_s": 600.0},
    ("Noise", "high_hz"): {"low_hz": 0.0, "duration_s": 600.0},
    ("PulseTrain", "rate_hz"): {"pulse_s": 1e-6},
    ("PulseTrain", "pulse_s"): {"rate_hz": 1.0},
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_waveform_takes_the_ends_of_its_ranges_and_nothing_beyond(kind):
    for name, spec in fields.specs_of(kind).items():
        if isinstance(spec, ChoiceSpec):
            for option, _ in spec.options:
                assert getattr(replace(kind(), **{name: option}), name) == option
        if not isinstance(spec, NumberSpec):
            continue
        beside = BESIDE.get((kind.__name__, name), {})
        for end in (spec.minimum, spec.maximum):
            assert getattr(replace(kind(), **{**beside, name: end}), name) == end
        for beyond in (spec.minimum - 1e-3, spec.maximum * (1 + 1e-9) + 1e-3):
            with pytest.raises(InvalidInputError, match=f"{kind.__name__}.{name}"):
                replace(kind(), **{name: beyond})


def test_every_number_of_every_waveform_has_an_end_that_gives_samples():
    for end in ("minimum", "maximum"):
        frequency_hz = getattr(fields.specs_of(Tone)["frequency_hz"].at_rate(1300.0), end)
        assert np.isfinite(Tone(frequency_hz=frequency_hz).samples(1300.0)).all()
        seed = getattr(fields.specs_of(Noise)["seed"], end)
        assert np.abs(Noise(seed=seed).samples(1300.0)).max() == 1.0
    for kind in (Tone, Noise):
        shortest_s = fields.specs_of(kind)["duration_s"].minimum
        assert kind(duration_s=shortest_s, window="none").samples(1300.0).size >= 1


def test_a_default_is_checked_as_any_value_and_kept_in_the_same_form():
    @dataclass(frozen=True, slots=True, kw_only=True)
    class Careless:
        size: float = fields.number(1, NumberSpec(label="Size", minimum=0.0))
        count: float = fields.number(-1.0, NumberSpec(label="Count", minimum=0.0))

        def __post_init__(self):
            fields.check(self)

    for _ in range(2):
        made = Careless(count=2.0)
        assert (made.size, type(made.size)) == (1.0, float)
        with pytest.raises(InvalidInputError, match=r"Careless\.count is -1.0"):
            Careless()
