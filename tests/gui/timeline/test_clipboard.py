"""Selected clips are copied, cut and pasted from the menu, wherever the keyboard is."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication

from skinsource.design import edits
from skinsource_gui.fields.number_field import NumberField
from tests.gui.timeline.bench import CONTROL


@pytest.fixture
def active(window):
    """The window, with an empty clipboard and a clip that is selected."""
    QGuiApplication.clipboard().clear()
    (clip,) = window.document.design.clips
    window.document.look(replace(window.document.view, selected_clips=(clip.id,)))
    return window


def waveforms(window):
    return [clip.waveform for clip in window.document.design.clips]


def test_keys_are_about_words_where_one_types_and_about_clips_in_the_timeline(active, qtbot):
    active.activateWindow()
    qtbot.waitUntil(active.isActiveWindow)
    field = active.panel("inspector").findChild(NumberField, "frequency_hz_field")
    field.setFocus()
    QTest.keyClick(field, Qt.Key.Key_C, CONTROL)
    assert QGuiApplication.clipboard().text() == "100 Hz"
    messages = []
    active.document.refused.connect(messages.append)
    QTest.keyClick(field, Qt.Key.Key_V, CONTROL)
    assert (len(waveforms(active)), messages) == (1, [])
    field.cancel()
    active.panel("timeline").lanes.setFocus()
    for key in (Qt.Key.Key_C, Qt.Key.Key_V):
        QTest.keyClick(QApplication.focusWidget(), key, CONTROL)
    assert len(waveforms(active)) == 2


@pytest.mark.parametrize("panel", ["timeline", "hand", "skin", "inspector"])
def test_paste_goes_to_the_head_and_the_time_that_were_clicked_last_from_any_focus(
    active, qtbot, panel
):
    active.activateWindow()
    qtbot.waitUntil(active.isActiveWindow)
    active.do("copy_clips")
    active.do("add_input")
    active.document.apply(edits.move_playhead(active.document.design, active.document.view, 0.9))
    heads = active.panel("timeline").heads
    QTest.mouseClick(heads.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(90, 50))
    assert heads.hasFocus()
    if panel == "inspector":
        active.panel("inspector").findChild(QAbstractButton, "mute_button").setFocus()
    elif panel != "timeline":
        active.panel(panel).setFocus()
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_V, CONTROL)
    first, second = active.document.design.inputs
    assert len(first.clips) == 1
    assert second.clips[-1].onset_s == 0.9


def test_they_work_with_the_timeline_hidden_and_say_what_was_pasted_where(active):
    active.docks["timeline"].hide()
    active.panel("hand").setFocus()
    (waveform,) = waveforms(active)
    messages = []
    active.document.refused.connect(messages.append)
    active.do("paste_clips")
    assert "holds no clips" in messages[-1]
    active.do("copy_clips")
    active.do("paste_clips")
    message = active.statusBar().currentMessage()
    assert message == "1 clip pasted at 0 ms, over the copied clips"
    assert waveforms(active) == [waveform, waveform]
    active.do("cut_clips")
    assert waveforms(active) == [waveform]
    active.do("undo")
    assert waveforms(active) == [waveform, waveform]
    active.document.edit("Empty", replace(active.document.design, inputs=()))
    assert not active.actions_by_name["copy_clips"].isEnabled()
    assert not active.actions_by_name["cut_clips"].isEnabled()
