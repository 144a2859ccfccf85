"""A number is typed, dragged, turned and stepped, and shown in the room that it has."""

import math
from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QVBoxLayout, QWidget

from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.time import TO
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields import units
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.number_field import PIXELS_PER_STEP, NumberField, fitting_text
from tests.gui.wheel import NOTCH, turn_wheel

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
            event = move_event(self.field, here, modifiers)
            QApplication.sendEvent(self.field, event)
        QTest.mouseRelease(self.field, Qt.MouseButton.LeftButton, modifiers, start)

    def turn(self, notches, modifiers=Qt.KeyboardModifier.NoModifier):
        return turn_wheel(self.field, self.field.rect().center(), (0, NOTCH * notches), modifiers)


def move_event(widget, here, modifiers):
    return QMouseEvent(
        QEvent.Type.MouseMove,
        here,
        QPointF(widget.mapToGlobal(here.toPoint())),
        Qt.MouseButton.NoButton,
        Qt.MouseButton.LeftButton,
        modifiers,
    )


@pytest.fixture
def make_bench(qtbot):
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


ANYTHING = NumberSpec(label="Offset", minimum=-math.inf, maximum=math.inf)


@pytest.mark.parametrize(
    ("text", "spec", "value"),
    [
        ("250", DURATION, 0.25),
        ("0,2s", DURATION, 0.2),
        ("  35  MS ", DURATION, 0.035),
        ("1e2", DURATION, 0.1),
        ("2 min", DURATION, 120.0),
        ("1500 µs", DURATION, 0.0015),
        ("0.1 kHz", FREQUENCY, 100.0),
        ("−180°", PHASE, -math.pi),
        ("0.5 pi", PHASE, math.pi / 2),
        ("300 mm/s²", AMPLITUDE, 0.3),
        ("7", SEED, 7.0),
        ("−20 dB", AMPLITUDE, -0.1),
        ("6,0db", replace(ANYTHING, label="Input gain"), -(10**0.3)),
    ],
)
def test_numbers_are_read_with_any_unit_of_theirs_and_with_a_decimal_comma(text, spec, value):
    # A level keeps the polarity.
    assert units.parse_level(text, spec, -1.0) == value


@pytest.mark.parametrize(
    ("text", "spec", "reason"),
    [
        ("", FREQUENCY, "nothing typed"),
        ("1.000,5", FREQUENCY, "Frequency: “1.000,5” is not a number. Allowed: 1 to 649 Hz."),
        ("1 000", FREQUENCY, "“1 000” is not a number"),
        ("nan", FREQUENCY, "is not a number"),
        ("700", FREQUENCY, "700 Hz is too high"),
        ("0", DURATION, "0 ms is too low. Allowed: 1 ms to 600 s."),
        ("20 ms", FREQUENCY, "“ms” is not one of its units. Units: Hz, kHz."),
        ("1.5", SEED, "is not a whole number. Allowed: whole numbers 0 to 2147483647."),
        ("-1e999 s", DURATION, "is too low"),
        ("1e999999999", ANYTHING, "1e999999999 is too high. Allowed: any number."),
        ("1e-999999999", DURATION, "is too low"),
        ("9" * 400, AMPLITUDE, "too long"),
        ("61 dB", AMPLITUDE, "is too high. Allowed: −1000 to 1000 m/s²."),
        ("6 dB", FREQUENCY, "“dB” is not one of its units"),
        ("9" * 5000, AMPLITUDE, "too long"),
    ],
)
def test_what_is_not_allowed_is_refused_with_what_is(text, spec, reason):
    with pytest.raises(InvalidInputError) as error:
        units.parse_level(text, spec, 1.0)
    assert reason in str(error.value)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.2, "s", "200 ms"),
        (21 / 1300, "s", "16.1538 ms"),
        (0.999, "s", "999 ms"),
        (1.0, "s", "1000 ms"),
        (-12.5, "s", "-12.5 s"),
        (math.pi / 2, "rad", "90°"),
        (-1e-17, "", "-1e-17"),
        (2147483647.0, "", "2147483647"),
    ],
)
def test_values_are_shown_with_sensible_digits(value, unit, text):
    assert units.value_text(value, unit) == text


def test_any_shown_number_is_read_back_to_the_value_it_shows():
    for milliseconds in range(1, 2000):
        value = milliseconds / 1000
        assert units.parse_number(units.number_text(value, "s"), DURATION, value) == value


def test_further_clicks_select_all_of_the_number_again(make_bench):
    bench = make_bench(FREQUENCY, 100.5)
    left, at = Qt.MouseButton.LeftButton, bench.field.rect().center()
    for click in (QTest.mouseDClick, QTest.mouseClick, QTest.mouseDClick):
        click(bench.field, left, pos=at)
        assert bench.field.selectedText() == bench.field.text()


def test_a_double_click_types_over_the_number(make_bench):
    bench = make_bench(FREQUENCY, 100.0)
    QTest.mouseClick(bench.field, Qt.MouseButton.LeftButton)
    assert not bench.field.editing
    QTest.mouseDClick(bench.field, Qt.MouseButton.LeftButton)
    assert bench.field.editing
    QTest.keyClicks(bench.field, "250")
    QTest.keyClick(bench.field, Qt.Key.Key_Enter)
    assert bench.edits == [(250.0, None)]


