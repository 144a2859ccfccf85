"""Clips that are moved, or copied, to an input place."""

from dataclasses import replace

from skinsource.design import edits
from skinsource.design.clips import MAX_CLIPS, Clip
from skinsource.design.design import MAX_INPUTS, Design, Input
from skinsource.design.edits.edit import Refusal
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone

TONE = Tone(100.0, 0.0, 0.2)
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        Input(location=7, clips=(Clip(waveform=TONE), Clip(onset_s=0.3)), amplitude=0.5),
        Input(location=3, clips=(Clip(onset_s=0.1, waveform=TONE),)),
    ),
)
VIEW = View(selected_inputs=(1,), selected_clips=(2,))


def test_a_clip_goes_to_the_track_that_is_at_the_place_and_keeps_its_onset_and_id():
    after = edits.move_clips_to_place(DESIGN, VIEW, (2,), 3)
    assert after.label == "Move clip at 7 (II pad) to 3 (III tip)"
    assert [[clip.id for clip in track.clips] for track in after.design.inputs] == [[1], [3, 2]]
    assert after.design.clip(2) is DESIGN.clip(2)
    assert after.view.selected_clips == (2,)
    assert after.view.selected_inputs == (2,)


def test_onto_a_free_place_a_track_is_made_as_strong_as_the_one_it_leaves():
    after = edits.move_clips_to_place(DESIGN, VIEW, (2,), 15).design
    assert [track.location for track in after.inputs] == [7, 3, 15]
    assert after.inputs[2].amplitude == 0.5
    assert after.inputs[2].clips == (DESIGN.clip(2),)
    assert after.inputs[2].colour not in {track.colour for track in DESIGN.inputs}


def test_a_copy_leaves_the_first_where_it_was_and_is_selected():
    after = edits.move_clips_to_place(DESIGN, VIEW, (2,), 3, copies=True)
    assert after.design.inputs[0] == DESIGN.inputs[0]
    assert after.design.inputs[1].clips[-1] == replace(DESIGN.clip(2), id=4)
    assert after.view.selected_clips == (4,)


def test_clips_of_several_tracks_go_together():
    after = edits.move_clips_to_place(DESIGN, VIEW, (1, 3), 20).design
    assert [[clip.id for clip in track.clips] for track in after.inputs] == [[2], [], [1, 3]]


def test_of_several_tracks_at_a_place_it_is_the_selected_one():
    twice = DESIGN.adding(Input(location=3))
    first = edits.move_clips_to_place(twice, VIEW, (2,), 3).design
    assert [len(track.clips) for track in first.inputs] == [1, 2, 0]
    chosen = replace(VIEW, selected_inputs=(1, 3))
    other = edits.move_clips_to_place(twice, chosen, (2,), 3).design
    assert [len(track.clips) for track in other.inputs] == [1, 1, 1]


def test_a_clip_that_is_there_already_stays_as_it_is():
    assert edits.move_clips_to_place(DESIGN, VIEW, (2,), 7).design == DESIGN


def test_what_cannot_be_is_refused_with_a_reason():
    full = Design(
        limb="synthetic-1",
        inputs=(Input(location=3, clips=(Clip(),) * MAX_CLIPS), Input(location=7, clips=(Clip(),))),
    )
    many = Design(limb="synthetic-1", inputs=(Input(location=1, clips=(Clip(),)),) * MAX_INPUTS)
    for outcome, label in (
        (edits.move_clips_to_place(DESIGN, VIEW, (), 3), "No clip is selected"),
        (edits.move_clips_to_place(DESIGN, VIEW, (2,), 0), "location"),
        (edits.move_clips_to_place(full, VIEW, (MAX_CLIPS + 1,), 3), "at most 1000 clips"),
        (edits.move_clips_to_place(many, VIEW, (1,), 5), "at most 100 inputs"),
    ):
        assert isinstance(outcome, Refusal)
        assert label in outcome.sentence
