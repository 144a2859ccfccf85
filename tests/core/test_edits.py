"""What can be done to a design: every edit, alone."""

from dataclasses import replace

import pytest

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import MAX_INPUTS, Design, Input, track
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
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


def places(outcome: Edit) -> list[int]:
    return [track.location for track in outcome.design.inputs]


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


def test_a_duplicate_is_the_same_but_for_id_and_colour():
    outcome = edits.duplicate_inputs(THREE, LAST, (2, 1))
    copies = outcome.design.inputs[3:]
    for copy, original in zip(copies, THREE.inputs[:2], strict=True):
        clips = tuple(replace(clip, id=original.clips[0].id) for clip in copy.clips)
        assert replace(copy, id=original.id, colour=original.colour, clips=clips) == original
    assert [clip.id for clip in outcome.design.clips] == [1, 2, 3, 4, 5]
    assert outcome.view.selected_inputs == (4, 5)
    assert outcome.label == "Duplicate 2 inputs"


@pytest.mark.parametrize("number", [1, 3])
def test_what_does_not_fit_is_refused_whole(number):
    design = replace(FULL, inputs=FULL.inputs[: MAX_INPUTS - number + 1])
    outcome = edits.duplicate_inputs(design, View(), design.ids[:number])
    assert outcome == Refusal(
        sentence=f"A design holds at most {MAX_INPUTS} inputs; remove some first."
    )
    assert edits.place_input(FULL, View(), 3) == outcome