def test_what_is_not_allowed_is_not_committed_and_says_why(make_bench, qtbot):
    bench = make_bench(FREQUENCY, 100.0)
    with qtbot.waitSignal(bench.field.problem_changed):
        bench.type("700")
    assert bench.edits == []
    assert "1 to 649 Hz" in bench.field.problem
    assert bench.field.toolTip() == bench.field.problem
    QTest.keyClick(bench.field, Qt.Key.Key_Backspace)
    assert not bench.field.problem
    QTest.keyClicks(bench.field, "0")
    bench.other.setFocus()
    qtbot.waitUntil(lambda: not bench.field.editing)
    assert (bench.field.text(), bench.field.problem, bench.edits) == ("100", "", [])
    # What is allowed is committed when the field is left.
    bench.field.setFocus()
    QTest.keyClicks(bench.field, "120")
    bench.other.setFocus()
    qtbot.waitUntil(lambda: bench.edits == [(120.0, None)])


def test_why_it_was_not_allowed_stands_below_the_field_until_there_is_another_value(qtbot):
    def left_wrong(leave):
        cell.field.setFocus()
        cell.field.begin_editing("-5")
        cell.field.clearFocus()
        assert cell.note == "Frequency: −5 Hz is too low. Allowed: 1 to 649 Hz."
        assert not cell.field.editing
        assert cell.field.value_si == value_si
        leave()
        assert cell.note == ""

    cell = FieldCell("frequency_hz", FREQUENCY)
    qtbot.addWidget(cell)
    cell.show()
    cell.activateWindow()
    qtbot.waitUntil(cell.isActiveWindow)
    value_si = cell.field.value_si
    left_wrong(cell.field.begin_editing)
    left_wrong(cell.forget_typing)
    left_wrong(lambda: cell.set_value(120.0))
    value_si = 120.0
    left_wrong(lambda: QTest.keyClick(cell.field, Qt.Key.Key_Up))


def test_typing_what_is_shown_does_not_change_the_value(make_bench):
    bench = make_bench(DURATION, 1 / 3)
    bench.type(bench.field.text())
    assert bench.edits == []
    QTest.keyClick(bench.field, Qt.Key.Key_Return)
    QTest.keyClick(bench.field, Qt.Key.Key_Return)
    assert (bench.edits, bench.field.value_si) == ([], 1 / 3)


def test_setting_the_value_tells_nobody_and_leaves_an_open_editor_alone(make_bench):
    bench = make_bench(DURATION, 0.1)
    bench.field.setFocus()
    QTest.keyClicks(bench.field, "7")
    bench.field.set_value(0.3)
    assert (bench.field.text(), bench.edits) == ("7", [])
    QTest.keyClick(bench.field, Qt.Key.Key_Escape)
    assert bench.field.text() == "300"
    # Without the keyboard nothing is being typed.
    bench.other.setFocus()
    bench.field.begin_editing()
    bench.field.set_value(0.4)
    assert bench.field.text() == "400"


@pytest.mark.parametrize("value", [2.45678, -2.45, 649.5, 0.0123])
def test_a_number_with_too_little_room_is_never_shown_as_another_one(make_bench, value):
    shown = make_bench(AMPLITUDE, value)
    metrics = shown.field.fontMetrics()
    texts = {fitting_text(value, AMPLITUDE, metrics, room_px) for room_px in range(60)}
    assert "…" in texts
    for text in texts - {"…"}:
        assert metrics.horizontalAdvance(text) <= 60
        read = float(text.removeprefix("≈").replace("−", "-"))
        assert read == pytest.approx(value, rel=0.3 if text.startswith("≈") else 0.005)


def test_a_long_time_is_shown_typed_and_copied_in_seconds(make_bench):
    bench = make_bench(DURATION, 0.2)
    for typed, value_si in (("2.5 s", 2.5), ("300", 0.3), ("20 s", 20.0), ("12.5", 12.5)):
        bench.type(typed)
        assert bench.edits[-1] == (value_si, None)
    assert bench.field.text() == "12.5"
    QTest.keyClick(bench.field, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QApplication.clipboard().text() == "12.5 s"
    bench.type("601")
    assert bench.field.problem == "Duration: 601 s is too high. Allowed: 1 ms to 600 s."


def test_words_stand_in_place_of_a_0_that_is_no_number_where_there_is_room(make_bench):
    bench = make_bench(TO, 0.0)
    field = bench.field
    assert (field.text(), field.unit_text) == ("by factor", "")
    field.setFocus()
    field.begin_editing()
    assert (field.text(), field.unit_text) == ("0", "ms")
    field.setText("250")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert field.value_si == 0.25
    field.set_value(0.0)
    field.setFixedWidth(60)
    assert field.text() == "0"


@pytest.mark.parametrize("width_px", [400, 84])
def test_a_narrow_field_never_hides_the_first_digit(make_bench, width_px):
    bench = make_bench(AMPLITUDE, -999.995)
    field = bench.field
    field.setStyleSheet("QLineEdit { padding: 0 4px; }")
    field.setFixedWidth(width_px)
    QApplication.processEvents()
    field.end(False)
    assert field.cursorPositionAt(QPoint(1, field.height() // 2)) == 0, field.text()
    assert (field.text() == "…") is (width_px == 84)


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
    qtbot.waitUntil(lambda: not bench.field.burst._pause.isActive())
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
@pytest.mark.parametrize("size", [units.FINE, units.PLAIN, units.COARSE])
@pytest.mark.parametrize("direction", [1, -1])
def test_every_step_changes_the_value_and_stays_allowed(spec, size, direction):
    value = 0.5 * (max(spec.minimum, 1.0) + 3.0)
    value = float(round(value)) if spec.whole else value
    for _ in range(200):
        after = units.stepped(value, direction, spec, size)
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
