"""What can be done to clips: every edit alone, and what they are together."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import edits
from skinsource.chain import placed_chain
from skinsource.clips import Clip, Fragment, Marker
from skinsource.design import MAX_CLIPS, MAX_INPUTS, Design, Input, track
from skinsource.edits import Edit, Refusal
from skinsource.effects import Trim, played
from skinsource.errors import FileFormatError
from skinsource.view import View
from skinsource.waveforms import Noise, Tap, Tone

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=77.0, duration_s=0.2)
#: Two clips on each of two tracks, one on a third, none on a fourth.
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        Input(
            location=7,
            clips=(
                Clip(waveform=TONE, onset_s=0.1),
                Clip(waveform=Noise(seed=1), onset_s=0.25, gain=-0.5, label="wind"),
            ),
        ),
        Input(
            location=2,
            clips=(Clip(waveform=Tap()), Clip(waveform=TONE, onset_s=0.5, muted=True)),
            colour=1,
            gain_curve=((0.0, 1.0), (1.0, 0.0)),
        ),
        track(11, Tone(duration_s=0.4), onset_s=0.3, colour=2, amplitude=0.25),
        Input(location=12, colour=3),
    ),
    markers=(Marker(time_s=0.05, name="first"), Marker(time_s=0.4), Marker(time_s=0.9)),
    loop_s=(0.1, 0.6),
)
VIEW = View(selected_inputs=(1,), selected_clips=(2,))
times = st.integers(0, 700).map(lambda k: k / 1000)
some_ids = st.lists(st.integers(1, 5), min_size=1, max_size=5, unique=True).map(tuple)


def total(design: Design, place: int) -> np.ndarray:
    """What a track plays from time 0 on, without its curve."""
    first, chain = placed_chain(design.inputs[place].clips, (), RATE_HZ)
    found = np.zeros(5000)
    for part in chain.parts:
        piece = played(part.waveform, part.effects, RATE_HZ, part.shift_s)
        found[first + part.start :][: piece.size] += part.gain * piece
    return found


def onsets(design: Design) -> list[float]:
    return [one.onset_s for one in design.clips]


def tracks(design: Design) -> list[list[int]]:
    return [[one.id for one in track.clips] for track in design.inputs]


def test_a_new_clip_is_added_and_selected():
    outcome = edits.add_clip(DESIGN, VIEW, 4, 0.2, Tap())
    assert outcome.design.inputs[3].clips == (Clip(waveform=Tap(), onset_s=0.2, id=6),)
    assert outcome.design.inputs[:3] == DESIGN.inputs[:3]
    assert (outcome.view.selected_clips, outcome.view.selected_inputs) == ((6,), (4,))
    assert outcome.label == "Add clip"


@settings(max_examples=60, deadline=None, derandomize=True)
@given(some_ids, st.floats(-700.0, 700.0), st.integers(-4, 4))
def test_clips_move_together_as_far_as_there_is_room(ids, by_s, by_tracks):
    outcome = edits.move_clips(DESIGN, VIEW, ids, by_s, by_tracks)
    before, after = DESIGN, outcome.design
    steps = {round(after.clip(one).onset_s - before.clip(one).onset_s, 9) for one in ids}
    assert len(steps) == 1
    assert abs(steps.pop()) <= abs(by_s) + 1e-9
    rows = {
        after.index_of(after.track_of(one).id) - before.index_of(before.track_of(one).id)
        for one in ids
    }
    assert len(rows) == 1
    assert abs(rows.pop()) <= abs(by_tracks)
    assert sorted(one.id for one in after.clips) == [1, 2, 3, 4, 5]
    for one in before.clips:
        if one.id not in ids:
            assert after.clip(one.id) is one


def test_a_clip_dragged_to_another_track_comes_back_the_same():
    there = edits.move_clips(DESIGN, VIEW, (2, 5), 0.1, 1)
    assert tracks(there.design) == [[1], [3, 4, 2], [], [5]]
    assert there.view.selected_clips == (2,)
    assert there.view.selected_inputs == (2,)
    assert there.label == "Move 2 clips"
    back = edits.move_clips(there.design, there.view, (2, 5), -0.1, -1)
    assert back.design == DESIGN


def test_clips_stop_at_the_ends_of_time_and_at_the_outer_tracks():
    early = edits.move_clips(DESIGN, VIEW, (1, 2), -9.0, -9)
    assert onsets(early.design)[:2] == [0.0, 0.15]
    late = edits.move_clips(DESIGN, VIEW, (1, 2), 1e6, 9)
    assert [late.design.clip(one).onset_s for one in (1, 2)] == [599.85, 600.0]
    assert tracks(late.design) == [[], [3, 4], [5], [1, 2]]


@settings(max_examples=40, deadline=None, derandomize=True)
@given(some_ids, times)
def test_a_copy_is_equal_and_not_the_same(ids, by_s):
    outcome = edits.copy_clips(DESIGN, VIEW, ids, by_s)
    design = outcome.design
    copies = [design.clip(one) for one in outcome.view.selected_clips]
    assert len(copies) == len(ids)
    originals = [one for one in DESIGN.clips if one.id in ids]
    for copy, original in zip(copies, originals, strict=True):
        assert copy.id not in [one.id for one in DESIGN.clips]
        assert copy.onset_s == pytest.approx(original.onset_s + by_s)
        assert replace(copy, id=original.id, onset_s=original.onset_s) == original
        assert design.clip(original.id) is original
    changed = design.with_clip(copies[0].id, gain=7.0)
    assert changed.clip(originals[0].id) is originals[0]


def test_duplicates_come_right_after_and_repetitions_in_a_row():
    outcome = edits.duplicate_clips(DESIGN, VIEW, (1, 2))
    # Together they last from 0.1 s to 0.45 s.
    assert [one.onset_s for one in outcome.design.inputs[0].clips] == [0.1, 0.25, 0.45, 0.6]
    assert outcome.label == "Duplicate 2 clips"
    thrice = edits.repeat_clips(DESIGN, VIEW, (5,), 4)
    assert [one.onset_s for one in thrice.design.inputs[2].clips] == [0.3, 0.7, 1.1, 1.5]
    assert thrice.view.selected_clips == (6, 7, 8)


def test_when_clips_go_the_next_one_of_the_track_is_selected():
    outcome = edits.remove_clips(DESIGN, VIEW, (1,))
    assert tracks(outcome.design) == [[2], [3, 4], [5], []]
    assert outcome.view.selected_clips == (2,)
    last = edits.remove_clips(DESIGN, VIEW, (5,))
    assert last.view.selected_clips == ()
    assert last.label == "Remove clip at 11 (I base)"
    assert [one.location for one in last.design.inputs] == [7, 2, 11, 12]


def test_gain_label_and_silence_of_clips_are_set_by_name():
    design = edits.set_clips(DESIGN, VIEW, (1, 5), "gain", 3).design
    assert [one.gain for one in design.clips] == [3.0, -0.5, 1.0, 1.0, 3.0]
    named = edits.set_clips(DESIGN, VIEW, (3,), "label", "here")
    assert named.design.clip(3).label == "here"
    assert named.label.startswith("Change label of clip at 2 (")
    once = edits.toggle_mute_clips(DESIGN, VIEW, (4, 5))
    assert [once.design.clip(one).muted for one in (4, 5)] == [True, True]
    again = edits.toggle_mute_clips(once.design, VIEW, (4, 5))
    assert [again.design.clip(one).muted for one in (4, 5)] == [False, False]
    assert [once.label, again.label] == ["Mute 2 clips", "Unmute 2 clips"]


@settings(max_examples=60, deadline=None, derandomize=True)
@given(times, st.integers(0, 599).map(lambda k: k / 1300))
def test_what_was_split_sounds_as_before_and_joins_to_what_it_was(at_s, onset_s):
    for cut_s in (at_s, onset_s):
        outcome = edits.split_clips(DESIGN, VIEW, (1, 2, 3, 4, 5), cut_s)
        if isinstance(outcome, Refusal):
            playing = [one for one in DESIGN.clips if one.onset_s < cut_s < one.end_s]
            assert (
                playing == []
                or min(min(cut_s - one.onset_s, one.end_s - cut_s) for one in playing) < 1e-8
            )
            continue
        for place in range(4):
            found, expected = total(outcome.design, place), total(DESIGN, place)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)
        ids = tuple(one.id for one in outcome.design.clips)
        again = edits.join_clips(outcome.design, outcome.view, ids)
        assert again.design == DESIGN


def test_parts_of_parts_join_to_what_they_were_in_one_go():
    design = DESIGN
    for at_s in (0.17, 0.2, 0.1503):
        design = edits.split_clips(design, VIEW, tuple(one.id for one in design.clips), at_s).design
    assert len(design.inputs[0].clips) == 5
    part = edits.split_clips(DESIGN, VIEW, (1,), 0.2)
    assert [one.id for one in part.design.inputs[0].clips] == [1, 6, 2]
    assert part.view.selected_clips == (6,)
    assert part.design.clip(6).effects == (Trim(start_s=0.1, duration_s=0.1),)
    whole = edits.join_clips(design, VIEW, tuple(one.id for one in design.clips))
    assert whole.design == DESIGN
    assert whole.view.selected_clips == (2,)


@pytest.mark.parametrize("change", [{"gain": 2.0}, {"onset_s": 0.21}, {"waveform": Tap()}])
def test_parts_that_differ_or_lie_apart_do_not_join(change):
    part = edits.split_clips(DESIGN, VIEW, (1,), 0.2).design.with_clip(6, **change)
    assert isinstance(edits.join_clips(part, VIEW, (1, 6)), Refusal)


@pytest.mark.parametrize(
    ("ends", "onset_s", "effects"),
    [
        ((0.15, 0.3), 0.15, (Trim(start_s=0.05, duration_s=0.15),)),
        ((0.1, 0.25), 0.1, (Trim(start_s=0.0, duration_s=0.15),)),
        ((0.1, 0.3), 0.1, ()),
        ((-5.0, 9.0), 0.1, ()),
        ((0.2, 0.1), 0.2, (Trim(start_s=0.1, duration_s=0.001),)),
    ],
)
def test_ends_that_are_dragged_trim_and_come_back(ends, onset_s, effects):
    outcome = edits.trim_clip(DESIGN, VIEW, 1, *ends)
    one = outcome.design.clip(1)
    assert (one.onset_s, one.effects) == (onset_s, effects)
    assert edits.trim_clip(outcome.design, VIEW, 1, 0.1, 0.3).design == DESIGN


def test_what_is_trimmed_stands_still():
    trimmed = edits.trim_clip(DESIGN, VIEW, 1, 0.1503, 0.2207).design
    found, before = (
        total(trimmed, 0),
        total(DESIGN, 0) - total(edits.set_clips(DESIGN, VIEW, (1,), "muted", True).design, 0),
    )
    muted = edits.set_clips(trimmed, VIEW, (2,), "muted", True).design
    found = total(muted, 0)
    inside = np.zeros(5000, bool)
    inside[int(np.ceil(0.1503 * RATE_HZ)) : int(np.ceil(0.2207 * RATE_HZ))] = True
    np.testing.assert_allclose(found, np.where(inside, before, 0.0), rtol=0, atol=1e-9)


def test_a_fragment_lies_elsewhere_as_it_lay_here():
    fragment = edits.fragment_of(DESIGN, (2, 3, 5))
    assert fragment.duration_s == pytest.approx(0.7)
    outcome = edits.paste_fragment(DESIGN, View(selected_inputs=(2,)), fragment, 1.0)
    design = outcome.design
    assert tracks(design) == [[1, 2], [3, 4, 6], [5, 7], [8]]
    assert [design.clip(one).onset_s for one in (6, 7, 8)] == [1.25, 1.0, 1.3]
    assert outcome.view.selected_clips == (6, 7, 8)
    assert outcome.label == "Paste 3 clips"
    below = edits.paste_fragment(DESIGN, View(selected_inputs=(4,)), fragment, 0.0).design
    assert [one.location for one in below.inputs] == [7, 2, 11, 12, 2, 11]
    assert below.inputs[5].amplitude == 0.25
    alone = edits.paste_fragment(Design(limb="any"), View(), fragment, 0.0).design
    assert [one.location for one in alone.inputs] == [7, 2, 11]


def test_a_fragment_travels_as_text():
    fragment = edits.fragment_of(DESIGN, (1, 4))
    words = edits.fragment_text(fragment)
    assert edits.fragment_from(words) == fragment
    with pytest.raises(FileFormatError, match="changed on its way"):
        edits.fragment_from(words.replace("Tone", "Tune"))
    with pytest.raises(FileFormatError, match="does not hold skinsource clips"):
        edits.fragment_from("{}")
    assert edits.fragment_of(DESIGN, (9,)) is None
    assert isinstance(fragment, Fragment)


def test_what_is_cut_leaves_no_other_clip_selected():
    outcome = edits.cut_clips(DESIGN, VIEW, (2, 5))
    assert tracks(outcome.design) == [[1], [3, 4], [], []]
    assert outcome.view.selected_clips == ()


@settings(max_examples=60, deadline=None, derandomize=True)
@given(times, st.integers(1, 500).map(lambda k: k / 1000))
def test_time_that_was_inserted_and_removed_again_changes_no_sound(at_s, length_s):
    there = edits.insert_time(DESIGN, VIEW, at_s, length_s).design
    at, by = round(at_s * RATE_HZ, 6), round(length_s * RATE_HZ)
    for place in range(4):
        before, found = total(DESIGN, place), total(there, place)
        first = int(np.ceil(at - 1e-6))
        np.testing.assert_allclose(found[:first], before[:first], rtol=0, atol=1e-9)
        gap = slice(first, int(np.ceil(at + length_s * RATE_HZ - 1e-6)))
        assert np.abs(found[gap]).max(initial=0.0) == 0.0
        if abs(by - length_s * RATE_HZ) < 1e-9:
            later = found[first + by :]
            np.testing.assert_allclose(later, before[first : 5000 - by], rtol=0, atol=1e-9)
    back = edits.remove_time(there, VIEW, at_s, at_s + length_s).design
    for place in range(4):
        np.testing.assert_allclose(total(back, place), total(DESIGN, place), rtol=0, atol=1e-9)
    assert [one.time_s for one in back.markers] == pytest.approx([0.05, 0.4, 0.9])
    assert back.loop_s == pytest.approx(DESIGN.loop_s)


def test_time_that_is_removed_takes_what_plays_then():
    design = edits.remove_time(DESIGN, VIEW, 0.2, 0.4).design
    for place in range(4):
        before, found = total(DESIGN, place), total(design, place)
        np.testing.assert_allclose(found[:260], before[:260], rtol=0, atol=1e-9)
        np.testing.assert_allclose(found[260:4000], before[520:4260], rtol=0, atol=1e-9)
    assert design.markers == (
        Marker(time_s=0.05, name="first"),
        Marker(time_s=0.2),
        Marker(time_s=0.7),
    )
    assert design.loop_s == (0.1, pytest.approx(0.4))
    assert design.inputs[1].gain_curve == (
        (0.0, 1.0),
        (0.2, pytest.approx(0.8)),
        (0.2, pytest.approx(0.6)),
        (0.8, 0.0),
    )


def test_a_loop_within_time_that_goes_is_gone():
    assert edits.remove_time(DESIGN, VIEW, 0.05, 0.7).design.loop_s is None


def test_markers_are_set_moved_named_and_taken_away():
    added = edits.add_marker(DESIGN, VIEW, 0.7, "end")
    assert added.design.markers == (*DESIGN.markers, Marker(time_s=0.7, name="end"))
    moved = edits.move_marker(added.design, VIEW, 3, 0.8).design
    named = edits.rename_marker(moved, VIEW, 3, "very end").design
    assert named.markers[3] == Marker(time_s=0.8, name="very end")
    assert edits.remove_marker(named, VIEW, 3).design == DESIGN


def test_loop_and_gain_curve_are_set_and_taken_away():
    looped = edits.set_loop(DESIGN, VIEW, (0.0, 1.0))
    assert looped.design.loop_s == (0.0, 1.0)
    assert edits.set_loop(looped.design, VIEW, None).design.loop_s is None
    curved = edits.set_gain_curve(DESIGN, VIEW, 1, ((0.0, 1.0), (2.0, 0.5)))
    assert curved.design.inputs[0].gain_curve == ((0.0, 1.0), (2.0, 0.5))
    assert curved.label == "Change gain curve of input at 7 (II pad)"


def test_selecting_clips_selects_their_tracks():
    view = edits.select_clips(DESIGN, VIEW, (5, 99, 1, 3, 5, 2)).view
    assert view.selected_clips == (5, 1, 3, 2)
    assert view.selected_inputs == (3, 2, 1)
    assert edits.toggle_clip(DESIGN, view, 2).view.selected_clips == (5, 1, 3)
    assert edits.toggle_clip(DESIGN, VIEW, 1).view.selected_clips == (2, 1)
    assert edits.select_all_clips(DESIGN, VIEW).view.selected_clips == (1, 3, 4, 5, 2)
    none = edits.select_clips(DESIGN, VIEW, ()).view
    assert (none.selected_clips, none.selected_inputs) == ((), (1,))
    assert edits.select_inputs(DESIGN, view, (3, 2)).view.selected_clips == (5, 3)
    assert edits.move_playhead(DESIGN, VIEW, 0.25).view.playhead_s == 0.25


def test_fields_of_the_selected_clips_are_edited_through_their_tracks():
    outcome = edits.change_field(DESIGN, VIEW, (1,), "onset_s", 0.35)
    assert onsets(outcome.design) == [0.1, 0.35, 0.0, 0.5, 0.3]
    both = edits.change_field(DESIGN, View(selected_clips=(1, 2)), (1,), "gain", 2.0)
    assert [one.gain for one in both.design.inputs[0].clips] == [2.0, 2.0]
    first = edits.change_kind(DESIGN, View(), (1, 4), "Tap")
    assert [one.waveform.title for one in first.design.inputs[0].clips] == ["Tap", "Noise"]
    assert [one.waveform for one in first.design.inputs[3].clips] == [Tap()]


FULL = Design(limb="any", inputs=(Input(location=1, clips=(Clip(),) * MAX_CLIPS),))
CROWD = Design(limb="any", inputs=(Input(location=1),) * MAX_INPUTS)
LANES = edits.fragment_of(DESIGN, (1, 3))


@pytest.mark.parametrize(
    "outcome",
    [
        edits.add_clip(DESIGN, VIEW, 9, 0.0, Tap()),
        edits.add_clip(DESIGN, VIEW, 1, -0.1, Tap()),
        edits.add_clip(DESIGN, VIEW, 1, 0.0, None),
        edits.add_clip(FULL, VIEW, 1, 0.0, Tap()),
        edits.move_clips(DESIGN, VIEW, (9,), 0.1),
        edits.move_clips(DESIGN, VIEW, (1,), float("nan")),
        edits.move_clips(DESIGN, VIEW, (1,), 0.1, 0.5),
        edits.copy_clips(FULL, VIEW, (1,), 0.1),
        edits.repeat_clips(DESIGN, VIEW, (1,), 1),
        edits.repeat_clips(DESIGN, VIEW, (1,), 10**9),
        edits.repeat_clips(DESIGN, VIEW, (5,), 1000 * 1000),
        edits.split_clips(DESIGN, VIEW, (1,), 0.05),
        edits.split_clips(DESIGN, VIEW, (1,), None),
        edits.split_clips(FULL, VIEW, (1,), 0.1),
        edits.join_clips(DESIGN, VIEW, (1, 2)),
        edits.join_clips(DESIGN, VIEW, ()),
        edits.trim_clip(DESIGN, VIEW, 9, 0.0, 1.0),
        edits.trim_clip(DESIGN, VIEW, 1, float("nan"), 1.0),
        edits.set_clips(DESIGN, VIEW, (1,), "id", 3),
        edits.set_clips(DESIGN, VIEW, (1,), "gain", "loud"),
        edits.remove_clips(DESIGN, VIEW, ()),
        edits.cut_clips(DESIGN, VIEW, ()),
        edits.paste_fragment(DESIGN, VIEW, LANES, -1.0),
        edits.paste_fragment(DESIGN, VIEW, LANES, None),
        edits.paste_fragment(FULL, VIEW, LANES, 0.0),
        edits.paste_fragment(CROWD, View(selected_inputs=(100,)), LANES, 0.0),
        edits.insert_time(DESIGN, VIEW, 0.1, 0.0),
        edits.insert_time(DESIGN, VIEW, -0.1, 1.0),
        edits.insert_time(DESIGN, VIEW, 0.0, 600.0),
        edits.remove_time(DESIGN, VIEW, 0.3, 0.2),
        edits.remove_time(DESIGN, VIEW, "0", 1.0),
        edits.add_marker(DESIGN, VIEW, -1.0),
        edits.move_marker(DESIGN, VIEW, 3, 0.1),
        edits.move_marker(DESIGN, VIEW, 0, float("inf")),
        edits.rename_marker(DESIGN, VIEW, 0, "two\nlines"),
        edits.remove_marker(DESIGN, VIEW, -1),
        edits.set_loop(DESIGN, VIEW, (1.0, 1.0)),
        edits.set_gain_curve(DESIGN, VIEW, 1, ((0.0, -1.0),)),
        edits.set_gain_curve(DESIGN, VIEW, 9, ()),
        edits.move_playhead(DESIGN, VIEW, -1.0),
    ],
)
def test_what_cannot_be_done_is_refused_with_one_sentence(outcome):
    assert isinstance(outcome, Refusal)
    assert outcome.sentence.endswith(".")
    assert len(outcome.sentence) < 400


def test_edits_lead_to_edits():
    assert isinstance(edits.select_clips(DESIGN, VIEW, (1,)), Edit)
