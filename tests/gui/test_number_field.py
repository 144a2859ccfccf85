import math
from dataclasses import replace
from itertools import product

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QVBoxLayout, QWidget

from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource_gui.widgets.number_field import PIXELS_PER_STEP, NumberField
from skinsource_gui.widgets.number_steps import stepped
from skinsource_gui.widgets.units import display_unit, number_text, parse_number, value_text

# A tooltip raises its window, which an invisible screen cannot.
pytestmark = pytest.mark.qt_log_ignore("does not support raise", extend=True)

DURATION = NumberSpec(label="Duration", unit="s", minimum=0.001, maximum=600.0, step=0.01)
FREQUENCY = NumberSpec(
    label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, step=0.02, logarithmic=True
)
PHASE = NumberSpec(label="Phase", unit="rad", minimum=-2 * math.pi, maximum=2 * math.pi, step=0.1)
SEED = NumberSpec(label="Seed", minimum=0, maximum=2**31 - 1, whole=True)
AMPLITUDE = NumberSpec(label="Amplitude", unit="m/s²", minimum=-1000, maximum=1000, step=0.05)


class Bench(QWidget):
    """A field among others, and what it told."""

    def __init__(self, spec, value):
        super().__init__()
        layout = QVBoxLayout(self)
        self.field = NumberField(spec)
        self.field.set_value(value)
        self.other = QLineEdit()
        layout.addWidget(self.field)
        layout.addWidget(self.other)
        self.edits = []
        self.field.edited.connect(self._note)

    def _note(self, value, gesture):
        self.edits.append((value, gesture))

    @property
    def values(self):
        return [value for value, _ in self.edits]

    @property
    def gestures(self):
        return {gesture for _, gesture in self.edits}

    def type(self, text):
        self.field.setFocus()
        QTest.keyClicks(self.field, text)
        QTest.keyClick(self.field, Qt.Key.Key_Return)

    def drag(self, *points, modifiers=Qt.KeyboardModifier.NoModifier):
        start = self.field.rect().center()
        QTest.mousePress(self.field, Qt.MouseButton.LeftButton, modifiers, start)
        for point in points:
            here = QPointF(start + QPoint(*point))
            event = _move(self.field, here, modifiers)
            QApplication.sendEvent(self.field, event)
        QTest.mouseRelease(self.field, Qt.MouseButton.LeftButton, modifiers, start)

    def turn(self, notches, modifiers=Qt.KeyboardModifier.NoModifier):
        centre = QPointF(self.field.rect().center())
        event = QWheelEvent(
            centre,
            QPointF(self.field.mapToGlobal(centre.toPoint())),
            QPoint(),
            QPoint(0, 120 * notches),
            Qt.MouseButton.NoButton,
            modifiers,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        event.ignore()
        QApplication.sendEvent(self.field, event)
        return event.isAccepted()


def _move(widget, here, modifiers):
    return QMouseEvent(
        QEvent.Type.MouseMove,
        here,
        QPointF(widget.mapToGlobal(here.toPoint())),
        Qt.MouseButton.NoButton,
        Qt.MouseButton.LeftButton,
        modifiers,
    )


@pytest.fixture
def bench(qtbot):
    def make(spec, value):
        widget = Bench(spec, value)
        qtbot.addWidget(widget)
        widget.show()
        qtbot.waitExposed(widget)
        widget.activateWindow()
        widget.other.setFocus()
        qtbot.waitUntil(widget.other.hasFocus)
        return widget

    return make


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("250", 0.25),
        ("200 ms", 0.2),
        ("0.2 s", 0.2),
        ("0,2s", 0.2),
        ("  35  MS ", 0.035),
        ("1e2", 0.1),
        ("2 min", 120.0),
        ("1500 µs", 0.0015),
    ],
)
def test_times_are_understood_with_unit_without_and_with_a_decimal_comma(text, seconds):
    assert parse_number(text, DURATION) == seconds


@pytest.mark.parametrize(
    ("text", "spec", "value"),
    [
        ("0.1 kHz", FREQUENCY, 100.0),
        ("360", PHASE, 2 * math.pi),
        ("−180°", PHASE, -math.pi),
        ("0.5 pi", PHASE, math.pi / 2),
        ("300 mm/s²", AMPLITUDE, 0.3),
        ("-1.5 m/s^2", AMPLITUDE, -1.5),
        ("7", SEED, 7.0),
    ],
)
def test_other_units_are_understood(text, spec, value):
    assert parse_number(text, spec) == value


@pytest.mark.parametrize(
    ("text", "spec", "words"),
    [
        ("abc", FREQUENCY, "Frequency: “abc” is not a number. Allowed: 1 to 649 Hz."),
        ("", FREQUENCY, "nothing typed"),
        ("1.000,5", FREQUENCY, "is not one of its units"),
        ("nan", FREQUENCY, "is not a number"),
        ("700", FREQUENCY, "Frequency: 700 Hz is too high. Allowed: 1 to 649 Hz."),
        ("0", DURATION, "Duration: 0 ms is too low. Allowed: 1 to 600000 ms."),
        ("20 ms", FREQUENCY, "“ms” is not one of its units. Units: Hz, kHz."),
        ("1.5", SEED, "is not a whole number. Allowed: whole numbers 0 to 2147483647."),
        ("1e99", FREQUENCY, "too high"),
    ],
)
def test_what_is_not_allowed_is_refused_with_what_is(text, spec, words):
    with pytest.raises(InvalidInputError) as error:
        parse_number(text, spec)
    assert words in str(error.value)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.2, "s", "200 ms"),
        (21 / 1300, "s", "16.1538 ms"),
        (600.0, "s", "600000 ms"),
        (math.pi / 2, "rad", "90°"),
        (100.0, "Hz", "100 Hz"),
        (-0.25, "m/s²", "-0.25 m/s²"),
        (-1e-17, "", "-1e-17"),
        (2147483647.0, "", "2147483647"),
    ],
)
def test_values_are_shown_with_sensible_digits(value, unit, text):
    assert value_text(value, unit) == text


