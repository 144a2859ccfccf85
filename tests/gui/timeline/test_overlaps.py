"""Clips that lie over each other: each can be reached, by mouse and keys."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QHelpEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QToolTip

from skinsource.design.clips import Clip
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.content import overlapping, overlaps_of
from tests.gui.timeline.lanes_bench import LEFT, LanesBench

LONG, SHORT = Tone(100.0, 0.0, 0.6), Tone(100.0, 0.0, 0.1)
# The second lies wholly below the first; the third over the end of the first.
CLIPS = (
    Clip(onset_s=0.0, waveform=LONG),
    Clip(onset_s=0.2, waveform=SHORT),
    Clip(onset_s=0.55, waveform=SHORT),
    Clip(onset_s=0.65, waveform=SHORT),
)


@pytest.fixture
def lanes(qtbot):
    bench = LanesBench(qtbot)
    bench.show(bench.design.with_input(0, clips=CLIPS))
    return bench


def test_overlaps_are_where_two_clips_or_more_play():
    spans = [(0.0, 0.6), (0.2, 0.3), (0.55, 0.65), (0.65, 0.75)]
    assert overlaps_of(spans) == [(0.2, 0.3), (0.55, 0.6)]
    assert overlaps_of([spans[0], spans[0], spans[1]]) == [(0.0, 0.6)]
    # Clips that follow each other, with the rounding of their lengths, do not overlap.
    assert overlaps_of([(0.1, 0.2 + 1e-12), (0.2, 0.3)]) == []
    assert overlaps_of([]) == []


def test_repeated_clicks_go_through_the_clips_below_the_pointer(lanes):
    place = lanes.at(0.25)
    ids = [clip.id for clip in lanes.design.inputs[0].clips]
    selected = []
    for _ in range(4):
        lanes.click(place)
        selected += lanes.view.selected_clips
    assert set(selected[:2]) == set(ids[:2])
    assert selected[2:] == selected[:2]
    assert lanes.edits == []


def test_a_clip_below_is_dragged_once_it_is_selected(lanes):
    small = lanes.design.inputs[0].clips[1].id
    place = lanes.at(0.25)
    while lanes.view.selected_clips != (small,):
        lanes.click(place)
    lanes.lanes.set_snaps(False)
    lanes.drag(place, place + QPointF(lanes.content.scale.px_per_s * 0.1, 0))
    assert lanes.onset(small) == pytest.approx(0.3, abs=0.003)
    assert lanes.design.inputs[0].clips[0].onset_s == 0.0


def test_a_double_click_opens_the_clip_that_was_on_top(lanes):
    small = lanes.design.inputs[0].clips[1].id
    place = lanes.at(0.25)
    while lanes.view.selected_clips != (small,):
        lanes.click(place)
    opened = []
    lanes.lanes.opened.connect(opened.append)
    # A double click begins with a click, which goes on to the next clip.
    lanes.click(place)
    QTest.mouseDClick(lanes.lanes.viewport(), LEFT, pos=place.toPoint())
    assert opened == [small]
    assert lanes.view.selected_clips == (small,)


def test_a_key_goes_through_clips_that_overlap(lanes):
    ids = [clip.id for clip in lanes.design.inputs[0].clips]
    lanes.click(lanes.at(0.05))
    selected = []
    for _ in range(3):
        lanes.key(Qt.Key.Key_O)
        selected.append(lanes.view.selected_clips[0])
    assert selected == [ids[1], ids[0], ids[1]]
    track = lanes.design.inputs[0]
    assert overlapping(track, track.clips[0]) == tuple(ids[:3])
    assert overlapping(track, track.clips[3]) == (ids[3],)


def test_the_menu_lists_the_clips_here(lanes):
    place = lanes.at(0.25)
    lanes.lanes.menu.open(QPoint(0, 0), place)
    menu = lanes.panel.findChild(QMenu, "clips_here")
    texts = [action.text() for action in menu.actions()]
    assert texts == ["Tone · 0 ms", "Tone · 200 ms"]
    menu.actions()[1].trigger()
    assert lanes.view.selected_clips == (lanes.design.inputs[0].clips[1].id,)
    for action in lanes.panel.findChildren(QMenu, "lanes_menu"):
        action.close()


def test_the_pointer_is_told_how_many_clips_are_here(lanes):
    at = lanes.at(0.25).toPoint()
    view = lanes.lanes.viewport()
    event = QHelpEvent(QEvent.Type.ToolTip, at, view.mapToGlobal(at))
    QApplication.sendEvent(view, event)
    assert QToolTip.text() == "2 clips here: click again, or O, for the next"
