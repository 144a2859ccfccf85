"""Keys that go from clip to clip."""

import pytest
from PySide6.QtCore import Qt

from tests.gui.timeline.lanes_bench import LanesBench

SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def lanes(qtbot):
    return LanesBench(qtbot)


def test_shift_and_down_selects_besides_the_nearest_clip_below_and_up_goes_back(lanes):
    lanes.click(lanes.box(2).center())
    before = lanes.design
    lanes.key(Qt.Key.Key_Down, SHIFT)
    assert lanes.view.selected_clips == (2, 4)
    # From the last one, which starts at 0.1 s: the first clip is the nearest.
    lanes.key(Qt.Key.Key_Up, SHIFT)
    assert lanes.view.selected_clips == (2, 4, 1)
    lanes.key(Qt.Key.Key_Up, SHIFT)
    assert lanes.view.selected_clips == (2, 4, 1)
    assert lanes.design is before
