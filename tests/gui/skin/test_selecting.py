from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF
from PySide6.QtTest import QTest

from skinsource.base.measurement_conditions import VOLAR_OUTPUTS
from skinsource_gui.panels.skin.layout import HAND
from skinsource_gui.panels.skin.painting import output_labels, ring_radius, small_font, square
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


def test_a_rubber_band_around_nothing_selects_nothing(window):
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
    assert "Output 55, " in window.panel.readout.toolTip()


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
