"""One editor for each kind of field."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from skinsource.fields import ChoiceSpec, NumberSpec, PlainSpec, SwitchSpec, TextSpec
from skinsource_gui.widgets.fields.field_cell import FieldCell

FREQUENCY = NumberSpec(label="Frequency", unit="Hz", minimum=1.0, maximum=649.0)


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
