"""The panel of the clip editor: what it says and reads."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox, QToolButton

from skinsource import Design, View
from skinsource.design.waveforms.tones import Glide, Tone
from skinsource.signals.synthesis import curve_of
from skinsource_gui.panels.clip_editor.tools import of_column
from tests.gui.clip_editor.bench import LEFT, NONE, SHIFT, Bench, whole
from tests.gui.wheel import NOTCH, turn_wheel


def test_without_a_clip_the_panel_says_what_to_do(flat):
    flat.design, flat.view = Design(limb="synthetic-1"), View()
    flat.show()
    assert "Click a place on the hand" in flat.panel._empty.text()
    assert flat.panel._empty.isVisible()
    assert flat.canvas.content is None


def test_only_the_tool_that_is_taken_shows_and_changes_points(tone, monkeypatch):
    tone.drag((0.0, 1.0), (0.0, 0.5))
    tone.panel.use("envelope")
    tone.key(Qt.Key.Key_Home)
    tone.panel.use("look")
    shaped, steps = tone.design, len(tone.gestures)
    for key in (Qt.Key.Key_Insert, Qt.Key.Key_PageDown, Qt.Key.Key_Delete, Qt.Key.Key_Up):
        tone.key(key)
    assert (tone.design, len(tone.gestures)) == (shaped, steps)
    tools = []

    def ask(*_):
        tools.append((tone.canvas.tool, tone.panel._toolbar._tools["look"].isChecked()))
        return QMessageBox.StandardButton.Ok

    monkeypatch.setattr(QMessageBox, "question", ask)
    tone.panel.use("envelope")
    tone.panel.use("pen")
    # While it was asked, no point could be seen.
    assert tools == [(tone.panel._view_tool, True)]
    assert tone.canvas.tool is tone.panel._pen.tool


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
    before = shown_s(near)
    turn(near, 1)
    assert length_of(shown_s(near)) < length_of(before)
    closer = shown_s(near)
    turn(near, -1, SHIFT)
    assert shown_s(near)[0] > closer[0]
    assert length_of(shown_s(near)) == pytest.approx(length_of(closer))


POINTS = ((0.0, 100.0, 0.5), (0.2, 300.0, 0.5), (0.4, 300.0, 0.9))


@pytest.fixture
def glide(qtbot):
    bench = Bench(qtbot, Glide(POINTS))
    bench.panel.use("glide")
    return bench


def frequency_at(bench, time_s, hz):
    return of_column(bench.canvas.content, "frequency").at(time_s, hz)


def curve(bench, column):
    return curve_of(bench.clip.waveform.points, column)


def same(first, other):
    np.testing.assert_allclose(np.array(first), np.array(other), rtol=0, atol=1e-12)


def click(bench, at):
    QTest.mouseClick(bench.canvas.viewport(), LEFT, pos=whole(at))


def test_a_point_of_the_frequency_is_dragged_and_the_amplitude_stays(glide):
    amplitude = curve(glide, "amplitude")
    glide.drag_px(frequency_at(glide, 0.2, 300.0), frequency_at(glide, 0.25, 400.0))
    times, values = zip(*curve(glide, "frequency"), strict=True)
    assert times == pytest.approx((0.0, 0.25, 0.4), abs=0.002)
    assert values == pytest.approx((100.0, 400.0, 300.0), abs=3.0)
    same(curve(glide, "amplitude"), amplitude)
    assert len(set(glide.gestures)) == 1


def test_a_point_of_the_amplitude_is_dragged_and_goes_no_higher_than_one(glide):
    frequency = curve(glide, "frequency")
    glide.drag_px(glide.at(0.4, 0.9), glide.at(0.4, 1.5))
    assert curve(glide, "amplitude")[-1] == (pytest.approx(0.4, abs=0.001), 1.0)
    assert glide.panel._glide.tool.active == "amplitude"
    assert [hz for _, hz in curve(glide, "frequency")] == pytest.approx([hz for _, hz in frequency])
    assert glide.refusals == []
    # The frequency stays below half the sample rate.
    glide.drag_px(frequency_at(glide, 0.4, 300.0), frequency_at(glide, 0.4, 900.0))
    assert 640.0 < curve(glide, "frequency")[-1][1] < 650.0
    assert np.abs(glide.drawn).max() <= 1.0


def test_a_click_on_a_line_adds_a_point_that_bends_nothing_and_stays(glide):
    before = glide.drawn
    click(glide, frequency_at(glide, 0.1, 200.0))
    tool = glide.panel._glide.tool.tools["frequency"]
    assert len(tool._points()) == 4
    np.testing.assert_allclose(glide.drawn, before, atol=1e-9)
    glide.key(Qt.Key.Key_Up, SHIFT)
    assert curve(glide, "frequency")[1] == pytest.approx((0.1, 210.0), abs=2.5)


def test_escape_gives_a_drag_up(glide):
    before = glide.clip
    start = frequency_at(glide, 0.2, 300.0)
    glide.drag_px(start, frequency_at(glide, 0.25, 400.0), release=False)
    assert glide.clip != before
    glide.key(Qt.Key.Key_Escape)
    same(glide.clip.waveform.points, POINTS)
    QTest.mouseRelease(glide.canvas.viewport(), LEFT)
    # The last point moves the end.
    glide.drag_px(frequency_at(glide, 0.4, 300.0), frequency_at(glide, 0.3, 300.0))
    assert glide.clip.duration_s == pytest.approx(0.3, abs=0.002)
    assert curve(glide, "amplitude")[-1][1] == pytest.approx(0.7, abs=0.02)


def test_keys_choose_points_change_curves_and_move_and_remove(glide):
    glide.key(Qt.Key.Key_PageDown)
    glide.key(Qt.Key.Key_PageDown)
    glide.key(Qt.Key.Key_Right)
    glide.key(Qt.Key.Key_Up)
    assert curve(glide, "frequency")[1] == pytest.approx((0.201, 301.0))
    assert len(set(glide.gestures)) == 1
    glide.key(Qt.Key.Key_F)
    glide.key(Qt.Key.Key_PageUp)
    glide.key(Qt.Key.Key_Down)
    assert curve(glide, "amplitude")[-1] == pytest.approx((0.4, 0.89))
    glide.key(Qt.Key.Key_F)
    glide.key(Qt.Key.Key_Delete)
    assert [time for time, _ in curve(glide, "frequency")] == pytest.approx([0.0, 0.4])


def test_only_a_glide_offers_the_tool_and_elsewhere_the_key_says_why_not(qtbot, glide):
    button = glide.panel.findChild(QToolButton, "clip_glide")
    assert button.isVisible()
    glide.show(glide.design.with_clip(1, waveform=Tone(100.0, 0.0, 0.2)))
    assert not button.isVisible()
    assert glide.panel._canvas.tool is glide.panel._view_tool
    glide.key(Qt.Key.Key_G)
    assert glide.refusals == ["The clip does not play a glide; choose that waveform first."]
    assert glide.panel._canvas.tool is glide.panel._view_tool
