"""Keys and menus of the lanes, clips that lie over each other, and gain curves."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QInputDialog, QMenu, QToolButton

from skinsource import Clip, edits
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.content import (
    overlapping,
    overlaps_of,
    show_gain_curves,
    shown_gain_curves,
)
from skinsource_gui.panels.timeline.gestures import GesturePreview
from tests.gui.timeline.bench import ALT, CONTROL, LEFT, NONE, SHIFT, LanesBench

_Key = Qt.Key


def test_shift_and_down_selects_besides_the_nearest_clip_below_and_up_goes_back(lanes):
    lanes.click(lanes.middle(2))
    lanes.key(_Key.Key_Down, SHIFT)
    assert lanes.view.selected_clips == (2, 4)
    # From the last one, which starts at 0.1 s: the first clip is the nearest.
    for _ in range(2):
        lanes.key(_Key.Key_Up, SHIFT)
        assert lanes.view.selected_clips == (2, 4, 1)
    assert lanes.edits == []


def test_a_click_on_the_ground_selects_the_track_alone_and_keys_then_move_and_remove_no_clip(lanes):
    before = lanes.design
    lanes.click(lanes.at(0.62))
    assert (lanes.view.selected_inputs, lanes.view.selected_clips) == ((1,), ())
    for key in (_Key.Key_Delete, _Key.Key_Right, _Key.Key_S, _Key.Key_M):
        lanes.key(key)
    assert lanes.design is before
    lanes.look(edits.select_clips(before, lanes.view, (2, 4)).view)
    lanes.click(lanes.at(0.62), CONTROL)
    assert lanes.view.selected_clips == (2, 4)


def test_on_clips_the_menu_is_about_one_or_all_that_are_selected(lanes):
    lines = lanes.menu_at(lanes.middle(2))
    assert lanes.view.selected_clips == (2,)
    lines["Mute clip"].trigger()
    assert lanes.design.clip(2).muted
    lanes.drag(lanes.at(0.62), lanes.at(0.25, lane=1))
    lanes.menu_at(lanes.middle(4))["Duplicate 2 clips"].trigger()
    assert len(lanes.design.clips) == 6
    lanes.click(lanes.middle(1))
    lanes.menu_at(lanes.middle(1))["Remove clip"].trigger()
    assert 1 not in [clip.id for clip in lanes.design.clips]


def test_a_clip_is_moved_to_a_place_added_copied_and_pasted(lanes):
    lanes.menu_at(lanes.middle(3))
    places = lanes.panel.findChild(QMenu, "lanes_places")
    entry = next(action for action in places.actions() if action.text().startswith("15 "))
    assert entry.text().endswith("(new track)")
    entry.trigger()
    assert lanes.design.track_of(3).location == 15
    lanes.menu_at(lanes.at(0.62, lane=1))["Add clip here"].trigger()
    assert lanes.design.inputs[1].clips[-1].onset_s == pytest.approx(0.62, abs=1e-3)
    asked = []
    lanes.panel.action_requested.connect(asked.append)
    lanes.menu_at(lanes.middle(1))["Copy"].trigger()
    lanes.menu_at(lanes.at(0.62))["Paste at playhead"].trigger()
    lanes.menu_at(lanes.middle(1))["Paste at playhead"].trigger()
    assert asked == ["copy_clips", "paste_clips", "paste_clips"]


def test_only_layers_are_offered_to_be_ungrouped(lanes):
    assert "Ungroup layers" not in lanes.menu_at(lanes.middle(1))
    lanes.show(edits.group_clips(lanes.design, lanes.view, (1, 2)).design)
    lanes.menu_at(lanes.middle(1))["Ungroup layers"].trigger()
    assert len(lanes.design.inputs[0].clips) == 3


def test_a_double_click_on_the_ruler_puts_playhead_and_marker_at_one_time(lanes):
    lanes.lanes.change(snaps=True)
    at = lanes.on_ruler(0.3) + QPointF(3, 0)
    lanes.click(at)
    lanes.double_click(at)
    assert [marker.time_s for marker in lanes.design.markers] == [lanes.view.playhead_s]
    assert lanes.view.playhead_s == pytest.approx(0.3)


def test_a_marker_that_is_dragged_onto_another_stays_beside_it(lanes):
    lanes.lanes.change(snaps=True)
    for time_s in (0.4, 0.62):
        lanes.show(edits.add_marker(lanes.design, lanes.view, time_s).design)
    lanes.drag(lanes.on_ruler(0.62, 6), lanes.on_ruler(0.4, 6), steps=9)
    times_s = [marker.time_s for marker in lanes.design.markers]
    assert times_s[0] == 0.4 < times_s[1] < 0.6
    assert f"{times_s[1] * 1e3:.5g} ms" in lanes.refusals[-1]


def test_keys_and_the_menu_put_copies_behind(lanes):
    lanes.click(lanes.middle(4))
    lanes.key(_Key.Key_R)
    lanes.key(_Key.Key_D, CONTROL)
    lanes.menu_at(lanes.middle(4))["Repeat clip"].trigger()
    onsets_s = [clip.onset_s for clip in lanes.design.inputs[1].clips]
    assert onsets_s == pytest.approx([0.1, 0.3, 0.5, 0.7])


def test_markers_are_added_renamed_and_removed_on_the_ruler(lanes, monkeypatch):
    place = QPointF(lanes.content.scale.x(0.5), 5)
    lanes.menu_at(place)["Add marker here"].trigger()
    assert lanes.design.markers[0].time_s == pytest.approx(0.5)
    asked, answers = [], iter(["x" * 101, "touch"])

    def ask(*args, text):
        asked.append((args[2], text))
        return next(answers), True

    monkeypatch.setattr(QInputDialog, "getText", ask)
    lanes.menu_at(place)["Rename marker…"].trigger()
    assert asked[1][1] == "x" * 101
    assert "100 letters" in asked[1][0]
    assert lanes.design.markers[0].name == "touch"
    lanes.menu_at(place)["Remove marker"].trigger()
    assert lanes.design.markers == ()


def test_a_drag_never_changes_the_zoom_and_fit_shows_the_clips_alone(lanes):
    fit = lanes.panel.findChild(QToolButton, "timeline_fit")
    for fitted in (False, True):
        if fitted:
            fit.click()
            end_s = max(clip.end_s for clip in lanes.design.clips)
            assert lanes.content.scale.shown_s == pytest.approx((0.0, end_s), abs=0.03)
        shown_s = lanes.content.scale.shown_s
        lanes.drag(lanes.middle(3), lanes.middle(3) + lanes.px(0.5))
        lanes.drag(lanes.middle(2), lanes.middle(2) + lanes.px(-0.1))
        assert lanes.content.scale.shown_s == shown_s
        lanes.key(_Key.Key_Right)
    assert lanes.view.time_range_s is None
    # What comes from elsewhere behind the edge is shown.
    late = Clip(onset_s=5.0, waveform=SHORT)
    lanes.show(lanes.design.with_input(1, clips=(late,)))
    assert lanes.content.scale.shown_s[1] > 5.1


LONG, SHORT = Tone(100.0, 0.0, 0.6), Tone(100.0, 0.0, 0.1)


def test_overlaps_are_where_two_clips_or_more_play():
    spans = [(0.0, 0.6), (0.2, 0.3), (0.55, 0.65), (0.65, 0.75)]
    assert overlaps_of(spans) == [(0.2, 0.3), (0.55, 0.6)]
    assert overlaps_of([spans[0], spans[0], spans[1]]) == [(0.0, 0.6)]
    # Clips that follow each other, with the rounding of their lengths, do not overlap.
    assert overlaps_of([(0.1, 0.2 + 1e-12), (0.2, 0.3)]) == []


def test_a_key_and_the_menu_reach_clips_that_overlap(lanes):
    # Of the clips of a track, the second lies below the first; the third over its end.
    onsets = ((0.0, LONG), (0.2, SHORT), (0.55, SHORT), (0.65, SHORT))
    clips = tuple(Clip(onset_s=onset_s, waveform=waveform) for onset_s, waveform in onsets)
    lanes.show(lanes.design.with_input(0, clips=clips))
    ids = [clip.id for clip in lanes.design.inputs[0].clips]
    lanes.click(lanes.at(0.05))
    selected = []
    for _ in range(3):
        lanes.key(_Key.Key_O)
        selected.append(lanes.view.selected_clips[0])
    assert selected == [ids[1], ids[0], ids[1]]
    track = lanes.design.inputs[0]
    assert overlapping(track, track.clips[0]) == tuple(ids[:3])
    assert overlapping(track, track.clips[3]) == (ids[3],)
    lanes.menu_at(lanes.at(0.25))
    lines = lanes.panel.findChild(QMenu, "clips_here").actions()
    assert [line.text() for line in lines] == ["Tone · 0 ms", "Tone · 200 ms"]
    lines[0].trigger()
    assert lanes.view.selected_clips == (ids[0],)


def test_what_the_clip_panel_edits_is_outlined_on_every_selected_track(lanes):
    lanes.click(lanes.middle(2))
    lanes.press(1, held=SHIFT)
    assert lanes.view.selected_inputs == (1, 2)
    assert lanes.content.chosen == (1, 4)
    edited = edits.change_field(lanes.design, lanes.view, (1, 2), "onset_s", 1.2).design
    moved = [clip.id for clip in edited.clips if clip != lanes.design.clip(clip.id)]
    assert moved == [1, 4]


def test_a_drag_whose_edit_is_undone_meanwhile_ends_with_its_label(lanes):
    start, before = lanes.middle(3), lanes.design
    lanes.drag(start, start + lanes.px(0.1), release=False)
    lanes.show(before)
    lanes.lanes.mouse.move(start + lanes.px(0.2), NONE)
    assert not lanes.lanes.mouse.busy
    assert lanes.lanes.overlay.preview == GesturePreview()
    assert lanes.design is before


@pytest.fixture
def curved(qtbot):
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


def test_it_is_shown_and_hidden_by_a_key_on_lane_and_head_and_caught_only_where_it_is_shown(curved):
    with_curve(curved, (0.1, 1.0), (0.5, 0.4))
    curved.key(_Key.Key_G)
    assert shown_gain_curves(curved.view) == frozenset()
    (hint,) = curved.content.strips
    assert not hint.shown
    curved.drag(on_line(curved, 0.4), on_line(curved, 0.4) + px(curved, gain=0.3))
    assert curve(curved) == ((0.1, 1.0), (0.5, 0.4))
    curved.rows.setFocus()
    curved.key(_Key.Key_G)
    assert shown_gain_curves(curved.view) == {1}


def test_shift_keeps_to_one_direction_and_ctrl_is_fine(curved):
    with_curve(curved, (0.1, 1.0), (0.3, 0.5), (0.9, 1.0))
    start = on_line(curved, 0.3)
    curved.drag(start, start + px(curved, 0.2, 0.1), SHIFT)
    assert curve(curved)[1][1] == 0.5
    assert curve(curved)[1][0] == pytest.approx(0.5, abs=0.005)
    start = on_line(curved, curve(curved)[1][0])
    curved.drag(start, start + px(curved, 0.2), CONTROL)
    assert curve(curved)[1][0] == pytest.approx(0.52, abs=0.002)
    start = on_line(curved, curve(curved)[1][0])
    curved.drag(start, start + px(curved, 0.6))
    # Others give it no more than room.
    assert curve(curved)[1][0] == 0.9
    assert curved.edits[-1][0] == "Change gain curve of input at 7 (II pad)"


def test_a_point_rests_on_a_gain_of_one_and_on_ends_of_clips_unless_alt_is_held(curved):
    curved.lanes.change(snaps=True)
    with_curve(curved, (0.1, 1.0), (0.45, 0.5), (0.9, 1.0))
    way = px(curved, 0.053, 0.5) + QPointF(0, 2)
    start = on_line(curved, 0.45)
    curved.drag(start, start + way)
    assert curve(curved)[1] == (0.5, 1.0)
    with_curve(curved, (0.1, 1.0), (0.45, 0.5), (0.9, 1.0))
    curved.drag(start, start + way, ALT)
    assert curve(curved)[1] != (0.5, 1.0)
    assert curve(curved)[1] == pytest.approx((0.5, 1.0), abs=0.15)


def test_keys_choose_move_and_remove_points(curved):
    with_curve(curved, (0.1, 1.0), (0.5, 0.4), (0.9, 0.2))
    curved.key(_Key.Key_PageDown, CONTROL)
    curved.key(_Key.Key_PageDown, CONTROL)
    assert "Point 2 of the gain curve" in curved.lanes.accessibleDescription()
    curved.key(_Key.Key_Right)
    curved.key(_Key.Key_Right, SHIFT)
    curved.key(_Key.Key_Up)
    curved.key(_Key.Key_Up, SHIFT)
    assert curve(curved)[1] == pytest.approx((0.511, 0.51))
    assert len({gesture for _, _, gesture in curved.edits}) == 1
    curved.key(_Key.Key_Delete)
    assert curve(curved) == ((0.1, 1.0), (0.9, 0.2))
    assert len(curved.design.clips) == 4
    # Now the keys are about clips again.
    curved.look(replace(curved.view, selected_clips=(1,)))
    curved.key(_Key.Key_Right)
    assert curved.onset(1) == pytest.approx(0.001)
    curved.key(_Key.Key_PageUp, CONTROL)
    assert curved.content.chosen_point == (1, 1)
    curved.key(_Key.Key_Escape)
    assert curved.content.chosen_point is None
    assert curved.lanes.accessibleDescription() == ""


def test_insert_adds_a_point_at_the_playhead_and_shows_the_curve(curved):
    with_curve(curved, (0.1, 1.0), (0.5, 0.2))
    curved.look(show_gain_curves(replace(curved.view, playhead_s=0.3), ()))
    curved.key(_Key.Key_Insert)
    assert curve(curved) == ((0.1, 1.0), (0.3, 0.6), (0.5, 0.2))
    assert curved.content.chosen_point == (1, 1)
    assert shown_gain_curves(curved.view) == {1}


def test_the_menu_on_a_point_removes_it_or_the_curve(curved):
    with_curve(curved, (0.1, 1.0), (0.5, 0.4))
    curved.menu_at(on_line(curved, 0.5))["Remove point"].trigger()
    assert curve(curved) == ((0.1, 1.0),)
    curved.menu_at(on_line(curved, 0.3))["Remove gain curve"].trigger()
    assert curve(curved) == ()


def test_a_lane_gives_higher_gains_room_only_once_the_button_is_up(curved):
    with_curve(curved, (0.1, 1.0), (0.5, 1.0))
    start = on_line(curved, 0.5)
    curved.drag(start, start + px(curved, gain=2.0), release=False)
    assert curve(curved)[1][1] == pytest.approx(3.0, abs=0.1)
    assert strip(curved).top == 2.0
    QTest.mouseRelease(curved.lanes.viewport(), LEFT)
    assert strip(curved).top > 3.0
