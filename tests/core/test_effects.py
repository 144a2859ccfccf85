"""What each effect is said to do."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import Clip
from skinsource.design.effects import BandLimit, Fade, Rectify, SoftClip, played, played_s
from skinsource.design.effects.time import Repeat, Reverse, Stretch, Trim, stretched_by
from skinsource.design.waveforms import Formula, Tone

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=100.0, duration_s=0.2, window="none")
shifts = st.floats(0.0, 0.99)
signals = st.lists(st.floats(-10.0, 10.0), min_size=1, max_size=60).map(np.array)


@given(st.integers(2, 80), shifts)
def test_backwards_plays_at_each_instant_what_was_as_far_from_the_end(n, shift):
    ramp = Formula(text="1 + t", duration_s=n / RATE_HZ)
    samples = played(ramp, (Reverse(),), RATE_HZ, shift / RATE_HZ)
    times_s = (np.arange(samples.size) - shift) / RATE_HZ
    inside = (times_s > 1e-9) & (times_s < n / RATE_HZ)
    assert inside.sum() >= n - 1
    assert samples[inside] == pytest.approx(1 + n / RATE_HZ - times_s[inside], abs=1e-9)


@pytest.mark.parametrize("shift_s", [0.0, 0.0003, 0.0009])
def test_backwards_too_nothing_plays_before_time_0(shift_s):
    # What a delayed recording has behind its end would come first.
    samples = Reverse().applied(np.ones(13), 1000.0, shift_s, 0.0105)
    own_s = np.arange(samples.size) / 1000.0 - shift_s
    assert (samples[own_s < 0.0] == 0.0).all()
    assert (samples[own_s >= 0.0] == 1.0).all()


def test_fades_have_their_shapes_and_are_placed_exactly():
    at = np.array([0.0, 0.25, 0.5, 1.0]) * 0.1
    assert Fade(0.1, 0.0, "straight").values_at(at, 1.0) == pytest.approx([0, 0.25, 0.5, 1])
    smooth = Fade(0.1, 0.0, "smooth").values_at(at, 1.0)
    assert smooth == pytest.approx([0, (1 - np.sqrt(0.5)) / 2, 0.5, 1])
    power = Fade(0.1, 0.0, "equal power").values_at(at, 1.0) ** 2
    # Crossed with one that ends there, the power stays.
    out = Fade(0.0, 0.1, "equal power").values_at(at + 0.9, 1.0) ** 2
    assert power + out == pytest.approx(np.ones(4))
    formula = Formula(text="1", duration_s=0.01)
    samples = played(formula, (Fade(0.005, 0.002, "straight"),), RATE_HZ, 0.25 / RATE_HZ)
    t = (np.arange(14) - 0.25) / RATE_HZ
    expected = np.clip(t / 0.005, 0, 1) * np.clip((0.01 - t) / 0.002, 0, 1)
    assert samples == pytest.approx(expected, abs=1e-12)


def test_fades_that_do_not_fit_are_shortened_alike_and_meet():
    fade = Fade(0.3, 0.1, "straight")
    assert fade.values_at(np.array([0.0, 0.1, 0.15, 0.175, 0.2]), 0.2) == pytest.approx(
        [0, 2 / 3, 1, 0.5, 0]
    )


@pytest.mark.parametrize("factor", [0.5, 0.8, 3.7])
def test_a_tape_that_runs_slower_divides_frequencies(factor):
    tone = Formula(text="sin(2*pi*80*t) * hann()", duration_s=0.3)
    samples = played(tone, (Stretch(factor),), RATE_HZ, 0.3 / RATE_HZ)
    t = (np.arange(samples.size) - 0.3) / RATE_HZ / factor
    inside = (t >= 0) & (t < 0.3)
    expected = np.sin(2 * np.pi * 80 * t) * 0.5 * (1 - np.cos(2 * np.pi * t / 0.3)) * inside
    assert np.abs(samples - expected).max() < 5e-6
    assert played_s(tone, (Stretch(factor),)) == pytest.approx(0.3 * factor)


def test_a_fast_tape_folds_nothing():
    high = Formula(text="sin(2*pi*500*t) * hann()", duration_s=0.3)
    assert np.abs(played(high, (Stretch(0.5),), RATE_HZ)).max() < 1e-4


@pytest.mark.parametrize("factor", [0.6, 2.5])
@pytest.mark.parametrize("frequency_hz", [25.0, 97.0, 600.0])
def test_frequencies_can_stay_whatever_the_length(factor, frequency_hz):
    tone = Tone(frequency_hz=frequency_hz, duration_s=0.6, window="none")
    samples = played(tone, (Stretch(factor, pitch="stays"),), RATE_HZ)
    assert samples.size == pytest.approx(0.6 * factor * RATE_HZ, abs=1)
    inner = samples[80:-80]
    t = np.arange(inner.size) / RATE_HZ
    waves = np.stack([np.sin(2 * np.pi * frequency_hz * t), np.cos(2 * np.pi * frequency_hz * t)])
    fit, *_ = np.linalg.lstsq(waves.T, inner, rcond=None)
    assert np.hypot(*fit) == pytest.approx(1.0, abs=0.03)
    assert np.std(inner - fit @ waves) < 0.05


@pytest.mark.parametrize(("shift_s", "size"), [(0.0, 80), (0.0004, 81)])
def test_what_is_stretched_plays_at_its_last_instant_too(shift_s, size):
    samples = Stretch(2.0).applied(np.ones(40), 1000.0, shift_s, 0.04)
    assert samples.size == size
    own_s = np.arange(size) / 1000.0 - shift_s
    assert (samples[(own_s >= 0.0) & (own_s < 0.08)] > 0.1).all()


@pytest.mark.parametrize(
    ("effects", "factor"),
    [
        ((), 1.0),
        ((Stretch(factor=2.0),), 2.0),
        ((Stretch(factor=2.0, on=False),), 1.0),
        ((Stretch(factor=2.0, pitch="stays"),), 1.0),
        ((Stretch(to_s=2.0),), 4.0),
        ((Trim(duration_s=0.25), Stretch(to_s=0.5)), 2.0),
        ((Stretch(factor=4.0), Reverse(), Stretch(factor=0.5)), 2.0),
    ],
)
def test_the_frequency_that_sounds_is_that_of_the_waveform_over_the_factor(effects, factor):
    tone = Tone(frequency_hz=100.0, duration_s=0.5)
    assert stretched_by(effects, tone.duration_s) == pytest.approx(factor)
    _, samples = Clip(waveform=tone, effects=effects).sampled(RATE_HZ)
    spectrum = np.abs(np.fft.rfft(samples, 2**16))
    assert np.argmax(spectrum) * RATE_HZ / 2**16 == pytest.approx(100.0 / factor, rel=0.02)


def test_more_than_can_be_held_is_refused_before_it_is_made():
    with pytest.raises(InvalidInputError, match="expected at most 3600 s"):
        played(TONE, (Repeat(1000, 60.0),), RATE_HZ)
    with pytest.raises(InvalidInputError, match="expected at most 3600 s"):
        Stretch(100.0).applied(np.ones(52_000), RATE_HZ)


def test_a_band_keeps_what_lies_in_it_and_removes_the_rest():
    low, inside, high = (
        Formula(text=f"sin(2*pi*{f}*t)*hann()", duration_s=1.0) for f in (10, 100, 500)
    )
    band = BandLimit(50.0, 200.0)
    for effect in (low, high):
        samples_in = effect.samples(RATE_HZ)
        assert np.abs(band.applied(samples_in, RATE_HZ)).max() < 2e-4
        assert band.share_removed(samples_in, RATE_HZ) > 0.999999
    samples_in = inside.samples(RATE_HZ)
    # Without a delay, and without another shape.
    assert np.abs(band.applied(samples_in, RATE_HZ) - samples_in).max() < 1e-4
    assert band.share_removed(samples_in, RATE_HZ) < 1e-9
    assert band.share_removed(np.zeros(10), RATE_HZ) == 0.0
    both = low.samples(RATE_HZ) + samples_in
    assert band.share_removed(both, RATE_HZ) == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize("n", [50, 51, 55])
def test_the_share_that_is_removed_counts_half_the_rate_once(n):
    limit = BandLimit(0.0, 400.0)
    samples = np.where(np.arange(n) % 2, -1.0, 1.0)
    size = limit._spectrum(samples, 1000.0)[1]
    frequencies_hz = np.abs(np.fft.fftfreq(size, 1.0 / 1000.0))
    energy = np.abs(np.fft.fft(samples, size)) ** 2
    share = (energy * limit.gains_at(frequencies_hz) ** 2).sum() / energy.sum()
    assert limit.share_removed(samples, 1000.0) == pytest.approx(1.0 - share, abs=1e-12)


def test_gains_of_a_band_are_as_said():
    gains = BandLimit(100.0, 200.0).gains_at(np.array([0, 79, 90, 100, 150, 200, 220, 240, 999.0]))
    assert gains == pytest.approx([0, 0, 0.5, 1, 1, 1, 0.5, 0, 0], abs=1e-12)
    assert (BandLimit(0.0, 24e3).gains_at(np.linspace(0.0, 24e3, 50)) == 1.0).all()
    with pytest.raises(InvalidInputError, match=r"low_hz is 300, expected less than high_hz, 300"):
        BandLimit(300.0, 300.0)


@given(signals)
def test_rectified_samples_are_their_magnitudes_or_what_is_above_nothing(samples):
    assert np.array_equal(Rectify().applied(samples, RATE_HZ), np.abs(samples))
    half = Rectify("half").applied(samples, RATE_HZ)
    assert np.array_equal(half - Rectify("half").applied(-samples, RATE_HZ), samples)


@given(signals, st.floats(0.01, 1000.0), st.floats(1e-6, 1000.0))
def test_soft_clipping_limits_and_keeps_order_and_sign(samples, drive, level):
    clipped = SoftClip(drive, level).applied(samples, RATE_HZ)
    assert clipped == pytest.approx(level * np.tanh(drive / level * samples), rel=1e-9)
    assert np.abs(clipped).max() <= level
    order = np.argsort(samples, kind="stable")
    assert (np.diff(clipped[order]) >= 0).all()


def test_effects_work_one_after_the_other_and_lengths_follow_them():
    tone = TONE.samples(RATE_HZ)
    limited = played(TONE, (Rectify("half"), SoftClip(3.0)), RATE_HZ)
    assert limited == pytest.approx(np.tanh(3.0 * np.maximum(tone, 0.0)))
    chain = (Trim(start_s=0.03), Rectify(), Trim(start_s=0.05), Trim(start_s=1.0, on=False))
    assert played_s(TONE, chain) == pytest.approx(0.12)
