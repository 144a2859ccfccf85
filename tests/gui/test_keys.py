"""Keys do what their page says, each one thing, and texts name them rightly."""

from functools import partial

import pytest
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QTextBrowser, QToolButton, QWidget

from skinsource_gui.panels.hand.site_keys import SiteKeys
from skinsource_gui.panels.skin.scale.range_handle import key_step_db
from skinsource_gui.panels.timeline.heads.list_keys import ListKeys
from skinsource_gui.shell.actions import ACTIONS
from skinsource_gui.widgets.fields.number_gestures import NumberGestures
from skinsource_gui.widgets.fields.number_typing import begins_typing
from skinsource_gui.widgets.keys import KEYS, MOUSE, key_text, meaning_of
from skinsource_gui.widgets.outputs.keys import OutputKeys

_Key, _Held = Qt.Key, Qt.KeyboardModifier
SIGNS = [Qt.Key(ord(sign)) for sign in "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ+-=. "]
NAMED = [
    *(_Key.Key_Left, _Key.Key_Right, _Key.Key_Up, _Key.Key_Down, _Key.Key_Home, _Key.Key_End),
    *(_Key.Key_PageUp, _Key.Key_PageDown, _Key.Key_Return, _Key.Key_Enter, _Key.Key_Delete),
    *(_Key.Key_Backspace, _Key.Key_Insert, _Key.Key_Escape, _Key.Key_F2),
]
HELD = [
    _Held.NoModifier,
    _Held.ShiftModifier,
    _Held.ControlModifier,
    _Held.AltModifier,
    _Held.ControlModifier | _Held.ShiftModifier,
    _Held.AltModifier | _Held.ShiftModifier,
]


def claims(place, parent):
    """What says of an event whether the widget takes it."""
    if place == "hand":
        return SiteKeys(20, parent).claims
    if place == "inputs":
        parent.kept = ListKeys(parent)
        return parent.kept.claims
    if place == "skin":
        return OutputKeys(parent).claims
    if place == "number":
        return lambda event: NumberGestures.knows(event) or begins_typing(event)
    if place == "colour_bar":
        return lambda event: bool(key_step_db(event))
    return partial(meaning_of, place)


def keys_at(place):
    return [key for gesture in KEYS[place].gestures.values() for key in gesture.keys]


@pytest.mark.parametrize("place", KEYS)
def test_a_widget_takes_the_keys_that_are_listed(qapp, place):
    parent = QObject()
    takes = claims(place, parent)
    taken = {
        QKeySequence(held.value | key.value).toString()
        for held in HELD
        for key in (*SIGNS, *NAMED)
        if takes(QKeyEvent(QEvent.Type.KeyPress, key, held))
    }
    assert taken == set(keys_at(place))


@pytest.mark.parametrize("place", KEYS)
def test_a_key_means_one_thing_at_a_place(place):
    assert len(keys_at(place)) == len(set(keys_at(place)))


def test_no_shortcut_is_given_twice():
    keys = [key for spec in ACTIONS for key in spec.keys]
    assert len(keys) == len(set(keys))


def test_the_number_pad_means_what_the_other_keys_mean(qapp):
    held = _Held.KeypadModifier
    assert meaning_of("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_Plus, held)) == "zoom_in"
    assert meaning_of("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_B, held)) == ""


def test_tooltips_name_the_keys_that_work(window):
    hint = window.findChild(QWidget, "mute_button").toolTip()
    assert hint.endswith(f"({key_text('inputs', 'mute')})")
    assert key_text("inputs", "shift_up") in window.actions_by_name["shift_input_up"].toolTip()
    for button, action in (
        ("play_button", "play"),
        ("repeat_button", "repeat"),
        ("skin_play", "play"),
        ("skin_play", "pause"),
    ):
        key = window.actions_by_name[action].shortcut().toString()
        tip = window.findChild(QToolButton, button).toolTip()
        assert key in tip


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
