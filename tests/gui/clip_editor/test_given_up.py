"""Esc in the editor of a clip, and whom the pen asks."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.effects.level import Envelope
from skinsource.design.waveforms.samples import Drawn, Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples
from tests.gui.clip_editor.bench import RATE_HZ, Bench

ESCAPE = Qt.Key.Key_Escape


def test_escape_takes_back_the_envelope_that_a_drag_began(tone):
    before = tone.design
    tone.drag((0.1, 1.0), (0.1, 0.5), release=False)
    assert len(tone.clip.effects) == 1
    tone.key(ESCAPE)
    assert tone.design == before
    assert len(set(tone.steps)) == 1


def test_escape_leaves_an_envelope_as_it_was_before_the_drag(tone):
    tone.design = tone.design.with_clip(1, effects=(Envelope(((0.0, 0.5), (0.2, 0.5))),))
    tone.show()
    before = tone.design
    tone.drag((0.2, 0.5), (0.15, 0.9), release=False)
    assert tone.design != before
    tone.key(ESCAPE)
    assert tone.design == before


@pytest.fixture
def questions(monkeypatch):
    asked = []

    def answer(*arguments):
        asked.append(arguments[2])
        return QMessageBox.StandardButton.Ok

    monkeypatch.setattr(QMessageBox, "question", answer)
    return asked


def test_the_clip_of_another_design_is_asked_about_though_it_has_the_same_number(qtbot, questions):
    bench = Bench(qtbot, Tone(100.0))
    bench.panel.use("pen")
    other = Design(
        limb="synthetic-1", inputs=(Input(location=3, clips=(Clip(waveform=Tone(50.0)),)),)
    )
    assert other.clips[0].id == bench.clip.id
    bench.design = other
    bench.show()
    assert bench.canvas.tool is bench.panel._view_tool
    bench.panel.use("pen")
    assert len(questions) == 2


def test_a_pen_draws_as_far_as_a_loud_recording_goes(qtbot, questions):
    loud = Samples(values=8.0 * np.sin(np.arange(260)), sample_rate_hz=RATE_HZ, unit="m/s²")
    bench = Bench(qtbot, Recording(loud))
    bench.panel.use("pen")
    bench.drag((0.05, 5.0), (0.1, 5.0))
    assert isinstance(bench.clip.waveform, Drawn)
    assert bench.drawn[round(0.07 * RATE_HZ)] == pytest.approx(5.0, abs=0.1)
