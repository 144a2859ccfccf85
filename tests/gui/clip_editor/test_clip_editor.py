"""The editor of a clip: what is drawn and shaped there is what plays."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox

from skinsource.clips import Clip
from skinsource.design import Design, Input
from skinsource.edits import Refusal
from skinsource.effects import Envelope
from skinsource.evaluation import evaluate
from skinsource.samples import Samples
from skinsource.view import View
from skinsource.waveforms import Drawn, Tone
from skinsource_gui.panels.clip_editor.panel import ClipEditorPanel
from skinsource_gui.panels.clip_editor.spectrum_strip import spectrum_db

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE, SHIFT, ALT = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
RATE_HZ = 1300.0


class Bench:
    """The panel with one clip, and the little of a document that it needs."""

    def __init__(self, qtbot, waveform):
        self.panel = ClipEditorPanel()
        qtbot.addWidget(self.panel)
        self.design = Design(
            limb="synthetic-1", inputs=(Input(location=7, clips=(Clip(waveform=waveform),)),)
        )
        self.view, self.steps, self.refusals = View(), [], []
        self.panel.edited.connect(self._edit)
        self.panel.resize(700, 420)
        self.panel.show()
        qtbot.waitExposed(self.panel)
        self.show()

    @property
    def clip(self):
        return self.design.inputs[0].clips[0]

    @property
    def canvas(self):
        return self.panel._canvas

    @property
    def drawn(self):
        return self.clip.waveform.samples(RATE_HZ)

    def show(self):
        self.panel.show_state(self.design, self.view)
        played = tuple(
            tuple(clip.waveform.samples(RATE_HZ) for clip in one.clips)
            for one in self.design.inputs
        )
        self.panel.show_results(
            {"inputs": self.design.inputs, "clip_waveforms": played, "sample_rate_hz": RATE_HZ}
        )

    def at(self, time_s, value):
        return self.canvas.content.at(time_s, value)

    def drag(self, *places, button=LEFT, held=NONE, release=True):
        points = [self.at(*one) for one in places]
        self.press(points[0], button, held)
        for one in points[1:]:
            self.canvas._tool.move(self.canvas.content, one, held)
        if release:
            QTest.mouseRelease(self.canvas.viewport(), button, held, _whole(points[-1]))

    def press(self, at, button=LEFT, held=NONE):
        QTest.mousePress(self.canvas.viewport(), button, held, _whole(at))

    def key(self, key, held=NONE):
        QTest.keyClick(self.canvas, key, held)

    def _edit(self, outcome, gesture):
        if isinstance(outcome, Refusal):
            self.refusals.append(outcome.sentence)
            return
        self.steps.append(gesture)
        self.design, self.view = outcome.design, outcome.view
        self.show()


def _whole(at):
    return QPoint(round(at.x()), round(at.y()))


@pytest.fixture
def flat(qtbot):
    """Silence of 0.2 s, drawn."""
    bench = Bench(qtbot, Drawn(Samples(values=np.zeros(260), sample_rate_hz=RATE_HZ)))
    bench.panel.use("pen")
    return bench


@pytest.fixture
def tone(qtbot):
    bench = Bench(qtbot, Tone(100.0, 0.0, 0.2))
    bench.panel.use("envelope")
    return bench


def test_a_stroke_becomes_samples_in_one_step(flat):
    flat.drag((0.05, 0.0), (0.08, 0.5), (0.1, 0.5), (0.12, 0.0))
    values = flat.drawn
    assert values.size == 260
    assert values.max() == pytest.approx(0.5, abs=0.01)
    assert (values[117:130] > 0.45).all()
    assert not values[:60].any()
    assert not values[160:].any()
    assert len(set(flat.steps)) == 1


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
    assert len(set(flat.steps)) == 2


def test_nothing_drawn_lies_beyond_one(flat):
    flat.drag((0.05, 0.0), (0.08, 5.0), (0.12, -5.0))
    assert np.abs(flat.drawn).max() == 1.0


def test_escape_takes_the_stroke_back(flat):
    before = flat.design
    flat.drag((0.05, 0.0), (0.1, 0.5), release=False)
    assert flat.design != before
    flat.key(Qt.Key.Key_Escape)
    assert flat.design == before
    assert len(set(flat.steps)) == 1


def test_what_is_drawn_is_what_is_predicted_from(flat):
    flat.drag((0.05, 0.0), (0.08, 0.5), (0.12, -0.3))
    (felt,) = evaluate(flat.design, "input_waveforms", view=flat.view)["input_waveforms"]
    np.testing.assert_array_equal(felt, flat.drawn)
    np.testing.assert_array_equal(flat.canvas.content.played, flat.drawn)


def test_a_tone_becomes_samples_after_one_question(tone, monkeypatch):
    asked = []
    answers = [QMessageBox.StandardButton.Cancel, QMessageBox.StandardButton.Ok]
    monkeypatch.setattr(
        QMessageBox, "question", lambda *args: asked.append(args[2]) or answers[len(asked) - 1]
    )
    tone.panel.use("pen")
    assert tone.canvas._tool is tone.panel._tools["look"]
    tone.panel.use("pen")
    assert tone.canvas._tool is tone.panel._tools["pen"]
    tone.drag((0.05, 0.0), (0.06, 0.0))
    tone.panel.use("look")
    tone.panel.use("pen")
    assert len(asked) == 2
    assert "Tone 100 Hz" in asked[0]
    assert isinstance(tone.clip.waveform, Drawn)
    np.testing.assert_array_equal(tone.drawn[100:], Tone(100.0, 0.0, 0.2).samples(RATE_HZ)[100:])


def test_bounding_leaves_what_lies_within_the_band(flat, qtbot):
    time_s = np.arange(1300) / RATE_HZ
    slow = np.sin(2 * np.pi * 10 * time_s) + np.sin(2 * np.pi * 100 * time_s)
    bench = Bench(qtbot, Drawn(Samples(values=slow / 2, sample_rate_hz=RATE_HZ)))
    assert bench.panel._spectrum.outside == pytest.approx(0.5, abs=0.01)
    bench.panel._drawing.bound()
    # What is left outside comes from the hard ends.
    assert bench.panel._spectrum.outside < 1e-3
    np.testing.assert_allclose(bench.drawn, np.sin(2 * np.pi * 100 * time_s) / 2, atol=1e-9)
    assert len(bench.steps) == 1


def points(bench):
    (envelope,) = bench.clip.effects
    return envelope.points


def test_a_click_on_the_curve_adds_a_point_without_changing_it(tone):
    tone.press(tone.at(0.1, 1.0))
    QTest.mouseRelease(tone.canvas.viewport(), LEFT, NONE, _whole(tone.at(0.1, 1.0)))
    assert len(points(tone)) == 2
    times = np.linspace(0, 0.2, 50)
    assert (Envelope(points(tone)).values_at(times) == 1.0).all()
    assert tone.panel._shaping.tool.chosen == (1,)


def test_a_point_is_dragged_and_moves_alone(tone):
    tone.press(tone.at(0.1, 1.0))
    QTest.mouseRelease(tone.canvas.viewport(), LEFT, NONE, _whole(tone.at(0.1, 1.0)))
    tone.drag(points(tone)[1][:2], (0.12, 0.4))
    first, second = points(tone)
    assert first[:2] == (0.0, 1.0)
    assert second[0] == pytest.approx(0.12, abs=0.002)
    assert second[1] == pytest.approx(0.4, abs=0.02)


def test_a_segment_goes_up_and_down_as_a_whole(tone):
    tone.design = tone.design.with_clip(1, effects=(Envelope(((0.0, 0.5), (0.2, 0.5))),))
    tone.show()
    tone.drag((0.1, 0.5), (0.13, 0.8))
    assert [time for time, *_ in points(tone)] == [0.0, 0.2]
    assert [value for _, value, _ in points(tone)] == pytest.approx([0.8, 0.8], abs=0.02)


def test_alt_and_a_click_on_a_segment_bends_it(tone):
    tone.design = tone.design.with_clip(1, effects=(Envelope(((0.0, 0.2), (0.2, 0.8))),))
    tone.show()
    kinds = []
    for _ in range(3):
        value = float(Envelope(points(tone)).values_at(np.array([0.1]))[0])
        tone.press(tone.at(0.1, value), held=ALT)
        QTest.mouseRelease(tone.canvas.viewport(), LEFT, ALT)
        kinds.append(points(tone)[0][2])
    assert kinds == ["smooth", "held", "straight"]


def test_keys_move_the_chosen_point_by_one_step_or_ten_and_remove_it(tone):
    tone.design = tone.design.with_clip(1, effects=(Envelope(((0.0, 0.5), (0.1, 0.5))),))
    tone.show()
    tone.panel._shaping.tool.chosen = (1,)
    tone.key(Qt.Key.Key_Right)
    tone.key(Qt.Key.Key_Up, SHIFT)
    assert points(tone)[1][:2] == pytest.approx((0.101, 0.6))
    assert len(set(tone.steps)) == 1
    tone.key(Qt.Key.Key_Delete)
    assert len(points(tone)) == 1


def test_escape_gives_a_drag_of_a_point_up(tone):
    tone.design = tone.design.with_clip(1, effects=(Envelope(((0.0, 0.5), (0.1, 0.5))),))
    tone.show()
    before = points(tone)
    tone.drag((0.1, 0.5), (0.15, 0.9), release=False)
    assert points(tone) != before
    tone.key(Qt.Key.Key_Escape)
    assert points(tone) == before


def test_a_rectangle_chooses_points(tone):
    tone.design = tone.design.with_clip(
        1, effects=(Envelope(((0.02, 0.5), (0.1, 0.5), (0.18, 0.5))),)
    )
    tone.show()
    tone.drag((0.05, 0.9), (0.19, 0.1))
    assert tone.panel._shaping.tool.chosen == (1, 2)
    assert tone.steps == []


def test_without_a_clip_the_panel_says_what_to_do(flat):
    flat.design, flat.view = Design(limb="synthetic-1"), View()
    flat.show()
    assert "Select a clip" in flat.panel._empty.text()
    assert flat.panel._empty.isVisible()
    assert flat.canvas.content is None


def test_the_spectrum_of_a_tone_peaks_at_its_frequency():
    frequency_hz, levels_db = spectrum_db(Tone(150.0, 0.0, 1.0).samples(RATE_HZ), RATE_HZ)
    assert frequency_hz[np.argmax(levels_db)] == pytest.approx(150.0, abs=1.0)
    assert levels_db.max() == pytest.approx(0.0)


def test_the_value_under_the_pointer_is_read(tone):
    tone.panel.use("look")
    QTest.mouseMove(tone.canvas.viewport(), _whole(tone.at(0.1, 0.0)))
    tone.canvas._tool.move(tone.canvas.content, QPointF(tone.at(0.1, 0.0)), NONE)
    assert not tone.panel.grab().isNull()


def test_a_double_click_puts_a_point_anywhere(tone):
    QTest.mouseDClick(tone.canvas.viewport(), LEFT, NONE, _whole(tone.at(0.1, 0.5)))
    assert len(points(tone)) == 2
    assert points(tone)[1][:2] == pytest.approx((0.1, 0.5), abs=0.02)


def test_a_drag_of_the_level_end_pulls_a_new_point_and_not_all(tone):
    tone.drag((0.1, 1.0), (0.1, 0.4))
    assert points(tone)[0][:2] == (0.0, 1.0)
    assert points(tone)[1][1] == pytest.approx(0.4, abs=0.02)
    assert len(set(tone.steps)) == 1


def test_another_clip_takes_the_pen_away(flat):
    flat.drag((0.05, 0.0), (0.08, 0.5))
    flat.design = flat.design.with_clip(1, waveform=Tone(100.0, 0.0, 0.2))
    flat.show()
    assert flat.canvas.tool is flat.panel._tools["look"]
