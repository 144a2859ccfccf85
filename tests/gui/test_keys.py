"""Keys do what their page says, each one thing, and texts name them rightly."""

from functools import partial

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractButton, QTextBrowser

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
