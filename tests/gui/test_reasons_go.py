"""Why something was not taken over is said until somebody goes on, and no longer."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QPushButton, QVBoxLayout, QWidget

from skinsource.design.waveforms.samples import Formula
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.editors import FieldCell

FREQUENCY = NumberSpec(label="Frequency", unit="Hz", minimum=1.0, maximum=649.0)
FORMULA = Formula.__dataclass_fields__["text"].metadata["spec"]
TOO_LOW = "Frequency: −5 Hz is too low. Allowed: 1 to 649 Hz."
UNDO = (Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)


class Page(QWidget):
    """A cell, a line of text and a button below each other."""

    def __init__(self, spec, value):
        super().__init__()
        column = QVBoxLayout(self)
        self.cell, self.line, self.button = FieldCell("one", spec), QLineEdit(), QPushButton("A")
        for part in (self.cell, self.line, self.button):
            column.addWidget(part)
        self.cell.set_value(value)

    @property
    def note(self):
        return self.cell.note

    def type_wrong_and_click_on(self):
        self.cell.field.setFocus()
        self.cell.field.begin_editing("-5")
        QTest.mouseClick(self.line, Qt.MouseButton.LeftButton)
        QApplication.processEvents()


@pytest.fixture
def page(qtbot):
    def make(spec=FREQUENCY, value=100.0):
        page = Page(spec, value)
        qtbot.addWidget(page)
        page.show()
        page.activateWindow()
        qtbot.waitUntil(page.isActiveWindow)
        return page

    return make


def test_the_click_that_leaves_a_wrong_number_leaves_its_reason(page):
    one = page()
    one.type_wrong_and_click_on()
    assert (one.cell.field.text(), one.note) == ("100", TOO_LOW)


def test_who_types_on_in_the_next_field_can_still_read_it(page):
    one = page()
    one.type_wrong_and_click_on()
    QTest.keyClicks(one.line, "aB 1")
    assert one.note == TOO_LOW


@pytest.mark.parametrize("keys", [(Qt.Key.Key_Escape,), (Qt.Key.Key_Tab,), UNDO])
def test_a_key_that_does_something_else_takes_the_reason_away(page, keys):
    one = page()
    one.type_wrong_and_click_on()
    QTest.keyClick(one.line, *keys)
    assert (one.note, one.cell.field.problem) == ("", "")


def test_a_click_elsewhere_takes_the_reason_away_once_it_is_no_double_click(page, qtbot):
    one = page()
    one.type_wrong_and_click_on()
    clicked_at = one.button.pos()
    QTest.mouseClick(one.button, Qt.MouseButton.LeftButton)
    QApplication.processEvents()
    # The second click of two finds what the first one found.
    assert (one.note, one.button.pos()) == (TOO_LOW, clicked_at)
    qtbot.waitUntil(lambda: one.note == "")


def test_while_a_button_is_held_the_reason_stays_where_it_is(page, qtbot, monkeypatch):
    monkeypatch.setattr(QApplication, "doubleClickInterval", lambda: 1)
    one = page()
    one.type_wrong_and_click_on()
    held = [Qt.MouseButton.LeftButton]
    asked = []
    monkeypatch.setattr(QApplication, "mouseButtons", lambda: asked.append(1) or held[0])
    QTest.mousePress(one.button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: len(asked) > 3)
    assert one.note == TOO_LOW
    held[0] = Qt.MouseButton.NoButton
    qtbot.waitUntil(lambda: one.note == "")
    QTest.mouseRelease(one.button, Qt.MouseButton.LeftButton)


def test_what_was_refused_is_said_until_somebody_goes_on_whatever_is_shown_meanwhile(page):
    one = page()
    one.cell.show_reason("Too many.")
    QApplication.processEvents()
    # As when something is selected.
    one.cell.set_value(100.0)
    assert one.note == "Too many."
    QTest.keyClick(one.line, Qt.Key.Key_Escape)
    assert one.note == ""


def test_another_value_takes_away_why_one_was_refused(page):
    one = page()
    one.cell.show_reason("Too many.")
    one.cell.set_value(120.0)
    assert one.note == ""


def test_a_remark_on_the_value_comes_back_after_a_reason(page, qtbot):
    felt = NumberSpec(label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, felt_hz=(25, 600))
    one = page(felt, 610.0)
    remark = one.note
    assert "measured band" in remark
    one.cell.show_reason("Too many.")
    QApplication.processEvents()
    assert one.note == "Too many."
    QTest.mouseClick(one.button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: one.note == remark)


def test_a_refused_text_that_still_stands_there_keeps_its_reason_and_escape_takes_both(page):
    one = page(FORMULA, "1")
    one.cell.field.selectAll()
    QTest.keyClicks(one.cell.field, "1/t")
    reason = 'formula "1/t", column 2: / is infinite at 0 s, expected finite numbers'
    one.cell.show_reason(reason)
    QApplication.processEvents()
    QTest.mouseClick(one.button, Qt.MouseButton.LeftButton)
    one.cell.set_value("1")
    assert (one.cell.field.text(), one.note) == ("1/t", reason)
    QTest.keyClick(one.cell.field, Qt.Key.Key_Escape)
    assert (one.cell.field.text(), one.note) == ("1", "")


def test_a_refused_text_that_has_become_the_value_is_not_wrong_any_more(page):
    one = page(FORMULA, "1")
    one.cell.field.selectAll()
    QTest.keyClicks(one.cell.field, "1/t")
    one.cell.show_reason("column 2: / is infinite at 0 s")
    one.cell.set_value("1/t")
    assert (one.note, one.cell.field.extraSelections()) == ("", [])
