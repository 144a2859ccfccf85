import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtTest import QTest

from skinsource_gui.panels.skin.map_canvas import FIT_ALL, FIT_HAND
from tests.gui.skin.bench import CONTROL, LEFT, MIDDLE, PLAIN, drag, place, wheel

# Zooming


def test_control_and_wheel_zoom_around_the_pointer(window):
    view, at = window.panel.map, QPoint(150, 100)
    before = view.map_layout().frame
    wheel(view, at, 3, CONTROL)
    after = view.map_layout().frame
    assert after.scale > 1.5 * before.scale
    assert after.to_map(QPointF(at)) == pytest.approx(before.to_map(QPointF(at)))


def test_zooming_out_ends_at_the_whole_outline(window):
    view = window.panel.map
    wheel(view, QPoint(150, 100), 3, CONTROL)
    wheel(view, QPoint(10, 10), -9, CONTROL)
    assert view.fit == FIT_ALL


def test_a_drag_with_the_middle_button_pans(window):
    view = window.panel.map
    view.zoom(4.0, QPointF(150, 200))
    before = place(window, 25)
    drag(view, QPoint(100, 100), QPoint(130, 160), button=MIDDLE)
    assert place(window, 25) - before == QPoint(30, 60)
    assert window.views == []


@pytest.mark.parametrize("way", ["key", "double click", "button"])
def test_there_are_three_ways_back_to_the_whole_outline(window, way):
    view = window.panel.map
    view.zoom(2.0, QPointF(0, 0))
    assert view.fit != FIT_ALL
    if way == "key":
        QTest.keyClick(view, Qt.Key.Key_0)
    elif way == "double click":
        QTest.mouseDClick(view, LEFT, PLAIN, QPoint(3, 3))
    else:
        QTest.mouseClick(window.panel.toolbar.all, LEFT)
    assert view.fit == FIT_ALL


def test_the_hand_can_be_fitted_alone(window):
    view = window.panel.map
    whole = view.map_layout().frame.scale
    QTest.mouseClick(window.panel.toolbar.hand, LEFT)
    assert view.fit == FIT_HAND
    assert view.map_layout().frame.scale > 1.3 * whole
    room = QRectF(view.rect())
    assert all(room.contains(view.place_of(number)) for number in range(1, 43))


def test_nothing_of_the_outline_is_cut_off_or_covered_at_any_size(window):
    outline = window.results["limb_map"].outline
    for size in ((300, 330), (300, 900), (420, 640), (1200, 500)):
        window.panel.resize(*size)
        layout = window.panel.map.map_layout()
        x, y = layout.frame.to_screen(outline).T
        assert layout.room.contains(QRectF(QPointF(x.min(), y.min()), QPointF(x.max(), y.max())))
        card = layout.palmar_card
        inside = (x > card.left()) & (x < card.right()) & (y > card.top()) & (y < card.bottom())
        assert not inside.any(), size


def test_an_output_reached_by_arrows_comes_into_sight(window):
    view = window.panel.map
    room = QRectF(view.rect())
    view.show_hand()
    hidden = {k for k in range(1, 73) if not room.contains(view.place_of(k))}
    view.cursor_output, visited = 54, set()
    for _ in range(12):
        QTest.keyClick(view, Qt.Key.Key_Down)
        assert room.contains(view.place_of(view.cursor_output))
        visited.add(view.cursor_output)
    assert visited & hidden
