"""A target stays a group in its design until it is detached, with the drives that were found."""

from dataclasses import replace

import pytest

from skinsource import Design, View, edits, open_design, save_design, track
from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import Refusal
from skinsource.design.edits.motions import motion_of, with_whole_motions
from skinsource.design.target import Target, conditions_of, is_unsolved, target_in
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples

PLAIN = Design(limb="synthetic-1", inputs=(track(7, Tone()),))


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


def after_edit(design, edit, *more):
    return with_whole_motions(design, edit(design, View(), *more))


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
