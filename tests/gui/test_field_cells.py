"""One editor for each kind of field."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.waveforms.samples import Formula
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, PlainSpec, SwitchSpec, TextSpec
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
