"""A chain of effects: their order, their switches, and when they want their samples."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from skinsource.design.effects.effect import ON, Effect, KeepsTime, own_duration_s
from skinsource.design.effects.playing import played, played_s
from skinsource.design.waveforms.tones import Tone
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=100.0, duration_s=0.1, window="none")
NUMBER = NumberSpec(label="Number")


@dataclass(frozen=True, slots=True, kw_only=True)
class Raised(KeepsTime):
    """Adds a number."""

    title: ClassVar[str] = "Raised"

    by: float = fields.number(1.0, NUMBER)
    on: bool = fields.switch(True, ON)

    def applied(self, samples, sample_rate_hz, shift_s=0.0, duration_s=None):
        return samples + self.by


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubled(KeepsTime):
    """Twice as strong."""

    title: ClassVar[str] = "Doubled"

    on: bool = fields.switch(True, ON)

    def applied(self, samples, sample_rate_hz, shift_s=0.0, duration_s=None):
        return 2.0 * samples


@dataclass(frozen=True, slots=True, kw_only=True)
class From:
    """What is left from a time on."""

    title: ClassVar[str] = "From"

    start_s: float = fields.number(0.0, NUMBER)
    on: bool = fields.switch(True, ON)

    def length(self, duration_s):
        return max(duration_s - self.start_s, 0.0)

    def shift_before(self, shift_s, duration_s, sample_rate_hz):
        samples = (shift_s - self.start_s) * sample_rate_hz
        return (samples - np.floor(samples)) / sample_rate_hz

    def applied(self, samples, sample_rate_hz, shift_s=0.0, duration_s=None):
        before = self.shift_before(shift_s, duration_s, sample_rate_hz)
        return samples[round((self.start_s - shift_s + before) * sample_rate_hz) :]


def test_without_effects_a_waveform_plays_its_own_samples():
    assert np.array_equal(played(TONE, (), RATE_HZ), TONE.samples(RATE_HZ))
    assert played_s(TONE, ()) == 0.1


def test_effects_work_one_after_the_other():
    raised_first = played(TONE, (Raised(by=1.0), Doubled()), RATE_HZ)
    raised_last = played(TONE, (Doubled(), Raised(by=1.0)), RATE_HZ)
    assert raised_first == pytest.approx(2.0 * (TONE.samples(RATE_HZ) + 1.0))
    assert raised_last == pytest.approx(2.0 * TONE.samples(RATE_HZ) + 1.0)


def test_an_effect_that_is_off_changes_nothing():
    off = (Raised(on=False), From(start_s=0.05, on=False))
    assert np.array_equal(played(TONE, off, RATE_HZ), TONE.samples(RATE_HZ))
    assert played_s(TONE, off) == 0.1


def test_lengths_follow_the_chain():
    assert played_s(TONE, (From(start_s=0.03), Doubled(), From(start_s=0.05))) == pytest.approx(
        0.02
    )


@pytest.mark.parametrize("shift", [0.0, 0.25, 0.7])
def test_each_effect_takes_samples_at_the_instants_that_it_needs(shift):
    asked = []

    def draw(waveform, sample_rate_hz, shift_s):
        asked.append(shift_s * sample_rate_hz)
        n = round(waveform.duration_s * sample_rate_hz) + (shift_s > 0)
        return np.arange(n) / sample_rate_hz - shift_s  # the own time, as a signal

    chain = (From(start_s=10.5 / RATE_HZ), Doubled(), From(start_s=20.25 / RATE_HZ))
    samples = played(TONE, chain, RATE_HZ, shift / RATE_HZ, draw=draw)
    assert asked == [pytest.approx((shift - 30.75) % 1.0)]
    own = np.arange(samples.size) / RATE_HZ - shift / RATE_HZ
    assert samples == pytest.approx(2.0 * (own + 30.75 / RATE_HZ), abs=1e-12)


def test_how_long_samples_play_is_told_or_counted():
    assert own_duration_s(np.zeros(13), RATE_HZ, 0.0, None) == 0.01
    assert own_duration_s(np.zeros(14), RATE_HZ, 0.0002, None) == 0.01
    assert own_duration_s(np.zeros(0), RATE_HZ, 0.0002, None) == 0.0
    assert own_duration_s(np.zeros(13), RATE_HZ, 0.0, 0.0096) == 0.0096


def test_what_is_made_so_is_an_effect():
    assert all(isinstance(kind(), Effect) for kind in (Raised, Doubled, From))
    assert not isinstance(TONE, Effect)
