"""The Clip menu does with clips what keys do; clips come from the head and go to places."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QKeySequence, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QInputDialog, QToolButton

from skinsource import Clip, Design, Input, View, edits, track
from skinsource.design.effects import BandLimit, Fade, Repeat, Reverse, Trim
from skinsource.design.waveforms import Drawn, Tap, Tone, WaveletTrain
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.clip_editor.tools import Pen
from skinsource_gui.qt.keys import KEYS, key_text
from skinsource_gui.shell.actions import ACTIONS
from tests.gui.timeline.bench import CONTROL, LEFT, NONE, SHIFT, TONE, TWO_TRACKS


@pytest.fixture
def active(active):
    """The studio, with the keyboard, an empty clipboard and a clip that is selected."""
    QGuiApplication.clipboard().clear()
    (clip,) = active.document.design.clips
    active.document.look(replace(active.document.view, selected_clips=(clip.id,)))
    return active


def waveforms(window):
    return [clip.waveform for clip in window.document.design.clips]


def test_keys_are_about_words_where_one_types_and_about_clips_in_the_timeline(active, qtbot):
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
    active.do("copy_clips")
    active.panel("hand").setFocus()
    for name in ("add_input", "undo", "add_input"):
        active.do(name)
    assert active.panel("timeline").lanes.hasFocus()
    active.document.apply(edits.move_playhead(active.document.design, active.document.view, 0.9))
    heads = active.panel("timeline").heads
    QTest.mouseClick(heads.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(20, 50))
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
    assert message == "1 clip pasted at 0 ms, over 1 other clip"
    active.do("undo")
    assert active.statusBar().currentMessage() == ""
    active.do("redo")
    assert waveforms(active) == [waveform, waveform]
    active.do("cut_clips")
    assert waveforms(active) == [waveform]
    active.document.edit("Empty", replace(active.document.design, inputs=()))
    assert not active.actions_by_name["copy_clips"].isEnabled()


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
    document.look(replace(document.view, selected_clips=(1,), playhead_s=0.05))
    for name in ("join_clips", "ungroup_clips"):
        assert not window.actions_by_name[name].isEnabled()
    document.look(replace(document.view, selected_clips=(1, 2)))
    for name in ("join_clips", "group_clips"):
        assert not window.actions_by_name[name].isEnabled(), "they are of two tracks"
    document.look(replace(document.view, selected_clips=(1,)))
    window.do("split_clips")
    document.look(replace(document.view, selected_clips=(1, 3)))
    for name, count in (("group_clips", 2), ("ungroup_clips", 3), ("join_clips", 2)):
        window.do(name)
        assert len(document.design.clips) == count, name
    # What is cut is what is copied: not the clip of the other track, which is dotted.
    document.look(replace(document.view, selected_clips=(1,)))
    window.do("cut_clips")
    window.do("paste_clips")
    assert len(document.design.clips) == 2
    document.look(edits.select_all_clips(document.design, document.view).view)
    window.do("remove_clips")
    assert document.design.clips == ()


# What stands among them in the menu; and the keys of the others.
OTHERS = {
    *("aim", "show_clip_editor", "match_tracks", "make_motion", "equalise_on_skin"),
    *("join_clips", "group_clips", "ungroup_clips", "place_actuators"),
}
ON_CLIPS = "nudge change_track split repeat mute duplicate fade_in fade_out stretch_clip remove"


def test_what_acts_on_clips_acts_on_selected_ones_else_refuses_in_one_sentence(two_clips):
    window, document, refused = two_clips, two_clips.document, []
    lanes, before = window.panel("timeline").lanes, document.design
    on_clips = {spec.name for spec in ACTIONS if spec.menu == "Clip"} - OTHERS
    assert all(window.actions_by_name[name].isEnabled() for name in on_clips)
    document.look(replace(document.view, selected_clips=()))
    document.refused.connect(refused.append)
    assert not any(window.actions_by_name[name].isEnabled() for name in {*on_clips, "cut_clips"})
    keys = KEYS["timeline"].gestures
    names = ON_CLIPS.split()
    for name in names:
        pressed = QKeySequence(keys[name].keys[0])[0]
        QTest.keyClick(lanes, pressed.key(), pressed.keyboardModifiers())
    window.do("copy_clips")
    assert refused == ["No clip is selected; click one in the timeline."] * (len(names) + 1)
    assert document.design is before
    # A new one is what is meant next.
    QTest.keyClick(lanes, Qt.Key.Key_N)
    QTest.keyClick(lanes, Qt.Key.Key_F)
    assert document.design.inputs[-1].clips[-1].effects == (Fade(0.02, 0.0),)


def test_duplicate_and_remove_of_the_menu_name_what_is_outlined_and_act_on_it(active, qtbot):
    document, words = active.document, []
    for key in (Qt.Key.Key_D, Qt.Key.Key_Backspace):
        field = active.panel("inspector").findChild(NumberField, "frequency_hz_field")
        field.setFocus()
        words.append(active.actions_by_name["duplicate_input"].text())
        QTest.keyClick(field, key, CONTROL)
        words.append((len(document.design.inputs), len(document.design.clips)))
        document.look(edits.select_inputs(document.design, document.view, (1,)).view)
    assert words == ["Duplicate clips", (1, 2), "Duplicate input", (0, 0)]


def test_fades_are_added_and_never_taken_away_by_a_key(two_clips):
    window, document, refused = two_clips, two_clips.document, []
    lanes = window.panel("timeline").lanes
    document.refused.connect(refused.append)
    QTest.keyClick(lanes, Qt.Key.Key_F)
    QTest.keyClick(lanes, Qt.Key.Key_F, SHIFT)
    assert {clip.effects for clip in document.design.clips} == {(Fade(0.02, 0.02),)}
    document.edit("By hand", document.design.with_clip(1, effects=(Fade(0.0, 0.15),)))
    window.do("fade_in")
    assert document.design.clips[0].effects == (Fade(0.02, 0.15),)
    window.do("fade_in")
    QTest.keyClick(lanes, Qt.Key.Key_F, SHIFT)
    assert [text.split()[2] for text in refused] == ["in", "out"]
    assert document.undo_stack.count() == 4


def test_effects_but_not_what_cuts_a_part_are_copied_to_others_in_one_step(two_clips):
    window, document = two_clips, two_clips.document
    QGuiApplication.clipboard().clear()
    refused = []
    document.refused.connect(refused.append)
    window.do("paste_effects")
    assert refused == ["The clipboard holds no effects; copy some first."]
    chain, late, early = (Repeat(400), Fade(0.01, 0.05)), Trim(0.05, 0.1), Trim(0.0, 0.05)
    document.edit("Effects", document.design.with_clip(2, effects=(*chain, early)))
    document.look(replace(document.view, selected_inputs=(2,), selected_clips=(2,)))
    window.do("copy_effects")
    # They are no clips.
    window.do("paste_clips")
    assert refused[1:] == ["The clipboard holds no clips; copy some first."]
    document.edit("Other", document.design.with_clip(1, effects=(BandLimit(), late)))
    before = document.design
    document.look(replace(document.view, selected_inputs=(1, 2), selected_clips=(1, 2)))
    window.do("paste_effects")
    one, other = (clip.effects for clip in document.design.clips)
    assert (one, other) == ((late, chain[1]), (chain[0], early, chain[1]))
    assert "2 clips were replaced" in window.statusBar().currentMessage()
    window.do("undo")
    assert document.design == before
    document.look(replace(document.view, selected_inputs=(), selected_clips=()))
    assert not window.actions_by_name["copy_effects"].isEnabled()
    assert not window.actions_by_name["paste_effects"].isEnabled()


@pytest.mark.parametrize("more", [(), (Fade(0.01, 0.0),), (Reverse(),)])
def test_a_part_of_what_plays_backwards_that_gets_its_own_effects_plays_the_same(two_clips, more):
    window, document = two_clips, two_clips.document
    effects = (Reverse(), Trim(0.0, 0.05), *more)
    document.edit("Part", document.design.with_clip(2, effects=effects))
    document.look(replace(document.view, selected_inputs=(2,), selected_clips=(2,)))
    window.do("copy_effects")
    window.do("paste_effects")
    assert document.design.clip(2).effects == effects


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


def test_selected_clips_are_stretched_by_the_factor_of_the_last_in_one_step(two_clips, monkeypatch):
    asked, document, lanes = [], two_clips.document, two_clips.panel("timeline").lanes
    monkeypatch.setattr(
        QInputDialog, "getDouble", lambda *about: (asked.append(about), (300.0, True))[1]
    )
    document.edit("Shorter", document.design.with_clip(1, waveform=replace(TONE, duration_s=0.1)))
    before = document.design
    QTest.keyClick(lanes, Qt.Key.Key_S, SHIFT)
    one, last = document.design.clips
    assert (one.onset_s, one.duration_s) == (0.0, pytest.approx(0.15))
    assert (last.onset_s, last.duration_s) == (0.1, pytest.approx(0.3))
    assert "2 clips" in asked[0][1]
    assert "Frequencies shift" in asked[0][2]
    two_clips.do("undo")
    assert document.design == before
    document.look(replace(document.view, selected_inputs=(2,), selected_clips=(2,)))
    QTest.keyClick(lanes, Qt.Key.Key_S, SHIFT)
    assert [clip.duration_s for clip in document.design.clips] == pytest.approx([0.1, 0.3])


def test_the_menu_says_the_keys_of_the_timeline(two_clips):
    assert two_clips.actions_by_name["split_clips"].text() == (
        f"Split at playhead\t{key_text('timeline', 'split')}"
    )


@pytest.fixture
def empty(open_window):
    return open_window(Design(limb="synthetic-1"), View(selected_inputs=()))


def button(studio, name):
    found = studio.panel("timeline").findChild(QToolButton, f"timeline_{name}")
    assert found.isVisible()
    return found


def press(studio, name):
    QTest.mouseClick(button(studio, name), Qt.MouseButton.LeftButton)


def played(studio):
    return [type(clip.waveform) for clip in studio.document.design.clips]


def test_the_menu_of_the_button_adds_clips_and_tracks(empty):
    popup = button(empty, "add").popupMode()
    assert popup == QToolButton.ToolButtonPopupMode.InstantPopup
    entries = {entry.text(): entry for entry in button(empty, "add").menu().actions()}
    names = ["Tone", "Wavelet train", "Tap", "Chirp", "Noise", "Draw", "File…", "", "Track"]
    assert list(entries) == names
    entries["Tone"].trigger()
    assert played(empty) == [Tone]
    assert empty.document.design.inputs[0].location == 7
    entries["Wavelet train"].trigger()
    assert played(empty) == [Tone, WaveletTrain]
    tone, train = empty.document.design.inputs[0].clips
    assert train.onset_s == tone.end_s
    assert "at 200 ms, behind the last" in empty.statusBar().currentMessage()
    assert empty.focusWidget() is empty.panel("timeline").lanes
    entries["Draw"].trigger()
    drawn = empty.document.design.inputs[0].clips[-1]
    assert (type(drawn.waveform), drawn.onset_s) == (Drawn, train.end_s)
    entries["Track"].trigger()
    assert [track.location for track in empty.document.design.inputs] == [7, 8]
    assert empty.document.view.selected_inputs == (2,)
    assert empty.focusWidget() is empty.panel("timeline").lanes


def test_a_first_drawn_waveform_takes_one_click_and_the_pen_lies_ready(empty):
    press(empty, "draw")
    assert played(empty) == [Drawn]
    (clip,) = empty.document.design.clips
    assert clip.waveform.samples.peak == 0.0
    editor = empty.panel("clip_editor")
    assert editor.isVisible()
    assert isinstance(editor._canvas.tool, Pen)


def test_a_new_clip_begins_at_the_playhead_or_behind_the_last_one_of_its_track():
    for playhead_s, track_id, onset_s in ((0.5, 1, 0.5), (0.1, 2, 0.3), (0.4, 2, 0.4)):
        view = View(selected_inputs=(1,), playhead_s=playhead_s)
        after = edits.add_waveform(TWO_TRACKS, view, TONE, track_id).design
        assert after.input(track_id).clips[-1].onset_s == onset_s


def test_after_another_clip_editor_and_timeline_show_all_of_a_new_design(open_window, settle):
    tone = Clip(waveform=Tone(duration_s=2.0))
    long = Design(limb="synthetic-1", inputs=(Input(location=7, clips=(tone,)),))
    window = open_window(long, View(selected_inputs=(1,)))
    press(window, "fit")
    window.do("show_clip_editor")
    settle()
    editor, lanes = window.panel("clip_editor"), window.panel("timeline").lanes
    editor._canvas.zoom(1.5)
    # The clip of another file has the same number.
    document = window.document
    longer = long.with_clip(1, waveform=Tone(duration_s=3.0))
    document.start_over(longer, document.view, None)
    assert editor._canvas.content.scale.shown_s == pytest.approx((0.0, 3.18))
    # Over the timeline, which does not see the empty design in between.
    window.do("new_design")
    document.apply(edits.add_waveform(document.design, document.view, Tone(duration_s=0.2)))
    settle()
    assert editor._canvas.content.scale.shown_s[1] < 0.25
    window.docks["timeline"].bring_forward()
    settle()
    assert lanes.content.scale.shown_s[1] < 0.7
    # A step of the history keeps what is seen.
    press(window, "fit")
    fitted = lanes.content.scale.shown_s
    window.do("mute_clips")
    window.do("undo")
    assert lanes.content.scale.shown_s == fitted


NO_BUTTON = Qt.MouseButton.NoButton


def send(lanes, kind, at):
    """A real event of the mouse, which the lanes hold wherever it goes."""
    button = NO_BUTTON if kind == QEvent.Type.MouseMove else LEFT
    buttons = NO_BUTTON if kind == QEvent.Type.MouseButtonRelease else LEFT
    event = QMouseEvent(kind, at, QPointF(lanes.mapToGlobal(at)), button, buttons, NONE)
    QApplication.sendEvent(lanes.viewport(), event)


def test_a_clip_is_dragged_onto_a_place_with_a_track_in_one_step(open_window):
    studio = open_window(TWO_TRACKS, View(selected_inputs=(1,), selected_clips=(1,)))
    document, lanes = studio.document, studio.panel("timeline").lanes
    diagram = studio.panel("hand").diagram
    start = next(box.rect.center() for box in lanes.content.boxes if box.clip.id == 2)
    end = QPointF(lanes.mapFromGlobal(diagram.mapToGlobal(diagram.site_centre(3))))
    send(lanes, QEvent.Type.MouseButtonPress, start)
    # There, and on to it again as hands tremble.
    for part in (0.02, 0.3, 0.7, 1.0, 1.0):
        send(lanes, QEvent.Type.MouseMove, start + part * (end - start))
    stage = diagram.stage
    assert stage.state.target == 3
    # Until it is dropped everything is as it was.
    assert document.design == TWO_TRACKS
    send(lanes, QEvent.Type.MouseButtonRelease, end)
    assert [len(track.clips) for track in document.design.inputs] == [2, 2]
    assert (document.design.track_of(2).location, document.design.clip(2).onset_s) == (3, 0.3)
    assert stage.state.target is None
    assert document.undo_stack.count() == 1
