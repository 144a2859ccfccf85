"""One editor for each kind of field."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel

from skinsource.design.waveforms.samples import Formula
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, PlainSpec, SwitchSpec, TextSpec
from skinsource_gui.fields.editors import FieldCell

FREQUENCY = NumberSpec(
    label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, felt_hz=(25.0, 600.0)
)


@pytest.fixture
def cell(qtbot):
    def make(spec, value):
        cell = FieldCell("one", spec)
        qtbot.addWidget(cell)
        cell.show()
        cell.set_value(value)
        cell.told = []
        cell.edited.connect(lambda name, value, gesture: cell.told.append((name, value)))
        return cell

    return make


def test_a_number_is_typed(cell):
    one = cell(FREQUENCY, 100.0)
    QTest.keyClicks(one.field, "250")
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    assert one.told == [("one", 250.0)]


def test_a_choice_is_chosen(cell):
    spec = ChoiceSpec(label="Size", options=(("s", "Small"), ("l", "Large")))
    one = cell(spec, "s")
    QTest.keyClick(one.field, Qt.Key.Key_Down)
    assert one.told == [("one", "l")]


def test_a_switch_is_switched_by_the_user_only(cell):
    one = cell(SwitchSpec(label="Mute"), True)
    assert one.field.isChecked()
    assert one.told == []
    QTest.keyClick(one.field, Qt.Key.Key_Space)
    assert one.told == [("one", False)]


def test_a_text_is_told_once_when_it_is_finished_and_not_if_it_stays(cell):
    one = cell(TextSpec(label="Name", longest=5, one_line=True), "a")
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    assert one.told == []
    QTest.keyClicks(one.field, "bcdefgh")
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    assert one.told == [("one", "abcde")]
    QTest.keyClick(one.field, Qt.Key.Key_Backspace)
    one.forget_typing()
    assert one.field.text() == "abcde"


def test_a_frequency_outside_the_measured_band_is_remarked_on(cell):
    assert "measured band" in cell(FREQUENCY, 610.0).note
    assert cell(FREQUENCY, 600.0).note == ""
    assert cell(NumberSpec(label="Length", unit="s", maximum=700.0), 610.0).note == ""


def test_a_kind_of_field_without_an_editor_is_shown_and_never_taken_for_another_one(cell):
    one = cell(PlainSpec(label="Shape"), (1.0, 2.0))
    assert type(one.field) is QLabel
    assert one.field.text() == "(1.0, 2.0)"
    assert one.told == []


FORMULA = Formula.__dataclass_fields__["text"].metadata["spec"]


def test_a_formula_is_told_with_each_key_that_leaves_it_readable(cell):
    one = cell(FORMULA, "t")
    one.field.moveCursor(QTextCursor.MoveOperation.End)
    QTest.keyClicks(one.field, "+12")
    assert [value for _, value in one.told] == ["t+1", "t+12"]
    assert one.note == ""
    assert one.field.text() == "t+12"


def test_a_formula_that_cannot_be_read_says_why_under_it_and_marks_the_column(cell):
    one = cell(FORMULA, "t")
    one.field.moveCursor(QTextCursor.MoveOperation.End)
    QTest.keyClicks(one.field, " + sim(t)")
    assert [value for _, value in one.told] == ["t "]
    assert one.note == 'formula "t + sim(t)", column 5: found sim, expected sin'
    (mark,) = one.field.extraSelections()
    assert (mark.cursor.selectionStart(), mark.cursor.selectionEnd()) == (4, 5)
    # Whoever shows the value that is kept meanwhile leaves what is typed.
    one.set_value("t")
    assert one.field.text() == "t + sim(t)"
    QTest.keyClick(one.field, Qt.Key.Key_Escape)
    assert (one.field.text(), one.note, one.field.extraSelections()) == ("t", "", [])
    assert len(one.told) == 1


def test_a_formula_that_is_refused_stays_as_it_is_typed(cell):
    one = cell(FORMULA, "t")
    one.field.selectAll()
    QTest.keyClicks(one.field, "1")
    one.set_value("1")
    QTest.keyClicks(one.field, "/t")
    assert one.told[-1] == ("one", "1/t")
    one.set_value("1")
    one.show_reason('formula "1/t", column 2: / is infinite at 0 s, expected finite numbers')
    assert one.field.text() == "1/t"
    assert one.field.extraSelections()[0].cursor.selectionEnd() == 2
    QTest.keyClicks(one.field, "+")
    QTest.keyClick(one.field, Qt.Key.Key_Backspace)
    assert "column" not in one.note
    one.set_value("another")
    assert one.field.text() == "another"


def test_quick_keys_of_a_formula_are_one_gesture_until_enter(cell, qtbot):
    one = cell(FORMULA, "t")
    gestures = []
    one.edited.connect(lambda name, value, gesture: gestures.append(gesture))
    one.field.moveCursor(QTextCursor.MoveOperation.End)
    QTest.keyClicks(one.field, "+12")
    QTest.keyClick(one.field, Qt.Key.Key_Return)
    QTest.keyClicks(one.field, "3")
    assert one.field.text() == "t+123"
    assert gestures[0] == gestures[1] != gestures[2]
    assert None not in gestures


def test_a_long_formula_is_wrapped_and_pasted_lines_become_one(cell):
    one = cell(FORMULA, "t")
    one.resize(200, 60)
    flat = one.field.height()
    one.set_value("+".join(["sin(2*pi*100*t)"] * 8))
    assert one.field.height() > 3 * flat / 2
    one.field.selectAll()
    QApplication.clipboard().setText("1 +\n 2*t\n")
    one.field.paste()
    assert one.told[-1] == ("one", "1 + 2*t")
    assert one.field.height() == flat
