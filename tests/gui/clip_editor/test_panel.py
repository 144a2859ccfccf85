"""The panel of the clip editor: what it says and reads."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox

from skinsource.design.design import Design
from skinsource.design.effects.level import Envelope
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.clip_editor.view import EditorItem, spectrum_db
from skinsource_gui.qt.theme import DARK
from tests.gui.clip_editor.bench import NONE, RATE_HZ, whole


def test_without_a_clip_the_panel_says_what_to_do(flat):
    flat.design, flat.view = Design(limb="synthetic-1"), View()
    flat.show()
    assert "Click a place on the hand" in flat.panel._empty.text()
    assert flat.panel._empty.isVisible()
    assert flat.canvas.content is None


def test_the_spectrum_of_a_tone_peaks_at_its_frequency():
    frequency_hz, levels_db = spectrum_db(Tone(150.0, 0.0, 1.0).samples(RATE_HZ), RATE_HZ)
    assert frequency_hz[np.argmax(levels_db)] == pytest.approx(150.0, abs=1.0)
    assert levels_db.max() == pytest.approx(0.0)


def test_the_value_under_the_pointer_is_read(tone):
    tone.panel.use("look")
    QTest.mouseMove(tone.canvas.viewport(), whole(tone.at(0.1, 0.0)))
    tone.canvas.tool.move(tone.canvas.content, QPointF(tone.at(0.1, 0.0)), NONE)
    assert not tone.panel.grab().isNull()


def test_only_the_tool_that_is_taken_shows_and_changes_points(tone, monkeypatch):
    tone.drag((0.0, 1.0), (0.0, 0.5))
    tone.panel.use("envelope")
    tone.key(Qt.Key.Key_Home)
    tone.panel.use("look")
    shaped, steps = tone.design, len(tone.steps)
    for key in (Qt.Key.Key_Insert, Qt.Key.Key_PageDown, Qt.Key.Key_Delete, Qt.Key.Key_Up):
        tone.key(key)
    assert (tone.design, len(tone.steps)) == (shaped, steps)
    tools = []

    def ask(*_):
        tools.append((tone.canvas.tool, tone.panel._toolbar._tools["look"].isChecked()))
        return QMessageBox.StandardButton.Ok

    monkeypatch.setattr(QMessageBox, "question", ask)
    tone.panel.use("envelope")
    tone.panel.use("pen")
    # While it was asked, no point could be seen.
    assert tools == [(tone.panel._view_tool, True)]
    assert tone.canvas.tool is tone.panel._pen


def test_a_low_wide_editor_has_its_spectrum_beside_the_curve(tone):
    canvas, spectrum = tone.canvas, tone.panel._spectrum
    tone.panel.resize(700, 420)
    assert spectrum.y() >= canvas.geometry().bottom()
    assert spectrum.width() == canvas.width()
    tone.panel.resize(1300, 200)
    assert spectrum.x() >= canvas.geometry().right()
    assert spectrum.height() == canvas.height() > 140
    assert canvas.width() > 2.5 * spectrum.width()


def test_curves_are_painted_again_only_when_they_look_different(tone, monkeypatch, use_theme):
    painted = []
    paint = EditorItem._paint_curve

    def counted(item, painter, content, samples, *args):
        painted.append(samples)
        paint(item, painter, content, samples, *args)

    monkeypatch.setattr(EditorItem, "_paint_curve", counted)
    tone.design = tone.design.with_clip(1, effects=(Envelope(((0.0, 0.5), (0.1, 0.5))),))
    tone.panel.show_state(tone.design, tone.view)
    tone.canvas.grab()
    painted.clear()
    # The points follow the pointer before it is known what they make of the clip.
    tone.panel._envelope.tool.move(tone.canvas.content, tone.at(0.1, 0.5), NONE)
    before = tone.canvas.grab().toImage()
    assert painted == []
    other = 0.25 * tone.drawn
    tone.panel.show_results(
        {
            "inputs": tone.design.inputs,
            "clip_waveforms": ((other,),),
            "sample_rate_hz": RATE_HZ,
        }
    )
    after = tone.canvas.grab().toImage()
    assert after != before
    # The waveform itself, and its axes, are as they were.
    assert [samples is other for samples in painted] == [True]
    tone.canvas.item.show_staleness(True)
    assert tone.canvas.grab().toImage() != after
    use_theme(DARK)
    tone.canvas.grab()
    assert len(painted) == 4


def test_all_of_it_is_seen_where_a_small_screen_leaves_it_little_height(tone):
    # What a window of 1366 x 768 px under a title bar leaves it at its foot.
    assert tone.panel.minimumHeight() <= 190
    tone.panel.resize(1360, 190)
    assert tone.panel.height() == 190
    tone.canvas.lay_out()
    assert tone.canvas.content.area.height() > 100
    assert tone.canvas.geometry().bottom() <= tone.canvas.parentWidget().rect().bottom()
