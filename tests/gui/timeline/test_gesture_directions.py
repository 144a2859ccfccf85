"""Which way gestures go: fades at the end, rectangles that add, what pans, what snaps to itself."""

import pytest
from PySide6.QtCore import QPointF, Qt

from skinsource.design.clips import Marker
from skinsource.design.design import Design
from tests.gui.timeline.lanes_bench import LanesBench

CONTROL, ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier


@pytest.fixture
def lanes(qtbot):
    return LanesBench(qtbot)


def px(bench, seconds):
    return QPointF(bench.content.scale.px_per_s * seconds, 0)


def test_an_upper_corner_at_the_end_fades_out_as_far_as_it_is_drawn_in(lanes):
    corner = lanes.box(2).topRight() + QPointF(-3, 4)
    lanes.drag(corner, corner + px(lanes, -0.05))
    (fade,) = lanes.design.clip(2).effects
    assert fade.out_s == pytest.approx(0.05, abs=0.003)
    assert fade.in_s == 0.0


def test_a_rectangle_with_ctrl_held_adds_to_what_is_selected(lanes):
    lanes.click(lanes.box(3).center())
    lanes.drag(lanes.at(0.62), lanes.at(0.45), CONTROL)
    assert set(lanes.view.selected_clips) == {2, 3}
    lanes.drag(lanes.at(0.62), lanes.at(0.45))
    assert lanes.view.selected_clips == (2,)


def test_a_marker_does_not_snap_to_where_it_was(lanes):
    design = lanes.design
    lanes.show(Design(limb="synthetic-1", inputs=design.inputs, markers=(Marker(time_s=0.61),)))
    flag = QPointF(lanes.content.scale.x(0.61), 4.0)
    lanes.drag(flag, flag + QPointF(6.0, 0.0))
    assert lanes.design.markers[0].time_s > 0.61
