"""The glide tool of the clip editor: frequency and amplitude, two curves over the waveform."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from skinsource.design.waveforms.tones import Glide, Tone
from skinsource.signals.synthesis import curve_of
from skinsource_gui.panels.clip_editor.tools import of_column
from tests.gui.clip_editor.bench import LEFT, NONE, SHIFT, Bench, whole

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


def drag(bench, start, end, held=NONE, *, release=True):
    view = bench.canvas.viewport()
    QTest.mousePress(view, LEFT, held, whole(start))
    for part in (0.5, 1.0):
        bench.canvas.tool.move(bench.canvas.content, start + part * (end - start), held)
    if release:
        QTest.mouseRelease(view, LEFT, held, whole(end))


def same(first, other):
    np.testing.assert_allclose(np.array(first), np.array(other), rtol=0, atol=1e-12)


def click(bench, at):
    QTest.mouseClick(bench.canvas.viewport(), LEFT, pos=whole(at))


def test_half_the_sample_rate_is_at_the_top_and_zero_at_the_foot(glide):
    area = glide.canvas.content.area
    assert frequency_at(glide, 0.0, 0.0).y() == pytest.approx(area.bottom())
    assert frequency_at(glide, 0.0, 650.0).y() == pytest.approx(area.top())


def test_a_point_of_the_frequency_is_dragged_and_the_amplitude_stays(glide):
    amplitude = curve(glide, "amplitude")
    drag(glide, frequency_at(glide, 0.2, 300.0), frequency_at(glide, 0.25, 400.0))
    times, values = zip(*curve(glide, "frequency"), strict=True)
    assert times == pytest.approx((0.0, 0.25, 0.4), abs=0.002)
    assert values == pytest.approx((100.0, 400.0, 300.0), abs=3.0)
    same(curve(glide, "amplitude"), amplitude)
    assert len(set(glide.steps)) == 1


def test_a_point_of_the_amplitude_is_dragged_and_goes_no_higher_than_one(glide):
    frequency = curve(glide, "frequency")
    drag(glide, glide.at(0.4, 0.9), glide.at(0.4, 1.5))
    assert curve(glide, "amplitude")[-1] == (pytest.approx(0.4, abs=0.001), 1.0)
    assert glide.panel._glide.tool.active == "amplitude"
    assert [hz for _, hz in curve(glide, "frequency")] == pytest.approx([hz for _, hz in frequency])
    assert glide.refusals == []


def test_the_frequency_stays_below_half_the_sample_rate(glide):
    start = frequency_at(glide, 0.4, 300.0)
    drag(glide, start, frequency_at(glide, 0.4, 900.0))
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


def test_the_last_point_moves_the_end_of_the_glide(glide):
    drag(glide, frequency_at(glide, 0.4, 300.0), frequency_at(glide, 0.3, 300.0))
    assert glide.clip.duration_s == pytest.approx(0.3, abs=0.002)
    assert curve(glide, "amplitude")[-1][1] == pytest.approx(0.7, abs=0.02)


def test_escape_gives_a_drag_up(glide):
    before = glide.clip
    start = frequency_at(glide, 0.2, 300.0)
    drag(glide, start, frequency_at(glide, 0.25, 400.0), release=False)
    assert glide.clip != before
    glide.key(Qt.Key.Key_Escape)
    same(glide.clip.waveform.points, POINTS)
    QTest.mouseRelease(glide.canvas.viewport(), LEFT)
    same(glide.clip.waveform.points, POINTS)


def test_keys_choose_points_change_curves_and_move_and_remove(glide):
    glide.key(Qt.Key.Key_PageDown)
    glide.key(Qt.Key.Key_PageDown)
    glide.key(Qt.Key.Key_Right)
    glide.key(Qt.Key.Key_Up)
    assert curve(glide, "frequency")[1] == pytest.approx((0.201, 301.0))
    assert len(set(glide.steps)) == 1
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
    glide.design = glide.design.with_clip(1, waveform=Tone(100.0, 0.0, 0.2))
    glide.show()
    assert not button.isVisible()
    assert glide.panel._canvas.tool is glide.panel._view_tool
    glide.key(Qt.Key.Key_G)
    assert glide.refusals == ["The clip does not play a glide; choose that waveform first."]
    assert glide.panel._canvas.tool is glide.panel._view_tool
