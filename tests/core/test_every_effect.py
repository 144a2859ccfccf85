"""Every effect there is: twice, reversed, of nothing, at its limits, at any rate and shift."""

import inspect
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from skinsource.design.effects import EFFECTS, Effect, played, played_s
from skinsource.design.waveforms import Formula, Impulse
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec

RATE_HZ = 1300.0
#: A burst that begins and ends in silence, and is the same at any rate.
BURST = Formula(text="gauss(0.04, 0.006) * sin(2*pi*120*t)", duration_s=0.08)
ENVELOPE = ((0.0, 0.2, "smooth"), (0.01, 1.0, "straight"), (0.02, 0.5, "held"), (0.03, 2.0))
#: Fields that make a member do something that another set does not.
MORE = {
    "Envelope": ({"points": ENVELOPE},),
    "Fade": ({"shape": "straight"}, {"shape": "equal power", "in_s": 5.0}),
    "Trim": ({"start_s": 0.0101}, {"start_s": 0.01, "duration_s": 0.0203}),
    "Stretch": ({"factor": 0.5}, {"to_s": 0.1}, {"pitch": "stays", "factor": 1.5}),
    "Repeat": ({"times": 3, "gap_s": 0.0101},),
    "BandLimit": ({"low_hz": 0.0, "high_hz": 100.0}, {"low_hz": 110.0}),
    "Rectify": ({"wave": "half"},),
}
ALL = [kind(**fields_of) for kind in EFFECTS for fields_of in ({}, *MORE.get(kind.__name__, ()))]
NAMES = [repr(effect)[:60] for effect in ALL]
#: What has to be beside one for it to reach both ends.
BESIDE = {("BandLimit", "low_hz"): {"high_hz": 24e3}, ("BandLimit", "high_hz"): {"low_hz": 0.0}}


def at_limits(kind):
    """The effect with each of its fields at each end, where that is allowed."""
    for name, spec in specs_of(kind).items():
        ends = ()
        if isinstance(spec, NumberSpec):
            ends = (spec.minimum, spec.maximum)
        elif isinstance(spec, ChoiceSpec):
            ends = tuple(option for option, _ in spec.options)
        for end in ends:
            yield kind(**{**BESIDE.get((kind.__name__, name), {}), name: end})


@pytest.mark.parametrize("kind", EFFECTS)
def test_an_effect_is_a_recipe_with_a_switch_that_describes_its_fields(kind):
    effect = kind()
    assert isinstance(effect, Effect)
    assert effect.on
    assert hash(effect) == hash(kind())
    assert set(specs_of(kind)) == set(inspect.signature(kind).parameters)
    assert kind.title
    assert kind.__doc__
    off = replace(effect, on=False)
    assert np.array_equal(played(BURST, (off,), RATE_HZ), BURST.samples(RATE_HZ))


at_shifts = pytest.mark.parametrize(("effect", "shift"), list(product(ALL, (0.0, 0.3, 0.999))))


@at_shifts
def test_it_plays_as_long_as_it_says_and_is_silent_outside(effect, shift):
    samples = played(BURST, (effect,), RATE_HZ, shift / RATE_HZ)
    length_s = played_s(BURST, (effect,))
    assert abs(samples.size - (length_s * RATE_HZ + (shift > 0))) <= 1.5
    assert samples.dtype == np.float64
    assert np.isfinite(samples).all()
    times = (np.arange(samples.size) - shift) / RATE_HZ
    assert not samples[(times < -1e-9) | (times > length_s + 1 / RATE_HZ)].any()
    assert np.abs(samples).max() > 0.01


@pytest.mark.parametrize("effect", ALL, ids=NAMES)
def test_it_leaves_what_it_takes_as_it_was_and_gives_the_same_again(effect):
    samples_in = BURST.samples(RATE_HZ)
    before = samples_in.copy()
    samples_in.flags.writeable = False
    samples = effect.applied(samples_in, RATE_HZ)
    assert np.array_equal(samples, effect.applied(before, RATE_HZ))
    assert np.array_equal(samples_in, before)


@at_shifts
def test_of_nothing_it_makes_nothing(effect, shift):
    assert effect.length(0.0) >= 0.0
    assert effect.applied(np.zeros(0), RATE_HZ, shift / RATE_HZ, 0.0).size <= 1
    assert effect.applied(np.zeros(0), RATE_HZ, shift / RATE_HZ).size <= 1
    assert not effect.applied(np.zeros(50), RATE_HZ, shift / RATE_HZ).any()
    assert np.isfinite(effect.applied(np.ones(1), RATE_HZ)).all()


@pytest.mark.parametrize("kind", EFFECTS)
def test_at_its_limits_it_gives_finite_samples_as_long_as_it_says(kind):
    for effect in at_limits(kind):
        for waveform, shift in ((BURST, 0.4), (Impulse(), 0.0)):
            if waveform is BURST and played_s(waveform, (effect,)) > 60.0:
                continue  # ten minutes take seconds, and an impulse fills them too
            samples = played(waveform, (effect,), RATE_HZ, shift / RATE_HZ)
            length = played_s(waveform, (effect,)) * RATE_HZ
            assert np.isfinite(samples).all(), effect
            assert abs(samples.size - length) <= 2.5, (effect, waveform)


#: How far a member may differ between rates, of a peak of 1.
TOLERANCE = {"Repeat": 1e-5, "Stretch": 1e-5, "BandLimit": 2e-3}


@pytest.mark.parametrize(("effect", "shift"), list(product(ALL, (0.0, 0.37))))
def test_it_does_the_same_at_every_rate(effect, shift):
    """A clip that starts a part of a sample of 1300 Hz late; the 48 kHz draw starts just there."""
    late_s = shift / RATE_HZ
    slow = played(BURST, (effect,), RATE_HZ, late_s)
    whole, behind = divmod(late_s * 48000.0, 1.0)
    # Own time 0 lies at `whole + behind` samples: the part before the last sample is the shift.
    fast = played(BURST, (effect,), 48000.0, behind / 48000.0)
    fast = np.concatenate((np.zeros(int(whole)), fast))
    both = [(13 * k, 480 * k) for k in range(slow.size // 13) if 480 * k < fast.size]
    at_slow, at_fast = (np.array(index) for index in zip(*both, strict=True))
    tolerance = TOLERANCE.get(type(effect).__name__, 1e-9)
    if getattr(effect, "pitch", "") == "stays":
        tolerance = 0.05
    if getattr(effect, "factor", 1.0) < 1.0:
        tolerance = 1e-3
    assert np.abs(slow[at_slow] - fast[at_fast]).max() <= tolerance
    assert len(both) >= 2
