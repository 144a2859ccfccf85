"""The pen of the clip editor can be reached from anywhere, and what is drawn is what plays."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox, QToolButton

from skinsource import Clip, Design, Input, track
from skinsource.design.effects import Fade, Reverse, Stretch, Trim, played
from skinsource.design.waveforms import Drawn, Recording, Tone
from skinsource.specs.samples import Samples
from skinsource_gui.panels.clip_editor.tools import Pen
from tests.gui.clip_editor.bench import RATE_HZ, RIGHT, SHIFT, Bench

SILENCE, FADE = Samples(values=np.zeros(260), sample_rate_hz=RATE_HZ), Fade(0.0, 0.01)


def test_a_stroke_becomes_samples_in_one_step(flat):
    flat.drag((0.05, 0.0), (0.08, 0.5), (0.1, 0.5), (0.12, 0.0))
    values = flat.drawn
    assert values.size == 260
    assert values.max() == pytest.approx(0.5, abs=0.01)
    assert (values[117:130] > 0.45).all()
    assert not values[:60].any()
    assert not values[160:].any()
    assert len(set(flat.gestures)) == 1


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
    answers["question"] = QMessageBox.StandardButton.Ok
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
    answers["question"] = QMessageBox.StandardButton.Ok
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


@pytest.fixture
def studio(open_window):
    def make(waveform):
        return open_window(Design(limb="synthetic-1", inputs=(track(7, waveform),)))

    return make


def pen_is_taken(window):
    return isinstance(window.panel("clip_editor")._canvas.tool, Pen)


def test_the_clip_panel_leads_to_the_pen_and_so_does_the_action(studio, qtbot):
    window = studio(Drawn())
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    button = window.panel("inspector").findChild(QToolButton, "draw_button")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor = window.panel("clip_editor")
    assert editor.isVisible()
    assert pen_is_taken(window)
    assert editor.isAncestorOf(QApplication.focusWidget())
    editor.use("look")
    window.do("draw_clip")
    assert pen_is_taken(window)


@pytest.mark.parametrize("waveform", [Tone(100.0), Drawn(SILENCE)], ids=["tone", "drawn"])
@pytest.mark.parametrize("effect", [Trim(0.1, 0.05), Stretch(2.0), Reverse()], ids=type)
def test_the_pen_draws_what_plays_of_a_trimmed_or_stretched_clip(
    qtbot, questions, waveform, effect
):
    bench = Bench(qtbot, waveform)
    before = replace(bench.clip, effects=(effect, FADE))
    bench.show(bench.design.with_clip(before.id, effects=before.effects))
    plays = played(waveform, (effect,), RATE_HZ)
    bench.panel.use("pen")
    assert effect.title.lower() in questions[0]
    assert bench.clip.effects == (FADE,)
    np.testing.assert_array_equal(bench.drawn, plays)
    bench.drag((0.02, 0.6), (0.03, 0.6), held=SHIFT)
    assert bench.drawn[30] == pytest.approx(0.6, abs=0.02)
    np.testing.assert_array_equal(bench.drawn[50:], plays[50:])
    assert bench.clip.duration_s == pytest.approx(before.duration_s, abs=1 / RATE_HZ)
    assert len(questions) == 1
