"""Each gesture that help lists for the timeline, made, and what came of it."""

import pytest
from PySide6.QtCore import QPointF

from skinsource_gui.panels.timeline.content import timeline_tooltip
from skinsource_gui.qt.keys import MOUSE
from tests.gui.timeline.gestures_made import MADE, end_of, middle
from tests.gui.timeline.lanes_bench import LanesBench


@pytest.fixture
def lanes(qtbot):
    bench = LanesBench(qtbot)
    bench.lanes.set_snaps(False)
    return bench


@pytest.mark.parametrize(
    ("where", "name"),
    [(where, name) for where in MADE for name in MOUSE[where].gestures],
)
def test_what_help_lists_is_what_the_mouse_does(lanes, where, name):
    MADE[where][name](lanes)


def test_over_the_end_of_a_clip_it_says_how_to_trim_and_how_to_stretch(lanes):
    text = timeline_tooltip(lanes.content, end_of(lanes, 2))
    assert "trim a clip" in text
    assert "with Shift or Alt: stretch" in text.replace("\n", " ")
    assert "fade" in timeline_tooltip(lanes.content, lanes.box(2).topLeft() + QPointF(3, 3))
    assert timeline_tooltip(lanes.content, middle(lanes, 2)) == ""
    assert timeline_tooltip(lanes.content, lanes.at(0.6)) == ""
