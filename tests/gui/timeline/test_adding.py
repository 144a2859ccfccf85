"""Clips come from the head of the timeline: the first ones within few clicks."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.view import View
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.panels.clip_editor.tools import Pen


@pytest.fixture
def empty(open_window):
    return open_window(Design(limb="synthetic-1"), View(selected_inputs=()))


def button(window, name):
    found = window.panel("timeline").findChild(QToolButton, f"timeline_{name}")
    assert found.isVisible()
    return found


def press(window, name):
    QTest.mouseClick(button(window, name), Qt.MouseButton.LeftButton, pos=point(window))


def point(window):
    # Left of the arrow, which opens the menu.
    return button(window, "add").rect().center() / 2


def played(window):
    return [type(clip.waveform) for clip in window.document.design.clips]


def test_a_first_tone_takes_one_click_and_a_wavelet_train_two(empty):
    press(empty, "add")
    assert played(empty) == [Tone]
    assert empty.document.design.inputs[0].location == 7
    # The arrow, and the entry.
    entries = {entry.text(): entry for entry in button(empty, "add").menu().actions()}
    names = ["Tone", "Wavelet train", "Pulse", "Sweep", "Noise", "Draw", "File…"]
    assert list(entries) == names
    entries["Wavelet train"].trigger()
    assert played(empty) == [Tone, WaveletTrain]
    tone, train = empty.document.design.inputs[0].clips
    assert train.onset_s == tone.end_s
    # The button goes on with what was added last.
    press(empty, "add")
    assert played(empty)[2] is WaveletTrain


def test_a_first_drawn_waveform_takes_one_click_and_the_pen_lies_ready(empty):
    press(empty, "draw")
    assert played(empty) == [Drawn]
    (clip,) = empty.document.design.clips
    assert clip.waveform.samples.peak == 0.0
    editor = empty.panel("clip_editor")
    assert editor.isVisible()
    assert isinstance(editor._canvas.tool, Pen)


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
