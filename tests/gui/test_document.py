"""The history of a document: what is a step, what is kept with it, and when it is saved."""

import gc
from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource import Design, View, edits, track
from skinsource.design.edits.edit import Edit
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.editors import TextLine
from skinsource_gui.plots.plot import Plot
from skinsource_gui.state.document import MOST_STEPS, Document, ReplaceDesign
from skinsource_gui.state.preferences import start_design

ONE_TONE = Design(limb="synthetic-1", inputs=(track(location=7, waveform=Tone()),))


def with_frequency(document: Document, frequency_hz: float) -> Design:
    return document.design.with_clip(1, waveform=Tone(frequency_hz=frequency_hz))


@pytest.fixture
def document(qapp):
    return Document(ONE_TONE)


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


def test_the_selected_inputs_always_exist(document):
    document.edit("add", document.design.adding(track(location=3)))
    document.look(View(selected_inputs=(2,)))
    document.undo_stack.undo()
    assert document.view.selected_input == 1
    document.edit("delete", document.design.without_input(0))
    assert document.view.selected_input is None


def test_saving_is_what_ends_being_unsaved(document, tmp_path):
    document.edit("f", with_frequency(document, 101.0))
    assert document.modified
    document.mark_saved(tmp_path / "a.skinsource")
    assert not document.modified
    document.undo_stack.undo()
    assert document.modified


def test_undo_leaves_what_is_only_looked_at(document):
    document.edit("add", document.design.adding(track(location=3)))
    panels = (("skin", (("map_style", "sensors"),)),)
    document.look(replace(document.view, axes="z", time_range_s=(0.0, 0.1), panels=panels))
    document.undo_stack.undo()
    view = document.view
    assert (view.axes, view.time_range_s, view.panels) == ("z", (0.0, 0.1), panels)


def choose(document: Document, *outputs: int) -> None:
    view = replace(document.view, outputs=outputs)
    document.apply(Edit(label="Select outputs", design=document.design, view=view))


def test_each_choice_of_outputs_is_a_step_and_no_edit_of_the_design(document):
    for outputs in ((1,), (1, 2), ()):
        choose(document, *outputs)
    assert document.undo_stack.count() == 3
    assert not document.modified
    for outputs in ((1, 2), (1,), View().outputs):
        document.undo_stack.undo()
        assert document.view.outputs == outputs


def amended(document, frequency_hz):
    design = with_frequency(document, frequency_hz)
    document.amend(Edit(label="amend", design=design, view=document.view))
    return design


def test_what_is_amended_is_no_step_and_comes_back_by_redo(document):
    document.edit("f", with_frequency(document, 101.0))
    design = amended(document, 102.0)
    assert document.undo_stack.count() == 1
    document.undo_stack.undo()
    assert document.design == ONE_TONE
    document.undo_stack.redo()
    assert document.design == design


def test_a_gesture_goes_on_after_what_was_amended(document):
    for frequency_hz in (101.0, 103.0):
        document.edit("f", with_frequency(document, frequency_hz), gesture=1)
        amended(document, frequency_hz + 1.0)
        amended(document, frequency_hz + 1.0)
    assert document.undo_stack.count() == 1
    document.undo_stack.undo()
    assert document.design == ONE_TONE


def test_an_amended_state_before_a_step_is_that_to_which_undo_leads(document):
    document.edit("f", with_frequency(document, 101.0))
    document.undo_stack.undo()
    design = amended(document, 102.0)
    document.undo_stack.redo()
    document.undo_stack.undo()
    assert document.design == design


def test_going_to_a_step_tells_once_and_undoes_or_redoes_all_between(document):
    for k in range(1, 1101):
        document.edit(f"edit {k}", with_frequency(document, 100.0 + k / 10))
    assert document.undo_stack.count() == MOST_STEPS
    frequencies_hz = []
    document.changed.connect(
        lambda: frequencies_hz.append(document.design.inputs[0].clips[0].waveform.frequency_hz)
    )
    document.go_to(0)
    document.go_to(500)
    document.go_to(5000)
    document.go_to(-3)
    assert frequencies_hz == [110.0, 160.0, 210.0, 110.0]
    document.go_to(0)
    assert len(frequencies_hz) == 4
    assert document.modified


def test_design_and_view_change_together_and_are_told_once(document):
    states = []
    document.changed.connect(lambda: states.append((document.design, document.view)))
    design = document.design.adding(track(location=3))
    view = View(axes="z", selected_inputs=(2,))
    document.apply(Edit(label="Place", design=design, view=view))
    assert states == [(design, view)]


