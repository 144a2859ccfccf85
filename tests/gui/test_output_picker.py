"""What mouse, wheel and keys mean on any map or axis."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent

from skinsource_gui.plots.outputs import OutputPicker
from skinsource_gui.plots.time_scale import TimeScale, range_by_wheel
from tests.gui.wheel import wheel_event

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


def test_space_is_left_to_others_until_keys_are_used_here_and_again_after_a_click(picker):
    space = key(Qt.Key.Key_Space)
    assert not picker.claims(space)
    assert press(picker, Qt.Key.Key_Right)
    assert picker.claims(space)
    click(picker, 10, 10)
    assert not picker.claims(space)
    assert picker.claims(key(Qt.Key.Key_Right))
    assert not picker.claims(key(Qt.Key.Key_Q))


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


def test_escape_gives_up_a_frame_before_it_selects_nothing(picker):
    picker.selected = (2,)
    picker.press(mouse(QEvent.Type.MouseButtonPress, 0, 0))
    picker.move(QPointF(80, 80), POINTS)
    assert press(picker, Qt.Key.Key_Escape)
    assert (picker.choices, picker.band) == ([], None)
    assert press(picker, Qt.Key.Key_Escape)
    assert picker.choices == [()]


def test_only_escape_twice_in_a_row_deselects_outputs(picker):
    picker.selected = (2,)
    for between in (lambda: press(picker, Qt.Key.Key_Left), lambda: click(picker, 300, 300)):
        press(picker, Qt.Key.Key_Escape)
        between()
    press(picker, Qt.Key.Key_Escape)
    assert picker.choices == []
    press(picker, Qt.Key.Key_Escape)
    assert picker.choices == [()]


SCALE = TimeScale(shown_s=(0.4, 0.6), left_px=10.0, width_px=200.0)
HELD = Qt.KeyboardModifier


def turned(x, y, held=HELD.NoModifier, at_px=60.0, whole_s=(0.0, 1.0)):
    at = QPointF(at_px, 5.0)
    event = wheel_event(at, at, (x, y), held)
    return range_by_wheel(event, SCALE, whole_s)


@pytest.mark.parametrize(
    ("turn", "held"), [((0, -120), HELD.ShiftModifier), ((-120, 0), HELD.NoModifier)]
)
def test_with_shift_or_sideways_it_goes_along_the_time(qapp, turn, held):
    assert turned(*turn, held) == pytest.approx((0.42, 0.62))


def test_it_ends_where_the_time_does_and_at_the_whole(qapp):
    assert turned(-12000, 0) == pytest.approx((0.8, 1.0))
    assert turned(0, -12000) is None
