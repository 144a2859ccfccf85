"""The gain curve of a track on its lane: shown, drawn, stepped by keys."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from skinsource_gui.panels.timeline.content import show_gain_curves, shown_gain_curves
from tests.gui.timeline.bench import ALT, CONTROL, LEFT, SHIFT, LanesBench

_Key = Qt.Key


@pytest.fixture
def lanes(qtbot):
    """Two tracks, the first of which shows its gain curve."""
    bench = LanesBench(qtbot)
    bench.look(show_gain_curves(bench.view, (1,)))
    return bench


def with_curve(bench, *points):
    bench.show(bench.design.with_input(0, gain_curve=points))


def strip(bench):
    return next(strip for strip in bench.content.strips if strip.lane.track.id == 1)


def curve(bench):
    return bench.design.inputs[0].gain_curve


def on_line(bench, time_s):
    return strip(bench).at(time_s, strip(bench).gain_at(time_s))


def px(bench, seconds=0.0, gain=0.0):
    gain_strip = strip(bench)
    return QPointF(
        bench.content.scale.px_per_s * seconds, -gain * gain_strip.height_px / gain_strip.top
    )


def test_it_is_shown_and_hidden_by_a_key_on_lane_and_head_and_caught_only_where_it_is_shown(lanes):
    with_curve(lanes, (0.1, 1.0), (0.5, 0.4))
    lanes.key(_Key.Key_G)
    assert shown_gain_curves(lanes.view) == frozenset()
    (hint,) = lanes.content.strips
    assert not hint.shown
    lanes.drag(on_line(lanes, 0.4), on_line(lanes, 0.4) + px(lanes, gain=0.3))
    assert curve(lanes) == ((0.1, 1.0), (0.5, 0.4))
    lanes.rows.setFocus()
    lanes.key(_Key.Key_G)
    assert shown_gain_curves(lanes.view) == {1}


def test_shift_keeps_to_one_direction_and_ctrl_is_fine(lanes):
    with_curve(lanes, (0.1, 1.0), (0.3, 0.5), (0.9, 1.0))
    start = on_line(lanes, 0.3)
    lanes.drag(start, start + px(lanes, 0.2, 0.1), SHIFT)
    assert curve(lanes)[1][1] == 0.5
    assert curve(lanes)[1][0] == pytest.approx(0.5, abs=0.005)
    start = on_line(lanes, curve(lanes)[1][0])
    lanes.drag(start, start + px(lanes, 0.2), CONTROL)
    assert curve(lanes)[1][0] == pytest.approx(0.52, abs=0.002)
    start = on_line(lanes, curve(lanes)[1][0])
    lanes.drag(start, start + px(lanes, 0.6))
    # Others give it no more than room.
    assert curve(lanes)[1][0] == 0.9
    assert lanes.edits[-1][0] == "Change gain curve of input at 7 (II pad)"


def test_a_point_rests_on_a_gain_of_one_and_on_ends_of_clips_unless_alt_is_held(lanes):
    lanes.lanes.set_snaps(True)
    with_curve(lanes, (0.1, 1.0), (0.45, 0.5), (0.9, 1.0))
    way = px(lanes, 0.053, 0.5) + QPointF(0, 2)
    start = on_line(lanes, 0.45)
    lanes.drag(start, start + way)
    assert curve(lanes)[1] == (0.5, 1.0)
    with_curve(lanes, (0.1, 1.0), (0.45, 0.5), (0.9, 1.0))
    lanes.drag(start, start + way, ALT)
    assert curve(lanes)[1] != (0.5, 1.0)
    assert curve(lanes)[1] == pytest.approx((0.5, 1.0), abs=0.15)


def test_keys_choose_move_and_remove_points(lanes):
    with_curve(lanes, (0.1, 1.0), (0.5, 0.4), (0.9, 0.2))
    lanes.key(_Key.Key_PageDown, CONTROL)
    lanes.key(_Key.Key_PageDown, CONTROL)
    assert "Point 2 of the gain curve" in lanes.lanes.accessibleDescription()
    lanes.key(_Key.Key_Right)
    lanes.key(_Key.Key_Right, SHIFT)
    lanes.key(_Key.Key_Up)
    lanes.key(_Key.Key_Up, SHIFT)
    assert curve(lanes)[1] == pytest.approx((0.511, 0.51))
    assert len({gesture for _, _, gesture in lanes.edits}) == 1
    lanes.key(_Key.Key_Delete)
    assert curve(lanes) == ((0.1, 1.0), (0.9, 0.2))
    assert len(lanes.design.clips) == 4
    # Now the keys are about clips again.
    lanes.key(_Key.Key_Right)
    assert lanes.onset(1) == pytest.approx(0.001)
    lanes.key(_Key.Key_PageUp, CONTROL)
    assert lanes.content.chosen_point == (1, 1)
    lanes.key(_Key.Key_Escape)
    assert lanes.content.chosen_point is None
    assert lanes.lanes.accessibleDescription() == ""


def test_insert_adds_a_point_at_the_playhead_and_shows_the_curve(lanes):
    with_curve(lanes, (0.1, 1.0), (0.5, 0.2))
    lanes.look(show_gain_curves(replace(lanes.view, playhead_s=0.3), ()))
    lanes.key(_Key.Key_Insert)
    assert curve(lanes) == ((0.1, 1.0), (0.3, 0.6), (0.5, 0.2))
    assert lanes.content.chosen_point == (1, 1)
    assert shown_gain_curves(lanes.view) == {1}


def test_the_menu_on_a_point_removes_it_or_the_curve(lanes):
    with_curve(lanes, (0.1, 1.0), (0.5, 0.4))
    lanes.menu_at(on_line(lanes, 0.5))["Remove point"].trigger()
    assert curve(lanes) == ((0.1, 1.0),)
    lanes.menu_at(on_line(lanes, 0.3))["Remove gain curve"].trigger()
    assert curve(lanes) == ()


def test_a_lane_gives_higher_gains_room_only_once_the_button_is_up(lanes):
    with_curve(lanes, (0.1, 1.0), (0.5, 1.0))
    start = on_line(lanes, 0.5)
    lanes.drag(start, start + px(lanes, gain=2.0), release=False)
    assert curve(lanes)[1][1] == pytest.approx(3.0, abs=0.1)
    assert strip(lanes).top == 2.0
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert strip(lanes).top > 3.0
