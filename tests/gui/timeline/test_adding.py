"""Clips come from the head of the timeline within few clicks, and go to places of the hand."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.view import View
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.panels.clip_editor.tools import Pen
from tests.gui.timeline.bench import LEFT, NONE, TWO_TRACKS


@pytest.fixture
def empty(open_window):
    return open_window(Design(limb="synthetic-1"), View(selected_inputs=()))


def button(window, name):
    found = window.panel("timeline").findChild(QToolButton, f"timeline_{name}")
    assert found.isVisible()
    return found


def press(window, name):
    QTest.mouseClick(button(window, name), Qt.MouseButton.LeftButton)


def played(window):
    return [type(clip.waveform) for clip in window.document.design.clips]


def test_the_menu_of_the_button_adds_clips_and_tracks(empty):
    popup = button(empty, "add").popupMode()
    assert popup == QToolButton.ToolButtonPopupMode.InstantPopup
    entries = {entry.text(): entry for entry in button(empty, "add").menu().actions()}
    names = ["Tone", "Wavelet train", "Pulse", "Sweep", "Noise", "Draw", "File…", "", "Track"]
    assert list(entries) == names
    entries["Tone"].trigger()
    assert played(empty) == [Tone]
    assert empty.document.design.inputs[0].location == 7
    entries["Wavelet train"].trigger()
    assert played(empty) == [Tone, WaveletTrain]
    tone, train = empty.document.design.inputs[0].clips
    assert train.onset_s == tone.end_s
    entries["Track"].trigger()
    assert played(empty) == [Tone, WaveletTrain]
    assert [track.location for track in empty.document.design.inputs] == [7, 8]
    assert empty.document.view.selected_inputs == (2,)


def test_a_first_drawn_waveform_takes_one_click_and_the_pen_lies_ready(empty):
    press(empty, "draw")
    assert played(empty) == [Drawn]
    (clip,) = empty.document.design.clips
    assert clip.waveform.samples.peak == 0.0
    editor = empty.panel("clip_editor")
    assert editor.isVisible()
    assert isinstance(editor._canvas.tool, Pen)


def test_what_is_to_be_drawn_begins_at_the_playhead_even_over_another_clip(window):
    window.document.look(replace(window.document.view, playhead_s=0.05))
    entries = {entry.text(): entry for entry in button(window, "add").menu().actions()}
    entries["Draw"].trigger()
    drawn = window.document.design.inputs[0].clips[-1]
    assert (type(drawn.waveform), drawn.onset_s) == (Drawn, 0.05)


def test_a_new_clip_begins_at_the_playhead_or_behind_the_last_one_of_its_track():
    tone = Tone(duration_s=0.2)
    tracks = (
        Input(location=3, clips=(Clip(waveform=tone), Clip(waveform=tone, onset_s=0.5))),
        Input(location=4),
    )
    design = Design(limb="synthetic-1", inputs=tracks)

    def onset(playhead_s, track=1):
        view = View(selected_inputs=(1,), playhead_s=playhead_s)
        after = edits.add_waveform(design, view, tone, track).design
        return after.input(track).clips[-1].onset_s

    assert onset(0.25) == 0.25
    assert onset(0.1) == onset(0.4) == 0.7
    assert onset(0.1, track=2) == 0.1


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


@pytest.fixture
def window(open_window):
    return open_window(TWO_TRACKS, View(selected_inputs=(1,), selected_clips=(1,)))


@pytest.fixture
def lanes(window):
    return window.panel("timeline").lanes


@pytest.fixture
def stage(window):
    return window.panel("hand").diagram.stage


def send(lanes, kind, at):
    """A real event of the mouse, which the lanes hold wherever it goes."""
    button = NO_BUTTON if kind == QEvent.Type.MouseMove else LEFT
    buttons = NO_BUTTON if kind == QEvent.Type.MouseButtonRelease else LEFT
    event = QMouseEvent(kind, at, QPointF(lanes.mapToGlobal(at)), button, buttons, NONE)
    QApplication.sendEvent(lanes.viewport(), event)


def carry(window, lanes, clip, site):
    """Press on a clip and go to a place, and on to it again as hands tremble."""
    start = next(box.rect.center() for box in lanes.content.boxes if box.clip.id == clip)
    diagram = window.panel("hand").diagram
    end = QPointF(lanes.mapFromGlobal(diagram.mapToGlobal(diagram.site_centre(site))))
    send(lanes, QEvent.Type.MouseButtonPress, start)
    for part in (0.02, 0.3, 0.7, 1.0, 1.0):
        send(lanes, QEvent.Type.MouseMove, start + part * (end - start))
    return end


def tracks(window):
    return [
        (track.location, [clip.id for clip in track.clips])
        for track in window.document.design.inputs
    ]


def test_a_clip_is_dragged_onto_a_place_with_a_track_in_one_step(window, lanes, stage):
    document = window.document
    end = carry(window, lanes, 2, 3)
    assert stage.state.target == 3
    # Until it is dropped everything is as it was.
    assert document.design == TWO_TRACKS
    send(lanes, QEvent.Type.MouseButtonRelease, end)
    assert tracks(window) == [(7, [1, 3]), (3, [4, 2])]
    assert document.design.clip(2).onset_s == 0.3
    assert stage.state.target is None
    assert document.undo_stack.count() == 1
    document.undo_stack.undo()
    assert document.design == TWO_TRACKS
    assert document.view.selected_clips == (2,)
