"""Cut, copy and paste of clips stand in the Edit menu; their keys are those of who has them."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.shell.menus import Palette, _state_and_keys

CONTROL = Qt.KeyboardModifier.ControlModifier


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


def test_the_palette_calls_them_by_their_names_with_the_keys_at_the_right(active):
    palette = Palette(list(active.actions_by_name.values()), active)
    palette.line.setText("cut cl")
    row = palette.list.item(0)
    assert row.text() == "Cut clips"
    assert _state_and_keys(palette.list.indexFromItem(row)) == "Ctrl+X"
    palette.deleteLater()


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
    lanes = active.panel("timeline")._table.lanes
    lanes.setFocus()
    assert QApplication.focusWidget() is not None
    for key in (Qt.Key.Key_C, Qt.Key.Key_V):
        QTest.keyClick(QApplication.focusWidget(), key, CONTROL)
    assert len(waveforms(active)) == 2
