"""Inputs on the map: a click selects one, Delete removes it, Escape takes the click back."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QHelpEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource.design.design import track
from skinsource.design.waveforms.pulses import Tap
from skinsource_gui.plots.outputs import output_at
from tests.gui.skin.bench import LEFT, PLAIN, SHIFT, click, place

KEY = Qt.Key


@pytest.fixture
def map_(window):
    """The map, over two inputs; the first one is selected."""
    window.show(window.design.adding(track(location=16, waveform=Tap())))
    return window.panel.map


def place_of(map_, location):
    [place] = map_.content.limb_map.input_positions[[location - 1]]
    at = map_.stage.layout.frame.to_screen(place[None])[0]
    return QPointF(*map(float, at)).toPoint()


def click_input(map_, location, modifier=PLAIN):
    QTest.mouseClick(map_, LEFT, modifier, place_of(map_, location))


def tooltip_at(map_, point):
    event = QHelpEvent(QEvent.Type.ToolTip, point, map_.mapToGlobal(point))
    QApplication.sendEvent(map_, event)
    return QToolTip.text()


@pytest.mark.parametrize("key", [KEY.Key_Delete, KEY.Key_Backspace])
def test_delete_removes_the_input_that_was_clicked_and_keeps_the_outputs(window, map_, key):
    first, second = window.design.ids
    click_input(map_, 16)
    assert window.view.selected_inputs == (second,)
    QTest.keyClick(map_, key)
    assert window.design.ids == (first,)
    assert window.view.outputs == (29, 52)
    assert [track.id for track in map_.content.inputs] == [first]


def test_without_a_selected_input_delete_says_so_and_removes_nothing(window, map_):
    window.show(selected_inputs=(), outputs=(8,))
    before = window.design
    QTest.keyClick(map_, KEY.Key_Delete)
    assert window.refusals[-1].startswith("No input is selected")
    assert (window.design, window.view.outputs) == (before, (8,))


def test_where_outputs_were_selected_last_delete_removes_no_input_that_was_before(window, map_):
    click_input(map_, 16)
    click(window, 8)
    before = window.design
    QTest.keyClick(map_, KEY.Key_Delete)
    assert window.refusals[-1].startswith("Outputs cannot be removed")
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
    for _ in range(2):
        QTest.keyClick(map_, KEY.Key_Escape)
    assert window.view.outputs == ()
    assert window.view.selected_inputs == window.design.ids[1:]


def test_of_inputs_at_one_place_each_click_selects_the_next(window, map_):
    window.show(
        window.design.adding(track(location=16)).adding(track(location=16)), selected_inputs=()
    )
    _, *here = window.design.ids
    chosen = []
    for _ in range(4):
        click_input(map_, 16)
        chosen += window.view.selected_inputs
    # The last one lies on top.
    assert chosen == [here[2], here[1], here[0], here[2]]
    # Two quick clicks are two clicks, and no wish to see the whole.
    map_.stage.pan_zoom.step("zoom_in")
    near = map_.stage.layout.frame
    QTest.mouseDClick(map_, LEFT, PLAIN, place_of(map_, 16))
    assert map_.stage.layout.frame == near


def test_an_input_under_an_output_is_selected_by_a_second_click(window, map_):
    window.panel.resize(240, 330)
    # A place that lies over an output, at this size.
    points = map_.stage.layout.points
    under = [(k, output_at(points, QPointF(place_of(map_, k)))) for k in range(1, 21)]
    location, output = next((k, output) for k, output in under if output is not None)
    window.show(
        window.design.adding(track(location=location)), selected_inputs=window.design.ids[:1]
    )
    first, _, third = window.design.ids
    click_input(map_, location)
    assert (window.view.outputs, window.view.selected_inputs) == ((output,), (first,))
    click_input(map_, location)
    assert (window.view.outputs, window.view.selected_inputs) == ((output,), (third,))
    click_input(map_, location)
    assert (window.view.outputs, window.view.selected_inputs) == ((output,), (third,))
    # With Shift outputs alone are meant.
    click_input(map_, location, SHIFT)
    assert (window.view.outputs, window.view.selected_inputs) == ((), (third,))
    lines = tooltip_at(map_, place_of(map_, location)).split("\n")
    assert f"Output {output}," in lines[0]
    assert lines[-2].startswith(f"Input 3: {location} ·")
    assert lines[-1] == "Click again for the next one here"
    QToolTip.hideText()


def test_a_tooltip_names_the_inputs_at_a_place(window, map_):
    assert tooltip_at(map_, place_of(map_, 16)).startswith("Input 2: 16 · ")
    assert "Click again" not in QToolTip.text()
    for _ in range(4):
        window.show(window.design.adding(track(location=16)))
    lines = tooltip_at(map_, place_of(map_, 16)).split("\n")
    assert [line.partition(":")[0] for line in lines[:3]] == ["Input 6", "Input 5", "Input 4"]
    assert lines[3:] == ["…", "Click again for the next one here"]
    QToolTip.hideText()


def test_the_readout_follows_the_mouse(window):
    view = window.panel.map
    QTest.mouseMove(view, place(window, 29))
    assert window.panel.readout.toolTip() == (
        "−11.0 dB re 1 m/s²  (0.282 m/s² RMS, whole record) · "
        "Output 29, Digit II, beside the nail, radial"
    )
    window.show(outputs=())
    QTest.mouseMove(view, (place(window, 60) + place(window, 69)) / 2)
    assert window.panel.readout.toolTip().endswith(" mm/s² RMS, whole record)")
    QTest.mouseMove(view, QPoint(5, 5))
    assert window.panel.readout.toolTip().startswith("No output selected")
