"""A 0 that is no number is said in words."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource.design.effects.time import TO


def test_words_stand_in_place_of_a_0_that_is_none(make_bench):
    around = make_bench(TO, 0.0)
    field = around.field
    assert field.text() == "by factor"
    assert field.unit_text == ""
    field.set_value(0.4)
    assert field.text() == "400"
    assert field.unit_text == "ms"


def test_such_a_0_is_typed_and_copied_as_a_number(make_bench):
    around = make_bench(TO, 0.0)
    field = around.field
    field.setFocus()
    field.begin_editing()
    assert field.text() == "0"
    assert field.unit_text == "ms"
    field.setText("250")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert field.value_si == 0.25


def test_where_words_have_no_room_the_number_stands(make_bench):
    around = make_bench(TO, 0.0)
    field = around.field
    field.setFixedWidth(60)
    assert field.text() == "0"
