"""The envelope tool of the clip editor: points and segments."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPixmap
from PySide6.QtTest import QTest

from skinsource.design.effects.level import UNCHANGED, Envelope, Fade
from skinsource_gui.panels.clip_editor import tools
from skinsource_gui.qt.theme import LIGHT
from tests.gui.clip_editor.bench import ALT, LEFT, NONE, RIGHT, SHIFT
from tests.gui.menus import lines_at


def shaped(bench, *places):
    """Give the clip an envelope with these points."""
    bench.show(bench.design.with_clip(1, effects=(Envelope(places),)))


def points(bench):
    (envelope,) = bench.clip.effects
    return envelope.points


def test_a_click_on_the_curve_adds_a_point_that_is_dragged_alone(tone):
    tone.press(tone.at(0.1, 1.0))
    QTest.mouseRelease(tone.canvas.viewport(), LEFT, NONE, tone.at(0.1, 1.0).toPoint())
    assert len(points(tone)) == 2
    assert (Envelope(points(tone)).values_at(np.linspace(0, 0.2, 50)) == 1.0).all()
    assert tone.panel._envelope.tool.chosen == (1,)
    tone.drag(points(tone)[1][:2], (0.12, 0.4))
    first, second = points(tone)
    assert first[:2] == (0.0, 1.0)
    assert second[0] == pytest.approx(0.12, abs=0.002)
    assert second[1] == pytest.approx(0.4, abs=0.02)
    # A double click puts a point anywhere.
    QTest.mouseDClick(tone.canvas.viewport(), LEFT, NONE, tone.at(0.05, 0.2).toPoint())
    assert points(tone)[1][:2] == pytest.approx((0.05, 0.2), abs=0.02)


def test_a_point_that_is_dragged_onto_zero_is_zero(tone):
    shaped(tone, (0.0, 1.0, "straight"), (0.1, 0.5, "straight"))
    place, zero = tone.at(0.1, 0.5), tone.at(0.1, 0.0)
    tone.drag_px(place, zero + QPointF(0.0, -0.4))
    assert points(tone)[1][1] == 0.0


def test_fades_are_seen_around_the_envelope_and_change_elsewhere(tone):
    def dashed(*effects):
        paths, picture = [], QPixmap(10, 10)

        class Painter(QPainter):
            def drawPath(self, path):
                if self.pen().style() == Qt.PenStyle.DashLine:
                    paths.append(path.boundingRect().getCoords())

        tone.show(tone.design.with_clip(1, effects=effects))
        painter = Painter(picture)
        tone.canvas.tool.paint(painter, tone.canvas.content, LIGHT)
        painter.end()
        return paths

    def box(start_s, end_s):
        first, last = tone.at(start_s, 1), tone.at(end_s, 0)
        return pytest.approx((first.x(), first.y(), last.x(), last.y()), abs=1)

    assert dashed(Envelope(UNCHANGED)) == []
    assert dashed(Fade(0.08, 0.05), Envelope(UNCHANGED)) == [box(0, 0.08), box(0.15, 0.2)]
    assert "Effects" in tone.panel._toolbar._description.toolTip()


def test_a_segment_goes_up_and_down_as_a_whole(tone):
    shaped(tone, (0.0, 0.5), (0.2, 0.5))
    tone.drag((0.1, 0.5), (0.13, 0.8))
    assert [time for time, *_ in points(tone)] == [0.0, 0.2]
    assert [value for _, value, _ in points(tone)] == pytest.approx([0.8, 0.8], abs=0.02)


def test_alt_and_a_click_on_a_segment_bends_it(tone):
    shaped(tone, (0.0, 0.2), (0.2, 0.8))
    kinds = []
    for _ in range(3):
        value = float(Envelope(points(tone)).values_at(np.array([0.1]))[0])
        tone.press(tone.at(0.1, value), held=ALT)
        QTest.mouseRelease(tone.canvas.viewport(), LEFT, ALT)
        kinds.append(points(tone)[0][2])
    assert kinds == ["smooth", "held", "straight"]


def test_keys_move_the_chosen_point_by_one_step_or_ten_and_remove_it(tone):
    shaped(tone, (0.0, 0.5), (0.1, 0.5))
    tone.panel._envelope.tool.chosen = (1,)
    tone.key(Qt.Key.Key_Right)
    tone.key(Qt.Key.Key_Up, SHIFT)
    assert points(tone)[1][:2] == pytest.approx((0.101, 0.6))
    assert len(set(tone.gestures)) == 1
    tone.key(Qt.Key.Key_Delete)
    assert len(points(tone)) == 1
    assert tone.panel._envelope.tool.chosen == (0,)  # the next Delete is for it


def test_a_rectangle_chooses_points(tone):
    shaped(tone, (0.02, 0.5), (0.1, 0.5), (0.18, 0.5))
    tone.drag((0.05, 0.9), (0.19, 0.1))
    assert tone.panel._envelope.tool.chosen == (1, 2)
    assert tone.gestures == []


def handles(tone):
    handles = tools._handles(tone.canvas.content, points(tone), tone.panel._envelope.tool.chosen)
    return {(handle.along, handle.up): place for handle, place in handles}


def pull(tone, handle, by_s, by_value, **more):
    content, start = tone.canvas.content, handles(tone)[handle]
    time_s, value = content.place(start)
    tone.drag((time_s, value), (time_s + by_s, value + by_value), **more)


def test_the_handles_of_the_box_around_chosen_points_scale_them(tone):
    before = Envelope(((0.0, 0.2), (0.06, 0.4), (0.08, 0.8), (0.1, 0.6), (0.17, 0.5))).points
    tone.show(tone.design.with_clip(1, effects=(Envelope(before),)))
    assert handles(tone) == {}
    tone.panel._envelope.tool.chosen = (1, 2, 3)
    pull(tone, (1, 0), 0.04, 0.1)
    assert [point[0] for point in points(tone)] == pytest.approx(
        [0, 0.06, 0.1, 0.14, 0.17], abs=1e-3
    )
    assert [point[1] for point in points(tone)] == [point[1] for point in before]
    pull(tone, (0, 1), 0.02, -0.2)
    assert [point[1] for point in points(tone)] == pytest.approx(
        [0.2, 0.4, 0.6, 0.5, 0.5], abs=0.01
    )
    pull(tone, (-1, -1), 0.04, 0.1)
    assert points(tone)[1][:2] == pytest.approx((0.1, 0.5), abs=0.01)
    assert points(tone)[2][:2] == pytest.approx((0.12, 0.6), abs=0.01)
    assert len(set(tone.gestures)) == 3
    there = points(tone)
    pull(tone, (1, 1), 0.05, 0.3, release=False)
    assert points(tone) != there
    tone.key(Qt.Key.Key_Escape)
    assert points(tone) == there


def test_a_drag_of_the_level_end_pulls_a_new_point_and_not_all(tone):
    tone.drag((0.1, 1.0), (0.1, 0.4))
    assert points(tone)[0][:2] == (0.0, 1.0)
    assert points(tone)[1][1] == pytest.approx(0.4, abs=0.02)
    assert len(set(tone.gestures)) == 1


def test_insert_adds_a_point_that_changes_nothing_and_arrows_move_it(tone):
    tone.panel.use("envelope")
    tone.key(Qt.Key.Key_Insert)
    assert points(tone) == ((0.0, 1.0, "straight"), (0.1, 1.0, "straight"))
    tone.key(Qt.Key.Key_Down)
    assert points(tone)[1][:2] == (0.1, 0.99)
    # The next one stands between that and the end, one after the first between both.
    tone.key(Qt.Key.Key_Insert)
    tone.key(Qt.Key.Key_PageUp)
    tone.key(Qt.Key.Key_PageUp)
    tone.key(Qt.Key.Key_Insert)
    assert [round(time_s, 9) for time_s, *_ in points(tone)] == [0.0, 0.05, 0.1, 0.15]
    assert tone.panel._envelope.tool.chosen == (1,)


def menu_at(tone, time_s, value):
    """What the right button offers there, after it went down, as a screen with a mouse sends it."""
    at = tone.at(time_s, value)
    tone.press(at, RIGHT)
    return lines_at(tone.canvas, "clip_editor_menu", tone.canvas.viewport(), at.toPoint())


def test_the_right_button_opens_the_menu_of_a_small_curve(tone):
    shaped(tone, (0.0, 0.5), (0.1, 0.9))
    lines = menu_at(tone, 0.1, 0.9)
    assert len(points(tone)) == 2  # nothing is done before a line is chosen
    lines["After this point: held"].trigger()
    assert points(tone)[1] == (0.1, 0.9, "held")
    lines["Remove point"].trigger()
    assert [time_s for time_s, *_ in points(tone)] == [0.0]
    menu_at(tone, 0.05, -0.4)["Add point here"].trigger()
    assert points(tone)[1][0] == pytest.approx(0.05, abs=0.002)