@pytest.mark.parametrize(
    ("gone", "selected", "then"),
    [
        ((1,), (1,), (2,)),
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


def test_several_inputs_are_muted_at_once_and_heard_again_only_together():
    once = edits.toggle_mute(THREE, LAST, (1,))
    both = edits.toggle_mute(once.design, LAST, (1, 2))
    assert [track.muted for track in both.design.inputs] == [True, True, False]
    again = edits.toggle_mute(both.design, LAST, (1, 2))
    assert [track.muted for track in again.design.inputs] == [False, False, False]
    assert [once.label, both.label, again.label] == [
        "Mute input at 7 (II pad)",
        "Mute 2 inputs",
        "Unmute 2 inputs",
    ]
    assert edits.toggle_solo(THREE, LAST, (3,)).design.inputs[2].solo


def test_a_typed_value_sets_all_that_have_such_a_field():
    outcome = edits.change_field(THREE, LAST, (1, 2, 3), "duration_s", 0.5)
    assert outcome.design.inputs[0].clips[0].waveform.duration_s == 0.5
    assert outcome.design.inputs[1].clips[0].waveform.duration_s == 0.5
    assert outcome.design.inputs[2] == THREE.inputs[2]
    assert outcome.label == "Change duration of 2 inputs"


def test_a_dragged_value_moves_all_by_the_same_step_and_back():
    there = edits.drag_field(THREE, LAST, (1, 2, 3), "amplitude", -1.7, lead=3, start=THREE)
    assert [track.amplitude for track in there.design.inputs] == [1.3, 0.8, -1.7]
    back = edits.drag_field(there.design, LAST, (1, 2, 3), "amplitude", -2.0, lead=3, start=THREE)
    assert back.design == THREE


def test_a_dragged_frequency_moves_all_by_the_same_factor():
    two = THREE.with_clip(2, waveform=Tone(frequency_hz=30.0))
    view = View(selected_inputs=(2, 1))
    outcome = edits.drag_field(two, view, (1, 2), "frequency_hz", 110.0, lead=1, start=two)
    assert [clip.waveform.frequency_hz for clip in outcome.design.clips[:2]] == [
        110.0,
        33.0,
    ]


def test_a_dragged_value_stays_within_what_is_allowed_and_comes_back_from_there():
    view = View(selected_inputs=(2, 1))
    far = edits.drag_field(THREE, view, (1, 2), "onset_s", 599.95, lead=1, start=THREE)
    assert [track.clips[0].onset_s for track in far.design.inputs] == [599.95, 600.0, 0.0]
    back = edits.drag_field(far.design, view, (1, 2), "onset_s", 0.0, lead=1, start=THREE)
    assert back.design == THREE


def test_a_choice_sets_all():
    outcome = edits.drag_field(
        THREE, View(selected_inputs=(1,)), (1, 2), "window", "none", lead=1, start=THREE
    )
    assert [track.clips[0].waveform.window for track in outcome.design.inputs[:2]] == [
        "none",
        "none",
    ]


def test_another_kind_keeps_what_both_share():
    outcome = edits.change_kind(THREE, LAST, (1, 2), "Tone")
    assert outcome.design.inputs[0] is THREE.inputs[0]
    assert outcome.design.inputs[1].clips[0].waveform == Tone(duration_s=0.2, window="tukey")


@pytest.mark.parametrize(
    ("ids", "index", "order"),
    [
        ((3,), 0, (3, 1, 2)),
        ((1,), 3, (2, 3, 1)),
        ((1, 3), 2, (2, 1, 3)),
        ((3, 1), 1, (1, 3, 2)),
        ((2,), 1, (1, 2, 3)),
        ((1,), -9, (1, 2, 3)),
        ((1,), 99, (2, 3, 1)),
    ],
)
def test_inputs_are_put_before_another(ids, index, order):
    outcome = edits.put_inputs_before(THREE, LAST, ids, index)
    assert outcome.design.ids == order
    assert outcome.view == LAST


@pytest.mark.parametrize(
    ("ids", "down", "order"),
    [
        ((3,), False, (1, 3, 2)),
        ((1,), False, (1, 2, 3)),
        ((2, 3), False, (2, 3, 1)),
        ((1, 2), False, (1, 2, 3)),
        ((1,), True, (2, 1, 3)),
        ((1, 3), True, (2, 1, 3)),
        ((1, 2), True, (3, 1, 2)),
    ],
)
def test_inputs_are_shifted_one_place_as_far_as_there_is_room(ids, down, order):
    assert edits.shift_inputs(THREE, LAST, ids, down).design.ids == order


def test_selecting_changes_nothing_of_the_design():
    outcome = edits.select_inputs(THREE, LAST, (3, 9, 2, 3))
    assert outcome.design is THREE
    assert outcome.view.selected_inputs == (3, 2)
    assert edits.select_all_inputs(THREE, View(selected_inputs=(2,))).view.selected_input == 2
    assert edits.toggle_selected(THREE, LAST, 2).view.selected_inputs == (1, 3, 2)
    assert edits.toggle_selected(THREE, LAST, 3).view.selected_inputs == (1,)
    assert edits.select_through(THREE, LAST, 3, 1).view.selected_inputs == (3, 2, 1)
    assert edits.select_through(THREE, LAST, None, 2).view.selected_inputs == (2,)


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
        edits.look_along(THREE, LAST, "zyx"),
        edits.look_by_method(THREE, LAST, None),
        edits.level_over(THREE, LAST, 3),
        edits.select_outputs(THREE, LAST, (1, 1)),
        edits.select_outputs(THREE, LAST, (10_001,)),
        edits.move_inputs(THREE, LAST, (1,), 10_001),
        edits.place_input(THREE, LAST, 0),
        edits.change_field(THREE, LAST, (1,), "frequency_hz", float("nan")),
        edits.change_field(THREE, LAST, (1,), "id", 2),
        edits.drag_field(THREE, LAST, (1, 3), "amplitude", float("inf"), lead=1, start=THREE),
        edits.change_kind(THREE, LAST, (1,), "Siren"),
        edits.change_waveform(THREE, LAST, (1,), None),
        edits.remove_inputs(THREE, LAST, (9,)),
        edits.duplicate_inputs(THREE, LAST, ()),
        edits.mute_inputs(THREE, LAST, (1,), "yes"),
        edits.clear_inputs(Design(limb="synthetic-1"), LAST),
    ],
)
def test_what_cannot_be_done_is_refused_with_one_sentence(outcome):
    assert isinstance(outcome, Refusal)
    assert outcome.sentence.endswith(".")
    assert len(outcome.sentence) < 400


def test_only_what_a_user_may_set_can_be_set_by_name():
    for input_track in THREE.inputs:
        settable = edits.fields_of(input_track)
        assert settable.keys() == {
            "amplitude",
            "gain_curve",
            "gain",
            "label",
            "onset_s",
            *specs_of(input_track.clips[0].waveform),
        }
