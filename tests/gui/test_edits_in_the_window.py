"""Edits made in the whole window: told once, evaluated once, undone with their selections."""

import gc

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource.design.view import View
from skinsource_gui.plots.plot import Plot
from skinsource_gui.state.document import MOST_STEPS, Document, ReplaceDesign
from skinsource_gui.state.preferences import start_design

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


def test_a_document_whose_saved_state_is_forgotten_stays_modified(qtbot, tmp_path):
    document = Document(start_design("synthetic-1"))
    document.mark_saved(tmp_path / "a.skinsource")
    for number in range(MOST_STEPS + 1):
        document.edit("a", document.design.with_clip(1, onset_s=(1 + number) / 10))
    while document.undo_stack.canUndo():
        document.undo_stack.undo()
    assert document.modified
