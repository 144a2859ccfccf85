"""Edits of clips: added, changed, moved, copied, cut, joined, trimmed and pasted."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import View, edits
from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.design.clips import MAX_CLIPS, MAX_EFFECTS, ONSET, Clip, Marker
from skinsource.design.design import MAX_INPUTS, Design, Input, track
from skinsource.design.edits.clips import copy_behind
from skinsource.design.edits.cutting import faded_ends
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects import Envelope, Fade, Rectify, Repeat, Reverse, Stretch, Trim
from skinsource.design.presets.presets import whole_design
from skinsource.design.waveforms import Layers, Noise, Tap, Tone
from tests.core.clips_bench import total

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=77.0, duration_s=0.2)
WIND = Clip(waveform=Noise(seed=1), onset_s=0.25, gain=-0.5, label="wind")
TAPPED = Clip(waveform=Tap()), Clip(waveform=TONE, onset_s=0.5, muted=True)
#: Two clips on each of two tracks, one on a third, none on a fourth.
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        Input(location=7, clips=(Clip(waveform=TONE, onset_s=0.1), WIND)),
        Input(location=2, clips=TAPPED, colour=1, gain_curve=((0.0, 1.0), (1.0, 0.0))),
        track(11, Tone(duration_s=0.4), onset_s=0.3, colour=2, amplitude=0.25),
        Input(location=12, colour=3),
    ),
    markers=(Marker(time_s=0.05, name="first"), Marker(time_s=0.4), Marker(time_s=0.9)),
    loop_s=(0.1, 0.6),
)
VIEW = View(selected_inputs=(1,), selected_clips=(2,))
times = st.integers(0, 700).map(lambda k: k / 1000)
some_ids = st.lists(st.integers(1, 5), min_size=1, max_size=5, unique=True).map(tuple)
few = settings(max_examples=60, deadline=None, derandomize=True)


def onsets(design: Design) -> list[float]:
    return [clip.onset_s for clip in design.clips]


def tracks(design: Design) -> list[list[int]]:
    return [[clip.id for clip in track.clips] for track in design.inputs]


def design_of(*clips: Clip) -> Design:
    return Design(limb="synthetic-1", inputs=(Input(location=7, clips=clips),))


def test_a_new_clip_is_added_and_selected():
    outcome = edits.add_clip(DESIGN, VIEW, 4, 0.2, Tap())
    assert outcome.design.inputs[3].clips == (Clip(waveform=Tap(), onset_s=0.2, id=6),)
    assert outcome.design.inputs[:3] == DESIGN.inputs[:3]
    assert (outcome.view.selected_clips, outcome.view.selected_inputs) == ((6,), (4,))
    assert outcome.label == "Add clip"


def test_gain_label_and_silence_of_clips_are_set_by_name():
    design = edits.set_clips(DESIGN, VIEW, (1, 5), "gain", 3).design
    assert [clip.gain for clip in design.clips] == [3.0, -0.5, 1.0, 1.0, 3.0]
    named = edits.set_clips(DESIGN, VIEW, (3,), "label", "here")
    assert named.design.clip(3).label == "here"
    once = edits.toggle_mute_clips(DESIGN, VIEW, (4, 5))
    assert [once.design.clip(clip_id).muted for clip_id in (4, 5)] == [True, True]
    again = edits.toggle_mute_clips(once.design, VIEW, (4, 5))
    assert [again.design.clip(clip_id).muted for clip_id in (4, 5)] == [False, False]
    assert [once.label, again.label] == ["Mute 2 clips", "Unmute 2 clips"]


def test_selecting_clips_selects_their_tracks():
    view = edits.select_clips(DESIGN, VIEW, (5, 99, 1, 3, 5, 2)).view
    assert view.selected_clips == (5, 1, 3, 2)
    assert view.selected_inputs == (3, 2, 1)
    assert edits.toggle_clip(DESIGN, view, 2).view.selected_clips == (5, 1, 3)
    assert edits.toggle_clip(DESIGN, VIEW, 1).view.selected_clips == (2, 1)
    assert edits.select_all_clips(DESIGN, VIEW).view.selected_clips == (1, 3, 4, 5, 2)
    none = edits.select_clips(DESIGN, VIEW, ()).view
    assert (none.selected_clips, none.selected_inputs) == ((), (1,))
    assert edits.select_inputs(DESIGN, view, (3, 2)).view.selected_clips == ()
    assert edits.move_playhead(DESIGN, VIEW, 0.25).view.playhead_s == 0.25


def test_fields_of_the_selected_clips_are_edited_through_their_tracks():
    outcome = edits.change_field(DESIGN, VIEW, (1,), "onset_s", 0.35)
    assert onsets(outcome.design) == [0.1, 0.35, 0.0, 0.5, 0.3]
    both = edits.change_field(DESIGN, View(selected_clips=(1, 2)), (1,), "gain", 2.0)
    assert [clip.gain for clip in both.design.inputs[0].clips] == [2.0, 2.0]
    first = edits.change_kind(DESIGN, View(), (1, 4), "Tap")
    assert [clip.waveform.title for clip in first.design.inputs[0].clips] == ["Tap", "Noise"]
    assert [clip.waveform for clip in first.design.inputs[3].clips] == [Tap()]


@few
@given(some_ids, st.floats(-700.0, 700.0), st.integers(-4, 4))
def test_clips_move_together_as_far_as_there_is_room(ids, by_s, by_tracks):
    after = edits.move_clips(DESIGN, VIEW, ids, by_s, by_tracks).design
    moves = {
        (
            round(after.clip(clip_id).onset_s - DESIGN.clip(clip_id).onset_s, 9),
            after.index_of(after.track_of(clip_id).id)
            - DESIGN.index_of(DESIGN.track_of(clip_id).id),
        )
        for clip_id in ids
    }
    assert len(moves) == 1
    step_s, rows = moves.pop()
    assert abs(step_s) <= abs(by_s) + 1e-9
    assert abs(rows) <= abs(by_tracks)
    assert sorted(clip.id for clip in after.clips) == [1, 2, 3, 4, 5]
    for clip in DESIGN.clips:
        assert clip.id in ids or after.clip(clip.id) is clip


def test_a_clip_dragged_to_another_track_comes_back_the_same():
    there = edits.move_clips(DESIGN, VIEW, (2, 5), 0.1, 1)
    assert tracks(there.design) == [[1], [3, 4, 2], [], [5]]
    assert (there.view.selected_clips, there.view.selected_inputs) == ((2,), (2,))
    back = edits.move_clips(there.design, there.view, (2, 5), -0.1, -1)
    assert back.design == DESIGN


def test_clips_stop_at_the_ends_of_time_and_at_the_outer_tracks():
    early = edits.move_clips(DESIGN, VIEW, (1, 2), -9.0, -9)
    assert onsets(early.design)[:2] == [0.0, 0.15]
    late = edits.move_clips(DESIGN, VIEW, (1, 2), 1e6, 9)
    assert [late.design.clip(clip_id).onset_s for clip_id in (1, 2)] == [599.85, 600.0]
    assert tracks(late.design) == [[], [3, 4], [5], [1, 2]]


@few
@given(some_ids, times)
def test_a_copy_is_equal_and_not_the_same(ids, by_s):
    outcome = edits.copy_clips(DESIGN, VIEW, ids, by_s)
    copies = [outcome.design.clip(clip) for clip in outcome.view.selected_clips]
    originals = [clip for clip in DESIGN.clips if clip.id in ids]
    for copy, original in zip(copies, originals, strict=True):
        assert copy.id not in [clip.id for clip in DESIGN.clips]
        assert copy.onset_s == pytest.approx(original.onset_s + by_s)
        assert replace(copy, id=original.id, onset_s=original.onset_s) == original
        assert outcome.design.clip(original.id) is original


def test_duplicates_come_right_after_and_repetitions_in_a_row():
    outcome = edits.duplicate_clips(DESIGN, VIEW, (1, 2))
    # Together they last from 0.1 s to 0.45 s.
    assert [clip.onset_s for clip in outcome.design.inputs[0].clips] == [0.1, 0.25, 0.45, 0.6]
    thrice = edits.repeat_clips(DESIGN, VIEW, (5,), 4)
    assert [clip.onset_s for clip in thrice.design.inputs[2].clips] == [0.3, 0.7, 1.1, 1.5]
    assert thrice.view.selected_clips == (6, 7, 8)


@few
@given(some_ids)
def test_copies_behind_stay_as_they_lay_and_lie_on_no_other_clip(ids):
    # There are copies of the first track's clips behind them already.
    outcome = copy_behind(edits.copy_clips(DESIGN, VIEW, (1, 2), 0.5).design, VIEW, ids, "Copy")
    new = outcome.view.selected_clips
    later_s = [
        outcome.design.clip(copy).onset_s - clip.onset_s
        for copy, clip in zip(new, (clip for clip in DESIGN.clips if clip.id in ids), strict=True)
    ]
    assert later_s == pytest.approx(later_s[:1] * len(ids))
    for copy in map(outcome.design.clip, new):
        others = (clip for clip in outcome.design.track_of(copy.id).clips if clip.id not in new)
        assert all(
            clip.end_s < copy.onset_s + 1e-9 or copy.end_s < clip.onset_s + 1e-9 for clip in others
        )


def test_a_copy_fills_the_first_hole_and_none_begins_too_late():
    def start_s(*onsets_s):
        clips = tuple(Clip(waveform=TONE, onset_s=onset_s) for onset_s in onsets_s)
        return copy_behind(design_of(*clips), VIEW, (1,), "Copy")

    assert start_s(0.0, 0.3, 0.7).design.clips[-1].onset_s == 0.5
    behind = start_s(0.0, 0.2, 0.41)
    assert (behind.design.clips[-1].onset_s, "610 ms" in behind.said) == (0.61, True)
    assert start_s(0.0).said == ""
    assert isinstance(start_s(ONSET.maximum), Refusal)


def test_a_fragment_lies_elsewhere_as_it_lay_here():
    fragment = edits.fragment_of(DESIGN, (2, 3, 5))
    assert fragment.duration_s == pytest.approx(0.7)
    lower = edits.fragment_of(DESIGN, (3, 5))
    assert [(lane.location, lane.offset) for lane in lower.lanes] == [(2, 0), (11, 1)]
    outcome = edits.paste_fragment(DESIGN, View(selected_inputs=(2,)), fragment, 1.0)
    design = outcome.design
    assert tracks(design) == [[1, 2], [3, 4, 6], [5, 7], [8]]
    assert [design.clip(clip_id).onset_s for clip_id in (6, 7, 8)] == [1.25, 1.0, 1.3]
    assert outcome.view.selected_clips == (6, 7, 8)
    below = edits.paste_fragment(DESIGN, View(selected_inputs=(4,)), fragment, 0.0).design
    assert [track.location for track in below.inputs] == [7, 2, 11, 12, 2, 11]
    assert below.inputs[5].amplitude == 0.25
    alone = edits.paste_fragment(Design(limb="synthetic-1"), View(), fragment, 0.0).design
    assert [track.location for track in alone.inputs] == [7, 2, 11]


@pytest.mark.parametrize("order", [(1, 2, 3), (3, 1, 2)])
def test_what_was_copied_from_selected_tracks_is_pasted_onto_them(order):
    fragment = edits.fragment_of(DESIGN, (1, 2, 3, 5))
    pasted = edits.paste_fragment(DESIGN, View(selected_inputs=order), fragment, 1.0)
    assert tracks(pasted.design) == [[1, 2, 6, 7], [3, 4, 8], [5, 9], []]
    again = edits.paste_fragment(pasted.design, pasted.view, fragment, 2.0)
    assert len(again.design.inputs) == len(DESIGN.inputs)
    assert "added" not in again.said
    below = edits.paste_fragment(DESIGN, View(selected_inputs=(4,)), fragment, 1.0)
    assert below.said.endswith("2 tracks added")


def test_a_fragment_travels_as_text():
    fragment = edits.fragment_of(DESIGN, (1, 4))
    text = edits.fragment_text(fragment)
    assert edits.fragment_from(text) == fragment
    with pytest.raises(FileFormatError, match="changed on its way"):
        edits.fragment_from(text.replace("Tone", "Tune"))
    with pytest.raises(FileFormatError, match="does not hold skinsource clips"):
        edits.fragment_from("{}")
    assert edits.fragment_of(DESIGN, (9,)) is None


@pytest.mark.parametrize("value", ["1e999", '"\\ud800"', "[" * 900 + "]" * 900, "9" * 4000])
def test_a_text_that_can_be_read_and_not_be_written_is_damaged(value):
    text = json.loads(edits.fragment_text(edits.fragment_of(DESIGN, (1,))))
    text["content"] = "HERE"
    with pytest.raises(FileFormatError, match="changed on its way"):
        edits.fragment_from(json.dumps(text).replace('"HERE"', value))


def test_what_is_cut_leaves_no_other_clip_selected_and_its_track():
    outcome = edits.cut_clips(DESIGN, VIEW, (2, 5))
    assert outcome.said == "2 clips cut"
    assert edits.remove_clips(DESIGN, VIEW, (2,)).said == "1 clip removed"
    assert tracks(outcome.design) == [[1], [3, 4], [], []]
    assert outcome.view.selected_clips == ()
    assert outcome.label == "Cut 2 clips"


@few
@given(times, st.integers(0, 599).map(lambda k: k / 1300))
def test_what_was_split_sounds_as_before_and_joins_to_what_it_was(at_s, on_sample_s):
    for cut_s in (at_s, on_sample_s):
        outcome = edits.split_clips(DESIGN, VIEW, (1, 2, 3, 4, 5), cut_s)
        if isinstance(outcome, Refusal):
            inside_s = (min(cut_s - clip.onset_s, clip.end_s - cut_s) for clip in DESIGN.clips)
            assert max(inside_s) < 1e-8
            continue
        for place in range(4):
            after, expected = (
                total(*outcome.design.inputs[place].clips),
                total(*DESIGN.inputs[place].clips),
            )
            np.testing.assert_allclose(after, expected, rtol=0, atol=1e-9)
        ids = tuple(clip.id for clip in outcome.design.clips)
        assert edits.join_clips(outcome.design, outcome.view, ids).design == DESIGN


def test_parts_of_parts_join_to_what_they_were_in_one_go():
    part = edits.split_clips(DESIGN, VIEW, (1,), 0.2)
    assert tracks(part.design)[0] == [1, 6, 2]
    assert part.view.selected_clips == (6,)
    assert part.design.clip(6).effects == (Trim(start_s=0.1, duration_s=0.1),)
    design = DESIGN
    for at_s in (0.17, 0.2, 0.1503):
        ids = tuple(clip.id for clip in design.clips)
        design = edits.split_clips(design, VIEW, ids, at_s).design
    assert len(design.inputs[0].clips) == 5
    whole = edits.join_clips(design, VIEW, tuple(clip.id for clip in design.clips))
    assert whole.design == DESIGN
    assert whole.view.selected_clips == (2,)


@pytest.mark.parametrize(
    "change",
    [
        {"gain": 2.0},
        {"onset_s": 0.21},
        {"waveform": Tap()},
        {"effects": (Trim(start_s=0.15, duration_s=0.05),)},
        {"effects": (Trim(start_s=0.1, duration_s=0.1), Fade(0.01, 0.0))},
    ],
)
def test_parts_that_differ_or_lie_or_lay_apart_do_not_join(change):
    part = edits.split_clips(DESIGN, VIEW, (1,), 0.2).design.with_clip(6, **change)
    assert isinstance(edits.join_clips(part, VIEW, (1, 6)), Refusal)


@pytest.mark.parametrize(
    ("ends", "onset_s", "effects"),
    [
        ((0.15, 0.3), 0.15, (Trim(start_s=0.05, duration_s=0.15),)),
        ((0.1, 0.25), 0.1, (Trim(start_s=0.0, duration_s=0.15),)),
        ((-5.0, 9.0), 0.1, ()),
        ((0.2, 0.1), 0.2, (Trim(start_s=0.1, duration_s=0.001),)),
    ],
)
def test_ends_that_are_dragged_trim_and_come_back(ends, onset_s, effects):
    outcome = edits.trim_clip(DESIGN, VIEW, 1, *ends)
    clip = outcome.design.clip(1)
    assert (clip.onset_s, clip.effects) == (onset_s, effects)
    assert edits.trim_clip(outcome.design, VIEW, 1, 0.1, 0.3).design == DESIGN


def test_a_clip_shorter_than_a_drag_leaves_is_trimmed_to_itself():
    whole = design_of(Clip(onset_s=0.5, waveform=Layers((Clip(effects=(Trim(0.1, 0.0004),)),))))
    [clip] = edits.trim_clip(whole, VIEW, 1, 0.2, 0.9).design.clips
    assert (clip.onset_s, clip.duration_s) == (0.5, pytest.approx(0.0004, abs=1e-15))


@pytest.mark.parametrize(
    ("ends", "onset_s", "duration_s"),
    [
        ((1.0, 1.001), 1.0, 0.01),
        ((1.999, 2.0), 1.99, 0.01),
        ((0.5, 2.0), 0.5, 1.5),
        ((-0.5, 2.0), 0.0, 2.0),
    ],
)
def test_ends_that_are_stretched_go_so_far_and_the_other_end_stays(ends, onset_s, duration_s):
    before = design_of(Clip(onset_s=1.0, waveform=Tone(duration_s=1.0)))
    [clip] = edits.stretch_clip(before, VIEW, 1, *ends).design.clips
    assert clip.onset_s == pytest.approx(onset_s, abs=1e-12)
    assert clip.duration_s == pytest.approx(duration_s, abs=1e-12)


def lengths_s(clip: Clip) -> list[float]:
    return [0.0 if end is None else round(end.length_s, 9) for end in faded_ends(clip)]


def test_the_fade_of_a_clip_is_the_last_one_that_nothing_behind_moves_in_time():
    fade = Fade(0.01, 0.02)
    for behind in (Rectify(), Reverse(on=False), Stretch(factor=2.0, on=False)):
        assert lengths_s(Clip(waveform=TONE, effects=(Fade(), fade, behind))) == [0.01, 0.02]
        clip = Clip(waveform=TONE, effects=(fade, behind), id=1)
        [faded] = edits.fade_clip(design_of(clip), VIEW, 1, 0.05, 0.0).design.clips
        assert faded.effects == (Fade(0.05, 0.0), behind)
    for effects in ((fade, Reverse()), (fade, Stretch(factor=2.0)), (replace(fade, on=False),)):
        assert lengths_s(Clip(waveform=TONE, effects=effects)) == [0.0, 0.0]


@pytest.mark.parametrize(
    ("cut_s", "lengths"),
    [
        (0.3, [[0.1, 0.0], [0.0, 0.08]]),
        (0.15, [[0.05, 0.0], [0.05, 0.08]]),
        (0.45, [[0.1, 0.03], [0.0, 0.05]]),
    ],
)
def test_what_was_split_fades_as_before_and_once_when_a_fade_is_dragged(cut_s, lengths):
    tone, fade = replace(TONE, duration_s=0.4), Fade(0.1, 0.08, "straight")
    before = design_of(Clip(waveform=tone, onset_s=0.1, effects=(fade,)))
    split = edits.split_clips(before, VIEW, (1,), cut_s).design
    np.testing.assert_allclose(total(*split.clips), total(*before.clips), rtol=0, atol=1e-12)
    assert [lengths_s(clip) for clip in split.clips] == lengths
    assert edits.join_clips(split, VIEW, (1, 2)).design == before
    for clip in split.clips:
        halves_s = [length_s / 2 for length_s in lengths_s(clip)]
        faded = edits.fade_clip(split, VIEW, clip.id, *halves_s).design.clip(clip.id)
        assert list(map(type, faded.effects)) == list(map(type, clip.effects))
        assert lengths_s(faded) == pytest.approx(halves_s)


def test_a_fade_out_has_only_the_room_that_the_fade_in_leaves():
    before = design_of(Clip(waveform=Tone(duration_s=1.0)))
    [clip] = edits.fade_clip(before, VIEW, 1, 0.7, 0.9).design.clips
    assert clip.effects == (Fade(0.7, 0.3),)


@pytest.mark.parametrize(
    ("location", "copies", "expected", "selected"),
    [
        (3, False, [[1], [3, 2]], ((2,), (2,))),
        (3, True, [[1, 2], [3, 4]], ((4,), (2,))),
        (15, False, [[1], [3], [2]], ((2,), (3,))),
        (7, False, [[1, 2], [3]], ((2,), (1,))),
    ],
)
def test_a_clip_goes_to_the_track_at_a_place_or_to_a_new_one(location, copies, expected, selected):
    first = Input(location=7, clips=(Clip(waveform=TONE), Clip(onset_s=0.3)), amplitude=0.5)
    before = Design(limb="synthetic-1", inputs=(first, Input(location=3, clips=(Clip(),))))
    after = edits.move_clips_to_place(before, VIEW, (2,), location, copies=copies)
    assert tracks(after.design) == expected
    assert (after.view.selected_clips, after.view.selected_inputs) == selected
    assert replace(after.design.clip(selected[0][0]), id=2) == before.clip(2)
    if location == 15:
        assert (after.design.inputs[2].amplitude, after.design.inputs[2].colour) == (0.5, 1)


def test_of_several_tracks_at_a_place_a_clip_goes_to_the_selected_one():
    twice = DESIGN.adding(Input(location=2))
    first = edits.move_clips_to_place(twice, VIEW, (1, 5), 2).design
    assert tracks(first) == [[2], [3, 4, 1, 5], [], [], []]
    chosen = replace(VIEW, selected_inputs=(1, 5))
    assert tracks(edits.move_clips_to_place(twice, chosen, (2,), 2).design)[4] == [2]


@few
@given(times, st.integers(1, 500).map(lambda k: k / 1000))
def test_time_that_was_inserted_and_removed_again_changes_no_sound(at_s, length_s):
    there = edits.insert_time(DESIGN, VIEW, at_s, length_s).design
    at, by = round(at_s * RATE_HZ, 6), round(length_s * RATE_HZ)
    back = edits.remove_time(there, VIEW, at_s, at_s + length_s).design
    for place in range(4):
        before, after = total(*DESIGN.inputs[place].clips), total(*there.inputs[place].clips)
        first = int(np.ceil(at - 1e-6))
        np.testing.assert_allclose(after[:first], before[:first], rtol=0, atol=1e-9)
        gap = slice(first, int(np.ceil(at + length_s * RATE_HZ - 1e-6)))
        assert not after[gap].any()
        if abs(by - length_s * RATE_HZ) < 1e-9:
            later = after[first + by :]
            np.testing.assert_allclose(later, before[first : 5000 - by], rtol=0, atol=1e-9)
        np.testing.assert_allclose(total(*back.inputs[place].clips), before, rtol=0, atol=1e-9)
    assert [marker.time_s for marker in back.markers] == pytest.approx([0.05, 0.4, 0.9])
    assert back.loop_s == pytest.approx(DESIGN.loop_s)


def test_time_that_is_removed_takes_what_plays_then():
    marked = edits.add_marker(DESIGN, VIEW, 0.399).design
    design = edits.remove_time(marked, VIEW, 0.2, 0.4).design
    for place in range(4):
        before, after = total(*DESIGN.inputs[place].clips), total(*design.inputs[place].clips)
        np.testing.assert_allclose(after[:260], before[:260], rtol=0, atol=1e-9)
        np.testing.assert_allclose(after[260:4000], before[520:4260], rtol=0, atol=1e-9)
    assert [marker.time_s for marker in design.markers] == pytest.approx([0.05, 0.2, 0.7])
    assert design.loop_s == (0.1, pytest.approx(0.4))
    assert edits.remove_time(DESIGN, VIEW, 0.05, 0.7).design.loop_s is None


def test_a_loop_that_would_end_too_late_is_gone():
    looped = Design(limb="synthetic-1", loop_s=(1100.0, 1190.0))
    assert edits.insert_time(looped, VIEW, 0.0, 10.0).design.loop_s == (1110.0, 1200.0)
    assert edits.insert_time(looped, VIEW, 0.0, 11.0).design.loop_s is None


# On a grid, so that points often lie at one time, and where time is cut.
tenths = st.integers(0, 12).map(lambda k: k / 10)
curves = st.lists(st.tuples(tenths, st.sampled_from((0.0, 0.5, 1.0, 3.0))), max_size=6).map(
    lambda points: tuple(sorted(points, key=lambda point: point[0]))
)


def gains(design: Design, times_s: np.ndarray) -> np.ndarray:
    curve = design.inputs[0].gain_curve
    return np.interp(times_s, *np.array(curve).T) if curve else np.ones(len(times_s))


def around(low: float, high: float) -> np.ndarray:
    """Times a little before and behind each tenth, from one to another."""
    grid = np.arange(round(low * 10), round(high * 10) + 1) / 10
    beside = np.concatenate((grid - 1e-7, grid + 1e-7))
    return beside[(beside > low) & (beside < high)]


@few
@given(curves, tenths, st.integers(1, 5).map(lambda k: k / 10))
def test_a_gain_curve_stays_before_and_behind_time_that_comes_or_goes(curve, at_s, length_s):
    before = Design(limb="synthetic-1", inputs=(Input(location=7, gain_curve=curve),))
    longer = edits.insert_time(before, VIEW, at_s, length_s).design
    end_s = round(at_s + length_s, 1)
    shorter = edits.remove_time(before, VIEW, at_s, end_s).design
    early = around(0.0, at_s)
    for after, late, by_s in (
        (longer, around(at_s, 1.4), length_s),
        (shorter, around(end_s, 2.0), -length_s),
    ):
        np.testing.assert_allclose(gains(after, early), gains(before, early), atol=1e-5)
        np.testing.assert_allclose(gains(after, late + by_s), gains(before, late), atol=1e-5)


# Sums of decimal times, as loops and a mouse give them, which no decimal number equals.
uneven = st.floats(0.0, 1.5) | st.integers(0, 30).map(lambda k: sum([0.05] * k))


@few
@given(st.lists(st.tuples(uneven, st.just(0.5)), max_size=5).map(sorted), uneven, uneven)
def test_rounding_of_times_refuses_no_edit(points, one_s, other_s):
    start_s, end_s = sorted((one_s, other_s + 1e-3 * (one_s == other_s)))
    shape = Envelope(((0.0, 1.0, "held"), *((x, y, "held") for x, y in points)))
    clip = Clip(waveform=Tone(duration_s=0.01 + other_s), onset_s=start_s, effects=(shape,))
    curved = Input(location=7, clips=(clip,) * 2, gain_curve=tuple(points))
    design = Design(limb="synthetic-1", inputs=(curved,))
    pasted = whole_design(design)
    for edit, *more in (
        (edits.remove_time, start_s, end_s),
        (edits.insert_time, start_s, end_s - start_s),
        (edits.split_clips, (1,), start_s + clip.duration_s / 3),
        *((edit, 1, start_s, end_s) for edit in (edits.trim_clip, edits.stretch_clip)),
        (edits.fade_clip, 1, 9.0, 0.1),
        (edits.group_clips, (1, 2)),
        (edits.paste_fragment, pasted, end_s),
    ):
        assert isinstance(edit(design, VIEW, *more), Edit), edit


def test_markers_loop_and_gain_curve_are_set_and_taken_away():
    added = edits.add_marker(DESIGN, VIEW, 0.7, "end")
    assert isinstance(edits.add_marker(added.design, VIEW, 0.7), Refusal)
    moved = edits.move_marker(added.design, VIEW, 3, 0.8).design
    assert isinstance(edits.move_marker(moved, VIEW, 3, 0.4), Refusal)
    named = edits.rename_marker(moved, VIEW, 3, "very end").design
    assert named.markers == (*DESIGN.markers, Marker(time_s=0.8, name="very end"))
    assert edits.remove_marker(named, VIEW, 3).design == DESIGN
    looped = edits.set_loop(DESIGN, VIEW, (0.0, 1.0))
    assert looped.design.loop_s == (0.0, 1.0)
    assert edits.set_loop(looped.design, VIEW, None).design.loop_s is None
    curved = edits.set_gain_curve(DESIGN, VIEW, 1, ((0.0, 1.0), (2.0, 0.5)))
    assert curved.design.inputs[0].gain_curve == ((0.0, 1.0), (2.0, 0.5))
    assert curved.label == "Change gain curve of input at 7 (II pad)"


FULL = design_of(*(Clip(),) * MAX_CLIPS)
CROWD = Design(limb="synthetic-1", inputs=(Input(location=1, clips=(Clip(),)),) * MAX_INPUTS)
CHAINED = design_of(Clip(effects=(Rectify(),) * MAX_EFFECTS))
LATE = design_of(Clip(onset_s=500.0, waveform=Tone(duration_s=200.0)))
LANES = edits.fragment_of(DESIGN, (1, 3))
NAN = float("nan")


@pytest.mark.parametrize(
    ("outcome", "reason"),
    [
        (edits.add_clip(DESIGN, VIEW, 9, 0.0, Tap()), "no longer there"),
        (edits.add_clip(DESIGN, VIEW, 1, 0.0, None), "waveform"),
        (edits.add_clip(FULL, VIEW, 1, 0.0, Tap()), "at most 1000 clips"),
        (edits.move_clips(DESIGN, VIEW, (9,), 0.1), "No clip is selected"),
        (edits.move_clips(DESIGN, VIEW, (1,), NAN), "a number from 0 to 600 s"),
        (edits.repeat_clips(DESIGN, VIEW, (1,), 10**9), "1000"),
        (edits.split_clips(DESIGN, VIEW, (1,), 0.05), "None of the selected clips plays at 0.05"),
        (edits.split_clips(DESIGN, VIEW, (1,), 0.1), "The selected clip begins at 0.1 s"),
        (edits.split_clips(DESIGN, VIEW, (1,), 0.3), "The selected clip ends at 0.3 s"),
        (edits.split_clips(DESIGN, VIEW, (1, 5), 0.3), "A selected clip ends at 0.3 s"),
        (edits.split_clips(CHAINED, VIEW, (1,), 0.1), "at most 32 effects"),
        (edits.remove_time(CHAINED, VIEW, 0.05, 0.1), "at most 32 effects"),
        (edits.split_clips(LATE, VIEW, (1,), 650.0), "none can begin after 600 s"),
        (edits.remove_clips(DESIGN, VIEW, ()), "No clip is selected"),
        (edits.paste_fragment(CROWD, View(selected_inputs=(100,)), LANES, 0.0), "100 inputs"),
        (edits.move_clips_to_place(DESIGN, VIEW, (2,), 0), "location"),
        (edits.move_clips_to_place(CROWD, VIEW, (1,), 5), "at most 100 inputs"),
        (edits.insert_time(DESIGN, VIEW, 0.0, 600.0), "onset_s"),
        (edits.move_marker(DESIGN, VIEW, 3, 0.1), "no longer there"),
        (edits.rename_marker(DESIGN, VIEW, 0, "two\nlines"), "one line"),
        (edits.set_gain_curve(DESIGN, VIEW, 1, ((0.0, -1.0),)), "gain_curve"),
    ],
)
def test_what_cannot_be_done_is_refused_with_a_reason(outcome, reason):
    assert isinstance(outcome, Refusal)
    assert reason in outcome.sentence


def test_a_full_chain_that_ends_in_a_trim_can_be_cut():
    full = design_of(Clip(effects=(*(Rectify(),) * (MAX_EFFECTS - 1), Trim(0.0, 0.2))))
    outcome = edits.split_clips(full, VIEW, (1,), 0.1)
    assert isinstance(outcome, Edit)
    assert len(outcome.design.clips) == 2


@pytest.mark.parametrize("inside", [Tone(), Layers((Clip(effects=(Repeat(times=1000),)),))])
@pytest.mark.parametrize("effects", [(Repeat(times=1000),) * MAX_EFFECTS, (Stretch(100.0),) * 3])
def test_a_clip_that_plays_longer_than_an_hour_is_none(inside, effects):
    with pytest.raises(InvalidInputError, match="expected at most 3600 s"):
        Clip(waveform=inside, effects=effects)
