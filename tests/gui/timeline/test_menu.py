"""The right button on rows of the list: what it offers, to whom, and that it does it."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.qt.keys import key_text

MOUSE, KEYBOARD = QContextMenuEvent.Reason.Mouse, QContextMenuEvent.Reason.Keyboard


CONTROL = Qt.KeyboardModifier.ControlModifier


ALL = ["Mute", "Solo", "Duplicate", "Remove", "Move up", "Move down", "Gain curve"]


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


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


@pytest.fixture
def active(window, qtbot):
    """The window, with the keyboard and an empty clipboard."""
    QGuiApplication.clipboard().clear()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    (clip,) = window.document.design.clips
    window.document.look(replace(window.document.view, selected_clips=(clip.id,)))
    return window


def waveforms(window):
    return [clip.waveform for clip in window.document.design.clips]


def test_they_stand_in_the_menu_and_say_the_keys_of_the_timeline(active):
    menus = [menu for menu in active.findChildren(QMenu) if menu.title().replace("&", "") == "Edit"]
    hints = {action.text(): action.statusTip() for menu in menus for action in menu.actions()}
    for text, key in (
        ("Cut clips", "Ctrl+X"),
        ("Copy clips", "Ctrl+C"),
        ("Paste clips at playhead", "Ctrl+V"),
    ):
        # After a tab: the menu shows it in its column of keys.
        assert f"({key}, in the timeline)" in hints[f"{text}\t{key}"]
    assert not active.actions_by_name["copy_clips"].shortcuts()


def test_a_paste_on_top_of_the_original_says_how_many_clips_and_when(active):
    active.do("copy_clips")
    active.do("paste_clips")
    message = active.statusBar().currentMessage()
    assert message == "1 clip pasted at 0 ms, on top of what was copied"
    active.document.look(replace(active.document.view, playhead_s=0.35))
    active.do("paste_clips")
    assert active.statusBar().currentMessage() == "1 clip pasted at 350 ms"


@pytest.mark.parametrize("shown", [True, False])
def test_selected_clips_are_copied_cut_and_pasted_wherever_the_keyboard_is(active, shown):
    if not shown:
        active.docks["timeline"].toggleViewAction().trigger()
    assert active.panel("timeline").isVisible() == shown
    active.panel("hand").setFocus()
    (waveform,) = waveforms(active)
    active.do("copy_clips")
    active.do("paste_clips")
    assert waveforms(active) == [waveform, waveform]
    active.do("cut_clips")
    assert waveforms(active) == [waveform]
    active.do("undo")
    assert waveforms(active) == [waveform, waveform]


def test_of_no_clips_and_an_empty_clipboard_they_say_so(active):
    messages = []
    active.document.refused.connect(messages.append)
    active.do("paste_clips")
    assert "holds no clips" in messages[-1]
    active.document.edit("Empty", replace(active.document.design, inputs=()))
    assert not active.actions_by_name["copy_clips"].isEnabled()
    assert not active.actions_by_name["cut_clips"].isEnabled()


def test_where_one_types_the_keys_are_about_the_words(active):
    field = next(
        field for field in active.panel("inspector").findChildren(NumberField) if field.isVisible()
    )
    field.setFocus()
    QTest.keyClick(field, Qt.Key.Key_C, CONTROL)
    assert QGuiApplication.clipboard().text() == "100 Hz"
    QTest.keyClick(field, Qt.Key.Key_V, CONTROL)
    assert len(waveforms(active)) == 1


def test_in_the_timeline_the_keys_are_about_the_clips(active):
    lanes = active.panel("timeline").lanes
    lanes.setFocus()
    assert QApplication.focusWidget() is not None
    for key in (Qt.Key.Key_C, Qt.Key.Key_V):
        QTest.keyClick(QApplication.focusWidget(), key, CONTROL)
    assert len(waveforms(active)) == 2
