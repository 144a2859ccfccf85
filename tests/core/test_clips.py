"""Clips on tracks and in groups: what they play, from exactly when on, and what a change costs."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import skinsource as ss
from skinsource import Clip, Design, Input, View, edits, track
from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.design.edits.edit import Refusal
from skinsource.design.effects.time import Reverse, Trim
from skinsource.design.waveforms import KINDS, Impulse, Layers, Noise, Tap, Tone
from skinsource.engine.quantities import new_graph, sources
from skinsource.signals.sampling import NEAR, on_grid
from skinsource.specs.models import decode, encode
from skinsource.specs.spec import Address
from tests.core.clips_bench import total

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


def levels(*inputs: Input) -> np.ndarray:
    design = Design(limb="synthetic-1", inputs=inputs)
    return new_graph().evaluate({"output_rms"}, sources(design, View()))["output_rms"]


ALONE = levels(Input(location=7, clips=CLIPS))


@settings(max_examples=50, deadline=None, derandomize=True)
@given(st.floats(0.0, 0.5))
def test_a_track_plays_the_sum_of_its_clips_at_their_own_instants(t_s):
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


#: Clips that differ in what they play alone.
ALIKE = tuple(Clip(waveform=Tone(frequency_hz), gain=0.3) for frequency_hz in (50.0, 77.0, 131.0))


@settings(max_examples=10, deadline=None, derandomize=True)
@given(st.permutations((*CLIPS, *ALIKE)))
def test_the_order_of_clips_changes_no_bit(clips):
    in_order, clips = (*CLIPS, *ALIKE), tuple(clips)
    expected = levels(Input(location=7, clips=in_order))
    np.testing.assert_array_equal(levels(Input(location=7, clips=clips)), expected)
    expected = Layers(in_order).samples(RATE_HZ)
    np.testing.assert_array_equal(Layers(clips).samples(RATE_HZ), expected)


def test_a_gain_curve_lies_over_the_time_of_the_design():
    curve = ((0.12, 1.0), (0.2, 3.0), (0.2, 0.5))
    samples, plain = played(*CLIPS, gain_curve=curve), played(*CLIPS)
    time_s = (int(0.1003 * RATE_HZ) + np.arange(plain.size)) / RATE_HZ
    factor = np.interp(time_s, (0.12, 0.2), (1.0, 3.0))
    factor[time_s >= 0.2] = 0.5
    np.testing.assert_allclose(samples, factor * plain, rtol=1e-12)


@pytest.mark.parametrize("clips", [(), (Clip(waveform=Tone(), muted=True), Clip(muted=True))])
def test_a_track_without_clips_that_sound_is_silent(clips):
    silent = Input(location=3, clips=clips)
    assert levels(silent).max() == 0.0
    np.testing.assert_array_equal(levels(Input(location=7, clips=CLIPS), silent), ALONE)
    assert played(*clips).size == 0


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


#: Ten clips, with onsets on samples and between them.
TONES = tuple(
    Clip(waveform=Tone(frequency_hz=60.0 + 31 * k, duration_s=0.06), onset_s=0.0503 + 0.05 * k)
    for k in range(9)
)
MANY = (*TONES, Clip(waveform=Noise(seed=3), onset_s=0.1))
DESIGN = Design(
    limb="synthetic-1", inputs=(Input(location=7, clips=MANY), track(3, Tap(), onset_s=1.0))
)
HEARD = ("output_rms", "input_waveforms")


def moved(clip_id: int, samples: int) -> Design:
    return DESIGN.with_clip(clip_id, onset_s=DESIGN.clip(clip_id).onset_s + samples / RATE_HZ)


def with_clips(clips) -> Design:
    return DESIGN.with_input(0, clips=tuple(clips))


@pytest.mark.parametrize(
    ("design", "drawn", "transforms"),
    [
        (moved(1, 1), 0, 1),
        (moved(4, 7), 0, 1),
        (moved(10, 40), 0, 1),
        (DESIGN.with_clip(4, gain=0.3), 0, 1),
        # One sample more than on samples: the clip begins between two.
        (DESIGN.with_clip(2, waveform=Tone(frequency_hz=333.0, duration_s=0.1)), 131, 1),
        (DESIGN.with_clip(2, onset_s=0.1004), 79, 1),
        (
            with_clips(replace(clip, onset_s=clip.onset_s + 0.01) for clip in DESIGN.clips[:10]),
            0,
            0,
        ),
        (DESIGN.with_input(0, amplitude=0.3), 0, 0),
        (with_clips(DESIGN.inputs[0].clips[::-1]), 0, 0),
        (DESIGN.with_input(0, gain_curve=((0.1, 0.0), (0.3, 1.0))), 0, 1),
        (DESIGN.with_clip(4, muted=True), 0, 1),
        (with_clips((*MANY, Clip(waveform=Noise(seed=77), muted=True))), 0, 0),
    ],
)
def test_an_edit_of_clips_draws_and_transforms_what_it_changed_and_nothing_else(
    design, drawn, transforms
):
    graph = new_graph()
    before = graph.evaluate(HEARD, sources(DESIGN, View()))
    graph.evaluate(HEARD, sources(design, View()))
    work = graph.work
    assert (work.samples_drawn, work.forward_transforms, work.inverse_transforms) == (
        drawn,
        transforms,
        0,
    )
    # Back again everything is there.
    after = graph.evaluate(HEARD, sources(DESIGN, View()))
    assert (graph.work.samples_drawn, graph.work.forward_transforms) == (0, 0)
    np.testing.assert_array_equal(after["output_rms"], before["output_rms"])


def test_what_clips_play_is_told_for_each_muted_or_not_and_anew_only_where_it_changed():
    graph = new_graph()
    muted = DESIGN.with_clip(4, muted=True).with_clip(5, gain=9.0)
    first, second = graph.evaluate(["clip_waveforms"], sources(muted, View()))["clip_waveforms"]
    assert [len(first), len(second)] == [10, 1]
    # From the sample before its onset on, before its gain.
    assert first[4] == pytest.approx(MANY[4].waveform.samples(RATE_HZ, 0.2503 - 325 / RATE_HZ))
    assert not any(samples.flags.writeable for samples in (*first, *second))
    changed = sources(muted.with_clip(3, waveform=Tap()), View())
    after = graph.evaluate(["clip_waveforms"], changed)["clip_waveforms"][0]
    same = [a is b for a, b in zip(after, first, strict=True)]
    assert same == [k != 2 for k in range(10)]


TONE_77 = Tone(frequency_hz=77.0, duration_s=0.1, window="none")
PARTS = (
    Clip(waveform=TONE_77, onset_s=0.0103),
    Clip(waveform=Noise(seed=3), onset_s=0.05, gain=-0.5),
    Clip(waveform=Tap(), onset_s=0.1, muted=True),
    Clip(waveform=TONE_77, effects=(Trim(start_s=0.02, duration_s=0.05),)),
)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(st.floats(0.0, 0.3), st.permutations(PARTS))
def test_a_group_plays_what_its_parts_play_there(onset_s, parts):
    group = Clip(waveform=Layers(parts=tuple(parts)), onset_s=onset_s)
    alone = [replace(part, onset_s=part.onset_s + onset_s) for part in PARTS]
    # An onset that is nearer than this to a sample is on it.
    atol = 2 * np.pi * TONE_77.frequency_hz * NEAR / RATE_HZ
    np.testing.assert_allclose(total(group), total(*alone), rtol=0, atol=atol)


def test_a_group_keeps_what_plays_backwards_up_to_its_last_sample():
    crack = Clip(waveform=Impulse(), effects=(Reverse(),), onset_s=0.25)
    group = Clip(waveform=Layers((replace(crack, onset_s=0.0),)), onset_s=0.25)
    np.testing.assert_array_equal(total(group), total(crack))
    assert total(group).any()


@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_a_product_is_that_of_the_formulas(shift):
    slow = Tone(frequency_hz=5.0, duration_s=0.2, window="none", phase_rad=0.5)
    both = Layers(parts=(Clip(waveform=TONE_77, gain=2.0), Clip(waveform=slow)), mode="product")
    samples = both.samples(RATE_HZ, shift / RATE_HZ)
    own_s = (np.arange(samples.size) - shift) / RATE_HZ
    expected = 2.0 * np.sin(2 * np.pi * 77.0 * own_s) * np.sin(2 * np.pi * 5.0 * own_s + 0.5)
    expected[(own_s < 0) | (own_s >= 0.1 - 1e-9)] = 0.0
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-9)
    assert both.duration_s == 0.2


def test_a_group_of_muted_parts_is_silent_and_as_long():
    silent = Layers(parts=tuple(replace(part, muted=True) for part in PARTS))
    assert not silent.samples(RATE_HZ).any()
    assert silent.samples(RATE_HZ).size == 325
    assert silent.duration_s == pytest.approx(0.25)


def nested(depth: int) -> Layers:
    layers = Layers()
    for _ in range(depth - 1):
        layers = Layers(parts=(Clip(waveform=layers, gain=0.9),))
    return layers


def test_groups_stand_in_groups_up_to_a_depth():
    deep = nested(15)
    np.testing.assert_allclose(
        deep.samples(RATE_HZ), 0.9**14 * Tone().samples(RATE_HZ), rtol=1e-12, atol=1e-15
    )
    assert decode(encode(deep), KINDS, Address()) == deep
    with pytest.raises(InvalidInputError, match="recipes within recipes at most 32 deep"):
        nested(17)


def test_a_tree_nested_too_deep_is_refused_before_its_clips_are_made(monkeypatch):
    tree = encode(Clip())
    for _ in range(16):
        tree = {"kind": "Clip", "waveform": {"kind": "Layers", "parts": [tree, tree]}}
    clips, check = [], Clip.__post_init__
    monkeypatch.setattr(Clip, "__post_init__", lambda clip: (clips.append(clip), check(clip)))
    with pytest.raises(FileFormatError, match="deep"):
        decode(tree["waveform"], KINDS, Address())
    assert not clips


class CountedTap(Tap):
    """A tap that counts how often it is asked for its duration."""

    count = 0

    @property
    def duration_s(self):
        CountedTap.count += 1
        return super().duration_s


def test_groups_in_groups_compute_their_length_once():
    clip, CountedTap.count = Clip(waveform=CountedTap()), 0
    for _ in range(12):
        clip = Clip(waveform=Layers(parts=(clip, clip)))
    assert clip.duration_s == Tap().duration_s
    assert CountedTap.count <= 3


@pytest.mark.parametrize("parts", [(), (TONE_77,), (Clip(),) * 101])
def test_an_impossible_group_is_refused_by_name(parts):
    with pytest.raises(InvalidInputError, match=r"Layers\.parts is"):
        Layers(parts)


UNGROUPED = Design(
    limb="synthetic-1", inputs=(Input(location=1, clips=PARTS), Input(location=2, clips=(Clip(),)))
)
VIEW = View(selected_inputs=(1,))


def test_clips_that_are_grouped_sound_as_before_and_come_back():
    grouped = edits.group_clips(UNGROUPED, VIEW, (1, 2, 3))
    assert [clip.id for clip in grouped.design.inputs[0].clips] == [1, 4]
    assert grouped.design.clip(1).onset_s == 0.0103
    assert grouped.view.selected_clips == (1,)
    assert grouped.label == "Group 3 clips"
    np.testing.assert_allclose(
        total(*grouped.design.inputs[0].clips), total(*PARTS), rtol=0, atol=1e-8
    )
    louder = grouped.design.with_clip(1, gain=2.0)
    freed = edits.ungroup_clips(louder, VIEW, (1,))
    back = [replace(clip, id=0) for clip in freed.design.inputs[0].clips]
    assert back == [replace(part, gain=2.0 * part.gain) for part in PARTS[:3]] + [PARTS[3]]
    assert freed.view.selected_clips == tuple(clip.id for clip in freed.design.inputs[0].clips[:3])
    assert freed.label == "Ungroup clip"


@pytest.mark.parametrize(("muted", "expected"), [(True, [True, True]), (False, [True, False])])
def test_what_was_silent_as_a_group_stays_silent_apart(muted, expected):
    group = Clip(waveform=Layers((Clip(muted=True), Clip(onset_s=0.3))), muted=muted)
    design = Design(limb="synthetic-1", inputs=(Input(location=7, clips=(group,)),))
    freed = edits.ungroup_clips(design, VIEW, (1,)).design
    assert [clip.muted for clip in freed.clips] == expected


def test_a_product_and_what_has_effects_stay_groups():
    product = edits.group_clips(UNGROUPED, VIEW, (1, 2), "product").design
    assert product.clip(1).waveform.mode == "product"
    summed = edits.group_clips(UNGROUPED, VIEW, (1, 2)).design.with_clip(1, effects=(Trim(),))
    for outcome in (
        edits.ungroup_clips(product, VIEW, (1,)),
        edits.ungroup_clips(summed, VIEW, (1,)),
        edits.ungroup_clips(UNGROUPED, VIEW, (1,)),
        edits.group_clips(UNGROUPED, VIEW, (1, 5)),
        edits.group_clips(UNGROUPED, VIEW, ()),
        edits.group_clips(UNGROUPED, VIEW, (1, 2), "mean"),
    ):
        assert isinstance(outcome, Refusal)
