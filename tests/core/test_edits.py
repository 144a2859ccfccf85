"""What can be done to a design: every edit, alone."""

from dataclasses import replace

import pytest

from skinsource import Clip, View, edits
from skinsource.design.design import MAX_INPUTS, Design, Input, track
from skinsource.design.edits.edit import Refusal
from skinsource.design.waveforms import Noise, Tap, Tone, WaveletTrain
from skinsource.specs.models import specs_of

THREE = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0), amplitude=1.0),
        track(location=2, waveform=Noise(seed=4), amplitude=0.5, onset_s=0.1, colour=1),
        track(location=15, waveform=Tap(), amplitude=-2.0, colour=2),
    ),
)
LAST = View(selected_inputs=(1, 3))
FULL = Design(limb="synthetic-1", inputs=(track(location=1),) * MAX_INPUTS)


def test_a_new_input_is_selected_and_plays_what_the_selected_one_plays():
    outcome = edits.place_input(THREE, LAST, 9)
    assert outcome.label == "Place input at 9 (IV pad)"
    assert outcome.design.inputs[:3] == THREE.inputs
    clip = Clip(waveform=Tap(), id=4)
    assert outcome.design.inputs[3] == Input(
        location=9, clips=(clip,), amplitude=-2.0, colour=3, id=4
    )
    assert outcome.view.selected_inputs == (4,)


def test_noise_placed_anew_is_another_noise():
    view = View(selected_inputs=(2,))
    design = THREE
    for place in (5, 6, 8):
        outcome = edits.place_input(design, view, place)
        design, view = outcome.design, outcome.view
    seeds = [clip.waveform.seed for clip in design.clips if isinstance(clip.waveform, Noise)]
    assert seeds == [4, 0, 1, 2]


def test_duplicates_of_tracks_are_selected_as_tracks_and_those_of_clips_with_their_clips():
    tracks = edits.duplicate_inputs(THREE, View(selected_inputs=(1,)), (1,))
    assert tracks.view.selected_inputs == tracks.design.ids[-1:]
    assert not tracks.view.selected_clips
    clips = edits.duplicate_inputs(THREE, View(selected_inputs=(1,), selected_clips=(1,)), (1,))
    assert clips.view.selected_clips


def test_a_duplicate_is_the_same_but_for_id_and_colour():
    outcome = edits.duplicate_inputs(THREE, LAST, (2, 1))
    copies = outcome.design.inputs[3:]
    for copy, original in zip(copies, THREE.inputs[:2], strict=True):
        clips = tuple(replace(clip, id=original.clips[0].id) for clip in copy.clips)
        assert replace(copy, id=original.id, colour=original.colour, clips=clips) == original
    assert [clip.id for clip in outcome.design.clips] == [1, 2, 3, 4, 5]
    assert outcome.view.selected_inputs == (4, 5)
    assert outcome.label == "Duplicate 2 inputs"


@pytest.mark.parametrize(
    ("gone", "selected", "then"),
    [
        ((1,), (1,), (2,)),
        ((2,), (2,), (3,)),
        ((3,), (3,), (2,)),
        ((1, 2), (2, 1), (3,)),
        ((1,), (1, 3), (3,)),
        ((2,), (1, 3), (1, 3)),
        ((1, 2, 3), (1,), ()),
    ],
)
def test_when_the_selected_ones_go_a_neighbour_is_selected(gone, selected, then):
    outcome = edits.remove_inputs(THREE, View(selected_inputs=selected), gone)
    assert outcome.design.ids == tuple(track_id for track_id in (1, 2, 3) if track_id not in gone)
    assert outcome.view.selected_inputs == then


def test_removed_inputs_are_counted_and_their_clips_where_those_are_more():
    assert edits.remove_inputs(THREE, LAST, (1,)).said == "1 input removed"
    several = edits.add_clip(THREE, LAST, 1, 0.5, Tap()).design
    assert edits.remove_inputs(several, LAST, (1, 3)).said == "2 inputs with 3 clips removed"
    assert edits.clear_inputs(several, LAST).said == "3 inputs with 4 clips removed"


def test_several_inputs_are_muted_at_once_and_heard_again_only_together():
    once = edits.toggle_mute(THREE, LAST, (1,))
    both = edits.toggle_mute(once.design, LAST, (1, 2))
    assert [track.muted for track in both.design.inputs] == [True, True, False]
    again = edits.toggle_mute(both.design, LAST, (1, 2))
    assert [track.muted for track in again.design.inputs] == [False, False, False]
    assert [once.label, both.label] == ["Mute input at 7 (II pad)", "Mute 2 inputs"]
    assert edits.toggle_solo(THREE, LAST, (3,)).design.inputs[2].solo


def test_a_typed_value_sets_all_that_have_such_a_field():
    outcome = edits.change_field(THREE, LAST, (1, 2, 3), "duration_s", 0.5)
    assert [clip.waveform.duration_s for clip in outcome.design.clips[:2]] == [0.5, 0.5]
    assert outcome.design.inputs[2] == THREE.inputs[2]
    assert outcome.label == "Change duration of 2 inputs"


DRAGGED = THREE.with_clip(2, waveform=Tone(frequency_hz=30.0))


