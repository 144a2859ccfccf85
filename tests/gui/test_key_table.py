"""The table of keys says what the widgets in the panels do with keys, no more and no less."""

from functools import partial

import pytest
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QTextBrowser, QWidget

from skinsource_gui.panels.hand.site_keys import SiteKeys
from skinsource_gui.panels.skin.scale.range_handle import key_step_db
from skinsource_gui.panels.timeline.heads.list_keys import ListKeys
from skinsource_gui.widgets.fields.number_gestures import NumberGestures
from skinsource_gui.widgets.fields.number_typing import begins_typing
from skinsource_gui.widgets.key_tables.key_table import WIDGET_KEYS, key_text, meant
from skinsource_gui.widgets.outputs.keys import OutputKeys

_Key, _Held = Qt.Key, Qt.KeyboardModifier
SIGNS = [Qt.Key(ord(sign)) for sign in "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ+-= "]
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
    others = ("history", "snapshot", "effects", "curve", "timeline", "clip_editor", "library")
    others += ("parts", "playhead")
    return partial(meant, place if place in others else "plot")


@pytest.mark.parametrize("place", WIDGET_KEYS)
def test_a_widget_takes_the_keys_that_the_table_lists(qapp, place):
    parent = QObject()
    takes = claims(place, parent)
    taken = {
        QKeySequence(held.value | key.value).toString()
        for held in HELD
        for key in (*SIGNS, *NAMED)
        if takes(QKeyEvent(QEvent.Type.KeyPress, key, held))
    }
    assert taken == {key for hint in WIDGET_KEYS[place][1] for key in hint.keys}


@pytest.mark.parametrize("place", WIDGET_KEYS)
def test_a_key_means_one_thing_at_a_place(place):
    keys = [key for hint in WIDGET_KEYS[place][1] for key in hint.keys]
    assert len(keys) == len(set(keys))


def test_the_number_pad_means_what_the_other_keys_mean(qapp):
    held = _Held.KeypadModifier
    assert meant("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_Plus, held)) == "zoom_in"
    assert meant("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_B, held)) == ""


def test_hints_name_the_keys_of_the_table(window):
    hint = window.findChild(QWidget, "mute_button").toolTip()
    assert hint.endswith(f"({key_text('inputs', 'mute')})")
    assert key_text("inputs", "shift_up") in window.actions_by_name["shift_input_up"].toolTip()


def test_the_keys_page_is_made_from_the_table(window):
    window.do("show_keys")
    words = window.findChild(QTextBrowser, "page_text").toPlainText()
    for heading, hints in WIDGET_KEYS.values():
        assert heading in words
        for hint in hints:
            assert hint.words in words
            assert hint.means in words
