"""Edits made in the whole window: told once, evaluated once, undone with their selections."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource.design.view import View
from skinsource_gui.plots.plot import Plot

KEY, CONTROL = Qt.Key, Qt.KeyboardModifier.ControlModifier


def place(window):
    hand = window.panel("hand").diagram
    QTest.mouseClick(
        hand, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, hand.site_centre(3)
    )


def test_escape_on_the_map_is_taken_back_by_ctrl_z_and_no_input_goes(window, settle):
    place(window)
    window.panel("skin").map.setFocus()
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
