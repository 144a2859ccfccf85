"""Buttons and preview of the inspector, and the way of the keys through it."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.samples import Recording
from skinsource_gui.qt.buttons import LetterButton
from skinsource_gui.shell.focus import tab_stops


def test_mute_and_solo_are_buttons_of_the_track(bench):
    bench.open("track_fold")
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
    # A clip of a newer design has no results yet.
    bench.panel.show_results({"clip_waveforms": (), "inputs": (), "sample_rate_hz": 1300.0})
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
    stops = [stop.objectName() for stop in tab_stops(bench.panel, ())]
    assert stops == [
        "draw_button",
        "location_field",
        "amplitude_field",
        "scaling",
        *("onset_s_field", "duration_s_field", "kind_field", "seed_field"),
        *("low_hz_field", "high_hz_field", "window_field"),
        *("effects_fold", "add_effect", "track_fold"),
    ]
