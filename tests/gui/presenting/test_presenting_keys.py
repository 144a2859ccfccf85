"""While presenting Space plays and Esc leaves, unless something is typed, dragged or chosen."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.shell import playing
from skinsource_gui.shell.playing import EscapeTwice


@pytest.fixture
def presented(make_window, design, qtbot):
    window = make_window(design)
    window.document.look(replace(window.document.view, outputs=(29, 30)))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    window.do("present")
    return window


@pytest.fixture
def played(presented):
    """How often playing was asked for."""
    asked = []
    action = presented.actions_by_name["play"]
    action.triggered.disconnect()
    action.triggered.connect(lambda: asked.append(True))
    return asked


def turn_list(window):
    return window.panel("frequency_and_amplitude").findChild(ChoiceField, "control_field")


def press(window, key):
    QTest.keyClick(window.focusWidget() or window, key)


def test_space_plays_where_the_keyboard_came_to_a_list_by_chance(presented, played):
    field = turn_list(presented)
    field.setFocus(Qt.FocusReason.OtherFocusReason)
    assert presented.focusWidget() is field
    press(presented, Qt.Key.Key_Space)
    assert played == [True]
    assert QApplication.activePopupWidget() is None
    # Out of presenting, Space on a list opens it.
    presented.do("present")
    presented.docks["frequency_and_amplitude"].bring_forward()
    field.setFocus(Qt.FocusReason.TabFocusReason)
    press(presented, Qt.Key.Key_Space)
    assert played == [True]
    field.hidePopup()


def test_space_plays_after_the_number_that_is_turned_was_dragged(presented, played):
    number = presented.panel("frequency_and_amplitude")._amplitude.field
    number.setFocus(Qt.FocusReason.MouseFocusReason)
    press(presented, Qt.Key.Key_Space)
    assert played == [True]


def test_escape_leaves_and_the_outputs_stay_selected(presented):
    presented.panel("skin").map.setFocus()
    press(presented, Qt.Key.Key_Escape)
    assert not presented.presenter.presenting
    assert presented.document.view.outputs == (29, 30)
    # Back among the bars the key is that of the map.
    presented.panel("skin").map.setFocus()
    press(presented, Qt.Key.Key_Escape)
    assert presented.document.view.outputs == ()


@pytest.mark.parametrize("name", ["hand", "traces", "frequency_and_amplitude"])
def test_escape_leaves_from_any_panel(presented, name):
    presented.docks[name].bring_forward()
    presented.panel(name).setFocus()
    press(presented, Qt.Key.Key_Escape)
    assert not presented.presenter.presenting


def test_escape_gives_up_what_is_typed_first(presented):
    number = presented.panel("frequency_and_amplitude")._amplitude.field
    number.setFocus()
    press(presented, Qt.Key.Key_5)
    assert number.editing
    press(presented, Qt.Key.Key_Escape)
    assert not number.editing
    assert presented.presenter.presenting
    press(presented, Qt.Key.Key_Escape)
    assert not presented.presenter.presenting


def test_escape_gives_up_what_is_dragged_first(presented):
    skin = presented.panel("skin").map
    skin.setFocus()
    at = skin.rect().center()
    QTest.mousePress(skin, Qt.MouseButton.LeftButton, pos=at)
    QTest.mouseMove(skin, at + at / 8)
    press(presented, Qt.Key.Key_Escape)
    QTest.mouseRelease(skin, Qt.MouseButton.LeftButton, pos=at + at / 8)
    assert presented.presenter.presenting
    assert presented.document.view.outputs == (29, 30)


def test_escape_closes_an_open_menu_first(presented, qtbot):
    menu = QMenu(presented)
    menu.addAction("One")
    menu.popup(presented.mapToGlobal(presented.rect().center()))
    qtbot.waitUntil(menu.isVisible)
    QTest.keyClick(menu, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not menu.isVisible())
    assert presented.presenter.presenting


def test_who_listens_for_escape_pressed_twice_hears_of_the_first_one(presented, qtbot, monkeypatch):
    # To leave may take a while here.
    monkeypatch.setattr(playing, "_WITHIN_S", 60.0)
    presented.do("present")
    twice = EscapeTwice(presented)
    # Before presenting begins, as where something plays already.
    twice.watch(True)
    presented.do("present")
    presented.panel("skin").map.setFocus()
    with qtbot.waitSignal(twice.pressed, timeout=5_000):
        press(presented, Qt.Key.Key_Escape)
        assert not presented.presenter.presenting
        press(presented, Qt.Key.Key_Escape)
    twice.watch(False)
