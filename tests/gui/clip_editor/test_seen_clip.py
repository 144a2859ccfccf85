"""Which part of a clip is seen in the editor: keys, wheel and drags."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from tests.gui.clip_editor.bench import LEFT, NONE, SHIFT, whole
from tests.gui.wheel import NOTCH, turn_wheel


@pytest.fixture
def near(tone):
    """The tone of 0.2 s, of which the middle is seen."""
    tone.panel.use("look")
    tone.key(Qt.Key.Key_Plus)
    tone.key(Qt.Key.Key_Plus)
    return tone


def shown_s(bench):
    return bench.canvas.content.scale.shown_s


def length_of(range_s):
    return range_s[1] - range_s[0]


def turn(bench, notches, held=NONE):
    viewport = bench.canvas.viewport()
    turn_wheel(viewport, viewport.rect().center(), (0, NOTCH * notches), held)


def test_keys_show_the_middle_larger_and_all_of_it_again(tone):
    whole_s = shown_s(tone)
    tone.key(Qt.Key.Key_Plus)
    assert length_of(shown_s(tone)) < length_of(whole_s)
    assert sum(shown_s(tone)) == pytest.approx(sum(whole_s))
    tone.key(Qt.Key.Key_Plus)
    tone.key(Qt.Key.Key_Minus)
    tone.key(Qt.Key.Key_0)
    assert shown_s(tone) == whole_s


def test_the_wheel_zooms_and_with_shift_goes_along(near):
    before = shown_s(near)
    turn(near, 1)
    assert length_of(shown_s(near)) < length_of(before)
    closer = shown_s(near)
    turn(near, -1, SHIFT)
    assert shown_s(near)[0] > closer[0]
    assert length_of(shown_s(near)) == pytest.approx(length_of(closer))


def test_a_drag_moves_what_is_seen_as_far_as_the_pointer_goes(near):
    first_s, last_s = shown_s(near)
    px_per_s = near.canvas.content.scale.px_per_s
    start = near.at((first_s + last_s) / 2, 0.0)
    near.press(start)
    for k in range(1, 6):
        at = whole(start) - QPoint(4 * k, 0)
        near.canvas.tool.move(near.canvas.content, QPointF(at), NONE)
        assert shown_s(near)[0] == pytest.approx(first_s + 4 * k / px_per_s, abs=0.6 / px_per_s)
    QTest.mouseRelease(near.canvas.viewport(), LEFT, NONE, at)
    assert shown_s(near)[0] == pytest.approx(first_s + 20 / px_per_s, abs=0.6 / px_per_s)
    assert length_of(shown_s(near)) == pytest.approx(last_s - first_s)


def test_nothing_moves_under_the_pen(flat):
    flat.key(Qt.Key.Key_Plus)
    before, reach = shown_s(flat), flat.canvas.content.reach
    middle_s = sum(before) / 2
    flat.drag((middle_s, 0.0), (middle_s + 0.001, 1.05), release=False)
    turn(flat, 1)
    assert (shown_s(flat), flat.canvas.content.reach) == (before, reach)
