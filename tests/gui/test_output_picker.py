"""What mouse, wheel and keys mean on any map or axis."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent

from skinsource_gui.plots.outputs import OutputPicker

POINTS = np.array([[10.0, 10.0], [60.0, 10.0], [np.nan, np.nan]])
MIDDLE, UNPLACED = QPointF(35, 10), (3,)
NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def picker(qapp):
    owner = QObject()
    picker = OutputPicker(owner)
    picker.owner, picker.choices = owner, []
    picker.chosen.connect(picker.choices.append)
    return picker


def key(code):
    return QKeyEvent(QEvent.Type.KeyPress, code, NONE)


def mouse(kind, x, y, held=NONE):
    left, at = Qt.MouseButton.LeftButton, QPointF(x, y)
    return QMouseEvent(kind, at, at, left, left, held)


def click(picker, x, y, held=NONE):
    picker.press(mouse(QEvent.Type.MouseButtonPress, x, y, held))
    picker.release(mouse(QEvent.Type.MouseButtonRelease, x, y, held), POINTS)


def press(picker, code):
    return picker.press_key(key(code), POINTS, UNPLACED, MIDDLE)


def test_the_pointer_comes_before_the_cursor_which_counts_with_the_keyboard_alone(picker):
    press(picker, Qt.Key.Key_Right)
    assert picker.pointed_at(focused=True) in (1, 2)
    assert picker.pointed_at(focused=False) is None
    picker.move(QPointF(58, 12), POINTS)
    assert picker.pointed_at(focused=False) == 2
    picker.move(QPointF(300, 300), POINTS)
    assert picker.pointed_at(focused=True) is None
    press(picker, Qt.Key.Key_Left)
    assert picker.pointed_at(focused=True) == 1


def test_only_another_selection_is_told_and_one_output_takes_the_cursor_along(picker):
    picker.selected = (1,)
    click(picker, 10, 10)
    assert picker.choices == []
    click(picker, 60, 10, SHIFT)
    assert picker.choices == [(1, 2)]
    click(picker, 60, 10)
    assert picker.choices[-1] == (2,)
    assert picker.cursor_output == 2


def test_only_escape_twice_in_a_row_deselects_outputs(picker):
    picker.selected = (2,)
    for between in (lambda: press(picker, Qt.Key.Key_Left), lambda: click(picker, 300, 300)):
        press(picker, Qt.Key.Key_Escape)
        between()
    press(picker, Qt.Key.Key_Escape)
    assert picker.choices == []
    press(picker, Qt.Key.Key_Escape)
    assert picker.choices == [()]
