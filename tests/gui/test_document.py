from dataclasses import replace

import pytest

from skinsource.design import Design, Input
from skinsource.view import View
from skinsource.waveforms import Tone
from skinsource_gui.state.document import Document

ONE_TONE = Design(limb="synthetic-1", inputs=(Input(location=7, waveform=Tone()),))


def with_frequency(document: Document, frequency_hz: float) -> Design:
    return document.design.with_input(0, waveform=Tone(frequency_hz=frequency_hz))


@pytest.fixture
def document(qapp):
    return Document(ONE_TONE)


def test_one_drag_is_one_undo_step(document):
    for frequency_hz in range(101, 121):
        document.edit("Change frequency", with_frequency(document, frequency_hz), gesture=1)
    assert document.design.inputs[0].waveform.frequency_hz == 120.0
    assert document.undo_stack.count() == 1
    document.undo_stack.undo()
    assert document.design is ONE_TONE
    document.undo_stack.redo()
    assert document.design.inputs[0].waveform.frequency_hz == 120.0


def test_two_drags_are_two_steps(document):
    document.edit("f", with_frequency(document, 101.0), gesture=1)
    document.edit("f", with_frequency(document, 102.0), gesture=2)
    assert document.undo_stack.count() == 2


def test_edits_without_a_gesture_never_merge(document):
    document.edit("f", with_frequency(document, 101.0))
    document.edit("f", with_frequency(document, 102.0))
    assert document.undo_stack.count() == 2


def test_a_drag_that_comes_back_leaves_no_trace(document):
    document.edit("f", with_frequency(document, 101.0), gesture=1)
    document.edit("f", ONE_TONE, gesture=1)
    assert document.undo_stack.count() == 0
    assert document.design == ONE_TONE
    assert not document.modified


def test_an_edit_that_changes_nothing_is_no_edit(document):
    document.edit("f", with_frequency(document, 100.0))
    assert document.undo_stack.count() == 0


def test_looking_at_something_else_is_not_undone_and_not_unsaved(document):
    document.look(View(outputs=(1, 2)))
    assert document.view.outputs == (1, 2)
    assert not document.modified
    assert not document.undo_stack.canUndo()


def test_the_selected_input_always_exists(document):
    document.edit("add", document.design.adding(Input(location=3)))
    document.look(View(selected_input=1))
    document.undo_stack.undo()
    assert document.view.selected_input == 0
    document.edit("delete", document.design.without_input(0))
    assert document.view.selected_input is None


def test_saving_is_what_ends_being_unsaved(document, tmp_path):
    document.edit("f", with_frequency(document, 101.0))
    assert document.modified
    document.mark_saved(tmp_path / "a.skinsource")
    assert not document.modified
    document.undo_stack.undo()
    assert document.modified


def test_another_design_starts_with_an_empty_history(document):
    document.edit("f", with_frequency(document, 101.0))
    document.start_over(Design(limb="synthetic-2"), View(), None)
    assert document.design == Design(limb="synthetic-2")
    assert not document.undo_stack.canUndo()
    assert not document.modified


def test_undo_and_redo_select_the_input_that_they_change(document):
    document.edit("add", document.design.adding(Input(location=3)))
    document.edit("add", document.design.adding(Input(location=9)))
    document.look(View(selected_input=2))
    document.edit("delete", document.design.without_input(2))
    assert document.view.selected_input == 1
    document.undo_stack.undo()
    assert document.view.selected_input == 2  # the one that came back
    document.edit("mute", document.design.with_input(0, muted=True))
    assert document.view.selected_input == 2  # an edit selects nothing by itself
    document.undo_stack.undo()
    assert document.view.selected_input == 0
    document.undo_stack.redo()
    assert document.view.selected_input == 0


def test_undoing_an_input_keeps_the_same_other_input_selected(document):
    document.edit("add", document.design.adding(Input(location=3)))
    document.edit("delete", document.design.without_input(0))
    assert document.design.inputs[document.view.selected_input].location == 3
    document.undo_stack.undo()
    document.look(View(selected_input=1))
    document.undo_stack.redo()
    assert document.design.inputs[document.view.selected_input].location == 3


def test_undo_of_a_limb_keeps_the_selection(document):
    document.edit("add", document.design.adding(Input(location=3)))
    document.look(View(selected_input=1))
    document.edit("limb", replace(document.design, limb="synthetic-3"))
    document.undo_stack.undo()
    assert document.view.selected_input == 1
