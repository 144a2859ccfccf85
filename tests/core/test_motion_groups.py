"""A motion stays a group in its design: it opens again, is changed, and is dissolved by hand."""

from dataclasses import replace

import pytest

from skinsource import Design, Input, View, edits, open_design, save_design, track
from skinsource.design.edits.edit import Refusal, change_inputs
from skinsource.design.edits.motions import motion_of, with_whole_motions
from skinsource.design.motions import MOTIONS, ApparentMotion, Sweep
from skinsource.design.waveforms.tones import Tone

PLAIN = Design(limb="synthetic-1", inputs=(track(7, Tone()),))
SWEEP = Sweep(path=(16, 18, 20))


def with_motion(motion=SWEEP, design=PLAIN):
    return edits.add_motion(design, View(), motion).design


def written(design):
    """What the clips of the first motion play, by their places."""
    return [
        (design.track_of(id).location, replace(design.clip(id), id=0))
        for id in design.motions[0].clips
    ]


def as_written_by(motion):
    return [(track.location, clip) for track in motion.tracks() for clip in track.clips]


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_motion_is_kept_with_its_clips_and_comes_back_from_a_file(kind, tmp_path):
    design = with_motion(kind())
    assert design.motions[0].motion == kind()
    assert written(design) == as_written_by(kind())
    save_design(tmp_path / "a.skinsource", design)
    assert open_design(tmp_path / "a.skinsource").design == design
    assert motion_of(design, design.motions[0].clips[-1]) == 0
    assert motion_of(design, design.inputs[0].clips[0].id) is None


@pytest.mark.parametrize(
    "motion",
    [
        replace(SWEEP, overlap=0.2, amplitude=0.5),
        replace(SWEEP, path=(18, 16, 3)),
        ApparentMotion(path=(16, 18, 16, 20, 7)),
    ],
    ids=["numbers", "path", "kind"],
)
def test_a_changed_motion_takes_the_place_of_the_one_before(motion):
    before = with_motion(design=with_motion(ApparentMotion(path=(2, 3))))
    # Of the second motion: its first track is softer and muted, and holds another clip besides.
    third = before.ids[3]
    before = edits.change_field(before, View(), (third,), "amplitude", 0.3).design
    before = edits.add_clip(before, View(), third, 2.0, Tone(70.0)).design
    before = edits.mute_inputs(before, View(), (third,), True).design
    own = before.input(third).clips[-1].id
    outcome = edits.change_motion(before, View(), 1, motion)
    after = outcome.design
    assert [group.motion for group in after.motions] == [ApparentMotion(path=(2, 3)), motion]
    assert written(replace(after, motions=after.motions[1:])) == as_written_by(motion)
    assert after.inputs[:3] == before.inputs[:3]
    assert after.clip(own).waveform == Tone(70.0)
    assert after.input(third).muted
    assert after.input(third).amplitude == pytest.approx(0.3 * motion.amplitude)
    silent = edits.set_clips(before, View(), before.motions[1].clips[:1], "muted", True).design
    clips = edits.change_motion(silent, View(), 1, motion).design.input(third).clips
    assert [clip.muted for clip in clips[:2]] == [False, True]
    places = [track.location for track in after.inputs[3:]]
    assert set(places) == {16, *motion.path}
    assert len(places) == len(set(places))
    assert set(outcome.view.selected_inputs) <= set(after.ids)


def test_what_is_no_motion_any_more_is_refused():
    assert isinstance(edits.change_motion(PLAIN, View(), 0, SWEEP), Refusal)
    assert isinstance(edits.change_motion(with_motion(), View(), 0, Tone()), Refusal)


def after_edit(design, edit, *more):
    return with_whole_motions(design, edit(design, View(), *more))


