"""Wavelets and tracks made alike on the skin, from the menu."""

import pytest

from skinsource import Design, View, track
from skinsource.design.waveforms import Tone, WaveletTrain
from skinsource.engine.levelling import track_levels_db

TRAIN = WaveletTrain((60.0, 400.0), slot_s=0.08)


@pytest.fixture
def trained(window):
    inputs = (track(7, TRAIN), track(3, Tone()))
    design = Design(limb="synthetic-1", inputs=inputs)
    window.document.start_over(design, View(selected_inputs=(1,), selected_clips=(1,)), None)
    return window


def gains(window, id=1):
    return window.document.design.clip(id).waveform.gains_db


def test_it_is_one_step_that_can_be_taken_back(qtbot, trained):
    trained.do("equalise_on_skin")
    qtbot.waitUntil(lambda: gains(trained) != ())
    assert gains(trained)[1] == 0.0
    assert gains(trained)[0] < -3.0
    assert trained.document.undo_stack.count() == 1
    assert trained.document.undo_stack.undoText() == "Balance wavelets of input at 7 (II pad)"
    assert trained.document.design.clip(1).label == ""
    trained.do("undo")
    assert gains(trained) == ()


def test_all_selected_trains_are_balanced_in_one_step(qtbot, trained):
    both = trained.document.design.adding(track(9, TRAIN))
    trained.document.start_over(both, View(selected_inputs=(1, 3), selected_clips=(3, 1)), None)
    trained.do("equalise_on_skin")
    qtbot.waitUntil(lambda: trained.document.undo_stack.count() == 1)
    assert all(both.clip(id).waveform.gains_db == () != gains(trained, id) for id in (1, 3))
    assert trained.document.undo_stack.undoText() == "Balance wavelets of 2 clips"


@pytest.mark.parametrize("meanwhile", [False, True])
def test_what_was_changed_meanwhile_or_cannot_be_predicted_is_left_as_it_is(
    qtbot, trained, meanwhile
):
    messages, high = [], WaveletTrain((60.0, 5000.0))
    trained.levelling.failed.connect(messages.append)
    if meanwhile:
        trained.do("equalise_on_skin")
    trained.document.edit("Change", trained.document.design.with_clip(1, waveform=high))
    if not meanwhile:
        trained.do("equalise_on_skin")
    qtbot.waitUntil(lambda: bool(messages))
    assert ("changed meanwhile" if meanwhile else "frequencies_hz is 5000") in messages[0]
    assert gains(trained) == ()


def test_selected_tracks_are_matched_in_one_step(qtbot, trained):
    action, messages = trained.actions_by_name["match_tracks"], []
    assert not action.isEnabled()
    assert "two inputs" in action.toolTip()
    trained.document.message.connect(messages.append)
    trained.document.look(View(selected_inputs=(1, 2)))
    assert "two inputs" not in action.toolTip()
    trained.do("match_tracks")
    qtbot.waitUntil(lambda: trained.document.undo_stack.count() == 1)
    (said,) = messages
    assert "Matched 1 input to input 3 (" in said
    assert "magnitude of x, y, z, loudest 100 ms" in said
    assert trained.document.design.inputs[-1].amplitude == 1.0
    levels_db = track_levels_db(trained.document.design, (1, 2))
    assert levels_db[1] == pytest.approx(levels_db[2], abs=0.01)
