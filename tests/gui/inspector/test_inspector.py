"""Buttons and preview of the inspector, pixel by pixel, and the way of the keys through it."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.samples import Recording
from skinsource_gui.plots.preview import WaveformPreview
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


@pytest.fixture
def preview(qtbot):
    widget = WaveformPreview()
    qtbot.addWidget(widget)
    widget.resize(420, 140)
    widget.set_look(0)
    widget.show()
    return widget


def test_one_loud_sample_in_a_minute_is_seen(preview):
    samples = np.zeros(78_000)
    samples[41_234] = 1.0
    preview.show_samples(samples, 1300.0)
    picture = preview.grab().toImage()
    # Right of the middle, just below the top.
    drawn = [column for column in range(420) if picture.pixelColor(column, 20).blue() > 150]
    inked = [column for column in drawn if picture.pixelColor(column, 20).red() < 120]
    assert inked
    assert all(215 <= column <= 225 for column in inked)


@pytest.mark.parametrize("n_samples", [600, 2600])
def test_a_tone_whose_samples_miss_its_peak_reaches_it(preview, n_samples):
    preview.show_samples(np.sin(0.5 * np.pi * np.arange(n_samples) + np.pi / 4), 1300.0)
    picture = preview.grab().toImage()
    # Samples alone end 20 px below the top.
    highest = 140 - 2
    for x in range(100, 300, 10):
        inked = [
            y
            for y in range(highest // 2)
            if any(picture.pixelColor(x + k, y).red() < 120 for k in range(5))
        ]
        assert min(inked) <= 8
