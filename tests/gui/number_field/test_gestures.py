from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource_gui.fields.number_field import PIXELS_PER_STEP
from skinsource_gui.fields.units import COARSE, FINE, PLAIN, Ladder, number_text, stepped
from tests.gui.number_field.bench import AMPLITUDE, DURATION, FREQUENCY, PHASE, SEED, move_event


def test_all_edits_of_a_drag_share_one_gesture_and_the_way_back_is_exact(bench):
    one = bench(FREQUENCY, 123.4567)
    way = [(10 * k, 0) for k in range(1, 11)]
    one.drag(*way, *reversed(way), (0, 0))
    assert one.values[0] > 123.4567
    assert max(one.values) > 180
    assert one.values[-1] == 123.4567
    assert len(one.gestures) == 1
    assert None not in one.gestures
    first = one.gestures
    one.edits.clear()
    one.drag((20, 0))
    assert one.gestures.isdisjoint(first)


def test_a_drag_up_raises_and_ctrl_makes_it_fine(bench):
    one = bench(AMPLITUDE, 1.0)
    one.drag((0, -10 * PIXELS_PER_STEP))
    assert one.field.value_si == 1.5
    one.drag((0, 10 * PIXELS_PER_STEP), modifiers=Qt.KeyboardModifier.ControlModifier)
    assert one.field.value_si == 1.45


def test_a_drag_stops_at_the_range_and_turns_back_at_once(bench):
    one = bench(AMPLITUDE, 999.9)
    one.drag((400, 0), (400 - PIXELS_PER_STEP, 0))
    assert one.values == [1000.0, 999.95]


