"""A number is changed by dragging, the wheel and keys."""

import math
from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource_gui.fields.number_field import PIXELS_PER_STEP
from skinsource_gui.fields.units import COARSE, FINE, PLAIN, stepped
from tests.gui.number_field.bench import AMPLITUDE, DURATION, FREQUENCY, PHASE, SEED, move_event


def test_all_edits_of_a_drag_share_one_gesture_and_the_way_back_is_exact(make_bench):
    bench = make_bench(FREQUENCY, 123.4567)
    way = [(10 * k, 0) for k in range(1, 11)]
    bench.drag(*way, *reversed(way), (0, 0))
    assert bench.values[0] > 123.4567
    assert max(bench.values) > 180
    assert bench.values[-1] == 123.4567
    assert len(bench.gestures) == 1
    assert None not in bench.gestures
    first = bench.gestures
    bench.edits.clear()
    bench.drag((20, 0))
    assert bench.gestures.isdisjoint(first)


def test_a_drag_up_raises_and_ctrl_makes_it_fine(make_bench):
    bench = make_bench(AMPLITUDE, 1.0)
    bench.drag((0, -10 * PIXELS_PER_STEP))
    assert bench.field.value_si == 1.5
    bench.drag((0, 10 * PIXELS_PER_STEP), modifiers=Qt.KeyboardModifier.ControlModifier)
    assert bench.field.value_si == 1.45


def test_a_drag_stops_at_the_range_and_turns_back_at_once(make_bench):
    bench = make_bench(AMPLITUDE, 999.9)
    bench.drag((400, 0), (400 - PIXELS_PER_STEP, 0))
    assert bench.values == [1000.0, 999.95]


def test_escape_during_a_drag_brings_back_the_number_in_the_same_gesture(make_bench):
    bench = make_bench(AMPLITUDE, 1.0)
    start = bench.field.rect().center()
    QTest.mousePress(bench.field, Qt.MouseButton.LeftButton, pos=start)
    move = move_event(bench.field, QPointF(start + QPoint(40, 0)), Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(bench.field, move)
    QTest.keyClick(bench.field, Qt.Key.Key_Escape)
    QTest.mouseRelease(bench.field, Qt.MouseButton.LeftButton, pos=start)
    assert bench.values == [1.5, 1.0]
    assert len(bench.gestures) == 1


def test_the_wheel_changes_nothing_unless_the_field_has_the_focus(make_bench):
    bench = make_bench(AMPLITUDE, 1.0)
    assert not bench.turn(1)
    assert bench.edits == []
    QTest.mouseClick(bench.field, Qt.MouseButton.LeftButton)
    assert bench.turn(1)
    assert bench.values == [1.05]


def test_ctrl_makes_steps_fine_and_shift_coarse(make_bench):
    bench = make_bench(AMPLITUDE, 1.0)
    bench.field.setFocus()
    bench.turn(1, Qt.KeyboardModifier.ControlModifier)
    bench.turn(-1, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(bench.field, Qt.Key.Key_Up)
    assert bench.values == [1.005, 1.0, 1.05]


def test_a_burst_of_steps_shares_one_gesture_until_a_pause(make_bench, qtbot):
    bench = make_bench(AMPLITUDE, 1.0)
    bench.field.setFocus()
    bench.turn(2)
    for _ in range(3):
        QTest.keyClick(bench.field, Qt.Key.Key_Down)
    assert len(bench.edits) == 4
    assert len(bench.gestures) == 1
    # A value that is set from elsewhere ends it, too.
    bench.field.set_value(3.0)
    bench.turn(1)
    assert len(bench.gestures) == 2
    qtbot.waitUntil(lambda: not bench.field.burst.active)
    QTest.keyClick(bench.field, Qt.Key.Key_Up)
    assert len(bench.gestures) == 3


@pytest.mark.parametrize(
    ("spec", "start", "keys", "values"),
    [
        (FREQUENCY, 150.0, "uuuuuu", [152, 154, 156, 158, 160, 165]),
        (FREQUENCY, 123.4567, "uud", [124, 126, 124]),
        (FREQUENCY, 40.0, "PPpC", [50, 60, 50, 50.1]),
        (FREQUENCY, 640.0, "uu", [649]),
        (DURATION, 0.123, "u", [0.13]),
        (PHASE, 0.02, "u", [pytest.approx(math.radians(5))]),
    ],
)
def test_steps_lead_to_round_numbers(make_bench, spec, start, keys, values):
    bench = make_bench(spec, start)
    bench.field.setFocus()
    press = {
        "u": (Qt.Key.Key_Up, Qt.KeyboardModifier.NoModifier),
        "d": (Qt.Key.Key_Down, Qt.KeyboardModifier.NoModifier),
        "P": (Qt.Key.Key_PageUp, Qt.KeyboardModifier.NoModifier),
        "p": (Qt.Key.Key_Down, Qt.KeyboardModifier.ShiftModifier),
        "C": (Qt.Key.Key_Up, Qt.KeyboardModifier.ControlModifier),
    }
    for key in keys:
        QTest.keyClick(bench.field, *press[key])
    assert bench.values == values


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
        assert after.is_integer() or not spec.whole
        value = after


def test_keys_that_mean_nothing_to_a_number_are_left_to_the_panel(make_bench, qtbot):
    bench = make_bench(AMPLITUDE, 1.0)
    keys = []
    bench.keyPressEvent = lambda event: keys.append(event.text())
    bench.field.setFocus()
    QTest.keyClicks(bench.field, "ms")
    assert keys == ["m", "s"]
    assert not bench.field.editing


def test_a_number_can_be_copied_and_pasted(make_bench):
    bench = make_bench(DURATION, 0.1)
    other = make_bench(DURATION, 0.5)
    bench.field.setFocus()
    QTest.keyClick(bench.field, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QApplication.clipboard().text() == "100 ms"
    QTest.keyClick(other.field, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClick(other.field, Qt.Key.Key_Return)
    assert other.edits == [(0.1, None)]


def test_the_unit_can_change_with_the_design(make_bench):
    bench = make_bench(AMPLITUDE, 1.0)
    bench.field.set_spec(replace(AMPLITUDE, unit="×"))
    bench.type("2 x")
    assert bench.values == [2.0]
