"""Buttons and preview of the inspector, and the way of the keys through it."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton

from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.samples import Recording
from skinsource_gui.qt.buttons import LetterButton


def test_mute_and_solo_are_buttons(bench):
    for name, field in (("mute_button", "muted"), ("solo_button", "solo")):
        button = bench.panel.findChild(LetterButton, name)
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        assert getattr(bench.track, field)
        assert button.isChecked()
        button.setFocus()
        QTest.keyClick(button, Qt.Key.Key_Space)
        assert not getattr(bench.track, field)
    assert bench.labels == [
        "Mute input at 7 (II pad)",
        "Unmute input at 7 (II pad)",
        "Solo input at 7 (II pad)",
        "End solo of input at 7 (II pad)",
    ]


def test_the_preview_shows_the_selected_input_and_its_length(bench):
    bench.show(selected_inputs=(3,))
    bench.panel.show_results(bench.results())
    assert bench.preview.duration_s == pytest.approx(21 / 1300)
    # Nothing has to be computed anew for another one to be shown.
    bench.show(selected_inputs=(1,))
    assert bench.preview.duration_s == pytest.approx(0.2)
    # Results of another number of inputs are those of another design.
    bench.panel.show_results({"input_waveforms": (np.ones(5),), "sample_rate_hz": 1300.0})
    assert bench.preview.duration_s is None
    bench.panel.show_problem("No limb of that name")
    assert bench.preview.message == "No limb of that name"


def test_an_old_preview_turns_pale_only_after_a_while(bench, qtbot):
    bench.panel.show_results(bench.results())
    fresh = bench.preview.grab().toImage()
    bench.panel.show_stale(True)
    assert bench.preview.grab().toImage() == fresh
    qtbot.waitUntil(lambda: bench.preview.grab().toImage() != fresh)
    bench.panel.show_results(bench.results())
    bench.panel.show_stale(False)
    assert bench.preview.grab().toImage() == fresh


def test_a_recording_has_a_button_that_asks_for_its_file(bench):
    actions = []
    bench.panel.action_requested.connect(actions.append)
    assert bench.panel.findChild(QPushButton, "recording_button") is None
    bench.show(bench.design.with_clip(1, waveform=Recording()))
    button = bench.panel.findChild(QPushButton, "recording_button")
    assert button.text() == "Choose file…"
    button.click()
    assert actions == ["import_recording"]


def test_tab_leads_through_the_fields_in_reading_order(bench):
    bench.show(bench.design.with_clip(1, waveform=Noise()))
    bench.choice("kind").setFocus()
    visited = []
    names = (
        "seed",
        "duration_s",
        "low_hz",
        "high_hz",
        "window",
        "amplitude",
        "onset_s",
        "location",
    )
    for _ in names:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        visited.append(QApplication.focusWidget().objectName())
    assert visited == [f"{name}_field" for name in names]
