"""The right button on rows of the list: what it offers, to whom, and that it does it."""

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import QApplication, QMenu

from skinsource_gui.qt.keys import key_text

MOUSE, KEYBOARD = QContextMenuEvent.Reason.Mouse, QContextMenuEvent.Reason.Keyboard
CONTROL = Qt.KeyboardModifier.ControlModifier
ALL = ["Mute", "Solo", "Duplicate", "Remove", "Move up", "Move down", "Gain curve"]


@pytest.fixture
def menu_of(bench):
    """Open the menu of a row; its actions by their words."""

    def close():
        for menu in bench.panel.findChildren(QMenu, "inputs_menu"):
            menu.close()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def open_menu(index, reason=MOUSE):
        close()
        at = bench.row(index).pos() + QPoint(60, 10)
        where = bench.rows.mapToGlobal(at)
        QApplication.sendEvent(bench.rows, QContextMenuEvent(reason, at, where))
        (menu,) = bench.panel.findChildren(QMenu, "inputs_menu")
        return {action.text().split("\t")[0]: action for action in menu.actions() if action.text()}

    yield open_menu
    close()


def test_the_menu_is_about_the_row_under_the_pointer_and_selects_it(bench, menu_of):
    actions = menu_of(2)
    assert list(actions) == ALL
    assert bench.view.selected_inputs == (3,)
    actions["Mute"].trigger()
    assert [track.muted for track in bench.design.inputs] == [False, False, True]
    actions = menu_of(2)
    assert actions["Mute"].isChecked()
    assert not actions["Solo"].isChecked()


def test_each_line_does_what_it_says(bench, menu_of):
    menu_of(1)["Solo"].trigger()
    assert [track.solo for track in bench.design.inputs] == [False, True, False]
    menu_of(1)["Move up"].trigger()
    assert bench.places == [2, 7, 15]
    menu_of(0)["Move down"].trigger()
    assert bench.places == [7, 2, 15]
    menu_of(1)["Duplicate"].trigger()
    assert bench.places == [7, 2, 15, 2]
    menu_of(0)["Remove"].trigger()
    assert bench.places == [2, 15, 2]


def test_on_one_of_several_it_is_about_all_of_them(bench, menu_of):
    bench.key(Qt.Key.Key_A, CONTROL)
    actions = menu_of(1)
    assert set(bench.view.selected_inputs) == {1, 2, 3}
    assert "Move 3 inputs up" in actions
    actions["Mute 3 inputs"].trigger()
    assert all(track.muted for track in bench.design.inputs)
    menu_of(1)["Remove 3 inputs"].trigger()
    assert bench.places == []


def test_the_menu_key_means_the_row_that_was_selected_last(bench, menu_of):
    bench.key(Qt.Key.Key_Down)
    menu_of(0, KEYBOARD)["Remove"].trigger()
    assert bench.places == [7, 15]


def test_lines_say_the_keys_of_the_table(bench, menu_of):
    shown = {text: line.text().split("\t")[1] for text, line in menu_of(0).items()}
    names = ("mute", "solo", "duplicate", "remove", "shift_up", "shift_down", "gain_curve")
    assert shown == {text: key_text("inputs", name) for text, name in zip(ALL, names, strict=True)}