@pytest.fixture
def new():
    """A new design, without inputs and without a file."""
    return Document(Design(limb="synthetic-1"))


def test_work_that_was_removed_by_hand_is_unsaved_until_it_is_taken_back(new):
    new.edit("add", new.design.adding(track(location=3)))
    titles = []
    new.title_changed.connect(lambda: titles.append(new.modified))
    new.apply(edits.clear_inputs(new.design, new.view))
    assert new.design == Design(limb="synthetic-1")
    assert new.modified
    assert titles == []
    new.go_to(0)
    assert not new.modified
    choose(new, 1)
    assert not new.modified


def test_a_file_that_holds_the_design_is_proof_of_it(new, tmp_path):
    new.mark_saved(tmp_path / "a.skinsource")
    new.edit("add", new.design.adding(track(location=3)))
    assert new.modified
    new.apply(edits.clear_inputs(new.design, new.view))
    assert not new.modified


KEY, CONTROL = Qt.Key, Qt.KeyboardModifier.ControlModifier


def place(window):
    hand = window.panel("hand").diagram
    QTest.mouseClick(
        hand, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, hand.site_centre(3)
    )


def test_escape_twice_on_the_map_is_taken_back_by_ctrl_z_and_no_input_goes(window, settle):
    place(window)
    window.panel("skin").map.setFocus()
    QTest.keyClick(window.panel("skin").map, KEY.Key_Escape)
    assert window.document.view.outputs == View().outputs
    QTest.keyClick(window.panel("skin").map, KEY.Key_Escape)
    assert window.document.view.outputs == ()
    QTest.keyClick(window.panel("skin").map, KEY.Key_Z, CONTROL)
    assert window.document.view.outputs == View().outputs
    assert len(window.document.design.inputs) == 2


def test_ctrl_z_in_a_text_that_was_taken_over_undoes_the_edit_and_never_makes_one(window):
    window.document.look(replace(window.document.view, selected_inputs=(), selected_clips=()))
    before, (line, *_) = window.document.design, window.panel("inspector").findChildren(TextLine)
    line.setFocus()
    QTest.keyClicks(line, "Soft")
    QTest.keyClick(line, KEY.Key_Return)
    # What is typed since comes first.
    QTest.keyClicks(line, "er")
    QTest.keyClick(line, KEY.Key_Z, CONTROL)
    assert window.document.design.title == line.text() != before.title
    QTest.keyClick(line, KEY.Key_Z, CONTROL)
    assert (window.document.design, line.text()) == (before, before.title)
    window.panel("skin").map.setFocus()
    assert window.document.undo_stack.canRedo()


@pytest.mark.parametrize("panel", ["traces", "spectra"])
def test_undo_and_redo_bring_back_the_axes_that_were_shown(window, settle, panel):
    plot = window.panel(panel).findChild(Plot)

    def louder(times):
        design = window.document.design
        amplitude = design.inputs[0].amplitude * times
        window.document.edit("Louder", design.with_input(0, amplitude=amplitude))
        settle()

    settle()
    first, before = window.document.design, plot.value_scale.values
    louder(1.6)
    grown = plot.value_scale.values
    assert grown != before
    window.document.undo_stack.undo()
    settle()
    assert plot.value_scale.values == before
    window.document.undo_stack.redo()
    settle()
    assert plot.value_scale.values == grown
    # While an edit goes on from what is shown, the axes stay as long as they fit.
    louder(1 / 1.3)
    assert plot.value_scale.values == grown
    window.document.start_over(first, window.document.view, None)
    settle()
    assert plot.value_scale.values == before


def steps_in_memory():
    return sum(isinstance(tracked, ReplaceDesign) for tracked in gc.get_objects())


def test_the_oldest_steps_are_forgotten_and_freed(qtbot):
    document = Document(start_design("synthetic-1"))
    gc.collect()
    before = steps_in_memory()
    for number in range(MOST_STEPS + 200):
        document.edit("a", document.design.with_clip(1, onset_s=number / 10))
    gc.collect()
    assert document.undo_stack.count() == MOST_STEPS
    assert steps_in_memory() - before == MOST_STEPS
    while document.undo_stack.canUndo():
        document.undo_stack.undo()
    assert document.design.inputs[0].clips[0].onset_s == 19.9
