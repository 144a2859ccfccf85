"""Outputs and inputs on the map: clicks, bands and keys select, remove and take back."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QHelpEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource.base.conventions import VOLAR_OUTPUTS
from skinsource.design.design import track
from skinsource.design.waveforms.pulses import Tap
from skinsource_gui.panels.skin.layout import HAND
from skinsource_gui.panels.skin.painting import output_labels, ring_radius, small_font, square
from skinsource_gui.plots.outputs import output_at
from skinsource_gui.qt.wheel import FREE
from tests.gui.skin.bench import CONTROL, LEFT, PLAIN, SHIFT, click, drag, place


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_a_click_with_shift_or_control_adds_and_removes(window, modifier):
    click(window, 8, modifier)
    assert window.view.outputs == (29, 52, 8)
    click(window, 29, modifier)
    assert window.view.outputs == (52, 8)


@pytest.mark.parametrize("size", [(250, 300), (420, 640), (1000, 1300)])
def test_each_of_the_72_outputs_can_be_clicked(window, size):
    window.panel.resize(*size)
    for number in range(1, 73):
        click(window, number)
        assert window.view.outputs == (number,)


def test_the_palmar_outputs_stay_where_they_are_while_the_map_is_zoomed(window):
    before = place(window, 61)
    window.panel.map.stage.pan_zoom.zoom(4.0, QPointF(100, 100))
    assert place(window, 61) == before
    click(window, 61)
    assert window.view.outputs == (61,)


def test_a_rubber_band_selects_what_is_inside(window):
    around = QRectF(place(window, 43), place(window, 55)).normalized().adjusted(-6, -6, 6, 6)
    drag(window.panel.map, around.topLeft().toPoint(), around.bottomRight().toPoint())
    assert window.view.outputs == (43, 44, 45, 46, 52, 53, 54, 55)
    start = QPoint(6, window.panel.map.height() - 60)
    drag(window.panel.map, start, start + QPoint(12, 20))
    assert window.view.outputs == ()


def test_escape_gives_up_a_rubber_band_and_then_the_selection(window):
    view = window.panel.map
    QTest.mousePress(view, LEFT, PLAIN, QPoint(10, 10))
    QTest.mouseMove(view, QPoint(300, 500))
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert view.picker.band is None
    QTest.mouseRelease(view, LEFT, PLAIN, QPoint(300, 500))
    assert window.views == []
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert window.view.outputs == ()


def test_only_escape_twice_in_a_row_deselects_outputs(window):
    view = window.panel.map
    ground = QPoint(6, view.height() - 60)
    for between in (
        lambda: QTest.keyClick(view, Qt.Key.Key_Left),
        lambda: QTest.mouseClick(view, LEFT, PLAIN, ground),
    ):
        QTest.keyClick(view, Qt.Key.Key_Escape)
        between()
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert window.view.outputs == (29, 52)
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert window.view.outputs == ()


def test_keys_go_on_from_a_click_and_the_pointer_is_read_before_the_cursor(window, qtbot):
    view, readout = window.panel.map, window.panel.readout
    window.activate(qtbot)
    view.setFocus()
    for _ in range(2):
        click(window, 52)
    # Only another selection is told.
    assert [shown.outputs for shown in window.views] == [(52,)]
    QTest.keyClick(view, Qt.Key.Key_Down)
    assert "Output 54, " in readout.toolTip()
    view.clearFocus()
    assert view.readout() == ""
    QTest.mouseMove(view, place(window, 29))
    assert "Output 29, " in readout.toolTip()
    QTest.mouseMove(view, QPoint(5, 5))
    assert "Output 54, " not in readout.toolTip()


def test_control_a_selects_all_dorsal_outputs(window):
    QTest.keyClick(window.panel.map, Qt.Key.Key_A, CONTROL)
    assert window.view.outputs == tuple(k for k in range(1, 73) if k not in VOLAR_OUTPUTS)
    assert len(window.view.outputs) == 66


def test_arrows_and_space_select_outputs(window):
    view = window.panel.map
    view.setFocus()
    window.show(outputs=(52,))
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Space):
        QTest.keyClick(view, key)
    assert window.view.outputs == (54,)
    QTest.keyClick(view, Qt.Key.Key_Left)
    QTest.keyClick(view, Qt.Key.Key_Space, SHIFT)
    assert window.view.outputs == (54, 55)


@pytest.mark.parametrize("size", [(300, 330), (420, 640)])
@pytest.mark.parametrize("outputs", [(54, 55, 70, 72), tuple(range(67, 73)), (52, 53, 54, 55)])
def test_labels_of_neighbours_cover_neither_each_other_nor_a_ring(window, size, outputs):
    window.panel.resize(*size)
    layout = window.panel.map.stage.layout
    metrics = QFontMetricsF(small_font(window.panel.map.font()))
    radius = ring_radius(54, window.panel.map.content, layout)
    labels = output_labels(outputs, layout, radius, metrics, QRectF())
    rings = [square(window.panel.map.stage.place_of(number), radius) for number in outputs]
    assert [label.number for label in labels] == list(outputs)
    for label in labels:
        others = [other_label.area for other_label in labels if other_label is not label]
        assert not any(map(label.area.intersects, others + rings)), label


def test_outputs_that_the_limb_does_not_have_are_not_drawn_and_stay_selected(window):
    window.show(outputs=(29, 52))
    without = window.panel.map.grab().toImage()
    window.show(outputs=(29, 52, 80))
    assert window.panel.map.grab().toImage() == without
    assert not window.panel.picture(300, 400).isNull()
    click(window, 3, SHIFT)
    assert window.view.outputs == (29, 52, 80, 3)


def test_another_limb_is_fitted_anew(window):
    view = window.panel.map
    view.stage.pan_zoom.zoom(4.0, QPointF(150, 200))
    assert view.stage.pan_zoom.fit == FREE
    before = view.stage.layout
    limb_map = view.content.limb_map
    view.show_content(replace(view.content, limb_map=replace(limb_map)))
    assert view.stage.pan_zoom.fit == HAND
    assert view.stage.layout.frame.scale < before.frame.scale


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


def test_delete_removes_the_clips_that_were_selected_last_and_no_input(window, map_):
    first, second = window.design.ids
    # A click between two outputs selects nothing; one on an output before it does not count.
    click(window, 8)
    (clip,) = window.design.input(first).clips
    window.show(selected_inputs=(first,), selected_clips=(clip.id,))
    QTest.mouseClick(map_, LEFT, PLAIN, QPoint(6, map_.height() - 60))
    QTest.keyClick(map_, KEY.Key_Delete)
    assert window.design.ids == (first, second)
    assert [len(track.clips) for track in window.design.inputs] == [0, 1]


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
        "Output 29, Digit II, beside the nail, radial · "
        "−11.0 dB re 1 m/s²  (0.282 m/s² RMS, whole record)"
    )
    # In little room the place is last to go.
    assert window.panel.readout.text().startswith("Output 29")
    window.show(outputs=())
    QTest.mouseMove(view, (place(window, 60) + place(window, 69)) / 2)
    assert window.panel.readout.toolTip().endswith(" mm/s² RMS, whole record)")
    QTest.mouseMove(view, QPoint(5, 5))
    strongest, hint = window.panel.readout.toolTip().split("\n")
    loudest = window.results["output_levels_db"].argmax() + 1
    assert strongest.startswith(f"Strongest: Output {loudest},")
    assert f" · {window.panel.strongest.text()} re 1 m/s²" in strongest
    assert window.panel.readout.text().startswith(f"Strongest: Output {loudest}")
    assert hint.startswith("No output selected")
