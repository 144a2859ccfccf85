"""Clips on tracks: what a track plays, from exactly when on."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelets import Gabor
from skinsource.engine.quantities import new_graph, sources
from skinsource.signals.sampling import on_grid

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=90.0, duration_s=0.1, window="none")
#: Four clips, two of which overlap, one of which is muted, none of which starts on a sample.
CLIPS = (
    Clip(waveform=TONE, onset_s=0.1003),
    Clip(waveform=Tone(frequency_hz=231.0, duration_s=0.07), onset_s=0.1501, gain=-0.3),
    Clip(waveform=Noise(seed=4), onset_s=0.02, muted=True),
    Clip(waveform=Tap(), onset_s=0.4009, gain=2.5),
)


def played(*clips: Clip, gain_curve=()) -> np.ndarray:
    """What a track plays from its first clip on."""
    track = Input(location=7, clips=clips, gain_curve=gain_curve)
    design = Design(limb="synthetic-1", inputs=(track,))
    return ss.evaluate(design, "input_waveforms")["input_waveforms"][0]


def levels(*inputs: Input, **changes) -> np.ndarray:
    design = Design(limb="synthetic-1", inputs=inputs, scaling="probe", **changes)
    return new_graph().evaluate({"output_rms"}, sources(design, View()))["output_rms"]


def test_a_track_plays_the_sum_of_its_clips_at_their_own_instants():
    samples = played(*CLIPS)
    # By the formulas: each recipe at its own time, from the sample before its onset on.
    first = int(np.floor(0.1003 * RATE_HZ))
    time_s = (first + np.arange(samples.size)) / RATE_HZ
    expected = np.zeros(samples.size)
    own = time_s - 0.1003
    expected += np.where((own >= 0) & (own < 0.1), np.sin(2 * np.pi * 90.0 * own), 0.0)
    begin = int(np.floor(0.1501 * RATE_HZ)) - first
    shift_s = 0.1501 - np.floor(0.1501 * RATE_HZ) / RATE_HZ
    part = CLIPS[1].waveform.samples(RATE_HZ, shift_s)
    expected[begin : begin + part.size] += -0.3 * part
    begin = int(np.floor(0.4009 * RATE_HZ)) - first
    part = Tap().samples(RATE_HZ, 0.4009 - np.floor(0.4009 * RATE_HZ) / RATE_HZ)
    expected[begin : begin + part.size] += 2.5 * part
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-9)


def test_one_clip_is_sampled_at_the_instants_of_the_limb():
    onset_s = 0.0123456
    samples = played(Clip(waveform=TONE, onset_s=onset_s))
    first = int(onset_s * RATE_HZ)
    own = (first + np.arange(samples.size)) / RATE_HZ - onset_s
    inside = (own >= 0) & (own < 0.1)
    np.testing.assert_allclose(samples[inside], np.sin(2 * np.pi * 90.0 * own[inside]), atol=1e-9)
    assert not samples[~inside].any()


@pytest.mark.parametrize("k", [0, 1, 130, 779_999])
@pytest.mark.parametrize("miss_s", [0.0, 1e-10, -1e-10])
def test_an_onset_on_a_sample_is_on_it_whatever_its_last_digits(k, miss_s):
    onset_s = min(max(k / RATE_HZ + miss_s, 0.0), 600.0)
    assert on_grid(onset_s * RATE_HZ) == (k, 0.0)


@given(st.floats(0.0, 780_000.0))
def test_a_position_is_kept_to_a_millionth_of_a_sample(position):
    whole, behind = on_grid(position)
    assert 0.0 <= behind < 1.0
    assert abs(whole + behind - position) < 1e-6


orders = st.permutations(CLIPS)


@settings(max_examples=20, deadline=None, derandomize=True)
@given(orders)
def test_the_order_of_clips_does_not_matter(clips):
    np.testing.assert_array_equal(levels(Input(location=7, clips=tuple(clips))), ALONE)


ALONE = levels(Input(location=7, clips=CLIPS))


@settings(max_examples=20, deadline=None, derandomize=True)
@given(st.integers(0, 400))
def test_all_clips_moved_by_whole_samples_play_the_same_so_much_later(k):
    later = tuple(replace(clip, onset_s=clip.onset_s + k / RATE_HZ) for clip in CLIPS)
    np.testing.assert_allclose(played(*later), played(*CLIPS), rtol=0, atol=2e-9)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(st.floats(0.0, 0.5))
def test_all_clips_moved_by_any_time_play_so_much_later(t_s):
    samples = played(*(replace(clip, onset_s=clip.onset_s + t_s) for clip in CLIPS))
    first = np.floor((CLIPS[0].onset_s + t_s) * RATE_HZ + 1e-6)
    # Each recipe drawn at instants that are so much earlier in its own time.
    expected = np.zeros(samples.size + 2)
    for clip in CLIPS:
        position = (clip.onset_s + t_s) * RATE_HZ
        begin = int(np.floor(position + 1e-6))
        late = position - begin
        part = clip.waveform.samples(RATE_HZ, late / RATE_HZ if late > 1e-6 else 0.0)
        if not clip.muted:
            at = begin - int(first)
            expected[at : at + part.size] += clip.gain * part
    np.testing.assert_allclose(samples, expected[: samples.size], rtol=0, atol=2e-9)


def test_clips_on_one_track_are_those_on_several_tracks_of_one_place():
    several = tuple(Input(location=7, clips=(clip,)) for clip in CLIPS)
    np.testing.assert_allclose(levels(*several), ALONE, rtol=1e-12)


def test_a_gain_of_a_clip_is_a_factor_beside_the_others():
    louder = tuple(replace(clip, gain=3.0 * clip.gain) for clip in CLIPS)
    np.testing.assert_allclose(levels(Input(location=7, clips=louder)), 3.0 * ALONE, rtol=1e-12)


def test_a_gain_curve_lies_over_the_time_of_the_design():
    curve = ((0.12, 1.0), (0.2, 3.0), (0.2, 0.5))
    samples, plain = played(*CLIPS, gain_curve=curve), played(*CLIPS)
    time_s = (int(0.1003 * RATE_HZ) + np.arange(plain.size)) / RATE_HZ
    factor = np.interp(time_s, (0.12, 0.2), (1.0, 3.0))
    factor[time_s >= 0.2] = 0.5
    np.testing.assert_allclose(samples, factor * plain, rtol=1e-12)


@pytest.mark.parametrize(
    "clips", [(), (Clip(muted=True),), (Clip(waveform=Tone(), muted=True), Clip(muted=True))]
)
def test_a_track_without_clips_that_sound_is_silent(clips):
    silent = Input(location=3, clips=clips)
    assert levels(silent).max() == 0.0
    np.testing.assert_array_equal(levels(Input(location=7, clips=CLIPS), silent), ALONE)
    assert played(*clips).size == 0


@pytest.mark.parametrize("onset_s", [0.0, 0.25, 600.0])
def test_clips_far_apart_are_summed_block_by_block(onset_s):
    far = Input(location=7, clips=(Clip(waveform=TONE), Clip(waveform=TONE, onset_s=onset_s)))
    once = levels(Input(location=7, clips=(Clip(waveform=TONE),)))
    n_once, n_far = 130 + 521, round(onset_s * RATE_HZ) + 130 + 521
    energy = levels(far) ** 2 * n_far / (once**2 * n_once)
    if onset_s == 600.0:
        np.testing.assert_allclose(energy, 2.0, rtol=1e-9)
    if onset_s == 0.0:
        np.testing.assert_allclose(energy, 4.0, rtol=1e-12)


def test_a_clip_that_cannot_be_played_is_named():
    high = Input(location=7, clips=(*CLIPS, Clip(waveform=Tone(frequency_hz=651.0))))
    with pytest.raises(InvalidInputError, match="half the sample rate"):
        levels(high)


def test_clips_get_the_smallest_free_ids_and_keep_them():
    design = Design(
        limb="synthetic-1",
        inputs=(Input(location=1, clips=(Clip(id=2), Clip())), track(2), Input(location=3)),
    )
    assert [clip.id for clip in design.clips] == [2, 1, 3]
    more = design.adding(design.inputs[0])
    assert [clip.id for clip in more.clips] == [2, 1, 3, 4, 5]
    assert more.inputs[0] is design.inputs[0]
    assert more.clip(3) is design.inputs[1].clips[0]
    assert more.track_of(3) is design.inputs[1]
    with pytest.raises(InvalidInputError, match="no clip has the id 9; there are 5"):
        more.clip(9)
    with pytest.raises(InvalidInputError, match=r"ids of the clips are .* 2 twice"):
        Design(limb="synthetic-1", inputs=(Input(location=1, clips=(Clip(id=2), Clip(id=2))),))


def test_a_change_of_one_clip_leaves_the_others_the_very_same():
    design = Design(limb="synthetic-1", inputs=(Input(location=1, clips=CLIPS), track(2)))
    changed = design.with_clip(2, gain=4.0)
    assert changed.inputs[1] is design.inputs[1]
    assert changed.clips[1].gain == 4.0
    assert [a is b for a, b in zip(changed.clips, design.clips, strict=True)] == [
        True,
        False,
        True,
        True,
        True,
    ]


def test_a_clip_knows_when_it_ends():
    clip = Clip(waveform=Tone(duration_s=0.2), onset_s=0.1)
    assert (clip.duration_s, clip.end_s) == (0.2, pytest.approx(0.3))


def test_a_waveform_stands_on_a_track_by_one_call():
    made = ss.track(7, Tap(), onset_s=0.1, amplitude=0.5)
    clip = ss.Clip(waveform=Tap(), onset_s=0.1)
    assert made == ss.Input(location=7, amplitude=0.5, clips=(clip,))
    assert ss.track(7) == ss.Input(location=7, clips=(ss.Clip(waveform=Tone()),))


@pytest.mark.parametrize(
    "wrong",
    [
        {"onset_s": -0.001},
        {"onset_s": 601.0},
        {"onset_s": float("nan")},
        {"gain": float("inf")},
        {"gain": 1001.0},
        {"waveform": None},
        {"waveform": "Tone"},
        {"waveform": Tone},
        {"effects": None},
        {"effects": (Tone(),)},
        {"muted": 1},
        {"label": "two\nlines"},
        {"id": -1},
    ],
)
def test_an_impossible_clip_is_refused_by_name(wrong):
    (name,) = wrong
    with pytest.raises(InvalidInputError, match=rf"Clip\.{name} is"):
        Clip(**wrong)


def test_levels_do_not_depend_on_how_a_track_was_cut():
    rng = np.random.default_rng(3)
    for waveform in (Tone(frequency_hz=377.7), Noise(seed=2), Gabor(frequency_hz=100.0)) * 6:
        whole = Design(
            limb="synthetic-1", inputs=(track(7, waveform, onset_s=float(rng.uniform(0, 1))),)
        )
        cut, [uncut] = whole, whole.clips
        for part in rng.uniform(0.05, 0.95, 3):
            ids = tuple(clip.id for clip in cut.clips)
            at_s = uncut.onset_s + float(part) * uncut.duration_s
            cut = edits.split_clips(cut, View(), ids, at_s).design
        assert len(cut.clips) == 4
        np.testing.assert_allclose(levels(*cut.inputs), levels(*whole.inputs), rtol=1e-12)
