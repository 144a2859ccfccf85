from itertools import product

import pytest
import shiboken6
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit

from skinsource_gui.shell.actions import ACTIONS

CONTROL = Qt.KeyboardModifier.ControlModifier
KEYS = [key for spec in ACTIONS for key in spec.keys]
OF_NUMBERS = {"Ctrl+C", "Ctrl+V"}
OF_TEXTS = {"Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+Y", "Ctrl+Backspace", "Ctrl+X", *OF_NUMBERS}


@pytest.fixture
def field(window, qtbot):
    """The field of the frequency, with the keyboard."""
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    field = window.panel("inspector").findChild(QLineEdit, "frequency_hz_field")
    field.setFocus()
    return field


def takes(field, key):
    """Whether the field wants the key for itself."""
    combination = QKeySequence(key)[0]
    event = QKeyEvent(
        QKeyEvent.Type.ShortcutOverride, combination.key(), combination.keyboardModifiers(), ""
    )
    event.ignore()
    QApplication.sendEvent(field, event)
    return event.isAccepted()


def test_every_shortcut_but_copy_and_paste_works_from_a_number_at_rest(field):
    assert {key for key in KEYS if takes(field, key)} == OF_NUMBERS


def test_while_typing_only_the_keys_of_texts_stay_with_the_text(field):
    field.begin_editing("12")
    # Whether others take undo and redo is for the texts to say: see below.
    assert {key for key in KEYS if takes(field, key)} <= OF_TEXTS
    assert not field.isReadOnly()


def test_undo_in_a_number_that_is_only_selected_takes_back_the_last_edit(window, field):
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=2.0))
    field.begin_editing()
    QTest.keyClick(field, Qt.Key.Key_Z, CONTROL)
    assert window.document.design.inputs[0].amplitude == 1.0
    assert field.isReadOnly()


class GreedyLine(QLineEdit):
    """A line of text as on desktops where nearly every key with Ctrl moves in the text."""

    def event(self, event):
        if event.type() == QKeyEvent.Type.ShortcutOverride:
            event.accept()
            return True
        return super().event(event)


def test_shortcuts_work_on_desktops_where_lines_of_text_want_them(window, field):
    for read_only, key in product((True, False), ("Ctrl+E", "Ctrl+K", "Ctrl+D", "Ctrl+T")):
        line = GreedyLine(window, readOnly=read_only)
        line.show()
        assert takes(line, key)
        line.setFocus()
        assert not takes(line, key), (read_only, key)
        field.setFocus()
        assert takes(line, key)


def test_a_field_that_dies_with_the_keyboard_leaves_the_next_one_watched(window, field):
    dying, following = GreedyLine(window), GreedyLine(window)
    for line in (dying, following):
        line.show()
    dying.setFocus()
    shiboken6.delete(dying)
    following.setFocus()
    assert not takes(following, "Ctrl+E")