@pytest.mark.parametrize(
    ("ids", "name", "value", "expected"),
    [
        ((1, 2, 3), "amplitude", 1.3, [1.3, 0.65, -2.6]),
        ((1, 2), "frequency_hz", 110.0, [110.0, 33.0]),
        ((1, 2), "onset_s", 599.95, [599.95, 600.0, 0.0]),
        ((1, 2), "window", "none", ["none", "none"]),
    ],
)
def test_a_dragged_value_moves_all_alike_within_what_is_allowed_and_back(
    ids, name, value, expected
):
    """By the same step, frequencies and amplitudes by the same factor; a choice sets all."""

    def values(design):
        tracks = design.inputs[: len(expected)]
        return [edits.value_of(track, name) for track in tracks]

    view = View(selected_inputs=(2, 1))
    there = edits.drag_field(DRAGGED, view, ids, name, value, lead=1, start=DRAGGED)
    assert values(there.design) == expected
    origin = values(DRAGGED)[0]
    back = edits.drag_field(there.design, view, ids, name, origin, lead=1, start=DRAGGED)
    assert back.design == DRAGGED


def test_gains_of_wavelets_follow_their_frequencies_and_all_go_for_a_new_one_with_a_word():
    train = WaveletTrain((50.0, 400.0, 50.0), gains_db=(-6.0, 0.0, -7.0))
    design = Design(limb="synthetic-1", inputs=(track(7, train),))
    for hz, gains_db, said in (
        ((400.0, 50.0, 50.0), (0.0, -6.0, -7.0), "keeps its gain"),
        ((400.0,), (0.0,), "keeps its gain"),
        ((50.0, 50.0, 50.0), (), "Gains removed"),
    ):
        after = edits.change_field(design, LAST, (1,), "frequencies_hz", hz)
        assert after.design.clip(1).waveform == WaveletTrain(hz, gains_db=gains_db)
        assert said in after.said


def test_another_kind_keeps_what_both_share():
    outcome = edits.change_kind(THREE, LAST, (1, 2), "Tone")
    assert outcome.design.inputs[0] is THREE.inputs[0]
    assert outcome.design.inputs[1].clips[0].waveform == Tone(duration_s=0.2, window="tukey")


@pytest.mark.parametrize(
    ("outcome", "order"),
    [
        (edits.put_inputs_before(THREE, LAST, (3,), 0), (3, 1, 2)),
        (edits.put_inputs_before(THREE, LAST, (1,), 3), (2, 3, 1)),
        (edits.put_inputs_before(THREE, LAST, (1, 3), 2), (2, 1, 3)),
        (edits.put_inputs_before(THREE, LAST, (3, 1), 1), (1, 3, 2)),
        (edits.put_inputs_before(THREE, LAST, (1,), -9), (1, 2, 3)),
        (edits.put_inputs_before(THREE, LAST, (1,), 99), (2, 3, 1)),
        (edits.shift_inputs(THREE, LAST, (3,), False), (1, 3, 2)),
        (edits.shift_inputs(THREE, LAST, (2, 3), False), (2, 3, 1)),
        (edits.shift_inputs(THREE, LAST, (1, 2), False), (1, 2, 3)),
        (edits.shift_inputs(THREE, LAST, (1,), True), (2, 1, 3)),
        (edits.shift_inputs(THREE, LAST, (1, 3), True), (2, 1, 3)),
    ],
)
def test_inputs_are_put_before_another_or_shifted_as_far_as_there_is_room(outcome, order):
    assert outcome.design.ids == order
    assert outcome.view == LAST


@pytest.mark.parametrize(
    ("outcome", "selected"),
    [
        (edits.select_inputs(THREE, LAST, (3, 9, 2, 3)), (3, 2)),
        (edits.select_all_inputs(THREE, View(selected_inputs=(2,))), (1, 3, 2)),
        (edits.toggle_selected(THREE, LAST, 2), (1, 3, 2)),
        (edits.toggle_selected(THREE, LAST, 3), (1,)),
        (edits.select_through(THREE, LAST, 3, 1), (3, 2, 1)),
        (edits.select_through(THREE, LAST, None, 2), (2,)),
    ],
)
def test_selecting_changes_nothing_of_the_design(outcome, selected):
    assert outcome.design is THREE
    assert outcome.view.selected_inputs == selected


def test_a_zoom_stays_on_the_same_piece_when_the_delay_goes():
    view = View(time_range_s=(0.1, 0.2))
    outcome = edits.remove_delay(THREE, view, removed=True)
    assert outcome.view.time_range_s == pytest.approx((0.048, 0.148))
    back = edits.remove_delay(THREE, outcome.view, removed=False)
    assert back.view.time_range_s == pytest.approx((0.1, 0.2))
    assert edits.remove_delay(THREE, view, removed=False).view is view


@pytest.mark.parametrize(
    "outcome",
    [
        edits.change_limb(THREE, LAST, "measured-9"),
        edits.change_scaling(THREE, LAST, "loud"),
        edits.place_input(FULL, LAST, 3),
        edits.duplicate_inputs(replace(FULL, inputs=FULL.inputs[:-2]), LAST, (1, 2, 3)),
        edits.change_field(THREE, LAST, (1,), "frequency_hz", float("nan")),
        edits.change_field(THREE, LAST, (1,), "id", 2),
        edits.drag_field(THREE, LAST, (1, 3), "amplitude", float("inf"), lead=1, start=THREE),
        edits.change_kind(THREE, LAST, (1,), "Siren"),
        edits.remove_inputs(THREE, LAST, (9,)),
        edits.clear_inputs(Design(limb="synthetic-1"), LAST),
    ],
)
def test_what_cannot_be_done_is_refused(outcome):
    assert isinstance(outcome, Refusal)


def test_only_what_a_user_may_set_can_be_set_by_name():
    always = {"amplitude", "gain_curve", "gain", "label", "onset_s"}
    for input_track in THREE.inputs:
        waveform_fields = specs_of(input_track.clips[0].waveform)
        assert edits.fields_of(input_track).keys() == {*always, *waveform_fields}
