"""Rig page > Measure…: an accelerometer is asked for, sweeps are played, and the result is kept."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton
from shiboken6 import isValid

import skinsource as ss
from skinsource.lab.playing.devices import Output
from skinsource.lab.rig_measuring.measurement import MeasuringSetup
from skinsource_gui.pages.rig.measuring import MeasurePage, setup_of, setup_text
from skinsource_gui.pages.rig.page import RigPage
from tests.core.rig_measuring.bench_top import (
    COIL,
    INPUT_VOLTS,
    RATE_HZ,
    SENSITIVITY,
    Card,
    ears,
    sensed,
    use,
)

WAIT = {"timeout": 60_000}


@pytest.fixture(scope="module")
def recording():
    return ears(sensed(COIL))


@pytest.fixture
def card(monkeypatch, recording):
    return use(monkeypatch, Card(recording, output=1))


@pytest.fixture
def rig_page(card, open_window, qtbot):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tone()),))
    window = open_window(design)
    settings = window.playback.player.settings
    settings.choose(Output(sample_rate_hz=RATE_HZ))
    window.do("edit_rig")
    rig_page = window.findChild(RigPage)
    qtbot.waitExposed(rig_page)
    QTest.mouseClick(rig_page.findChild(QPushButton, "rig_add"), Qt.MouseButton.LeftButton)
    channel = rig_page.rig.channels[0]
    channel = replace(channel, actuator="example-voice-coil", full_scale_v=3.0)
    rig_page.take_channel(0, channel)
    yield rig_page
    rig_page._saved = rig_page.rig
    rig_page.reject()


@pytest.fixture
def page(rig_page, qtbot):
    rig_page.fields.measure.click()
    measure_page = rig_page.findChild(MeasurePage)
    qtbot.waitUntil(lambda: not measure_page._looking, **WAIT)
    assert not measure_page.start.isEnabled()
    measure_page.arm.click()
    qtbot.waitUntil(measure_page.start.isEnabled, **WAIT)
    values = {
        "sensitivity_v_per_m_per_s2": SENSITIVITY,
        "input_full_scale_v": INPUT_VOLTS,
        "level_db": -20.0,
        "sweep_s": 1.5,
        "repeats": 2,
    }
    for name, value in values.items():
        measure_page.cells[name].edited.emit(name, value, None)
    yield measure_page
    if isValid(measure_page) and measure_page.isVisible():
        measure_page.reject()


def test_what_is_measured_is_drawn_beside_the_model_and_kept(page, rig_page, qtbot):
    assert not page.keep.isEnabled()
    page.start.click()
    assert page.stop.isEnabled()
    assert not page.start.isEnabled()
    qtbot.waitUntil(page.start.isEnabled, **WAIT)
    assert page.keep.isEnabled(), page.message.text()
    curves = page.plot.plot.curves
    assert [name.short for name in curves.names] == ["Measured", "Model"]
    assert np.abs(curves.y[0] - curves.y[1])[curves.x < 800.0].max() < 0.3
    assert "240 points from 20 to 1000 Hz" in page.message.text()
    assert "dB from the model, at" in page.message.text()
    assert rig_page.rig.channels[0].measured is None
    page.keep.click()
    channel = rig_page.rig.channels[0]
    assert np.abs(channel.measured.response(100.0) / COIL.response(100.0) - 1.0) < 0.03
    assert channel.measured_on
    assert "240 points" in rig_page.fields.measured.text()
    # The next channel is measured with the same sensor, on this machine on another day too.
    rig_page.fields.measure.click()
    again = rig_page.findChildren(MeasurePage)[-1]
    assert again.setup.sweep_s == 1.5
    again.reject()
    assert setup_of(setup_text(again.setup)) == again.setup
    for odd in ("", "[", "[1]", '{"sweep_s": -1}', '{"other": 1}'):
        assert setup_of(odd) == MeasuringSetup()


def test_what_cannot_be_measured_says_why(page, card, qtbot):
    page.cells["loopback_input"].edited.emit("loopback_input", 1, None)
    assert "expected two inputs" in page.message.text()
    assert page.setup.loopback_input == 0
    for highest_hz, can_start in ((3900.0, False), (1000.0, True)):
        page.cells["highest_hz"].edited.emit("highest_hz", highest_hz, None)
        assert page.start.isEnabled() is can_start
    page.cells["input_number"].edited.emit("input_number", 5, None)
    page.start.click()
    qtbot.waitUntil(page.start.isEnabled, **WAIT)
    assert "has 2 inputs, and input 5 is to be recorded" in page.message.text()
    assert not page.keep.isEnabled()
