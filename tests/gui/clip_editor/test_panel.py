"""The panel of the clip editor: what it says and reads."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtTest import QTest

from skinsource.design import Design
from skinsource.view import View
from skinsource.waveforms import Tone
from skinsource_gui.panels.clip_editor.spectrum_strip import spectrum_db
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
    tone.canvas._tool.move(tone.canvas.content, QPointF(tone.at(0.1, 0.0)), NONE)
    assert not tone.panel.grab().isNull()
