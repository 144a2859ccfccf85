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
def make_page(qtbot):
    def make(spec=FREQUENCY, value=100.0):
        page = Page(spec, value)
        qtbot.addWidget(page)
        page.show()
        page.activateWindow()
        qtbot.waitUntil(page.isActiveWindow)
        return page

    return make


def test_the_click_that_leaves_a_wrong_number_leaves_its_reason(make_page):
    page = make_page()
    page.type_wrong_and_click_on()
    assert (page.cell.field.text(), page.note) == ("100", TOO_LOW)


@pytest.mark.parametrize("keys", [(Qt.Key.Key_Escape,), (Qt.Key.Key_Tab,), UNDO])
def test_a_key_that_does_something_else_takes_the_reason_away(make_page, keys):
    page = make_page()
    page.type_wrong_and_click_on()
    QTest.keyClick(page.line, *keys)
    assert (page.note, page.cell.field.problem) == ("", "")


def test_a_click_elsewhere_takes_the_reason_away_once_it_is_no_double_click(make_page, qtbot):
    page = make_page()
    page.type_wrong_and_click_on()
    clicked_at = page.button.pos()
    QTest.mouseClick(page.button, Qt.MouseButton.LeftButton)
    QApplication.processEvents()
    # The second click of two finds what the first one found.
    assert (page.note, page.button.pos()) == (TOO_LOW, clicked_at)
    qtbot.waitUntil(lambda: page.note == "")


def test_what_was_refused_is_said_until_somebody_goes_on_whatever_is_shown_meanwhile(make_page):
    page = make_page()
    page.cell.show_reason("Too many.")
    QApplication.processEvents()
    # As when something is selected.
    page.cell.set_value(100.0)
    assert page.note == "Too many."
    QTest.keyClick(page.line, Qt.Key.Key_Escape)
    assert page.note == ""


def test_a_remark_on_the_value_comes_back_after_a_reason(make_page, qtbot):
    spec = NumberSpec(
        label="Frequency", unit="Hz", minimum=1.0, maximum=649.0, measured_band_hz=(25, 600)
    )
    page = make_page(spec, 610.0)
    remark = page.note
    assert "measured band" in remark
    page.cell.show_reason("Too many.")
    QApplication.processEvents()
    assert page.note == "Too many."
    QTest.mouseClick(page.button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: page.note == remark)


def test_a_refused_text_that_still_stands_there_keeps_its_reason_and_escape_takes_both(make_page):
    page = make_page(FORMULA, "1")
    page.cell.field.selectAll()
    QTest.keyClicks(page.cell.field, "1/t")
    reason = 'formula "1/t", column 2: / is infinite at 0 s, expected finite numbers'
    page.cell.show_reason(reason)
    QApplication.processEvents()
    QTest.mouseClick(page.button, Qt.MouseButton.LeftButton)
    page.cell.set_value("1")
    assert (page.cell.field.text(), page.note) == ("1/t", reason)
    QTest.keyClick(page.cell.field, Qt.Key.Key_Escape)
    assert (page.cell.field.text(), page.note) == ("1", "")