def test_edits_by_hand_dissolve_a_motion_and_say_so_once():
    design = with_motion()
    clip, last = design.motions[0].clips[0], design.ids[-1]
    for edit, more in (
        (edits.move_clips, ((clip,), 0.1)),
        (edits.remove_inputs, ((last,),)),
        (edits.move_inputs, ((last,), 5)),
        (edits.set_clips, ((clip,), "gain", 0.5)),
    ):
        outcome = after_edit(design, edit, *more)
        assert outcome.design.motions == (), edit.__name__
        assert "single clips" in outcome.said
        again = after_edit(outcome.design, edits.move_clips, (clip,), 0.1)
        assert again.said == ""
        # A drag edits the design as it was when the button went down, and the group stays away.
        dragged = with_whole_motions(outcome.design, edit(design, View(), *more))
        assert (dragged.design.motions, dragged.said) == ((), "")


def test_clips_of_a_dissolved_motion_are_called_after_what_they_play_and_others_keep_their_name():
    design = with_motion(design=with_motion())
    first, second = design.motions
    after = after_edit(design, edits.move_clips, first.clips[:1], 0.1).design
    assert after.motions == (second,)
    assert [after.clip(id).label for id in first.clips] == ["", "", ""]
    assert list(map(after.clip, second.clips)) == list(map(design.clip, second.clips))


def test_edits_of_other_things_and_the_way_back_keep_it():
    design = with_motion()
    last = design.ids[-1]
    for edit, more in (
        (edits.mute_inputs, ((last,), True)),
        (edits.set_gain_curve, (last, ((0.0, 0.5),))),
        (edits.change_field, ((1,), "amplitude", 0.3)),
        (edits.change_field, ((design.ids[1], last), "amplitude", -0.3)),
        (edits.set_clips, (design.motions[0].clips[:1], "muted", True)),
        (edits.add_clip, (last, 3.0, Tone())),
        (edits.shift_inputs, ((last,), False)),
    ):
        outcome = after_edit(design, edit, *more)
        assert outcome.design.motions == design.motions, edit.__name__
        assert outcome.said == ""
    clip = design.motions[0].clips[0]
    moved = edits.move_clips(design, View(), (clip,), 0.1).design
    back = edits.move_clips(moved, View(), (clip,), -0.1)
    assert with_whole_motions(moved, back).design.motions == design.motions
    empty = Design(limb="synthetic-1", inputs=(Input(location=7),))
    assert with_motion(design=empty).motions != ()


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_motion_that_is_made_louder_as_a_whole_stays_one(kind):
    design = with_motion(kind())
    group = design.motions[0]
    tracks = design.inputs[len(PLAIN.inputs) :]
    changes = {track.id: {"amplitude": 0.3 * track.amplitude} for track in tracks}
    outcome = after_edit(design, change_inputs, "Change", changes)
    assert outcome.design.motions == (replace(group, motion=kind(amplitude=0.3)),)
    assert outcome.said == ""


def test_a_motion_whose_clips_all_play_something_else_is_that_motion():
    design = with_motion()
    group = design.motions[0]
    waveform = replace(group.motion.waveform, frequency_hz=77.0)
    changes = {clip: {"waveform": waveform} for clip in group.clips}
    ids = {track.id: {} for track in design.inputs}
    outcome = after_edit(design, change_inputs, "Change", ids, changes)
    assert [each.motion.waveform for each in outcome.design.motions] == [waveform]


def test_a_duration_that_ends_before_the_trim_of_a_clip_says_that_nothing_plays():
    design = with_motion()
    for duration_s in (0.01, 0.7):
        edited = after_edit(design, edits.change_field, design.ids[-1:], "duration_s", duration_s)
        assert ("Nothing plays" in edited.said) == (duration_s < 0.7)
        assert "single clips" in edited.said


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_motion_that_is_moved_whole_begins_later_and_one_moved_to_other_places_is_none(kind):
    design = with_motion(kind())
    group = design.motions[0]
    outcome = after_edit(design, edits.move_clips, group.clips, 0.3)
    assert outcome.design.motions == (replace(group, motion=kind(onset_s=0.3)),)
    assert outcome.said == ""
    # A drag goes on from the design as it was when the button went down.
    back = with_whole_motions(outcome.design, edits.move_clips(design, View(), group.clips, 0.1))
    assert back.design.motions == (replace(group, motion=kind(onset_s=0.1)),)
    up = with_whole_motions(outcome.design, edits.move_clips(design, View(), group.clips, 0.1, -1))
    assert up.design.motions == ()
    assert "single clips" in up.said
