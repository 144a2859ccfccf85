"""Each gesture that help lists for the timeline, made, and what comes of it."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QInputDialog, QMenu, QToolButton

from skinsource import Marker, edits
from skinsource.design.display_units import value_text
from skinsource_gui.panels.timeline.content import show_gain_curves, timeline_tooltip
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.keys import MOUSE
from tests.gui.timeline.bench import ALT, CONTROL, LEFT, NONE, SHIFT
from tests.gui.wheel import turn_wheel

DOWN = QPointF(0, 48)


def end_of(lanes, clip):
    box = lanes.box(clip)
    return QPointF(box.right() - 2, box.center().y())


def start_of(lanes, clip):
    box = lanes.box(clip)
    return QPointF(box.left() + 2, box.center().y())


def move(lanes):
    lanes.drag(lanes.middle(3), lanes.middle(3) + lanes.px(0.1) + DOWN)
    assert lanes.onset(3) == pytest.approx(0.8, abs=0.004)
    assert lanes.design.track_of(3).id == 2
    # By whole samples, in one step.
    samples = (lanes.onset(3) - 0.7) * 1300
    assert samples == pytest.approx(round(samples), abs=1e-6)
    assert len({gesture for _, _, gesture in lanes.edits}) == 1
    assert lanes.edits[0][2] is not None
    assert lanes.view.selected_clips == (3,)


def along(lanes):
    lanes.drag(lanes.middle(3), lanes.middle(3) + lanes.px(0.1) + DOWN, SHIFT)
    assert lanes.onset(3) == pytest.approx(0.8, abs=0.004)
    assert lanes.design.track_of(3).id == 1


def copy(lanes):
    lanes.drag(lanes.middle(4), lanes.middle(4) + lanes.px(0.25), CONTROL)
    assert len(lanes.design.inputs[1].clips) == 2


def free(lanes):
    lanes.lanes.change(snaps=True)
    lanes.drag(lanes.middle(3), lanes.middle(3) + lanes.px(-0.397), ALT)
    assert lanes.onset(3) != pytest.approx(0.3, abs=1e-6)
    assert lanes.onset(3) == pytest.approx(0.303, abs=0.004)


def trim(lanes):
    lanes.drag(end_of(lanes, 2), end_of(lanes, 2) - lanes.px(0.1))
    (effect,) = lanes.design.clip(2).effects
    assert type(effect).__name__ == "Trim"
    assert lanes.design.clip(2).duration_s == pytest.approx(0.1, abs=0.004)
    lanes.drag(start_of(lanes, 1), start_of(lanes, 1) + lanes.px(0.05))
    assert lanes.onset(1) == pytest.approx(0.05, abs=0.004)
    assert lanes.design.clip(1).end_s == pytest.approx(0.2)


def stretch(lanes):
    for held in (SHIFT, ALT):
        before = lanes.design
        lanes.drag(end_of(lanes, 2), end_of(lanes, 2) + lanes.px(0.1), held)
        (effect,) = lanes.design.clip(2).effects
        assert type(effect).__name__ == "Stretch"
        assert lanes.design.clip(2).duration_s == pytest.approx(0.3, abs=0.004)
        lanes.show(before)


def fade(lanes):
    corner = lanes.box(2).topLeft() + QPointF(3, 4)
    lanes.drag(corner, corner + lanes.px(0.05))
    (effect,) = lanes.design.clip(2).effects
    assert (effect.in_s, effect.out_s) == (pytest.approx(0.05, abs=0.003), 0.0)
    # To a tenth of a millisecond.
    assert effect.in_s == pytest.approx(round(effect.in_s, 4), abs=1e-9)
    # It is caught again where it ends.
    end = corner + lanes.px(0.05)
    assert lanes.lanes.mouse.cursor_at(end) == Qt.CursorShape.SizeFDiagCursor
    lanes.drag(end, end + lanes.px(-0.02))
    corner = lanes.box(2).topRight() + QPointF(-3, 4)
    lanes.drag(corner, corner + lanes.px(-0.05))
    (effect,) = lanes.design.clip(2).effects
    assert effect.in_s == pytest.approx(0.03, abs=0.004)
    assert effect.out_s == pytest.approx(0.05, abs=0.003)
    # A part has its fade where it was.
    lanes.lanes.edit(edits.split_clips, (2,), lanes.onset(2) + 0.1)
    corner = lanes.box(2).topLeft() + lanes.px(0.03) + QPointF(3, 4)
    lanes.drag(corner, corner + lanes.px(-0.02))
    assert lanes.design.clip(2).effects[1].in_s == pytest.approx(0.01, abs=0.004)


def place(lanes):
    lanes.lanes.elsewhere = lambda at: (
        DropPlace(location=13) if at is not None and at.y() > 400 else None
    )
    start, end, before = lanes.middle(3), lanes.middle(3) + QPointF(0, 600), lanes.design
    lanes.drag(start, end, release=False)
    lanes.key(Qt.Key.Key_Escape)
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert lanes.design == before
    lanes.drag(start, end, CONTROL)
    assert len(lanes.design.clips) == 5
    lanes.drag(start, end)
    assert lanes.design.track_of(3).location == 13
    # Beside all places nothing is dropped, and the pointer says so.
    lanes.lanes.elsewhere = lambda at: DropPlace() if at is not None and at.y() > 400 else None
    before, start = lanes.design, lanes.middle(2)
    lanes.drag(start, end, release=False)
    assert lanes.lanes.viewport().cursor().shape() == Qt.CursorShape.ForbiddenCursor
    lanes.lanes.mouse.move(start + lanes.px(0.1), NONE)
    assert lanes.lanes.viewport().cursor().shape() == Qt.CursorShape.ClosedHandCursor
    lanes.lanes.mouse.move(end, NONE)
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert lanes.design == before


def select(lanes):
    # A shaky click is no drag.
    lanes.drag(lanes.middle(4), lanes.middle(4) + QPointF(2, 1))
    assert (lanes.view.selected_clips, lanes.edits) == ((4,), [])
    lanes.click(lanes.middle(2), CONTROL)
    assert set(lanes.view.selected_clips) == {2, 4}
    lanes.click(lanes.middle(2), CONTROL)
    assert lanes.view.selected_clips == (4,)
    lanes.click(lanes.at(0.62, lane=1))
    assert lanes.view.playhead_s == pytest.approx(0.62, abs=0.002)


def below(lanes):
    lanes.show(lanes.design.with_clip(2, onset_s=0.05))
    both = QPointF(lanes.content.scale.x(0.12), lanes.box(2).center().y())
    selected = []
    for _ in range(4):
        lanes.click(both)
        selected += lanes.view.selected_clips
    assert set(selected[:2]) == {1, 2}
    assert selected[2:] == selected[:2]


def opened(lanes):
    actions = []
    lanes.panel.action_requested.connect(actions.append)
    lanes.double_click(lanes.middle(2))
    assert actions == ["show_clip_editor"]
    assert lanes.view.selected_clips == (2,)


def add(lanes):
    lanes.lanes.change(snaps=True)
    lanes.double_click(lanes.at(0.617, lane=1))
    steps = lanes.design.inputs[1].clips[-1].onset_s / lanes.content.grid_s
    assert steps == pytest.approx(round(steps), abs=1e-6)


def frame(lanes):
    lanes.drag(lanes.at(0.62), lanes.at(0.25, lane=1))
    assert set(lanes.view.selected_clips) == {2, 4}
    assert set(lanes.view.selected_inputs) == {1, 2}
    lanes.click(lanes.middle(3))
    lanes.drag(lanes.at(0.62), lanes.at(0.45), CONTROL)
    assert set(lanes.view.selected_clips) == {2, 3}
    assert lanes.edits == []


def snap(lanes):
    button = lanes.panel.findChild(QToolButton, "timeline_snap")
    for snaps in (False, True):
        button.click()
        assert lanes.content.snaps == snaps


def menu(lanes):
    lanes.look(edits.select_all_clips(lanes.design, lanes.view).view)
    at = lanes.middle(2).toPoint()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, lanes.lanes.mapToGlobal(at))
    QApplication.sendEvent(lanes.lanes.viewport(), event)
    (shown,) = (menu for menu in lanes.panel.findChildren(QMenu) if menu.isVisible())
    text = " ".join(action.text() for action in shown.actions()).lower()
    shown.close()
    assert all(word in text for word in ("split", "join", "group", "repeat", "mute", "remove"))


def wheel(lanes, turns, held):
    turn_wheel(lanes.lanes.viewport(), lanes.at(0.2), (0, turns), held)


def shown_s(lanes):
    return lanes.content.scale.shown_s


def zoom(lanes):
    start_s, end_s = shown_s(lanes)
    wheel(lanes, 240, CONTROL)
    assert shown_s(lanes)[1] - shown_s(lanes)[0] < 0.9 * (end_s - start_s)


def pan(lanes):
    wheel(lanes, 960, CONTROL)
    before = shown_s(lanes)
    wheel(lanes, -120, SHIFT)
    after = shown_s(lanes)
    assert after[0] > before[0]
    turn_wheel(lanes.lanes.viewport(), lanes.at(0.2), (-120, 0), NONE)
    assert shown_s(lanes)[0] > after[0]
    middle_button = Qt.MouseButton.MiddleButton
    before, at = shown_s(lanes), lanes.at(sum(before) / 2).toPoint()
    QTest.mousePress(lanes.lanes.viewport(), middle_button, NONE, at)
    lanes.lanes.mouse.move(QPointF(at) + QPointF(60, 0), NONE)
    QTest.mouseRelease(lanes.lanes.viewport(), middle_button, NONE, at)
    assert shown_s(lanes)[0] < before[0]


def playhead(lanes):
    lanes.click(lanes.on_ruler(0.35))
    assert lanes.view.playhead_s == pytest.approx(0.35, abs=0.004)


def loop(lanes):
    lanes.drag(lanes.on_ruler(0.2, 4), lanes.on_ruler(0.5, 4))
    assert lanes.design.loop_s == pytest.approx((0.2, 0.5), abs=0.004)
    assert lanes.view.playhead_s == 0.0
    # A click there puts the playhead, and the loop stays.
    lanes.click(lanes.on_ruler(0.35, 4))
    assert lanes.view.playhead_s == pytest.approx(0.35, abs=0.004)
    assert lanes.design.loop_s == pytest.approx((0.2, 0.5), abs=0.004)


def loop_end(lanes):
    lanes.show(edits.set_loop(lanes.design, lanes.view, (0.2, 0.5)).design)
    lanes.drag(lanes.on_ruler(0.5), lanes.on_ruler(0.6))
    assert lanes.design.loop_s == pytest.approx((0.2, 0.6), abs=0.004)


def marker(lanes):
    lanes.double_click(lanes.on_ruler(0.4))
    assert [marker.time_s for marker in lanes.design.markers] == pytest.approx([0.4], abs=0.004)


def rename_marker(lanes):
    lanes.show(edits.add_marker(lanes.design, lanes.view, 0.4).design)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(QInputDialog, "getText", lambda *_, text: ("hit", True))
        lanes.double_click(lanes.on_ruler(0.4, 4))
    assert [(marker.time_s, marker.name) for marker in lanes.design.markers] == [(0.4, "hit")]


def move_marker(lanes):
    lanes.lanes.change(snaps=True)
    lanes.show(edits.add_marker(lanes.design, lanes.view, 0.61, "hit").design)
    # It does not snap to where it was.
    lanes.drag(lanes.on_ruler(0.61, 4), lanes.on_ruler(0.61, 4) + QPointF(6, 0))
    (moved,) = lanes.design.markers
    assert 0.61 < moved.time_s < 0.63
    assert moved == Marker(time_s=moved.time_s, name="hit")


def ruler_menu(lanes):
    lanes.click(lanes.middle(2))
    place = QPointF(lanes.content.scale.x(0.9), 5)
    lanes.menu_at(place)["Loop the selected clips"].trigger()
    assert lanes.design.loop_s == pytest.approx((0.3, 0.5))
    lanes.menu_at(place)["Delete time in loop"].trigger()
    assert lanes.design.clip(3).onset_s == pytest.approx(0.5)
    assert 2 not in [clip.id for clip in lanes.design.clips]


def strip_of(lanes):
    lanes.look(show_gain_curves(lanes.view, (1,)))
    lanes.show(lanes.design.with_input(0, gain_curve=((0.0, 1.0), (0.6, 1.0))))
    return next(strip for strip in lanes.content.strips if strip.lane.track.id == 1)


def curve(lanes):
    return lanes.design.inputs[0].gain_curve


def point(lanes):
    strip = strip_of(lanes)
    lanes.drag(strip.at(0.6, 1.0), strip.at(0.5, 0.5))
    assert curve(lanes)[0] == (0.0, 1.0)
    assert curve(lanes)[1] == pytest.approx((0.5, 0.5), abs=0.05)


def segment(lanes):
    strip = strip_of(lanes)
    lanes.drag(strip.at(0.3, 1.0), strip.at(0.3, 0.5))
    assert [gain for _, gain in curve(lanes)] == pytest.approx([0.5, 0.5], abs=0.05)
    assert [time_s for time_s, _ in curve(lanes)] == [0.0, 0.6]


def add_gain(lanes):
    lanes.double_click(strip_of(lanes).at(0.3, 1.0))
    assert curve(lanes)[1] == pytest.approx((0.3, 1.0), abs=0.005)
    # A double click beside the line is the ground's.
    lanes.double_click(lanes.at(0.62) + QPointF(0, -12))
    assert (len(curve(lanes)), len(lanes.design.clips)) == (3, 5)


def draw(lanes):
    strip = strip_of(lanes)
    lanes.drag(strip.at(0.3, 1.0), strip.at(0.3, 0.5), CONTROL)
    assert len(curve(lanes)) == 3
    assert curve(lanes)[1][1] == pytest.approx(0.5, abs=0.05)
    assert len({gesture for _, _, gesture in lanes.edits}) == 1


#: How a test makes each gesture that the table lists.
OF_CLIPS = move, along, copy, free, trim, stretch, fade, place, select, below, frame, snap, menu
OF_RULER = playhead, loop, loop_end, marker, rename_marker, move_marker
MADE = {
    "clips": {each.__name__: each for each in (*OF_CLIPS, add, zoom, pan)} | {"open": opened},
    "ruler": {each.__name__: each for each in OF_RULER} | {"menu": ruler_menu},
    "gain_curve": {"point": point, "segment": segment, "add": add_gain, "draw": draw},
}


@pytest.mark.parametrize(
    ("where", "name"), [(where, name) for where in MADE for name in MOUSE[where].gestures]
)
def test_what_help_lists_is_what_the_mouse_does(lanes, where, name):
    MADE[where][name](lanes)


@pytest.mark.parametrize(
    ("start", "way", "held"),
    [
        (lambda lanes: lanes.middle(3), (80, 48), NONE),
        (lambda lanes: lanes.middle(3), (80, 48), CONTROL),
        (lambda lanes: end_of(lanes, 2), (-40, 0), NONE),
        (lambda lanes: end_of(lanes, 2), (40, 0), SHIFT),
        (lambda lanes: lanes.box(2).topLeft() + QPointF(3, 4), (40, 0), NONE),
        (lambda lanes: lanes.on_ruler(0.2, 4), (40, 0), NONE),
        (lambda lanes: strip_of(lanes).at(0.6, 1.0), (40, 8), NONE),
        (lambda lanes: strip_of(lanes).at(0.55, 1.0), (0, 8), NONE),
        (lambda lanes: strip_of(lanes).at(0.55, 1.0), (0, 8), CONTROL),
        (lambda lanes: strip_of(lanes).at(0.4, 1.0), (80, 0), NONE),
    ],
)
def test_escape_gives_any_drag_up_as_if_it_had_not_begun(lanes, start, way, held):
    at = start(lanes)
    before = lanes.design
    lanes.drag(at, at + QPointF(*way), held, release=False)
    assert lanes.design != before
    lanes.key(Qt.Key.Key_Escape)
    assert lanes.design == before
    after_escape = len(lanes.edits)
    lanes.lanes.mouse.move(at + QPointF(60, 0), held)
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert len(lanes.edits) == after_escape
    assert lanes.edits[-1][2] == lanes.edits[0][2]


def over_clip(lanes):
    """A place on the curve within clip 2, which plays from 0.3 to 0.5 s."""
    return strip_of(lanes).at(0.4, 1.0)


def test_where_a_gain_curve_passes_over_a_clip_the_way_of_a_drag_says_which_is_meant(lanes):
    start = over_clip(lanes)
    before = curve(lanes)
    lanes.drag(start, start + lanes.px(0.1))
    assert lanes.onset(2) == pytest.approx(0.4, abs=0.004)
    assert (curve(lanes), lanes.view.selected_clips) == (before, (2,))
    start = over_clip(lanes)
    lanes.drag(start, start + QPointF(2, 12), release=False)
    # Once begun it stays what it is.
    lanes.lanes.mouse.move(start + QPointF(80, 12), NONE)
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert lanes.onset(2) == pytest.approx(0.4, abs=0.004)
    assert all(gain < 0.9 for _, gain in curve(lanes))
    lanes.click(lanes.middle(1))
    lanes.click(over_clip(lanes))
    assert lanes.view.selected_clips == (2,)


def test_an_edge_snaps_to_the_end_of_a_clip_on_another_track_and_shows_where(lanes):
    lanes.lanes.change(snaps=True)
    # The clip on the other track ends at 0.3 s.
    start = lanes.middle(3)
    lanes.drag(start, start + lanes.px(-0.4 + 0.003), release=False)
    assert lanes.onset(3) == pytest.approx(0.3, abs=1e-12)
    assert lanes.lanes.overlay.preview.guide_s == pytest.approx(0.3)
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT)
    assert lanes.lanes.overlay.preview.guide_s is None


def test_selected_clips_move_together_and_none_starts_before_zero(lanes):
    lanes.click(lanes.middle(4))
    lanes.click(lanes.middle(2), CONTROL)
    lanes.drag(lanes.middle(2), lanes.middle(2) + lanes.px(-0.25))
    assert lanes.onset(4) == pytest.approx(0.0, abs=1e-12)
    assert lanes.onset(2) == pytest.approx(0.2)


def test_an_end_that_is_dragged_beyond_its_clip_says_the_length_that_the_clip_has(lanes):
    lanes.lanes.change(snaps=True)
    end, whole_s = end_of(lanes, 2), lanes.design.clip(2).duration_s
    # Another clip starts there, which the end does not reach.
    lanes.drag(end, end + lanes.px(0.2), release=False)
    assert lanes.design.clip(2).duration_s == whole_s
    assert lanes.lanes.overlay.preview.label.startswith(value_text(whole_s, "s"))
    assert lanes.lanes.overlay.preview.guide_s is None
    lanes.lanes.mouse.cancel()
    for end, by_s in ((end_of(lanes, 1), -0.1), (start_of(lanes, 1), 0.1)):
        lanes.drag(end, end + lanes.px(by_s), release=False)
        assert lanes.lanes.overlay.preview.guide_s == 0.1
        lanes.lanes.mouse.cancel()


def test_the_pointer_shows_what_can_be_dragged_and_an_end_from_a_little_outside(lanes):
    box, cursor, Shape = lanes.box(2), lanes.lanes.mouse.cursor_at, Qt.CursorShape
    assert cursor(box.center()) == Shape.OpenHandCursor
    assert cursor(start_of(lanes, 2)) == Shape.SizeHorCursor
    assert cursor(box.topLeft() + QPointF(3, 3)) == Shape.SizeFDiagCursor
    assert cursor(box.topRight() + QPointF(-3, 3)) == Shape.SizeBDiagCursor
    assert cursor(lanes.at(0.62)) == Shape.ArrowCursor
    assert cursor(QPointF(lanes.box(3).left() - 3, box.center().y())) == Shape.SizeHorCursor
    lanes.drag(QPointF(box.right() + 3, box.center().y()), box.center(), ALT)
    assert lanes.design.clip(2).duration_s < 0.15


def test_over_the_end_of_a_clip_it_says_how_to_trim_and_how_to_stretch(lanes):
    text = timeline_tooltip(lanes.content, end_of(lanes, 2))
    assert "trim a clip" in text
    assert "with Shift or Alt: stretch" in text.replace("\n", " ")
    assert "fade" in timeline_tooltip(lanes.content, lanes.box(2).topLeft() + QPointF(3, 3))
    assert timeline_tooltip(lanes.content, lanes.middle(2)) == ""
    assert timeline_tooltip(lanes.content, lanes.at(0.6)) == ""


def test_a_drag_brings_nothing_back_that_changed_meanwhile(lanes):
    start = lanes.middle(4)
    lanes.drag(start, start, release=False, steps=0)
    muted = edits.toggle_mute(lanes.design, lanes.view, (1,)).design
    lanes.show(muted)
    lanes.lanes.mouse.move(start + QPointF(40, 0), NONE)
    assert lanes.design == muted
    QTest.mouseRelease(lanes.lanes.viewport(), LEFT, NONE, QPoint(0, 0))
    lanes.drag(start, start + QPointF(20, 0), release=False)
    without = edits.remove_inputs(lanes.design, lanes.view, (2,)).design
    lanes.show(without)
    lanes.lanes.mouse.move(start + QPointF(40, 0), NONE)
    QTest.keyClick(lanes.lanes, Qt.Key.Key_Escape)
    assert lanes.design == without
