"""Keys do what their page says, each one thing, in fields as well; texts name them rightly."""

from functools import partial
from itertools import product

import pytest
import shiboken6
from PySide6.QtCore import QEvent, Qt, QUrl
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QLineEdit, QTextBrowser

from skinsource_gui.fields.number_field import begins_typing, makes_step
from skinsource_gui.panels.skin.scale import key_step_db
from skinsource_gui.panels.skin.time import ScrubBar
from skinsource_gui.qt.keys import KEYS, MOUSE, SHORTCUTS, meaning_of
from skinsource_gui.shell.actions import ACTIONS
from skinsource_gui.shell.playing import Transport

_Key, _Held = Qt.Key, Qt.KeyboardModifier
SIGNS = [Qt.Key(ord(sign)) for sign in "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ+-=. "]
NAMED = [
    *(_Key.Key_Left, _Key.Key_Right, _Key.Key_Up, _Key.Key_Down, _Key.Key_Home, _Key.Key_End),
    *(_Key.Key_PageUp, _Key.Key_PageDown, _Key.Key_Return, _Key.Key_Enter, _Key.Key_Delete),
    *(_Key.Key_Backspace, _Key.Key_Insert, _Key.Key_Escape, _Key.Key_F2),
]
#: What stands on keys that Qt calls otherwise.
ON_KEYS = {
    **{"PgUp": "Page Up", "PgDown": "Page Down", "Ins": "Insert", "Del": "Delete"},
    **{"Return": "Enter", "-": "−"},
}
HELD = [
    _Held.NoModifier,
    _Held.ShiftModifier,
    _Held.ControlModifier,
    _Held.AltModifier,
    _Held.ControlModifier | _Held.ShiftModifier,
    _Held.AltModifier | _Held.ShiftModifier,
]


def claims(place):
    """What says of an event whether the widget takes it."""
    if place == "number":
        return lambda event: makes_step(event) or begins_typing(event)
    if place == "colour_bar":
        return lambda event: bool(key_step_db(event))
    return partial(meaning_of, place)


def keys_at(place):
    return [key for gesture in KEYS[place].gestures.values() for key in gesture.keys]


def test_a_widget_takes_the_keys_that_are_listed(qapp):
    for place in KEYS:
        takes = claims(place)
        keys = [
            QKeySequence(held.value | key.value).toString()
            for held in HELD
            for key in (*SIGNS, *NAMED)
            if takes(QKeyEvent(QEvent.Type.KeyPress, key, held))
        ]
        assert sorted(keys) == sorted(keys_at(place)), place


def test_no_shortcut_is_given_twice():
    keys = [key for spec in ACTIONS for key in spec.keys]
    assert len(keys) == len(set(keys))


def test_the_number_pad_means_what_the_other_keys_mean(qapp):
    held = _Held.KeypadModifier
    assert meaning_of("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_Plus, held)) == "zoom_in"
    assert meaning_of("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_B, held)) == ""


def test_a_single_key_is_called_what_stands_on_it():
    for gesture in (gesture for place in KEYS.values() for gesture in place.gestures.values()):
        if len(gesture.keys) == 1:
            *held, key = gesture.keys[0].split("+")
            assert gesture.shown == "+".join((*held, ON_KEYS.get(key, key)))


@pytest.mark.parametrize("part", [Transport, ScrubBar])
def test_tooltips_name_the_shortcut_that_an_action_has(qtbot, monkeypatch, part):
    monkeypatch.setitem(SHORTCUTS, "play", ("Ctrl+P",))
    widget = part()
    qtbot.addWidget(widget)
    tips = [button.toolTip() for button in widget.findChildren(QAbstractButton)]
    assert any("(Ctrl+P)" in tip for tip in tips)
    assert not any("(Space)" in tip for tip in tips)


def test_the_manual_is_the_readme_with_its_pages(window):
    window.do("show_manual")
    browser = window.findChild(QTextBrowser, "page_text")
    assert "Install and start" in browser.toPlainText()
    browser.setSource(QUrl("docs/limbs.md"))
    assert "pre_trigger_delay_s" in browser.toPlainText()


def test_the_keys_page_lists_each_gesture_and_the_key_of_each_action(window):
    window.do("show_keys")
    text = window.findChild(QTextBrowser, "page_text").toPlainText()
    for place in (*MOUSE.values(), *KEYS.values()):
        assert place.heading in text
        for gesture in place.gestures.values():
            assert gesture.shown in text
            assert gesture.effect in text
    for name, action in window.actions_by_name.items():
        keys = ", ".join(key.toString() for key in action.shortcuts())
        assert not keys or f"\n{keys}" in text, name


CONTROL = Qt.KeyboardModifier.ControlModifier
ACTION_KEYS = [key for spec in ACTIONS for key in spec.keys]
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
    assert {key for key in ACTION_KEYS if takes(field, key)} == OF_NUMBERS


def test_while_typing_only_the_keys_of_texts_stay_with_the_text(field):
    field.begin_editing("12")
    # Whether others take undo and redo is for the texts to say: see below.
    assert {key for key in ACTION_KEYS if takes(field, key)} <= OF_TEXTS
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
