"""Where a gain curve passes over a clip, the way of a drag says which of them is meant."""

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from tests.gui.timeline.gestures_made import curve, px, strip_of
from tests.gui.timeline.lanes_bench import LEFT, LanesBench

_NONE = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def bench(qtbot):
    bench = LanesBench(qtbot)
    bench.lanes.set_snaps(False)
    return bench


def over_clip(bench):
    """A place on the curve within clip 2, which plays from 0.3 to 0.5 s."""
    return strip_of(bench).at(0.4, 1.0)


def test_along_it_moves_the_clip(bench):
    start = over_clip(bench)
    before = curve(bench)
    bench.drag(start, start + px(bench, 0.1))
    assert bench.onset(2) == pytest.approx(0.4, abs=0.004)
    assert curve(bench) == before
    assert bench.view.selected_clips == (2,)


def test_up_and_down_it_moves_the_curve(bench):
    start = over_clip(bench)
    bench.drag(start, start + QPointF(2, 12))
    assert bench.onset(2) == 0.3
    assert all(gain < 0.9 for _, gain in curve(bench))


def test_once_begun_it_stays_what_it_is(bench):
    start = over_clip(bench)
    bench.drag(start, start + QPointF(0, 12), release=False)
    bench.lanes.mouse.move(start + QPointF(80, 12), _NONE)
    QTest.mouseRelease(bench.lanes.viewport(), LEFT)
    assert bench.onset(2) == 0.3


def test_a_click_there_selects_the_clip(bench):
    bench.click(over_clip(bench))
    assert bench.view.selected_clips == (2,)
    assert [gain for _, gain in curve(bench)] == [1.0, 1.0]


def test_escape_gives_it_up(bench):
    start = over_clip(bench)
    bench.drag(start, start + px(bench, 0.1), release=False)
    assert bench.lanes.mouse.cancel()
    assert bench.onset(2) == 0.3
