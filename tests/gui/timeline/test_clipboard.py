"""The Clip menu does with the selected clips what keys do on the timeline, wherever these are."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QInputDialog

from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.effects.level import BandLimit, Fade
from skinsource.design.effects.time import Repeat
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.qt.keys import key_text
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


TONE = Tone(100.0, duration_s=0.2)


@pytest.fixture
def two_clips(open_window):
    design = Design(limb="synthetic-1", inputs=(track(7, TONE), track(3, TONE, onset_s=0.1)))
    view = View(selected_inputs=(1, 2), selected_clips=(1, 2), playhead_s=0.15)
    return open_window(design, view)


def effects(window):
    return [[type(effect) for effect in clip.effects] for clip in window.document.design.clips]


def test_each_entry_acts_on_all_selected_clips_in_one_step(two_clips):
    window, document = two_clips, two_clips.document
    for name, clips in (("split_clips", 4), ("repeat_clips", 4), ("duplicate_clips", 4)):
        window.do(name)
        assert len(document.design.clips) == clips, name
        window.do("undo")
    window.do("mute_clips")
    assert all(clip.muted for clip in document.design.clips)
    assert window.actions_by_name["mute_clips"].isChecked()
    window.do("limit_to_band")
    assert effects(window) == [[BandLimit], [BandLimit]]
    assert [clip.waveform for clip in document.design.clips] == [TONE, TONE]
    window.do("remove_clips")
    assert document.design.clips == ()
    assert not window.actions_by_name["split_clips"].isEnabled()


def test_fades_come_and_go_and_leave_the_other_end(two_clips):
    window, document = two_clips, two_clips.document
    window.do("fade_in")
    window.do("fade_out")
    assert effects(window) == [[Fade], [Fade]]
    assert {(clip.effects[0].in_s, clip.effects[0].out_s) for clip in document.design.clips} == {
        (0.02, 0.02)
    }
    assert document.undo_stack.count() == 2
    # An effect behind that moves nothing in time leaves the fade what it is.
    window.do("limit_to_band")
    window.do("fade_in")
    assert [clip.effects[0].in_s for clip in document.design.clips] == [0.0, 0.0]
    assert [clip.effects[0].out_s for clip in document.design.clips] == [0.02, 0.02]
    assert not window.actions_by_name["fade_in"].isChecked()


def test_effects_are_copied_to_other_clips_in_one_step(two_clips):
    window, document = two_clips, two_clips.document
    QGuiApplication.clipboard().clear()
    refused = []
    document.refused.connect(refused.append)
    window.do("paste_effects")
    assert refused == ["The clipboard holds no effects; copy some first."]
    chain = (Repeat(400), Fade(0.01, 0.05))
    document.edit("Effects", document.design.with_clip(2, effects=chain))
    document.look(replace(document.view, selected_inputs=(2,), selected_clips=(2,)))
    window.do("copy_effects")
    # They are no clips.
    window.do("paste_clips")
    assert refused[1:] == ["The clipboard holds no clips; copy some first."]
    document.edit("Other", document.design.with_clip(1, effects=(BandLimit(),)))
    before = document.design
    document.look(replace(document.view, selected_inputs=(1, 2), selected_clips=(1, 2)))
    window.do("paste_effects")
    assert [clip.effects for clip in document.design.clips] == [chain, chain]
    window.do("undo")
    assert document.design == before
    document.look(replace(document.view, selected_inputs=(), selected_clips=()))
    assert not window.actions_by_name["copy_effects"].isEnabled()
    assert not window.actions_by_name["paste_effects"].isEnabled()


def test_effects_that_would_make_a_clip_too_long_are_refused(two_clips):
    window, document = two_clips, two_clips.document
    document.edit(
        "Short", document.design.with_clip(2, waveform=Tap(), effects=(Repeat(1000, 3.5),))
    )
    document.look(replace(document.view, selected_inputs=(2,), selected_clips=(2,)))
    refused = []
    document.refused.connect(refused.append)
    window.do("copy_effects")
    document.look(replace(document.view, selected_inputs=(1,), selected_clips=(1,)))
    window.do("paste_effects")
    assert len(refused) == 1
    assert document.design.clip(1).effects == ()


def test_a_clip_is_stretched_to_a_typed_length(two_clips, monkeypatch):
    monkeypatch.setattr(QInputDialog, "getDouble", lambda *_: (300.0, True))
    two_clips.do("stretch_clip")
    last = two_clips.document.design.clip(2)
    assert (last.onset_s, last.duration_s) == (0.1, pytest.approx(0.3))


def test_the_menu_says_the_keys_of_the_timeline(two_clips):
    assert two_clips.actions_by_name["split_clips"].text() == (
        f"Split at playhead\t{key_text('timeline', 'split')}"
    )
    view = replace(two_clips.document.view, selected_inputs=(), selected_clips=())
    two_clips.document.look(view)
    assert not two_clips.actions_by_name["match_tracks"].isEnabled()
