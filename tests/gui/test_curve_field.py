"""Breakpoints as a small curve."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from skinsource.design.effects.level import POINTS
from skinsource_gui.fields.curve_field import CurveField

START = ((0.0, 0.0, "straight"), (0.1, 1.0, "smooth"), (0.2, 0.5, "held"))
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def field(qtbot):
    field = CurveField(POINTS)
    qtbot.addWidget(field)
    field.resize(220, 84)
    field.set_value(START)
    field.show()
    field.edits = []
    field.edited.connect(lambda points, gesture: field.edits.append((points, gesture)))
    return field


def drag(field, start, by_px):
    at = start.toPoint()
    QTest.mousePress(field, LEFT, pos=at)
    QTest.mouseMove(field, at + QPoint(*by_px) / 2)
    QTest.mouseMove(field, at + QPoint(*by_px))


def test_a_point_is_dragged_in_one_gesture_and_stays_between_its_neighbours(field):
    start = field.place_of(1)
    drag(field, start, (20, 10))
    assert (field.place_of(1) - start - QPointF(20, 10)).manhattanLength() < 1.0
    QTest.mouseRelease(field, LEFT)
    x, y, segment = field.value[1]
    assert 0.1 < x < 0.2
    assert 0.5 < y < 1.0
    assert segment == "smooth"
    assert (field.value[0], field.value[2]) == (START[0], START[2])
    assert len({gesture for _, gesture in field.edits}) == 1
    drag(field, field.place_of(1), (500, -500))
    assert field.value[1][0] == 0.2
    assert field.edits[0][1] != field.edits[-1][1]


def test_a_press_on_the_curve_adds_a_point_there_without_changing_it(field):
    middle = (field.place_of(0) + field.place_of(1)) / 2
    QTest.mousePress(field, LEFT, pos=middle.toPoint())
    QTest.mouseRelease(field, LEFT, pos=middle.toPoint())
    assert len(field.value) == 4
    x, y, segment = field.value[1]
    assert y == pytest.approx(10 * x, abs=1e-9)
    assert segment == "straight"
    assert field.chosen == 1
    assert [points for points, _ in field.edits] == [field.value]


def test_a_drag_is_given_up_with_escape(field):
    drag(field, field.place_of(1), (20, 10))
    assert field.value != START
    QTest.keyClick(field, Qt.Key.Key_Escape)
    assert field.value == START
    assert field.edits[-1][0] == START
    QTest.mouseMove(field, QPoint(10, 10))
    assert field.value == START


def test_beside_the_curve_a_click_adds_nothing_and_a_double_click_a_point_just_there(field):
    beside = QPoint(round(field.place_of(0).x()) + 20, round(field.place_of(1).y()) + 3)
    QTest.mouseClick(field, LEFT, pos=beside)
    assert field.edits == []
    QTest.mouseDClick(field, LEFT, pos=beside)
    assert len(field.value) == 4
    assert (field.place_of(1) - QPointF(beside)).manhattanLength() < 2.0
    assert field.chosen == 1


def test_keys_choose_move_continue_add_and_remove(field):
    field.setFocus()
    QTest.keyClick(field, Qt.Key.Key_PageDown)
    assert field.chosen == 1
    assert field.text == "2/3 · 100 ms · 1 · smoothly on"
    for key, held in (
        (Qt.Key.Key_Right, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier),
        (Qt.Key.Key_Down, Qt.KeyboardModifier.NoModifier),
    ):
        QTest.keyClick(field, key, held)
    assert field.value[1] == (0.111, 0.95, "smooth")
    assert len({gesture for _, gesture in field.edits}) == 1
    QTest.keyClick(field, Qt.Key.Key_S)
    assert field.value[1][2] == "held"
    QTest.keyClick(field, Qt.Key.Key_Insert)
    assert [x for x, _, _ in field.value] == [0.0, 0.111, 0.1555, 0.2]
    assert field.chosen == 2
    QTest.keyClick(field, Qt.Key.Key_Delete)
    QTest.keyClick(field, Qt.Key.Key_End)
    QTest.keyClick(field, Qt.Key.Key_Delete)
    QTest.keyClick(field, Qt.Key.Key_Home)
    QTest.keyClick(field, Qt.Key.Key_Delete)
    assert len(field.value) == 1
    n_edits = len(field.edits)
    QTest.keyClick(field, Qt.Key.Key_Delete)
    assert (len(field.value), len(field.edits)) == (1, n_edits)
