"""The hand, magnified."""

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from skinsource.design.design import track
from skinsource.limbs.synthetic import standard_hand
from skinsource_gui.panels.hand.layout import palmar_drawing
from skinsource_gui.qt.wheel import FREE, WHOLE
from tests.gui.hand.bench import KEY, LEFT
from tests.gui.skin.bench import wheel


def test_the_wheel_zooms_at_the_pointer_and_back_to_the_whole_hand(studio):
    before = studio.diagram.stage.layout.transform.m11()
    at = studio.diagram.site_centre(18)
    wheel(studio.diagram, at, 3)
    assert studio.diagram.stage.layout.transform.m11() > 1.5 * before
    assert (studio.diagram.site_centre(18) - at).manhattanLength() <= 2
    wheel(studio.diagram, at, -9)
    assert studio.diagram.stage.layout.transform.m11() == before


def test_places_are_used_where_they_are_seen(studio):
    wheel(studio.diagram, studio.diagram.site_centre(13), 5)
    studio.click(13)
    assert studio.sites == [13]


def test_what_is_magnified_beyond_the_picture_is_not_hit(studio):
    diagram = studio.diagram
    wheel(diagram, diagram.site_centre(3), 8)
    below = [k for k in range(1, 21) if diagram.site_centre(k).y() > diagram.height()]
    assert below
    assert diagram.stage.site_at(QPointF(diagram.site_centre(below[0]))) is None
    QTest.mouseClick(diagram, LEFT, pos=QPoint(diagram.width() // 2, diagram.height() - 3))
    assert studio.edits == []


def test_a_double_click_beside_the_places_shows_the_whole_hand(studio):
    wheel(studio.diagram, studio.diagram.site_centre(3), 4)
    assert studio.diagram.stage.pan_zoom.fit == FREE
    empty = next(
        QPoint(x, y)
        for y in range(10, studio.diagram.height(), 7)
        for x in range(10, studio.diagram.width(), 7)
        if studio.diagram.stage.layout.site_at(QPointF(x, y)) is None
    )
    QTest.mouseDClick(studio.diagram, Qt.MouseButton.LeftButton, pos=empty)
    assert studio.diagram.stage.pan_zoom.fit == WHOLE
    assert studio.edits == []


def test_the_cursor_comes_into_sight(studio):
    studio.show(track(location=3), selected=0)
    wheel(studio.diagram, studio.diagram.site_centre(3), 6)
    studio.keys(KEY.Key_1, KEY.Key_6)
    assert studio.diagram.rect().contains(studio.diagram.site_centre(16))


def test_the_hand_cannot_be_moved_out_of_sight(studio):
    diagram = studio.diagram
    wheel(diagram, QPoint(2, 2), 4)
    for _ in range(60):
        diagram.stage.pan_zoom.pan(80, 80)
    outline = diagram.stage.layout.transform.map(palmar_drawing(standard_hand()).outline)
    middle, reach = QPointF(diagram.rect().center()), 0.25 * diagram.width()
    assert any(
        outline.contains(middle + QPointF(dx * reach, dy * reach))
        for dx in (-1, -0.5, 0, 0.5, 1)
        for dy in (-1, -0.5, 0, 0.5, 1)
    )
