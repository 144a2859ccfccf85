"""Each gesture that help lists for the timeline, made, and what came of it."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource.design import edits
from skinsource_gui.panels.timeline.content import show_gain_curves
from skinsource_gui.qt.frames import DropPlace
from tests.gui.timeline.lanes_bench import LEFT
from tests.gui.wheel import turn_wheel

CONTROL, SHIFT, ALT = (
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)


NONE = Qt.KeyboardModifier.NoModifier


DOWN = QPointF(0, 48)


def px(bench, seconds):
    return QPointF(bench.content.scale.px_per_s * seconds, 0)


def middle(bench, clip):
    return bench.box(clip).center()


def end_of(bench, clip):
    box = bench.box(clip)
    return QPointF(box.right() - 2, box.center().y())


def double_click(bench, at):
    QTest.mouseDClick(bench.lanes.viewport(), LEFT, pos=QPoint(round(at.x()), round(at.y())))


def on_ruler(bench, time_s):
    return QPointF(bench.content.scale.x(time_s), 4)


def move(bench):
    bench.drag(middle(bench, 3), middle(bench, 3) + px(bench, 0.1) + DOWN)
    assert bench.onset(3) == pytest.approx(0.8, abs=0.004)
    assert bench.design.track_of(3).id == 2


def along(bench):
    bench.drag(middle(bench, 3), middle(bench, 3) + px(bench, 0.1) + DOWN, SHIFT)
    assert bench.onset(3) == pytest.approx(0.8, abs=0.004)
    assert bench.design.track_of(3).id == 1


def copy(bench):
    bench.drag(middle(bench, 4), middle(bench, 4) + px(bench, 0.25), CONTROL)
    assert len(bench.design.inputs[1].clips) == 2


def free(bench):
    bench.lanes.set_snaps(True)
    bench.drag(middle(bench, 3), middle(bench, 3) + px(bench, -0.397), ALT)
    assert bench.onset(3) != pytest.approx(0.3, abs=1e-6)
    assert bench.onset(3) == pytest.approx(0.303, abs=0.004)


def trim(bench):
    bench.drag(end_of(bench, 2), end_of(bench, 2) - px(bench, 0.1))
    (effect,) = bench.design.clip(2).effects
    assert type(effect).__name__ == "Trim"
    assert bench.design.clip(2).duration_s == pytest.approx(0.1, abs=0.004)


def stretch(bench):
    for held in (SHIFT, ALT):
        before = bench.design
        bench.drag(end_of(bench, 2), end_of(bench, 2) + px(bench, 0.1), held)
        (effect,) = bench.design.clip(2).effects
        assert type(effect).__name__ == "Stretch"
        assert bench.design.clip(2).duration_s == pytest.approx(0.3, abs=0.004)
        bench.show(before)


def fade(bench):
    box = bench.box(2)
    corner = QPointF(box.left() + 3, box.top() + 3)
    bench.drag(corner, corner + px(bench, 0.05))
    (effect,) = bench.design.clip(2).effects
    assert type(effect).__name__ == "Fade"


def place(bench):
    bench.lanes.elsewhere = lambda at: (
        DropPlace(location=13) if at is not None and at.y() > 400 else None
    )
    bench.drag(middle(bench, 3), middle(bench, 3) + QPointF(0, 600))
    assert bench.design.track_of(3).location == 13


def select(bench):
    bench.click(middle(bench, 4))
    bench.click(middle(bench, 2), CONTROL)
    assert set(bench.view.selected_clips) == {2, 4}
    bench.click(middle(bench, 2), CONTROL)
    assert bench.view.selected_clips == (4,)


def below(bench):
    design = bench.design.with_clip(2, onset_s=0.05)
    bench.show(design)
    both = QPointF(bench.content.scale.x(0.12), bench.box(2).center().y())
    bench.click(both)
    first = bench.view.selected_clips
    bench.click(both)
    assert {*first, *bench.view.selected_clips} == {1, 2}


def opened(bench):
    actions = []
    bench.panel.action_requested.connect(actions.append)
    double_click(bench, middle(bench, 2))
    assert actions == ["show_clip_editor"]
    assert bench.view.selected_clips == (2,)


def add(bench):
    double_click(bench, bench.at(0.5, lane=1))
    assert len(bench.design.inputs[1].clips) == 2


def frame(bench):
    bench.drag(bench.at(0.6), bench.at(0.05, lane=1))
    assert set(bench.view.selected_clips) >= {2, 4}
    assert 3 not in bench.view.selected_clips


def menu(bench):
    at = middle(bench, 2).toPoint()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, bench.lanes.mapToGlobal(at))
    QApplication.sendEvent(bench.lanes.viewport(), event)
    (shown,) = (menu for menu in bench.panel.findChildren(QMenu) if menu.isVisible())
    text = " ".join(action.text() for action in shown.actions()).lower()
    shown.close()
    assert all(word in text for word in ("split", "repeat", "mute", "remove"))


def wheel(bench, turns, held):
    turn_wheel(bench.lanes.viewport(), bench.at(0.2), (0, turns), held)


def shown_s(bench):
    return bench.content.scale.shown_s


def zoom(bench):
    start_s, end_s = shown_s(bench)
    wheel(bench, 240, CONTROL)
    assert shown_s(bench)[1] - shown_s(bench)[0] < 0.9 * (end_s - start_s)


def pan(bench):
    wheel(bench, 480, CONTROL)
    wheel(bench, 480, CONTROL)
    before = shown_s(bench)
    wheel(bench, -120, SHIFT)
    assert shown_s(bench)[0] > before[0]
    middle_button = Qt.MouseButton.MiddleButton
    before, at = shown_s(bench), bench.at(sum(before) / 2).toPoint()
    QTest.mousePress(bench.lanes.viewport(), middle_button, NONE, at)
    bench.lanes.mouse.move(QPointF(at) + QPointF(60, 0), NONE)
    QTest.mouseRelease(bench.lanes.viewport(), middle_button, NONE, at)
    assert shown_s(bench)[0] < before[0]


def playhead(bench):
    bench.click(on_ruler(bench, 0.35))
    assert bench.view.playhead_s == pytest.approx(0.35, abs=0.004)


def loop(bench):
    bench.drag(on_ruler(bench, 0.2), on_ruler(bench, 0.5), SHIFT)
    assert bench.design.loop_s == pytest.approx((0.2, 0.5), abs=0.004)


def loop_end(bench):
    bench.show(edits.set_loop(bench.design, bench.view, (0.2, 0.5)).design)
    bench.drag(on_ruler(bench, 0.5), on_ruler(bench, 0.6))
    assert bench.design.loop_s == pytest.approx((0.2, 0.6), abs=0.004)


def marker(bench):
    double_click(bench, on_ruler(bench, 0.4))
    assert [marker.time_s for marker in bench.design.markers] == pytest.approx([0.4], abs=0.004)


def move_marker(bench):
    marker(bench)
    bench.drag(on_ruler(bench, 0.4), on_ruler(bench, 0.6))
    assert [marker.time_s for marker in bench.design.markers] == pytest.approx([0.6], abs=0.008)


def strip_of(bench):
    bench._look(show_gain_curves(bench.view, (1,)))
    bench.show(bench.design.with_input(0, gain_curve=((0.0, 1.0), (0.6, 1.0))))
    return next(strip for strip in bench.content.strips if strip.lane.track.id == 1)


def curve(bench):
    return bench.design.inputs[0].gain_curve


def point(bench):
    strip = strip_of(bench)
    bench.drag(strip.at(0.6, 1.0), strip.at(0.5, 0.5))
    assert curve(bench)[0] == (0.0, 1.0)
    assert curve(bench)[1] == pytest.approx((0.5, 0.5), abs=0.05)


def segment(bench):
    strip = strip_of(bench)
    bench.drag(strip.at(0.3, 1.0), strip.at(0.3, 0.5))
    assert [gain for _, gain in curve(bench)] == pytest.approx([0.5, 0.5], abs=0.05)
    assert [time_s for time_s, _ in curve(bench)] == [0.0, 0.6]


def add_gain(bench):
    double_click(bench, strip_of(bench).at(0.3, 1.0))
    assert len(curve(bench)) == 3


def draw(bench):
    strip = strip_of(bench)
    bench.drag(strip.at(0.3, 1.0), strip.at(0.3, 0.5), CONTROL)
    assert len(curve(bench)) == 3
    assert curve(bench)[1][1] == pytest.approx(0.5, abs=0.05)


#: How a test makes each gesture that the table lists.
MADE = {
    "clips": {
        "move": move,
        "along": along,
        "copy": copy,
        "free": free,
        "trim": trim,
        "stretch": stretch,
        "fade": fade,
        "place": place,
        "select": select,
        "below": below,
        "open": opened,
        "add": add,
        "frame": frame,
        "menu": menu,
        "zoom": zoom,
        "pan": pan,
    },
    "ruler": {
        "playhead": playhead,
        "loop": loop,
        "loop_end": loop_end,
        "marker": marker,
        "move_marker": move_marker,
    },
    "gain_curve": {"point": point, "segment": segment, "add": add_gain, "draw": draw},
}
