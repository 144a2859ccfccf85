"""Edits of clips where they lie: added, removed, changed by name, and selected."""

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from tests.core.clips_bench import DESIGN, VIEW, onsets, tracks


def test_a_new_clip_is_added_and_selected():
    outcome = edits.add_clip(DESIGN, VIEW, 4, 0.2, Tap())
    assert outcome.design.inputs[3].clips == (Clip(waveform=Tap(), onset_s=0.2, id=6),)
    assert outcome.design.inputs[:3] == DESIGN.inputs[:3]
    assert (outcome.view.selected_clips, outcome.view.selected_inputs) == ((6,), (4,))
    assert outcome.label == "Add clip"


def test_when_clips_go_the_next_one_of_the_track_is_selected():
    outcome = edits.remove_clips(DESIGN, VIEW, (1,))
    assert tracks(outcome.design) == [[2], [3, 4], [5], []]
    assert outcome.view.selected_clips == (2,)
    last = edits.remove_clips(DESIGN, VIEW, (5,))
    assert last.view.selected_clips == ()
    assert last.label == "Remove clip at 11 (I base)"
    assert [track.location for track in last.design.inputs] == [7, 2, 11, 12]


def test_gain_label_and_silence_of_clips_are_set_by_name():
    design = edits.set_clips(DESIGN, VIEW, (1, 5), "gain", 3).design
    assert [clip.gain for clip in design.clips] == [3.0, -0.5, 1.0, 1.0, 3.0]
    named = edits.set_clips(DESIGN, VIEW, (3,), "label", "here")
    assert named.design.clip(3).label == "here"
    assert named.label.startswith("Change label of clip at 2 (")
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
    assert edits.select_inputs(DESIGN, view, (3, 2)).view.selected_clips == (5, 3)
    assert edits.move_playhead(DESIGN, VIEW, 0.25).view.playhead_s == 0.25


def test_fields_of_the_selected_clips_are_edited_through_their_tracks():
    outcome = edits.change_field(DESIGN, VIEW, (1,), "onset_s", 0.35)
    assert onsets(outcome.design) == [0.1, 0.35, 0.0, 0.5, 0.3]
    both = edits.change_field(DESIGN, View(selected_clips=(1, 2)), (1,), "gain", 2.0)
    assert [clip.gain for clip in both.design.inputs[0].clips] == [2.0, 2.0]
    first = edits.change_kind(DESIGN, View(), (1, 4), "Tap")
    assert [clip.waveform.title for clip in first.design.inputs[0].clips] == ["Tap", "Noise"]
    assert [clip.waveform for clip in first.design.inputs[3].clips] == [Tap()]
