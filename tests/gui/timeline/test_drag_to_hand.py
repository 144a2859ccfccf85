"""Clips dragged from the timeline onto the hand, in the whole window."""

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from skinsource.design.view import View
from tests.gui.timeline.bench import LEFT, NONE, TWO_TRACKS

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
