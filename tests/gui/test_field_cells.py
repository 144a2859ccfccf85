"""One editor for each kind of field, and breakpoints as a small curve."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.effects.level import POINTS
from skinsource.design.waveforms.samples import Formula
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, PlainSpec, SwitchSpec, TextSpec
from skinsource_gui.fields.curve_field import CurveField
from skinsource_gui.fields.editors import FieldCell, ValueLabel

FREQUENCY = NumberSpec(
    label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, measured_band_hz=(25.0, 600.0)
)


@pytest.fixture
def make_cell(qtbot):
    def make(spec, value):
        cell = FieldCell("one", spec)
        qtbot.addWidget(cell)
        cell.show()
        cell.set_value(value)
        cell.edits = []
        cell.edited.connect(lambda name, value, gesture: cell.edits.append((name, value)))
        return cell

    return make


def test_a_choice_is_chosen(make_cell):
    spec = ChoiceSpec(label="Size", options=(("s", "Small"), ("l", "Large")))
    cell = make_cell(spec, "s")
    QTest.keyClick(cell.field, Qt.Key.Key_Down)
    assert cell.edits == [("one", "l")]


def test_a_switch_is_switched_by_the_user_only(make_cell):
    cell = make_cell(SwitchSpec(label="Mute"), True)
    assert cell.field.isChecked()
    assert cell.edits == []
    QTest.keyClick(cell.field, Qt.Key.Key_Space)
    assert cell.edits == [("one", False)]


def test_a_text_is_told_once_when_it_is_finished_and_not_if_it_stays(make_cell):
    cell = make_cell(TextSpec(label="Name", longest=5, one_line=True), "a")
    QTest.keyClick(cell.field, Qt.Key.Key_Return)
    assert cell.edits == []
    QTest.keyClicks(cell.field, "bcdefgh")
    QTest.keyClick(cell.field, Qt.Key.Key_Return)
    assert cell.edits == [("one", "abcde")]
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
    assert [value for _, value in cell.edits] == ["t "]
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
    cell.resize(200, 60)
    flat = cell.field.height()
    cell.set_value("+".join(["sin(2*pi*100*t)"] * 8))
    assert cell.field.height() > 3 * flat / 2
    cell.field.selectAll()
    QApplication.clipboard().setText("1 +\n 2*t\n")
    cell.field.paste()
    assert cell.edits[-1] == ("one", "1 + 2*t")
    assert cell.field.height() == flat


def test_why_a_value_was_refused_is_said_until_the_field_is_used_again(make_cell):
    cell = make_cell(FREQUENCY, 610.0)
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
