"""Motions and targets stay groups in their design, until they are dissolved or detached."""

from dataclasses import replace

import pytest

from skinsource import Design, Input, View, edits, open_design, save_design, track
from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import Refusal, change_inputs
from skinsource.design.edits.motions import motion_of, with_whole_motions
from skinsource.design.motions import MOTIONS, ApparentMotion, Sweep
from skinsource.design.target import Target, conditions_of, is_unsolved, target_in
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples

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
        assert dragged.design.motions == ()
        assert "single clips" not in dragged.said
    removed = after_edit(design, edits.remove_inputs, (last,)).said
    assert removed.startswith("1 input removed. "), "it is a sentence of its own"


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


def a_drive(*values):
    return Samples(values=values, sample_rate_hz=1300.0)


DRIVES = a_drive(0.0, 1.0, -0.5), a_drive(0.5, 0.0, 0.25)
PLAYED = [Recording(drive, "Target") for drive in DRIVES]


def painted(design=PLAIN, outputs=(30,), brush="strong"):
    return edits.paint_target(design, View(), outputs, brush).design


def a_solution(design, places=(7, 9), drives=DRIVES):
    conditions = conditions_of(design)
    return replace(target_in(design)[1], places=places, drives=drives, solved_for=conditions)


def solved(design=None, places=(7, 9), drives=DRIVES):
    design = design or painted()
    return edits.solve_target(design, View(), a_solution(design, places, drives)).design


def changed(design, **changes):
    target = replace(target_in(design)[1], **changes)
    return edits.change_target(design, View(), target).design


def test_strokes_make_outputs_strong_quiet_and_free_again():
    design = painted(painted(painted(), (31, 32), "quiet"), (29,), "strong")
    assert (target_in(design)[1].strong, target_in(design)[1].quiet) == ((29, 30), (31, 32))
    design = painted(painted(design, (31,), "strong"), (29, 32), "erase")
    assert (target_in(design)[1].strong, target_in(design)[1].quiet) == ((30, 31), ())


def test_a_target_begins_at_the_playhead_without_tracks():
    outcome = edits.paint_target(PLAIN, View(playhead_s=0.5), [30])
    assert outcome.design.inputs == PLAIN.inputs
    assert target_in(outcome.design)[1].onset_s == 0.5
    assert is_unsolved(outcome.design)


def test_a_solved_target_is_tracks_that_play_its_drives():
    design = solved()
    tracks = design.inputs[1:]
    assert [each.location for each in tracks] == [7, 9]
    assert [each.clips[0].waveform for each in tracks] == [
        Recording(drive, "Target") for drive in DRIVES
    ]
    assert {motion_of(design, each.clips[0].id) for each in tracks} == {0}
    assert not is_unsolved(design)


@pytest.mark.parametrize("design", [painted(), solved()], ids=["painted", "solved"])
def test_a_target_comes_back_from_a_file(design, tmp_path):
    save_design(tmp_path / "a.skinsource", design)
    assert open_design(tmp_path / "a.skinsource").design == design


@pytest.mark.parametrize(
    ("edit", "more", "unsolved"),
    [
        (edits.paint_target, ([31], "quiet"), True),
        (edits.change_limb, ("synthetic-2",), True),
        (edits.change_scaling, ("relative",), True),
        (edits.mute_inputs, ((2,), True), False),
    ],
)
def test_drives_are_wanted_anew_where_they_depend_on_what_changed(edit, more, unsolved):
    after = after_edit(solved(), edit, *more).design
    assert is_unsolved(after) == unsolved
    assert len(after.motions) == 1


@pytest.mark.parametrize(
    ("changes", "unsolved"),
    [
        ({"beta": 1.0}, True),
        ({"waveform": Tap()}, True),
        ({"most": 3}, True),
        ({"amplitude": 2.0}, False),
        ({"onset_s": 0.3}, False),
    ],
)
def test_fields_want_other_drives_unless_the_same_are_louder_or_later(changes, unsolved):
    after = changed(solved(), **changes)
    assert is_unsolved(after) == unsolved
    assert [each.clips[0].waveform for each in after.inputs[1:]] == [
        Recording(it, "Target") for it in DRIVES
    ]
    assert {each.clips[0].onset_s for each in after.inputs[1:]} == {changes.get("onset_s", 0.0)}


def test_other_places_take_over_and_selected_clips_stay_so():
    design = solved()
    view = View(selected_clips=(design.inputs[0].clips[0].id,))
    outcome = edits.solve_target(design, view, a_solution(design, (9, 10)))
    assert [track.location for track in outcome.design.inputs] == [7, 9, 10]
    assert outcome.view is view


def test_clips_that_move_together_stay_a_target_and_keep_its_waveform():
    design = solved(changed(painted(), waveform=Tap()))
    ids = design.motions[0].clips
    moved = after_edit(design, edits.move_clips, ids, 0.2).design
    assert target_in(moved)[1] == replace(target_in(design)[1], onset_s=0.2)
    assert not is_unsolved(moved)
    apart = after_edit(design, edits.move_clips, ids[:1], 0.2)
    assert target_in(apart.design) is None
    assert apart.said == "Target is now single clips; Undo brings it back."


def test_a_detached_target_is_ordinary_tracks():
    design = solved()
    detached = edits.detach_target(design, View()).design
    assert detached.inputs == design.inputs
    assert target_in(detached) is None
    again = painted(detached)
    assert again.inputs == design.inputs
    assert target_in(again)[1] == Target(strong=(30,))


def test_what_a_target_cannot_be_is_refused():
    for outcome in (
        edits.detach_target(PLAIN, View()),
        edits.solve_target(PLAIN, View(), Target()),
        edits.change_target(painted(), View(), Tone()),
        edits.paint_target(PLAIN, View(), [30], "loud"),
        edits.paint_target(PLAIN, View(), [30], "select"),
    ):
        assert isinstance(outcome, Refusal)
    with pytest.raises(InvalidInputError, match="strong and quiet"):
        Target(strong=(3,), quiet=(3,))
    with pytest.raises(InvalidInputError, match="1 places and 2 drives"):
        Target(places=(7,), drives=DRIVES)


def test_drives_of_an_older_wish_play_until_it_is_solved():
    design = painted()
    older = a_solution(design)
    newer = changed(design, beta=1.0)
    after = edits.solve_target(newer, View(), older).design
    assert [track.location for track in after.inputs[1:]] == [7, 9]
    assert is_unsolved(after)
    louder = changed(design, amplitude=2.0)
    assert not is_unsolved(edits.solve_target(louder, View(), older).design)


def test_a_target_without_strong_outputs_plays_nothing():
    erased = painted(painted(solved(), (31,), "quiet"), (30,), "erase")
    typed = changed(solved(), strong=())
    for design in (erased, typed):
        assert design.inputs == PLAIN.inputs
        assert not is_unsolved(design)