def test_escape_during_a_drag_brings_back_the_number_in_the_same_gesture(bench):
    one = bench(AMPLITUDE, 1.0)
    start = one.field.rect().center()
    QTest.mousePress(one.field, Qt.MouseButton.LeftButton, pos=start)
    move = move_event(one.field, QPointF(start + QPoint(40, 0)), Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(one.field, move)
    QTest.keyClick(one.field, Qt.Key.Key_Escape)
    QTest.mouseRelease(one.field, Qt.MouseButton.LeftButton, pos=start)
    assert one.values == [1.5, 1.0]
    assert len(one.gestures) == 1


def test_the_wheel_changes_nothing_unless_the_field_has_the_focus(bench):
    one = bench(AMPLITUDE, 1.0)
    assert not one.turn(1)
    assert one.edits == []
    QTest.mouseClick(one.field, Qt.MouseButton.LeftButton)
    assert one.turn(1)
    assert one.values == [1.05]


def test_ctrl_makes_steps_fine_and_shift_coarse(bench):
    one = bench(AMPLITUDE, 1.0)
    one.field.setFocus()
    one.turn(1, Qt.KeyboardModifier.ControlModifier)
    one.turn(-1, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(one.field, Qt.Key.Key_Up)
    assert one.values == [1.005, 1.0, 1.05]


def test_a_burst_of_steps_shares_one_gesture_until_a_pause(bench, qtbot):
    one = bench(AMPLITUDE, 1.0)
    one.field.setFocus()
    one.turn(2)
    for _ in range(3):
        QTest.keyClick(one.field, Qt.Key.Key_Down)
    assert len(one.edits) == 4
    assert len(one.gestures) == 1
    qtbot.waitUntil(lambda: not one.field.gestures.in_burst)
    QTest.keyClick(one.field, Qt.Key.Key_Up)
    assert len(one.gestures) == 2


def test_a_value_set_from_elsewhere_ends_a_burst(bench):
    one = bench(AMPLITUDE, 1.0)
    one.field.setFocus()
    one.turn(1)
    one.field.set_value(1.0)
    one.turn(1)
    assert len(one.gestures) == 2


@pytest.mark.parametrize(
    ("start", "keys", "values"),
    [
        (150.0, "uuuuuu", [152, 154, 156, 158, 160, 165]),
        (123.4567, "uud", [124, 126, 124]),
        (123.4567, "d", [122]),
        (40.0, "PPpC", [50, 60, 50, 50.1]),
        (640.0, "uu", [649]),
        (1.0, "ud", [1.02, 1.0]),
    ],
)
def test_steps_lead_to_round_numbers_about_two_percent_apart(bench, start, keys, values):
    one = bench(FREQUENCY, start)
    one.field.setFocus()
    press = {
        "u": (Qt.Key.Key_Up, Qt.KeyboardModifier.NoModifier),
        "d": (Qt.Key.Key_Down, Qt.KeyboardModifier.NoModifier),
        "P": (Qt.Key.Key_PageUp, Qt.KeyboardModifier.NoModifier),
        "p": (Qt.Key.Key_Down, Qt.KeyboardModifier.ShiftModifier),
        "C": (Qt.Key.Key_Up, Qt.KeyboardModifier.ControlModifier),
    }
    for key in keys:
        QTest.keyClick(one.field, *press[key])
    assert one.values == values


def test_wheel_drag_and_keys_make_the_same_numbers(bench):
    for way in ("keys", "wheel", "drag"):
        one = bench(FREQUENCY, 95.3)
        one.field.setFocus()
        if way == "keys":
            for _ in range(5):
                QTest.keyClick(one.field, Qt.Key.Key_Up)
        elif way == "wheel":
            one.turn(5)
        else:
            one.drag((5 * PIXELS_PER_STEP, 0))
        assert one.field.value_si == 104.0, way


@pytest.mark.parametrize(
    ("spec", "start", "shown"),
    [(DURATION, 0.123, "130"), (PHASE, 0.02, "5"), (AMPLITUDE, 0.333, "0.35")],
)
def test_a_step_makes_the_shown_number_round(bench, spec, start, shown):
    one = bench(spec, start)
    one.field.setFocus()
    QTest.keyClick(one.field, Qt.Key.Key_Up)
    assert one.field.text() == shown


def test_a_thousand_steps_up_and_down_keep_numbers_short():
    value = 1.0
    for direction in (1, -1):
        for _ in range(1000):
            value = stepped(value, direction, FREQUENCY)
            assert len(number_text(value, "Hz")) <= 4
    assert value == 1.0


def test_the_way_back_on_a_ladder_leads_to_its_anchor():
    ladder = Ladder(123.4567, FREQUENCY, PLAIN)
    way = [ladder.value_si(k) for k in (0, 3, -2, 0)]
    assert way == [123.4567, 128.0, 120.0, 123.4567]


def test_a_whole_number_takes_only_whole_steps(bench):
    one = bench(SEED, 0)
    one.field.setFocus()
    one.turn(1, Qt.KeyboardModifier.ControlModifier)
    one.turn(3)
    one.turn(-9)
    assert one.values == [1, 4, 0]
    one.type("1.5")
    assert "whole" in one.field.problem


@pytest.mark.parametrize("spec", [DURATION, FREQUENCY, PHASE, AMPLITUDE, SEED])
@pytest.mark.parametrize("size", [FINE, PLAIN, COARSE])
@pytest.mark.parametrize("direction", [1, -1])
def test_every_step_changes_the_value_and_stays_allowed(spec, size, direction):
    value = 0.5 * (max(spec.minimum, 1.0) + 3.0)
    value = float(round(value)) if spec.whole else value
    for _ in range(200):
        after = stepped(value, direction, spec, size)
        assert spec.minimum <= after <= spec.maximum
        assert after != value or after in (spec.minimum, spec.maximum)
        value = after


def test_keys_that_mean_nothing_to_a_number_are_left_to_the_panel(bench, qtbot):
    one = bench(AMPLITUDE, 1.0)
    heard = []
    one.keyPressEvent = lambda event: heard.append(event.text())
    one.field.setFocus()
    QTest.keyClicks(one.field, "ms")
    assert heard == ["m", "s"]
    assert not one.field.editing


def test_a_number_can_be_copied_and_pasted(bench):
    one = bench(DURATION, 0.1)
    other = bench(DURATION, 0.5)
    one.field.setFocus()
    QTest.keyClick(one.field, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QApplication.clipboard().text() == "100 ms"
    QTest.keyClick(other.field, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClick(other.field, Qt.Key.Key_Return)
    assert other.edits == [(0.1, None)]


def test_the_unit_can_change_with_the_design(bench):
    one = bench(AMPLITUDE, 1.0)
    one.field.set_spec(replace(AMPLITUDE, unit="×"))
    one.type("2 x")
    assert one.values == [2.0]
