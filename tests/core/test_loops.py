"""Loops: one period of a steady tone, what moves of all else, at a speed that can be followed."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine.loops import animation_of, common_turns, loop_of, shown_part

HZ = 130.0


def moving(design, quantity="moving_z"):
    return ss.evaluate(design, quantity)[quantity]


def tones(duration_s, **changes):
    first = ss.waveforms.Tone(frequency_hz=HZ, duration_s=duration_s, phase_rad=0.7)
    second = replace(first, phase_rad=2.7, **changes)
    inputs = (ss.track(7, first), ss.track(12, second, amplitude=2.0))
    return ss.Design(limb="synthetic-1", inputs=inputs)


@pytest.mark.parametrize("duration_s", [0.06, 0.3])
def test_short_tones_loop_as_endless_ones_do(duration_s):
    long = moving(tones(3.0))
    at_s = 2.0 + np.arange(12) / (12 * HZ)
    endless = np.stack([long.acceleration(time_s)[:, 0] for time_s in at_s])
    design = tones(duration_s)
    loop = loop_of(design, moving(design))
    assert loop.duration_s == pytest.approx(1.0 / HZ)
    shares = at_s * HZ
    np.testing.assert_allclose(
        [loop.values(share) for share in shares], endless, atol=0.01 * np.abs(endless).max()
    )
    assert loop.largest == pytest.approx(np.abs(loop.phasors).max())
    np.testing.assert_allclose(loop.values(0.3), loop.values(5.3), atol=1e-12)


@pytest.mark.parametrize("changes", [{"frequency_hz": 200.0}, {"window": "none"}])
def test_tones_that_differ_pass(changes):
    design = tones(0.2, **changes)
    assert loop_of(design, moving(design)).phasors is None


def test_what_passes_begins_before_the_stimulus_and_ends_where_it_rests():
    tap = ss.track(7, ss.waveforms.Tap(), onset_s=0.3)
    design = ss.Design(limb="synthetic-1", inputs=(tap,))
    signals = moving(design)
    loop = loop_of(design, signals)
    assert loop.begin_s == pytest.approx(0.295 + signals.delay_s)
    after = round((loop.begin_s + loop.duration_s) * signals.sample_rate_hz) + 1
    assert np.abs(signals.signals[..., after:]).max() <= 0.05 * signals.largest
    assert np.abs(loop.values(0.0)).max() < 0.02 * signals.largest
    # A quiet tail is left out, and the last clip is not, however soft.
    hum = 0.011 * signals.largest * np.sin(np.arange(signals.response_samples))
    humming = replace(signals, signals=signals.signals + hum)
    assert loop_of(design, humming).duration_s == pytest.approx(loop.duration_s, abs=0.05)
    both = design.adding(ss.track(7, ss.waveforms.Tap(), onset_s=0.6, amplitude=0.001))
    assert loop_of(both, moving(both)).duration_s > 0.32
    times_s, traces = loop.traces((29,), loop.duration_s)
    assert 0.0 <= times_s[0] < times_s[-1] <= loop.duration_s
    peak = np.abs(signals.signals[28]).max()
    assert np.abs(traces).max() == pytest.approx(peak, rel=0.1)


@pytest.mark.parametrize("frequency_hz", [50.0, 400.0])
def test_the_fastest_strong_component_is_shown_at_two_hertz(frequency_hz):
    tone = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=0.2)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
    assert loop_of(design, moving(design)).slow_motion == pytest.approx(frequency_hz / 2.0)
    noisy = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
    loop = loop_of(noisy, moving(noisy))
    assert 1.0 < loop.fastest_hz / loop.slow_motion <= 2.0


def test_lengths_of_vectors_are_not_negative_and_move_twice_as_fast():
    design = tones(0.2)
    along, length = (loop_of(design, moving(design, f"moving_{name}")) for name in ("z", "vector"))
    assert length.slow_motion == pytest.approx(2.0 * along.slow_motion)
    assert length.values(0.25).min() >= 0.0
    assert not length.signed


@pytest.mark.parametrize("onset_s", [0.3, 30.0])
def test_an_animation_leaves_silence_out_at_any_speed(onset_s):
    tap = ss.track(7, ss.waveforms.Tap(), onset_s=onset_s)
    design = ss.Design(limb="synthetic-1", inputs=(tap,))
    for removed in (True, False):
        view = ss.View(slow_motion=5.0, delay_removed=removed)
        begin_s, end_s, slow_motion = animation_of(design, view)
        delay_s = 0.0 if removed else moving(design).delay_s
        assert begin_s == pytest.approx(onset_s + delay_s - 0.005)
        assert 0.05 < end_s - begin_s < 0.4
        assert slow_motion == 5.0


def test_an_animation_of_a_long_response_goes_to_its_end():
    taps = (ss.track(7, ss.waveforms.Tap()), ss.track(8, ss.waveforms.Tap(), onset_s=40.0))
    begin_s, end_s, _ = animation_of(ss.Design(limb="synthetic-1", inputs=taps), ss.View())
    assert (begin_s < 0.1, end_s > 40.1) == (True, True)


def test_at_its_own_speed_an_animation_shows_one_period_of_a_steady_tone_without_a_seam():
    design = tones(0.5)
    begin_s, end_s, slow_motion = animation_of(design, ss.View(slow_motion=0.0))
    assert (end_s - begin_s, slow_motion) == (pytest.approx(1.0 / HZ), HZ / 2.0)
    signals = moving(design)
    first, last = signals.acceleration(begin_s), signals.acceleration(end_s)
    np.testing.assert_allclose(first, last, atol=0.01 * signals.largest)
    assert animation_of(tones(0.03), ss.View(slow_motion=0.0, delay_removed=True))[0] == 0.0


@pytest.mark.parametrize(
    ("tones_hz", "expected"),
    [
        ((80.0, 180.0, 300.0), (4, True)),
        ((50.0, 80.0, 100.0, 200.0, 400.0), (5, True)),
        ((50.0, 200.0), (1, True)),
        ((80.0, 181.0), (4, False)),
    ],
)
def test_loops_of_unlike_tones_begin_again_after_their_common_period(tones_hz, expected):
    assert common_turns([1.0 / hz for hz in tones_hz], 16) == expected


def test_spectra_have_the_tone_on_top_as_high_in_designs_of_any_length():
    heights_db = []
    for silence in ((), (ss.track(8, ss.waveforms.Tap(), onset_s=2.0, amplitude=0.0),)):
        design = replace(tones(0.5), inputs=(*tones(0.5).inputs, *silence))
        frequency_hz, levels_db = loop_of(design, moving(design)).spectra((29, 30))
        assert levels_db.shape == (2, frequency_hz.size)
        np.testing.assert_allclose(frequency_hz[levels_db.argmax(axis=1)], HZ, atol=3.0)
        heights_db.append(levels_db.max(axis=1))
    np.testing.assert_allclose(*heights_db, atol=0.2)


def test_of_a_motion_the_part_with_the_most_energy_is_found():
    early = ss.track(7, ss.waveforms.Tap(), onset_s=0.0)
    late = ss.track(12, ss.waveforms.Tap(), onset_s=0.6, amplitude=5.0)
    design = ss.Design(limb="synthetic-1", inputs=(early, late))
    loop = loop_of(design, moving(design))
    after_s, away_s = shown_part([loop], 0.05)
    part = loop.part(after_s, 0.05)
    assert (part.duration_s, part.largest, away_s) == (0.05, loop.largest, [0.0])
    assert after_s == pytest.approx(0.6, abs=0.02)
    np.testing.assert_allclose(
        part.values(0.5), loop.values((after_s + 0.025) / loop.duration_s), atol=1e-9
    )
    # It stays within the motion.
    assert shown_part([loop], 0.999 * loop.duration_s)[0] <= 0.001 * loop.duration_s + 1e-9
    steady = loop_of(tones(0.3), moving(tones(0.3)))
    assert steady.part(after_s, 0.1) is steady


def test_of_several_motions_the_part_is_found_in_which_most_are_seen():
    def loop(*onsets_s):
        # The last tap is the strongest.
        taps = [
            ss.track(7, ss.waveforms.Tap(), onset_s=each, amplitude=k)
            for k, each in enumerate(onsets_s, 1)
        ]
        design = ss.Design(limb="synthetic-1", inputs=tuple(taps))
        whole = loop_of(design, moving(design))
        return whole.part(-onsets_s[0], 1.0)

    early, late, both = loop(0.0), loop(0.8), loop(0.0, 0.7)
    assert shown_part([both], 0.1)[0] == pytest.approx(0.68, abs=0.03)
    after_s, away_s = shown_part([early, both], 0.1)
    assert (after_s, away_s) == (pytest.approx(0.0, abs=0.01), [0.0, 0.0])
    # What is short is seen from its beginning, though the long one gets louder after that.
    chirp = ss.track(7, ss.waveforms.Chirp(duration_s=1.0))
    design = ss.Design(limb="synthetic-1", inputs=(chirp,))
    louder = loop_of(design, moving(design)).part(0.0, 1.0)
    assert shown_part([louder], 0.1)[0] > shown_part([early, louder], 0.1)[0] == 0.0
    # No part holds all: it is told where the others are.
    after_s, away_s = shown_part([early, late, both], 0.3)
    assert 0.5 < after_s <= 0.7
    assert away_s == [pytest.approx(-after_s, abs=0.02), 0.0, 0.0]
    silence = loop_of(ss.Design(limb="synthetic-1"), moving(ss.Design(limb="synthetic-1")))
    assert shown_part([early, silence.part(0.0, 1.0)], 0.1)[1] == [0.0, 0.0]
