"""Clips dragged from the timeline onto the hand, in the whole window."""

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.lanes import LanesView

LEFT, NO_BUTTON = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
NONE, CONTROL = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier
TONE = Tone(100.0, 0.0, 0.2)
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        Input(location=7, clips=(Clip(waveform=TONE), Clip(onset_s=0.3, waveform=TONE))),
        Input(location=3, clips=(Clip(onset_s=0.1, waveform=TONE),)),
    ),
)


@pytest.fixture
def window(open_window):
    return open_window(DESIGN, View(selected_inputs=(1,), selected_clips=(1,)))


@pytest.fixture
def lanes(window):
    return window.findChild(LanesView, "lanes")


@pytest.fixture
def stage(window):
    return window.panel("hand").diagram.stage


def send(lanes, kind, at, held=NONE):
    """A real event of the mouse, which the lanes hold wherever it goes."""
    button = NO_BUTTON if kind == QEvent.Type.MouseMove else LEFT
    buttons = NO_BUTTON if kind == QEvent.Type.MouseButtonRelease else LEFT
    event = QMouseEvent(kind, at, QPointF(lanes.mapToGlobal(at)), button, buttons, held)
    QApplication.sendEvent(lanes.viewport(), event)


def site_in_lanes(window, lanes, site):
    """Where a place of the hand is, px of the lanes."""
    diagram = window.panel("hand").diagram
    return QPointF(lanes.mapFromGlobal(diagram.mapToGlobal(diagram.site_centre(site))))


def carry(window, lanes, clip, site, held=NONE):
    """Press on a clip and go to a place, and on to it again as hands tremble."""
    start = next(box.rect.center() for box in lanes.content.boxes if box.clip.id == clip)
    end = site_in_lanes(window, lanes, site)
    send(lanes, QEvent.Type.MouseButtonPress, start, held)
    for part in (0.02, 0.3, 0.7, 1.0, 1.0):
        send(lanes, QEvent.Type.MouseMove, start + part * (end - start), held)
    return end


def tracks(window):
    return [
        (track.location, [clip.id for clip in track.clips])
        for track in window.document.design.inputs
    ]


def test_a_clip_is_dragged_onto_a_place_with_a_track_in_one_step(window, lanes, stage):
    end = carry(window, lanes, 2, 3)
    assert stage.state.target == 3
    # Until it is dropped everything is as it was.
    assert window.document.design == DESIGN
    send(lanes, QEvent.Type.MouseButtonRelease, end)
    assert tracks(window) == [(7, [1]), (3, [3, 2])]
    assert window.document.design.clip(2).onset_s == 0.3
    assert stage.state.target is None
    assert window.document.undo_stack.count() == 1
    window.document.undo_stack.undo()
    assert window.document.design == DESIGN
    assert window.document.view.selected_clips == (2,)


def test_ctrl_copies_and_a_free_place_gets_a_track(window, lanes):
    end = carry(window, lanes, 2, 13, CONTROL)
    send(lanes, QEvent.Type.MouseButtonRelease, end, CONTROL)
    assert tracks(window) == [(7, [1, 2]), (3, [3]), (13, [4])]
    assert window.document.view.selected_clips == (4,)


def test_escape_gives_it_up_and_leaves_no_step(window, lanes, stage):
    lanes.setFocus()
    end = carry(window, lanes, 2, 3)
    QTest.keyClick(lanes, Qt.Key.Key_Escape)
    assert stage.state.target is None
    send(lanes, QEvent.Type.MouseButtonRelease, end)
    assert window.document.design == DESIGN
    assert window.document.undo_stack.count() == 0


def test_beside_the_places_and_back_over_the_lanes_the_place_is_let_go(window, lanes, stage):
    carry(window, lanes, 2, 3)
    hand = window.panel("hand")
    corner = QPointF(lanes.mapFromGlobal(hand.mapToGlobal(hand.rect().topLeft())))
    send(lanes, QEvent.Type.MouseMove, corner + QPointF(3, 3))
    assert stage.state.target is None
    there = next(box.rect.center() for box in lanes.content.boxes if box.clip.id == 3)
    send(lanes, QEvent.Type.MouseMove, there)
    assert stage.state.target is None
    send(lanes, QEvent.Type.MouseButtonRelease, there)
    assert tracks(window) == [(7, [1]), (3, [3, 2])]
    assert window.document.design.clip(2).onset_s != 0.3
    assert window.document.undo_stack.count() == 1
