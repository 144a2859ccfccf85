"""What the mouse does to clips."""

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from tests.gui.timeline.lanes_bench import LEFT, LanesBench

CONTROL, SHIFT, ALT = (
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)


@pytest.fixture
def lanes(qtbot):
    return LanesBench(qtbot)


def middle(bench, clip):
    return bench.box(clip).center()


def px(bench, seconds):
    return QPointF(bench.content.scale.px_per_s * seconds, 0)


def test_a_clip_follows_the_pointer_by_whole_samples_and_is_one_step(lanes):
    lanes.lanes.set_snaps(False)
    lanes.drag(middle(lanes, 3), middle(lanes, 3) + px(lanes, 0.1))
    samples = (lanes.onset(3) - 0.7) * 1300
    assert lanes.onset(3) == pytest.approx(0.8, abs=0.003)
    assert samples == pytest.approx(round(samples), abs=1e-6)
    assert len({gesture for _, _, gesture in lanes.edits}) == 1
    assert lanes.edits[0][2] is not None
    assert lanes.view.selected_clips == (3,)


def test_an_edge_snaps_to_the_end_of_a_clip_on_another_track_and_shows_where(lanes):
    # The clip on the other track ends at 0.3 s.
    start = middle(lanes, 3)
    lanes.drag(start, start + px(lanes, -0.4 + 0.003), release=False)
    assert lanes.onset(3) == pytest.approx(0.3, abs=1e-12)
    assert lanes.lanes.overlay.preview.guide_s == pytest.approx(0.3)
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert lanes.lanes.overlay.preview.guide_s is None


def test_selected_clips_move_together_and_none_starts_before_zero(lanes):
    lanes.click(middle(lanes, 4))
    lanes.click(middle(lanes, 2), CONTROL)
    assert set(lanes.view.selected_clips) == {2, 4}
    lanes.drag(middle(lanes, 2), middle(lanes, 2) + px(lanes, -0.25))
    assert lanes.onset(4) == pytest.approx(0.0, abs=1e-12)
    assert lanes.onset(4) >= 0.0
    assert lanes.onset(2) == pytest.approx(0.2)


def test_escape_gives_a_drag_up_as_if_it_had_not_begun(lanes):
    before = lanes.design
    lanes.drag(middle(lanes, 3), middle(lanes, 3) + px(lanes, 0.1), release=False)
    assert lanes.design != before
    lanes.key(Qt.Key.Key_Escape)
    assert lanes.design == before
    after_escape = len(lanes.edits)
    QTest.mouseMove(lanes.lanes.viewport(), lanes.box(1).center().toPoint())
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert len(lanes.edits) == after_escape
    assert lanes.edits[-1][2] == lanes.edits[0][2]


def test_a_start_is_dragged_and_the_end_stays(lanes):
    lanes.lanes.set_snaps(False)
    box = lanes.box(2)
    lanes.drag(QPointF(box.left() + 2, box.center().y()), box.center())
    clip = lanes.design.clip(2)
    assert clip.onset_s == pytest.approx(0.4, abs=0.004)
    assert clip.end_s == pytest.approx(0.5)


def test_a_rectangle_selects_what_it_touches_over_all_tracks(lanes):
    lanes.drag(lanes.at(0.62), lanes.at(0.25, lane=1))
    assert set(lanes.view.selected_clips) == {2, 4}
    assert set(lanes.view.selected_inputs) == {1, 2}
    assert lanes.edits == []


def test_a_click_on_the_ground_puts_the_playhead_there_and_selects_the_track(lanes):
    lanes.lanes.set_snaps(False)
    lanes.click(middle(lanes, 1))
    lanes.click(lanes.at(0.62, lane=1))
    assert lanes.view.playhead_s == pytest.approx(0.62, abs=0.002)
    assert (lanes.view.selected_clips, lanes.view.selected_inputs) == ((), (2,))


def test_the_pointer_shows_what_can_be_dragged(lanes):
    box = lanes.box(2)
    cursor = lanes.lanes.mouse.cursor_at
    assert cursor(box.center()) == Qt.CursorShape.OpenHandCursor
    assert cursor(QPointF(box.left() + 2, box.center().y())) == Qt.CursorShape.SizeHorCursor
    assert cursor(box.topLeft() + QPointF(3, 3)) == Qt.CursorShape.SizeFDiagCursor
    assert cursor(box.topRight() + QPointF(-3, 3)) == Qt.CursorShape.SizeBDiagCursor
    assert cursor(lanes.at(0.62)) == Qt.CursorShape.ArrowCursor


def test_an_end_can_be_caught_from_a_little_outside(lanes):
    box = lanes.box(2)
    lanes.drag(QPointF(box.right() + 3, box.center().y()), box.center(), ALT)
    assert lanes.design.clip(2).duration_s < 0.15
    cursor = lanes.lanes.mouse.cursor_at
    box = lanes.box(3)
    assert cursor(QPointF(box.left() - 3, box.center().y())) == Qt.CursorShape.SizeHorCursor


def test_keys_act_on_the_clip_that_the_inspector_shows_where_none_is_selected(lanes):
    lanes.click(lanes.at(0.62))
    assert lanes.view.selected_clips == ()
    lanes.key(Qt.Key.Key_M)
    assert [clip.muted for clip in lanes.design.inputs[0].clips] == [True, False, False]


def test_a_new_clip_lies_on_the_grid(lanes):
    QTest.mouseDClick(lanes.lanes.viewport(), LEFT, pos=lanes.at(0.617, lane=1).toPoint())
    onset_s = lanes.design.inputs[1].clips[-1].onset_s
    steps = onset_s / lanes.content.grid_s
    assert steps == pytest.approx(round(steps), abs=1e-6) or onset_s in (0.3, 0.5, 0.7)


def test_a_corner_fades_and_the_fade_is_caught_again_where_it_ends(lanes):
    box = lanes.box(2)
    corner = box.topLeft() + QPointF(3, 4)
    lanes.drag(corner, corner + px(lanes, 0.05))
    (fade,) = lanes.design.clip(2).effects
    assert fade.in_s == pytest.approx(0.05, abs=0.003)
    assert fade.out_s == 0.0
    end = box.topLeft() + QPointF(3, 4) + px(lanes, 0.05)
    assert lanes.lanes.mouse.cursor_at(end) == Qt.CursorShape.SizeFDiagCursor
    lanes.drag(end, end + px(lanes, -0.02))
    (fade,) = lanes.design.clip(2).effects
    assert fade.in_s == pytest.approx(0.03, abs=0.004)
