"""Edits made in the whole window: told once, evaluated once, undone with their selections."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.view import View

KEY, CONTROL = Qt.Key, Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def counted(window, settle):
    """Count what the document tells and what the engine is asked."""
    settle()
    counts = {"told": 0, "evaluated": 0}

    def count(name):
        counts[name] += 1

    window.document.changed.connect(lambda: count("told"))
    window.engine.finished.connect(lambda _: count("evaluated"))
    return counts


def place(window):
    hand = window.panel("hand").diagram
    QTest.mouseClick(
        hand, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, hand.site_centre(3)
    )


@pytest.mark.parametrize("edit", [place, lambda window: window.do("duplicate_input")])
def test_placing_and_duplicating_are_told_once_and_evaluated_once(window, settle, counted, edit):
    edit(window)
    settle()
    assert len(window.document.design.inputs) == 2
    assert counted == {"told": 1, "evaluated": 1}


def test_escape_on_the_map_is_taken_back_by_ctrl_z_and_no_input_goes(window, settle):
    place(window)
    window.panel("skin").map.setFocus()
    QTest.keyClick(window.panel("skin").map, KEY.Key_Escape)
    assert window.document.view.outputs == ()
    QTest.keyClick(window.panel("skin").map, KEY.Key_Z, CONTROL)
    assert window.document.view.outputs == View().outputs
    assert len(window.document.design.inputs) == 2


def test_a_full_design_refuses_ctrl_d_with_a_sentence(make_window):
    inputs = tuple(Input(location=1, colour=k) for k in range(MAX_INPUTS))
    window = make_window(Design(limb="synthetic-1", inputs=inputs))
    window.do("duplicate_input")
    QApplication.processEvents()
    assert f"at most {MAX_INPUTS} inputs" in window.notice.text
    assert len(window.document.design.inputs) == MAX_INPUTS
