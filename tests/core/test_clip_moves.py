"""Clips that lie elsewhere: moved, copied, repeated, cut and pasted."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.base.errors import FileFormatError
from skinsource.design import edits
from skinsource.design.clips import Fragment
from skinsource.design.design import Design
from skinsource.design.view import View
from tests.core.clips_bench import DESIGN, VIEW, onsets, some_ids, times, tracks


@settings(max_examples=60, deadline=None, derandomize=True)
@given(some_ids, st.floats(-700.0, 700.0), st.integers(-4, 4))
def test_clips_move_together_as_far_as_there_is_room(ids, by_s, by_tracks):
    outcome = edits.move_clips(DESIGN, VIEW, ids, by_s, by_tracks)
    before, after = DESIGN, outcome.design
    steps = {
        round(after.clip(clip_id).onset_s - before.clip(clip_id).onset_s, 9) for clip_id in ids
    }
    assert len(steps) == 1
    assert abs(steps.pop()) <= abs(by_s) + 1e-9
    rows = {
        after.index_of(after.track_of(clip_id).id) - before.index_of(before.track_of(clip_id).id)
        for clip_id in ids
    }
    assert len(rows) == 1
    assert abs(rows.pop()) <= abs(by_tracks)
    assert sorted(clip.id for clip in after.clips) == [1, 2, 3, 4, 5]
    for clip in before.clips:
        if clip.id not in ids:
            assert after.clip(clip.id) is clip


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
    assert [late.design.clip(clip_id).onset_s for clip_id in (1, 2)] == [599.85, 600.0]
    assert tracks(late.design) == [[], [3, 4], [5], [1, 2]]


@settings(max_examples=40, deadline=None, derandomize=True)
@given(some_ids, times)
def test_a_copy_is_equal_and_not_the_same(ids, by_s):
    outcome = edits.copy_clips(DESIGN, VIEW, ids, by_s)
    design = outcome.design
    copies = [design.clip(clip) for clip in outcome.view.selected_clips]
    assert len(copies) == len(ids)
    originals = [clip for clip in DESIGN.clips if clip.id in ids]
    for copy, original in zip(copies, originals, strict=True):
        assert copy.id not in [clip.id for clip in DESIGN.clips]
        assert copy.onset_s == pytest.approx(original.onset_s + by_s)
        assert replace(copy, id=original.id, onset_s=original.onset_s) == original
        assert design.clip(original.id) is original
    changed = design.with_clip(copies[0].id, gain=7.0)
    assert changed.clip(originals[0].id) is originals[0]


def test_duplicates_come_right_after_and_repetitions_in_a_row():
    outcome = edits.duplicate_clips(DESIGN, VIEW, (1, 2))
    # Together they last from 0.1 s to 0.45 s.
    assert [clip.onset_s for clip in outcome.design.inputs[0].clips] == [0.1, 0.25, 0.45, 0.6]
    assert outcome.label == "Duplicate 2 clips"
    thrice = edits.repeat_clips(DESIGN, VIEW, (5,), 4)
    assert [clip.onset_s for clip in thrice.design.inputs[2].clips] == [0.3, 0.7, 1.1, 1.5]
    assert thrice.view.selected_clips == (6, 7, 8)


def test_a_fragment_lies_elsewhere_as_it_lay_here():
    fragment = edits.fragment_of(DESIGN, (2, 3, 5))
    assert fragment.duration_s == pytest.approx(0.7)
    outcome = edits.paste_fragment(DESIGN, View(selected_inputs=(2,)), fragment, 1.0)
    design = outcome.design
    assert tracks(design) == [[1, 2], [3, 4, 6], [5, 7], [8]]
    assert [design.clip(clip_id).onset_s for clip_id in (6, 7, 8)] == [1.25, 1.0, 1.3]
    assert outcome.view.selected_clips == (6, 7, 8)
    assert outcome.label == "Paste 3 clips"
    below = edits.paste_fragment(DESIGN, View(selected_inputs=(4,)), fragment, 0.0).design
    assert [track.location for track in below.inputs] == [7, 2, 11, 12, 2, 11]
    assert below.inputs[5].amplitude == 0.25
    alone = edits.paste_fragment(Design(limb="synthetic-1"), View(), fragment, 0.0).design
    assert [track.location for track in alone.inputs] == [7, 2, 11]


@pytest.mark.parametrize("order", [(1, 2, 3), (3, 1, 2)])
def test_what_was_copied_from_selected_tracks_is_pasted_onto_them(order):
    fragment = edits.fragment_of(DESIGN, (1, 2, 3, 5))
    pasted = edits.paste_fragment(DESIGN, View(selected_inputs=order), fragment, 1.0)
    assert len(pasted.design.inputs) == len(DESIGN.inputs)
    assert tracks(pasted.design)[:3] == [[1, 2, 6, 7], [3, 4, 8], [5, 9]]
    again = edits.paste_fragment(pasted.design, pasted.view, fragment, 2.0)
    assert len(again.design.inputs) == len(DESIGN.inputs)


def test_a_fragment_travels_as_text():
    fragment = edits.fragment_of(DESIGN, (1, 4))
    text = edits.fragment_text(fragment)
    assert edits.fragment_from(text) == fragment
    with pytest.raises(FileFormatError, match="changed on its way"):
        edits.fragment_from(text.replace("Tone", "Tune"))
    with pytest.raises(FileFormatError, match="does not hold skinsource clips"):
        edits.fragment_from("{}")
    assert edits.fragment_of(DESIGN, (9,)) is None
    assert isinstance(fragment, Fragment)


def test_what_is_cut_leaves_no_other_clip_selected():
    outcome = edits.cut_clips(DESIGN, VIEW, (2, 5))
    assert tracks(outcome.design) == [[1], [3, 4], [], []]
    assert outcome.view.selected_clips == ()
