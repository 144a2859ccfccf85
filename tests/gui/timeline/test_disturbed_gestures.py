"""Gestures on the timeline while something else changes the design, and cut clips that stay."""

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from skinsource.base.errors import InvalidInputError
from skinsource.design import edits
from tests.gui.timeline.lanes_bench import NONE, LanesBench

CONTROL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def lanes(qtbot):
    return LanesBench(qtbot)


def middle(bench, clip):
    return bench.box(clip).center()


def test_a_drag_brings_nothing_back_that_was_removed_meanwhile(lanes):
    start = middle(lanes, 4)
    lanes.drag(start, start + QPointF(20, 0), release=False)
    without = edits.remove_inputs(lanes.design, lanes.view, (2,)).design
    lanes.show(without)
    lanes.lanes.mouse.move(start + QPointF(40, 0), NONE)
    assert lanes.design == without
    QTest.keyClick(lanes.lanes, Qt.Key.Key_Escape)
    assert lanes.design == without


def test_a_drag_that_has_not_moved_yet_keeps_what_changes_meanwhile(lanes):
    start = middle(lanes, 3)
    lanes.drag(start, start, release=False, steps=0)
    muted = edits.toggle_mute(lanes.design, lanes.view, (2,)).design
    lanes.show(muted)
    lanes.lanes.mouse.move(start + QPointF(40, 0), NONE)
    assert lanes.design == muted


def test_what_could_not_be_copied_is_not_cut(lanes, monkeypatch):
    def refuse(*_):
        raise InvalidInputError("too many bytes")

    monkeypatch.setattr(edits, "fragment_text", refuse)
    lanes.click(middle(lanes, 3))
    before = lanes.design
    QTest.keyClick(lanes.lanes, Qt.Key.Key_X, CONTROL)
    assert lanes.design == before
    assert lanes.refusals == ["too many bytes."]
