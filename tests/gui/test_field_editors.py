"""One editor for each kind of field; lists of numbers and points, typed; curves by mouse."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QToolButton

from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.level import POINTS as CURVE_POINTS
from skinsource.design.waveforms import Formula, Glide, WaveletTrain
from skinsource.signals.synthesis import curve_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import CurveSpec, ListSpec, NumberSpec
from skinsource.specs.spec import ChoiceSpec, PlainSpec, SwitchSpec, TextSpec
from skinsource_gui.fields.curve_field import CurveField
from skinsource_gui.fields.editors import FieldCell, GlideCurve, SweepDialog, ValueLabel
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.fields.units import numbers_text, points_text, read_numbers, read_points
from skinsource_gui.qt.resources import number_named

FREQUENCIES = specs_of(WaveletTrain)["frequencies_hz"]


POINTS = specs_of(Glide)["points"]


DELAYS = ListSpec(label="Delays", of=NumberSpec(label="Delay", unit="s", minimum=0, maximum=9))


@pytest.fixture
def make_cell(qtbot):
    def make(spec, value):
        cell = FieldCell("many", spec)
        qtbot.addWidget(cell)
        cell.edits = []
        cell.edited.connect(lambda name, value, gesture: cell.edits.append(value))
        cell.set_value(value)
        cell.show()
        qtbot.waitExposed(cell)
        cell.line = cell.field if isinstance(cell.field, LiveText) else cell.findChild(LiveText)
        if cell.line is not None:
            cell.line.setFocus()
            cell.line.moveCursor(QTextCursor.MoveOperation.End)
        return cell

    return make


@pytest.mark.parametrize(
    ("spec", "text", "values", "shown"),
    [
        (FREQUENCIES, "50 84.1 400", (50.0, 84.1, 400.0), "50, 84.1, 400"),
        (FREQUENCIES, "50;84,1;400", (50.0, 84.1, 400.0), "50, 84.1, 400"),
        (FREQUENCIES, "50 Hz, 0.4 kHz,", (50.0, 400.0), "50, 400"),
        # In a list all times are in milliseconds.
        (DELAYS, "0, 250, 2500, 3 s", (0.0, 0.25, 2.5, 3.0), "0, 250, 2500, 3000"),
        (
            POINTS,
            "0 60 0; 2500, 84.1, 1;",
            ((0.0, 60.0, 0.0), (2.5, 84.1, 1.0)),
            "0 60 0; 2500 84.1 1",
        ),
    ],
)
def test_lists_are_read_as_one_writes_them_and_shown_short(spec, text, values, shown):
    read, write = (read_points, points_text) if spec is POINTS else (read_numbers, numbers_text)
    assert read(text, spec) == values
    assert write(values, spec) == shown
    assert read(shown, spec) == values


@pytest.mark.parametrize(
    ("spec", "text", "reason"),
    [
        (FREQUENCIES, "50, x", "“x” is not a number"),
        (FREQUENCIES, "50, 0", "0 Hz is too low"),
        (FREQUENCIES, "", "0 typed. Allowed: 1 to 1000 numbers"),
        (POINTS, "0 60 0; 100 60", "“100 60” has 2 numbers. Each point has 3: time in ms"),
        (POINTS, "0 60 0", "1 typed. Allowed: 2 to 2000 points"),
        (POINTS, "100 60 0; 50 60 1", "50 comes after 100. Put the points in the order"),
        (POINTS, "0 60 0; 100 60 2", "2 is too high"),
    ],
)
def test_what_a_list_may_not_hold_is_refused_in_words(spec, text, reason):
    with pytest.raises(InvalidInputError, match=reason):
        (read_points if spec is POINTS else read_numbers)(text, spec)


def test_a_list_is_told_while_it_is_typed_and_stays_as_it_is_typed(make_cell):
    cell = make_cell(FREQUENCIES, (50.0, 84.1))
    assert cell.line.text() == "50, 84.1"
    QTest.keyClicks(cell.line, ",70")
    assert cell.edits[-1] == (50.0, 84.1, 70.0)
    cell.set_value((50.0, 84.1, 70.0))
    assert cell.line.text() == "50, 84.1,70"
    cell.set_value((60.0,))
    assert cell.line.text() == "60"


@pytest.mark.parametrize("end", [Qt.Key.Key_Escape, Qt.Key.Key_Tab])
def test_of_half_a_list_nothing_is_taken_and_esc_or_leaving_brings_it_back(make_cell, qtbot, end):
    cell, gestures = make_cell(FREQUENCIES, (50.0, 84.1)), set()
    cell.activateWindow()
    qtbot.waitUntil(cell.isActiveWindow)
    cell.edited.connect(lambda _name, value, _gesture: cell.set_value(value))
    cell.edited.connect(lambda _name, _value, gesture: gestures.add(gesture))
    QTest.keyClicks(cell.line, ", 90z")
    assert (50.0, 84.1, 90.0) in cell.edits
    assert cell.edits[-1] == (50.0, 84.1)
    assert cell.note == "Frequency: “z” is not one of its units. Units: Hz, kHz."
    # Together they undo as one step.
    assert len(gestures) == 1
    QTest.keyClick(cell.line, end)
    assert (cell.line.text(), cell.edits[-1], cell.note) == ("50, 84.1", (50.0, 84.1), "")


def test_a_sweep_replaces_the_list_once_it_is_accepted(qtbot, make_cell):
    cell = make_cell(FREQUENCIES, (400.0, 100.0, 50.0))
    cell.findChild(QToolButton, "sweep").click()
    dialog = cell.window().findChild(SweepDialog)
    qtbot.waitUntil(dialog.isVisible)
    assert dialog.values == (400.0, 141.4, 50.0)
    assert dialog.findChild(QLabel, "sweep_list").text() == "400, 141.4, 50 Hz"
    # Between near ones, more than tenths are needed.
    dialog.low.set_value(399.9)
    dialog.spacing.choose("linear")
    dialog.order.choose("up")
    assert dialog.findChild(QLabel, "sweep_list").text() == "399.9, 399.95, 400 Hz"
    assert cell.edits == []
    dialog.accept()
    assert cell.edits == [(399.9, 399.95, 400.0)]


def glide_cell(make_cell, points):
    """A cell whose owner takes over each edit, as the inspector does."""
    cell = make_cell(POINTS, points)
    cell.edited.connect(lambda _, value, __: cell.set_value(value))
    cell.curves = {
        name: cell.findChild(GlideCurve, f"{name}_curve") for name in ("frequency", "amplitude")
    }
    return cell


def test_a_point_that_is_dragged_moves_its_curve_and_not_the_other(make_cell):
    cell = glide_cell(make_cell, Glide().points)
    curve = cell.curves["frequency"]
    at = curve.place_of(1).toPoint()
    QTest.mousePress(curve, Qt.MouseButton.LeftButton, pos=at)
    for down_px in (4, 8):
        QTest.mouseMove(curve, at + QPoint(0, -down_px))
    QTest.mouseRelease(curve, Qt.MouseButton.LeftButton, pos=at + QPoint(0, -8))
    points = cell.edits[-1]
    assert curve_of(points, "frequency")[1][1] > 70.0
    assert curve_of(points, "amplitude") == curve_of(Glide().points, "amplitude")
    assert cell.line.text() == points_text(points, POINTS)


def test_a_new_point_stays_though_it_bends_nothing_yet(make_cell):
    cell = glide_cell(make_cell, ((0.0, 100.0, 1.0), (0.5, 100.0, 1.0)))
    curve = cell.curves["frequency"]
    between = ((curve.place_of(0) + curve.place_of(1)) / 2).toPoint()
    QTest.mousePress(curve, Qt.MouseButton.LeftButton, pos=between)
    assert len(curve.value) == 3
    QTest.mouseMove(curve, between + QPoint(0, 20))
    QTest.mouseRelease(curve, Qt.MouseButton.LeftButton, pos=between + QPoint(0, 20))
    bends = curve_of(cell.edits[-1], "frequency")
    assert len(bends) == 3
    assert bends[1][1] < 80.0
    assert bends[0][1] == bends[2][1] == 100.0


def test_times_of_points_are_shown_short_and_stay_exact_when_others_are_typed(make_cell):
    time = NumberSpec(label="Time", unit="s", minimum=0, maximum=9)
    gain = NumberSpec(label="Gain", minimum=0, maximum=4)
    spec = CurveSpec(label="Gain curve", x=time, y=gain, most=9)
    cell = make_cell(spec, ((0.509010598, 1.0), (0.917761532, 0.0)))
    assert cell.field.line.text() == "509.01 1; 917.76 0"
    cell.field.line.setPlainText("509.01 1; 917.76 2")
    assert cell.edits == [((0.509010598, 1.0), (0.917761532, 2.0))]
    cell.field.line.setPlainText("509.02 1; 917.76 2")
    assert cell.edits[1:] == [((0.50902, 1.0), (0.917761532, 2.0))]
    # Rounded, these would be one.
    cell.set_value(((0.509010598, 1.0), (0.509010599, 0.0)))
    assert cell.field.line.text() == "509.010598 1; 509.010599 0"


BAND = NumberSpec(
    label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, measured_band_hz=(25.0, 600.0)
)


def test_a_choice_is_chosen(make_cell):
    spec = ChoiceSpec(label="Size", options=(("s", "Small"), ("l", "Large")))
    cell = make_cell(spec, "s")
    QTest.keyClick(cell.field, Qt.Key.Key_Down)
    assert cell.edits == ["l"]


def test_a_switch_is_switched_by_the_user_only(make_cell):
    cell = make_cell(SwitchSpec(label="Mute"), True)
    assert cell.field.isChecked()
    assert cell.edits == []
    QTest.keyClick(cell.field, Qt.Key.Key_Space)
    assert cell.edits == [False]


def test_a_text_is_told_once_when_it_is_finished_and_not_if_it_stays(make_cell):
    cell = make_cell(TextSpec(label="Name", longest=5, one_line=True), "a")
    QTest.keyClick(cell.field, Qt.Key.Key_Return)
    assert cell.edits == []
    QTest.keyClicks(cell.field, "bcdefgh")
    QTest.keyClick(cell.field, Qt.Key.Key_Return)
    assert cell.edits == ["abcde"]
    QTest.keyClick(cell.field, Qt.Key.Key_Backspace)
    cell.forget_typing()
    assert cell.field.text() == "abcde"


def test_a_kind_of_field_without_an_editor_is_shown_and_never_taken_for_another_one(make_cell):
    cell = make_cell(PlainSpec(label="Shape"), (1.0, 2.0))
    assert type(cell.field) is ValueLabel
    assert cell.field.text() == "(1.0, 2.0)"
    assert cell.edits == []


FORMULA = Formula.__dataclass_fields__["text"].metadata["spec"]


def test_a_formula_that_cannot_be_read_says_why_under_it_and_marks_the_column(make_cell):
    cell = make_cell(FORMULA, "t")
    cell.field.moveCursor(QTextCursor.MoveOperation.End)
    QTest.keyClicks(cell.field, " + sim(t)")
    assert cell.edits == ["t "]
    assert cell.note == 'formula "t + sim(t)", column 5: found sim, expected sin'
    (mark,) = cell.field.extraSelections()
    assert (mark.cursor.selectionStart(), mark.cursor.selectionEnd()) == (4, 5)
    # Whoever shows the value that is kept meanwhile leaves what is typed.
    cell.set_value("t")
    assert cell.field.text() == "t + sim(t)"
    QTest.keyClick(cell.field, Qt.Key.Key_Escape)
    assert (cell.field.text(), cell.note, cell.field.extraSelections()) == ("t", "", [])
    assert len(cell.edits) == 1


def test_a_long_formula_is_wrapped_and_pasted_lines_become_one(make_cell):
    cell = make_cell(FORMULA, "t")
    assert cell.field.verticalScrollBar().maximum() == 0
    cell.resize(200, 60)
    flat = cell.field.height()
    cell.set_value("+".join(["sin(2*pi*100*t)"] * 8))
    assert cell.field.height() > 3 * flat / 2
    cell.field.selectAll()
    QApplication.clipboard().setText("1 +\n 2*t\n")
    cell.field.paste()
    assert cell.edits[-1] == "1 + 2*t"
    assert cell.field.height() == flat


def test_why_a_value_was_refused_is_said_until_the_field_is_used_again(make_cell):
    cell = make_cell(BAND, 610.0)
    remark = cell.note
    cell.show_reason("Too many.")
    # As when something is selected.
    cell.set_value(610.0)
    assert cell.note == "Too many."
    QTest.keyClick(cell.field, Qt.Key.Key_Up)
    assert cell.note == remark
    cell.show_reason("Too many.")
    cell.set_value(615.0)
    assert cell.note == remark


def test_a_refused_text_that_still_stands_there_keeps_its_reason_and_escape_takes_both(make_cell):
    cell = make_cell(FORMULA, "1")
    cell.field.selectAll()
    QTest.keyClicks(cell.field, "1/t")
    reason = 'formula "1/t", column 2: / is infinite at 0 s, expected finite numbers'
    cell.show_reason(reason)
    cell.set_value("1")
    assert (cell.field.text(), cell.note) == ("1/t", reason)
    QTest.keyClick(cell.field, Qt.Key.Key_Escape)
    assert (cell.field.text(), cell.note) == ("1", "")


START = ((0.0, 0.0, "straight"), (0.1, 1.0, "smooth"), (0.2, 0.5, "held"))


LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def field(qtbot):
    field = CurveField(CURVE_POINTS)
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


def test_a_number_of_the_table_has_the_limits_that_its_field_names():
    spec = number_named("length_of_part", maximum=3.0)
    assert (spec.minimum, spec.maximum, spec.step, spec.unit) == (0.001, 3.0, 0.1, "s")
