import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource_gui.panels.skin.level_range import AutomaticRange, tick_levels
from tests.gui.skin.bench import (
    CONTROL,
    LEFT,
    PLAIN,
    drag,
)

# The range of the colours


def test_the_automatic_range_holds_the_loudest_output(window):
    assert window.panel.colour_bar.range_db == (-60.0, -10.0)
    assert window.panel.colour_bar.auto_button.isChecked()


def test_the_automatic_range_does_not_flicker():
    follows, tops = AutomaticRange(), []
    for loudest in (-11.0, -9.9, -12.9, -5.2, -4.9, -7.9, -8.1, -17.9, -18.1, -200.0):
        tops.append(follows.follow(np.array([-200.0, loudest]))[1])
    assert tops == [-10, -5, -5, -5, 0, 0, -5, -15, -15, -15]


def test_a_handle_is_dragged(window):
    bar = window.panel.colour_bar
    drag(bar.strip.high, QPoint(10, 6), QPoint(10, 46))
    low, high = window.view.map_range_db
    assert low == -60.0
    assert -20.0 < high < -10.0
    assert bar.range_db == (low, high)
    assert not bar.auto_button.isChecked()


def test_a_handle_pulled_past_the_other_stops_before_it(window):
    bar = window.panel.colour_bar
    drag(bar.strip.low, QPoint(10, 6), QPoint(10, -900))
    assert window.view.map_range_db == (-11.0, -10.0)


def test_a_drag_between_the_handles_moves_both(window):
    strip = window.panel.colour_bar.strip
    middle = QPoint(17, strip.height() // 2)
    drag(strip, middle, middle - QPoint(0, 30))
    low, high = window.view.map_range_db
    assert high > -10.0
    assert high - low == pytest.approx(50.0)


def test_the_scale_stands_still_while_a_handle_is_dragged(window):
    strip = window.panel.colour_bar.strip
    QTest.mousePress(strip.high, LEFT, PLAIN, QPoint(10, 6))
    before = strip.low.pos(), strip.high.pos().y()
    QTest.mouseMove(strip.high, QPoint(10, 36))
    assert strip.low.pos() == before[0]
    assert strip.high.pos().y() == pytest.approx(before[1] + 30, abs=1)
    QTest.mouseRelease(strip.high, LEFT, PLAIN, QPoint(10, 6))


def test_a_double_click_brings_the_automatic_range_back(window):
    window.show(map_range_db=(-30.0, -20.0))
    QTest.mouseDClick(window.panel.colour_bar.strip, LEFT, PLAIN, QPoint(17, 200))
    assert window.view.map_range_db is None
    assert window.panel.colour_bar.range_db == (-60.0, -10.0)


def test_keys_move_a_handle_or_the_whole_range(window):
    strip = window.panel.colour_bar.strip
    QTest.keyClick(strip.high, Qt.Key.Key_Up)
    assert window.view.map_range_db == (-60.0, -9.0)
    QTest.keyClick(strip.low, Qt.Key.Key_Down, CONTROL)
    assert window.view.map_range_db == (-60.1, -9.0)
    QTest.keyClick(strip, Qt.Key.Key_PageUp)
    assert window.view.map_range_db == pytest.approx((-50.1, 1.0))


def test_exact_levels_are_typed(window):
    field = window.panel.colour_bar.low_field
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "-42.5")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.view.map_range_db == (-42.5, -10.0)
    assert field.text() == "−42.5"


def test_a_level_may_have_a_decimal_comma_and_a_unit(window):
    field = window.panel.colour_bar.low_field
    field.setFocus()
    QTest.keyClicks(field, "-45,5 dB")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.view.map_range_db == (-45.5, -10.0)


def test_an_impossible_level_goes_as_far_as_it_can(window):
    field = window.panel.colour_bar.low_field
    field.selectAll()
    QTest.keyClicks(field, "30")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.view.map_range_db == (-11.0, -10.0)
    assert field.value_si == -11.0


def test_the_switch_holds_the_range_and_frees_it(window):
    button = window.panel.colour_bar.auto_button
    QTest.mouseClick(button, LEFT)
    assert window.view.map_range_db == (-60.0, -10.0)
    QTest.mouseClick(button, LEFT)
    assert window.view.map_range_db is None


def test_ticks_are_round_and_apart():
    assert tick_levels(-66.0, 6.0, room_px=200.0, spacing_px=24.0) == [
        -60,
        -50,
        -40,
        -30,
        -20,
        -10,
        0,
    ]
    assert tick_levels(-1.0, 0.0, room_px=200.0, spacing_px=24.0) == [-1.0, -0.5, 0.0]
