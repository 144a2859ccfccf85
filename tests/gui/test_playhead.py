"""One playhead, in the view: the timeline and the traces show it, and move it."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource import Clip, Design, Input, Marker, View, edits
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline import painting
from skinsource_gui.panels.timeline.lanes import LanesView
from skinsource_gui.plots.plot import Plot, stops_of
from skinsource_gui.state.engine import Purpose

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
ALT, SHIFT = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ShiftModifier
CLIPS = (Clip(onset_s=0.1, waveform=Tone(100.0, 0.0, 0.2)), Clip(onset_s=0.6))
DESIGN = Design(
    limb="synthetic-1", inputs=(Input(location=7, clips=CLIPS),), markers=(Marker(time_s=0.45),)
)


@pytest.fixture
def window(open_window):
    return open_window(DESIGN, View(playhead_s=0.25))


@pytest.fixture
def lanes(window):
    return window.findChild(LanesView, "lanes")


@pytest.fixture
def plot(window):
    return window.findChild(Plot, "traces-plot")


def at(plot, time_s):
    area = plot.places.area
    x = plot.places.left + plot.x_window.part(time_s) * area.width()
    return QPoint(round(x), round(area.center().y()))


def drag(plot, start_s, end_s, *, release=True):
    """Press, move in steps, and let go; pyqtgraph learns of drags from moves alone."""
    view, start, end = plot.viewport(), at(plot, start_s), at(plot, end_s)
    QTest.mouseMove(view, start)
    QTest.mousePress(view, LEFT, NONE, start)
    for step in range(1, 5):
        QTest.mouseMove(view, start + (end - start) * (step / 4))
    if release:
        QTest.mouseRelease(view, LEFT, NONE, end)


def shown_in_lanes(lanes):
    return lanes.content.scale.time(lanes.playhead.pos().x())


def test_it_is_dragged_in_the_traces_and_stands_there_in_the_timeline(window, plot, lanes):
    drag(plot, 0.25, 0.5)
    assert window.document.view.playhead_s == pytest.approx(0.5, abs=0.01)
    assert plot.playhead.position == window.document.view.playhead_s
    assert shown_in_lanes(lanes) == pytest.approx(window.document.view.playhead_s, abs=1e-9)
    assert not window.document.undo_stack.count()
    # What was dragged is the playhead: nothing was zoomed.
    assert window.document.view.time_range_s is None


def test_escape_gives_up_a_drag_in_the_traces(window, plot, lanes):
    plot.setFocus()
    drag(plot, 0.25, 0.5, release=False)
    assert window.document.view.playhead_s > 0.4
    QTest.keyClick(plot, Qt.Key.Key_Escape)
    assert window.document.view.playhead_s == 0.25
    QTest.mouseMove(plot.viewport(), at(plot, 0.7))
    QTest.mouseRelease(plot.viewport(), LEFT, NONE, at(plot, 0.7))
    assert window.document.view.playhead_s == 0.25
    assert plot.playhead.position == 0.25
    assert shown_in_lanes(lanes) == pytest.approx(0.25)


@pytest.mark.parametrize("where", ["lanes", "plot"])
def test_keys_move_it_by_steps_and_from_stop_to_stop(window, lanes, plot, where):
    place = lanes if where == "lanes" else plot
    place.setFocus()
    playheads_s = []
    down, up = Qt.Key.Key_PageDown, Qt.Key.Key_PageUp
    steps = [(Qt.Key.Key_Right, ALT), (Qt.Key.Key_Left, ALT | SHIFT)]
    for key, held in (*steps, (down, NONE), (down, NONE), (up, NONE), (up, NONE)):
        QTest.keyClick(place, key, held)
        playheads_s.append(window.document.view.playhead_s)
    assert playheads_s == pytest.approx([0.251, 0.241, 0.3, 0.45, 0.3, 0.1], abs=1e-12)
    assert window.document.design is DESIGN


def test_stops_are_ends_of_clips_and_of_the_loop_and_markers():
    assert stops_of(replace(DESIGN, loop_s=(0.2, 0.9))) == pytest.approx(
        (0.0, 0.1, 0.2, 0.3, 0.45, 0.6, CLIPS[1].end_s, 0.9)
    )


def test_a_key_brings_what_is_seen_to_where_it_goes(window, lanes):
    document = window.document
    document.look(replace(document.view, time_range_s=(0.2, 0.4)))
    lanes.setFocus()
    QTest.keyClick(lanes, Qt.Key.Key_PageDown)
    QTest.keyClick(lanes, Qt.Key.Key_PageDown)
    assert document.view.playhead_s == 0.45
    low, high = document.view.time_range_s
    assert low <= 0.45 <= high
    assert high - low == pytest.approx(0.2)


def test_moving_it_evaluates_nothing_and_paints_nothing_but_lines(
    window, lanes, plot, settle, monkeypatch
):
    settle()
    asked, changes = [], []
    monkeypatch.setattr(window.engine, "request", asked.append)
    window.document.changed.connect(lambda: changes.append(1))
    monkeypatch.setattr(painting, "paint_silence_reason", lambda *_: changes.append(3))
    shown = [(panel, panel.show_state) for panel in window.panels]
    for panel, _ in shown:
        monkeypatch.setattr(panel, "show_state", lambda *_: changes.append(2))
    for step in range(20):
        window.document.look(replace(window.document.view, playhead_s=0.3 + 0.01 * step))
        QApplication.processEvents()
    # Results are checked and judged a while after they came, whatever is done meanwhile.
    later = (Purpose.CHECK, Purpose.JUDGE)
    assert [request for request in asked if request.purpose not in later] == []
    assert changes == []
    assert shown_in_lanes(lanes) == plot.playhead.position == pytest.approx(0.49)


def test_an_edit_of_a_panel_that_knows_an_older_place_leaves_it_where_it_is(window):
    document, hand = window.document, window.panel("hand")
    stale = document.view
    document.look(replace(document.view, playhead_s=0.7))
    hand.edited.emit(edits.toggle_mute(document.design, stale, (1,)), None)
    assert document.design.inputs[0].muted
    assert document.view.playhead_s == 0.7
    hand.view_changed.emit(replace(stale, outputs=(3,)))
    assert (document.view.playhead_s, document.view.outputs) == (0.7, (3,))
