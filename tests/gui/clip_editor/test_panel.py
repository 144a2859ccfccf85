"""The clip editor: what it says and reads, and what its tools change; the pen, from anywhere."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox, QPushButton, QToolButton

from skinsource import Clip, Design, Input, View, track
from skinsource.design.effects import Fade, Reverse, Stretch, Trim, played
from skinsource.design.waveforms import Drawn, Glide, Recording, Tone
from skinsource.signals.synthesis import curve_of
from skinsource.specs.samples import Samples
from skinsource_gui.panels.clip_editor.tools import Pen, of_column
from tests.gui.clip_editor.bench import LEFT, NONE, RATE_HZ, RIGHT, SHIFT, Bench
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
        tools.append((tone.canvas.tool, tone.panel._toolbar.tools["look"].isChecked()))
        return QMessageBox.StandardButton.Yes

    monkeypatch.setattr(QMessageBox, "question", ask)
    tone.panel.use("envelope")
    tone.panel.use("pen")
    # While it was asked, no point could be seen.
    assert tools == [(tone.panel._view_tool, True)]
    assert tone.canvas.tool is tone.panel._pen.tool


def shown_s(bench):
    return bench.canvas.content.scale.shown_s


def length_of(range_s):
    return range_s[1] - range_s[0]


def turn(bench, notches, held=NONE):
    viewport = bench.canvas.viewport()
    turn_wheel(viewport, viewport.rect().center(), (0, NOTCH * notches), held)


def test_a_drag_moves_what_is_seen_as_far_as_the_pointer_goes(tone):
    # The tone of 0.2 s, of which the middle is seen.
    tone.panel.use("look")
    tone.key(Qt.Key.Key_Plus)
    tone.key(Qt.Key.Key_Plus)
    first_s, last_s = shown_s(tone)
    px_per_s = tone.canvas.content.scale.px_per_s
    start = tone.at((first_s + last_s) / 2, 0.0)
    tone.press(start)
    for k in range(1, 6):
        at = start.toPoint() - QPoint(4 * k, 0)
        tone.canvas.tool.move(tone.canvas.content, QPointF(at), NONE)
        assert shown_s(tone)[0] == pytest.approx(first_s + 4 * k / px_per_s, abs=0.6 / px_per_s)
    QTest.mouseRelease(tone.canvas.viewport(), LEFT, NONE, at)
    assert shown_s(tone)[0] == pytest.approx(first_s + 20 / px_per_s, abs=0.6 / px_per_s)
    assert length_of(shown_s(tone)) == pytest.approx(last_s - first_s)
    before = shown_s(tone)
    turn(tone, 1)
    assert length_of(shown_s(tone)) < length_of(before)
    closer = shown_s(tone)
    turn(tone, -1, SHIFT)
    assert shown_s(tone)[0] > closer[0]
    assert length_of(shown_s(tone)) == pytest.approx(length_of(closer))


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
    at = frequency_at(glide, 0.1, 200.0).toPoint()
    QTest.mouseClick(glide.canvas.viewport(), LEFT, pos=at)
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
    np.testing.assert_allclose(glide.clip.waveform.points, POINTS, rtol=0, atol=1e-12)
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


def test_only_a_glide_offers_the_tool_with_all_of_it_and_elsewhere_says_why_not(qtbot, glide):
    button = glide.panel.findChild(QToolButton, "clip_glide")
    assert button.isVisible()
    glide.show(glide.design.with_clip(1, effects=(Trim(0.1),)))
    assert (glide.canvas.content.drawn.size, glide.canvas.content.played) == (520, None)
    glide.show(glide.design.with_clip(1, waveform=Tone(100.0, 0.0, 0.2)))
    assert not button.isVisible()
    assert glide.panel._canvas.tool is glide.panel._view_tool
    glide.key(Qt.Key.Key_G)
    assert glide.refusals == ["The clip does not play a glide; choose that waveform first."]
    assert glide.panel._canvas.tool is glide.panel._view_tool


SILENCE, FADE = Samples(values=np.zeros(260), sample_rate_hz=RATE_HZ), Fade(0.0, 0.01)


def test_with_shift_a_stroke_is_a_straight_line(flat):
    flat.drag((0.05, 0.0), (0.07, -0.8), (0.09, 0.3), (0.15, 0.5), held=SHIFT)
    line = flat.drawn[70:190]
    assert np.abs(np.diff(line, 2)).max() < 1e-9
    assert line[-1] > line[0] > 0


def test_the_right_button_draws_back_to_zero(flat):
    flat.drag((0.02, 0.6), (0.18, 0.6))
    flat.drag((0.08, 0.1), (0.1, 0.2), button=RIGHT)
    values = flat.drawn
    assert not values[105:129].any()
    assert values[95] == pytest.approx(0.6, abs=0.02)
    assert len(set(flat.gestures)) == 2


def test_a_stroke_stays_within_one_and_escape_takes_it_back(flat):
    before = flat.design
    flat.drag((0.05, 0.0), (0.08, 5.0), (0.12, -5.0), release=False)
    assert np.abs(flat.drawn).max() == 1.0
    flat.key(Qt.Key.Key_Escape)
    assert flat.design == before
    assert len(set(flat.gestures)) == 1


def test_a_tone_becomes_samples_after_one_question(tone, answers):
    tone.panel.use("pen")
    assert tone.canvas.tool is tone.panel._tools["look"]
    answers["question"] = QMessageBox.StandardButton.Yes
    tone.panel.use("pen")
    assert tone.canvas.tool is tone.panel._tools["pen"]
    tone.drag((0.05, 0.0), (0.06, 0.0))
    tone.panel.use("look")
    tone.panel.use("pen")
    assert len(answers["asked"]) == 2
    assert "Tone 100 Hz" in answers["asked"][0]
    assert isinstance(tone.clip.waveform, Drawn)
    np.testing.assert_array_equal(tone.drawn[100:], Tone(100.0, 0.0, 0.2).samples(RATE_HZ)[100:])


@pytest.fixture
def questions(answers):
    answers["question"] = QMessageBox.StandardButton.Yes
    return answers["asked"]


def test_the_clip_of_another_design_is_asked_about_though_it_has_the_same_number(qtbot, questions):
    bench = Bench(qtbot, Tone(100.0))
    bench.panel.use("pen")
    other = Design(
        limb="synthetic-1", inputs=(Input(location=3, clips=(Clip(waveform=Tone(50.0)),)),)
    )
    assert other.clips[0].id == bench.clip.id
    bench.show(other)
    bench.drag((0.05, 0.0), (0.06, 0.5))
    assert len(questions) == 2
    assert bench.clip.waveform == Tone(50.0)
    bench.drag((0.05, 0.0), (0.06, 0.5))
    assert isinstance(bench.clip.waveform, Drawn)
    assert len(questions) == 2


def test_draw_stays_on_when_a_step_is_taken_back(flat):
    flat.panel.use("pen")
    for before in (flat.design, flat.design.with_clip(1, waveform=Tone(50.0))):
        flat.drag((0.05, 0.0), (0.08, 0.5))
        flat.show(before)
        assert flat.canvas.tool is flat.panel._tools["pen"]


def test_a_pen_draws_as_far_as_a_loud_recording_goes(qtbot, questions):
    loud = Samples(values=8.0 * np.sin(np.arange(260)), sample_rate_hz=RATE_HZ, unit="m/s²")
    bench = Bench(qtbot, Recording(loud))
    bench.panel.use("pen")
    bench.drag((0.05, 5.0), (0.1, 5.0))
    assert isinstance(bench.clip.waveform, Drawn)
    assert bench.drawn[round(0.07 * RATE_HZ)] == pytest.approx(5.0, abs=0.1)


def pen_is_taken(window):
    return isinstance(window.panel("clip_editor")._canvas.tool, Pen)


def test_the_clip_panel_leads_to_the_pen_and_so_does_the_action(open_window, qtbot):
    window = open_window(Design(limb="synthetic-1", inputs=(track(7, Drawn()),)))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    button = window.panel("inspector").findChild(QPushButton, "draw_button")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor = window.panel("clip_editor")
    assert editor.isVisible()
    assert pen_is_taken(window)
    assert editor.isAncestorOf(QApplication.focusWidget())
    editor.use("look")
    window.do("draw_clip")
    assert pen_is_taken(window)


@pytest.mark.parametrize("waveform", [Tone(100.0), Drawn(SILENCE)], ids=["tone", "drawn"])
@pytest.mark.parametrize("effect", [Trim(0.1002, 0.05), Stretch(2.0), Reverse()], ids=type)
def test_the_pen_draws_what_plays_of_a_clip_and_grey_lies_where_it_plays_or_nowhere(
    qtbot, questions, waveform, effect
):
    bench = Bench(qtbot, waveform)
    before = replace(bench.clip, onset_s=0.1002, effects=(effect,))
    bench.show(bench.design.with_clip(1, onset_s=before.onset_s, effects=(effect, FADE)))
    plays = played(waveform, (effect,), RATE_HZ)
    seen = {Trim: before.sampled(RATE_HZ)[1]}.get(type(effect))
    np.testing.assert_array_equal(bench.canvas.content.drawn, seen)
    # The pen was taken before the effect was.
    bench.panel._switch_to("pen")
    bench.drag((0.02, 0.3), (0.03, 0.3))
    assert effect.title.lower() in questions[0]
    assert bench.clip.effects == (FADE,)
    np.testing.assert_array_equal(bench.drawn, plays)
    bench.drag((0.02, 0.6), (0.03, 0.6), held=SHIFT)
    assert bench.drawn[30] == pytest.approx(0.6, abs=0.02)
    np.testing.assert_array_equal(bench.drawn[50:], plays[50:])
    assert bench.clip.duration_s == pytest.approx(before.duration_s, abs=1 / RATE_HZ)
    assert len(questions) == 1
