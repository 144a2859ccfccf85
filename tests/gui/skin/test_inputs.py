"""Inputs on the map: a click selects one, Delete removes it, Escape takes the click back."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from skinsource.design import track
from skinsource.edits import Refusal
from skinsource.waveforms import Tap
from tests.gui.skin.bench import LEFT, PLAIN, click

KEY = Qt.Key


@pytest.fixture
def map_(window):
    """The map, over two inputs; the first one is selected."""
    window.design = window.design.adding(track(location=16, waveform=Tap()))
    window.show()
    return window.panel.map


def click_input(map_, location):
    [place] = map_.content.limb_map.input_positions[[location - 1]]
    at = map_.stage.layout.frame.to_screen(place[None])[0]
    QTest.mouseClick(map_, LEFT, PLAIN, QPointF(*map(float, at)).toPoint())


@pytest.mark.parametrize("key", [KEY.Key_Delete, KEY.Key_Backspace])
def test_delete_removes_the_input_that_was_clicked_and_keeps_the_outputs(window, map_, key):
    first, second = window.design.ids
    click_input(map_, 16)
    assert window.view.selected_inputs == (second,)
    QTest.keyClick(map_, key)
    assert window.design.ids == (first,)
    assert window.view.outputs == (29, 52)
    assert [one.id for one in map_.content.inputs] == [first]


def test_without_a_selected_input_delete_says_so_and_removes_nothing(window, map_):
    window.show(selected_inputs=(), outputs=(8,))
    before = window.design
    QTest.keyClick(map_, KEY.Key_Delete)
    assert isinstance(window.outcomes[-1], Refusal)
    assert window.outcomes[-1].sentence.startswith("No input is selected")
    assert (window.design, window.view.outputs) == (before, (8,))


def test_where_outputs_were_selected_last_delete_removes_no_input_that_was_before(window, map_):
    click_input(map_, 16)
    click(window, 8)
    before = window.design
    QTest.keyClick(map_, KEY.Key_Delete)
    assert window.outcomes[-1].sentence.startswith("Outputs cannot be removed")
    assert window.design == before
    # Once another input is selected, wherever, that is meant.
    window.show(selected_inputs=window.design.ids[:1])
    QTest.keyClick(map_, KEY.Key_Delete)
    assert window.design.ids == before.ids[1:]


def test_escape_after_a_click_on_an_input_selects_no_input_and_then_no_output(window, map_):
    click_input(map_, 16)
    QTest.keyClick(map_, KEY.Key_Escape)
    assert window.view.selected_inputs == ()
    assert window.view.outputs == (29, 52)
    QTest.keyClick(map_, KEY.Key_Escape)
    assert window.view.outputs == ()


@pytest.mark.parametrize("outputs", [(8,), (29,)])
def test_escape_after_a_click_on_an_output_leaves_the_inputs_selected(window, map_, outputs):
    window.show(outputs=(29,))
    click_input(map_, 16)
    click(window, *outputs)
    QTest.keyClick(map_, KEY.Key_Escape)
    assert window.view.outputs == ()
    assert window.view.selected_inputs == window.design.ids[1:]


def test_escape_after_the_clicked_input_went_elsewhere_selects_no_outputs(window, map_):
    click_input(map_, 16)
    window.view = replace(window.view, selected_inputs=())
    window.show()
    QTest.keyClick(map_, KEY.Key_Escape)
    assert window.view.outputs == ()


def test_escape_gives_up_what_the_mouse_began_before_it_takes_back_the_input(window, map_):
    click_input(map_, 16)
    QTest.mousePress(map_, LEFT, PLAIN, QPointF(10, 10).toPoint())
    QTest.keyClick(map_, KEY.Key_Escape)
    QTest.mouseRelease(map_, LEFT, PLAIN, QPointF(10, 10).toPoint())
    assert window.view.selected_inputs == window.design.ids[1:]
    assert window.view.outputs == (29, 52)