def test_any_shown_number_is_read_back_to_the_value_it_shows():
    for milliseconds in range(1, 2000):
        value = milliseconds / 1000
        assert parse_number(number_text(value, "s"), DURATION) == value


def test_enter_commits_what_was_typed_as_a_step_of_its_own(bench):
    one = bench(DURATION, 0.1)
    one.type("0,2 s")
    assert one.edits == [(0.2, None)]
    assert one.field.text() == "200"
    assert not one.field.editing


def test_escape_restores_the_number(bench):
    one = bench(DURATION, 0.1)
    one.field.setFocus()
    QTest.keyClicks(one.field, "77")
    assert one.field.text() == "77"
    QTest.keyClick(one.field, Qt.Key.Key_Escape)
    assert (one.field.text(), one.edits) == ("100", [])


def test_a_double_click_types_over_the_number(bench):
    one = bench(FREQUENCY, 100.0)
    QTest.mouseClick(one.field, Qt.MouseButton.LeftButton)
    assert not one.field.editing
    QTest.mouseDClick(one.field, Qt.MouseButton.LeftButton)
    assert one.field.editing
    QTest.keyClicks(one.field, "250")
    QTest.keyClick(one.field, Qt.Key.Key_Enter)
    assert one.edits == [(250.0, None)]


def test_what_is_not_allowed_is_not_committed_and_says_why(bench, qtbot):
    one = bench(FREQUENCY, 100.0)
    with qtbot.waitSignal(one.field.problem_changed):
        one.type("700")
    assert one.edits == []
    assert "1 to 649 Hz" in one.field.problem
    assert one.field.toolTip() == one.field.problem
    one.other.setFocus()
    qtbot.waitUntil(lambda: not one.field.editing)
    assert (one.field.text(), one.field.problem, one.edits) == ("100", "", [])


def test_the_reason_goes_as_soon_as_the_text_is_allowed(bench):
    one = bench(FREQUENCY, 100.0)
    one.type("700")
    assert one.field.problem
    QTest.keyClick(one.field, Qt.Key.Key_Backspace)
    assert not one.field.problem
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    assert one.edits == [(70.0, None)]


def test_leaving_the_field_commits_what_is_allowed(bench, qtbot):
    one = bench(FREQUENCY, 100.0)
    one.field.setFocus()
    QTest.keyClicks(one.field, "120")
    one.other.setFocus()
    qtbot.waitUntil(lambda: one.edits == [(120.0, None)])


def test_typing_what_is_shown_does_not_change_the_value(bench):
    one = bench(DURATION, 1 / 3)
    one.type(one.field.text())
    assert one.edits == []
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    assert (one.edits, one.field.value_si) == ([], 1 / 3)


def test_setting_the_value_tells_nobody_and_leaves_an_open_editor_alone(bench):
    one = bench(DURATION, 0.1)
    one.field.setFocus()
    QTest.keyClicks(one.field, "7")
    one.field.set_value(0.3)
    assert (one.field.text(), one.edits) == ("7", [])
    QTest.keyClick(one.field, Qt.Key.Key_Escape)
    assert one.field.text() == "300"


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
    move = _move(one.field, QPointF(start + QPoint(40, 0)), Qt.KeyboardModifier.NoModifier)
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
    assert one.values == [1.005, 0.505, 0.555]


def test_a_burst_of_steps_shares_one_gesture_until_a_pause(bench, qtbot):
    one = bench(AMPLITUDE, 1.0)
    one.field.setFocus()
    one.turn(2)
    for _ in range(3):
        QTest.keyClick(one.field, Qt.Key.Key_Down)
    assert len(one.edits) == 4
    assert len(one.gestures) == 1
    qtbot.waitUntil(lambda: not one.field.in_burst)
    QTest.keyClick(one.field, Qt.Key.Key_Up)
    assert len(one.gestures) == 2


def test_a_value_set_from_elsewhere_ends_a_burst(bench):
    one = bench(AMPLITUDE, 1.0)
    one.field.setFocus()
    one.turn(1)
    one.field.set_value(1.0)
    one.turn(1)
    assert len(one.gestures) == 2


def test_steps_of_a_logarithmic_number_multiply(bench):
    one = bench(FREQUENCY, 100.0)
    one.field.setFocus()
    for _ in range(35):
        QTest.keyClick(one.field, Qt.Key.Key_Up)
    assert one.values[0] == 102.0
    assert one.values[-1] == pytest.approx(200, rel=0.01)
    assert all(len(number_text(value, "Hz")) <= 5 for value in one.values)


def test_a_whole_number_takes_only_whole_steps(bench):
    one = bench(SEED, 0)
    one.field.setFocus()
    one.turn(1, Qt.KeyboardModifier.ControlModifier)
    one.turn(3)
    one.turn(-9)
    assert one.values == [1, 4, 0]
    one.type("1.5")
    assert "whole" in one.field.problem


@pytest.mark.parametrize(
    ("spec", "tenths"),
    [
        *product([DURATION, FREQUENCY, PHASE, AMPLITUDE], [10, -10, 100, 1]),
        *product([SEED], [10, -10, 100]),
    ],
)
def test_every_step_changes_the_value_and_stays_allowed(spec, tenths):
    value = 0.5 * (max(spec.minimum, 1.0) + 3.0)
    value = float(round(value)) if spec.whole else value
    for _ in range(200):
        after = stepped(value, tenths, spec, display_unit(spec.unit))
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
