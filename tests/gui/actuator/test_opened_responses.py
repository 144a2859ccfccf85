"""A response that is opened is shown whole, and ends what was said of the file before."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QFileDialog

from skinsource.actuator_demand import ActuatorSettings
from skinsource.design import Design, track
from skinsource.panel_settings import settings_of, with_settings
from skinsource.view import View
from skinsource.waveforms import Tone


@pytest.fixture
def window(make_window):
    tone = track(7, Tone(frequency_hz=100.0, duration_s=0.1))
    return make_window(Design(limb="synthetic-1", inputs=(tone,)), View(selected_inputs=(1,)))


def settings(window):
    return settings_of(window.document.view, "actuator", ActuatorSettings)


def zoom(window):
    zoomed = replace(settings(window), zoom=(10.0, 10.4))
    window.document.look(with_settings(window.document.view, "actuator", zoomed))
    window.catch_up()


def test_another_actuator_is_shown_whole_and_a_good_file_ends_the_complaint(
    window, qtbot, tmp_path, monkeypatch
):
    window.docks["actuator"].bring_forward()
    panel = window.panel("actuator")
    qtbot.waitUntil(panel.isVisible)
    zoom(window)
    panel.choices.cell("actuator").edited.emit("actuator", "example-voice-coil", None)
    assert settings(window).actuator == "example-voice-coil"
    assert settings(window).zoom is None
    zoom(window)
    bad, good = tmp_path / "bad.csv", tmp_path / "good.csv"
    bad.write_text("1,2\n3,4\n", encoding="utf-8")
    good.write_text("frequency_hz,gain\n20,1\n100,2\n500,1\n", encoding="utf-8")
    paths = iter((bad, good))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(next(paths)), ""))
    panel.choices.open.click()
    qtbot.waitUntil(lambda: "bad.csv" in window.notice.text, timeout=30_000)
    assert settings(window).zoom == (10.0, 10.4)
    panel.choices.open.click()
    qtbot.waitUntil(lambda: settings(window).actuator == "measured", timeout=30_000)
    assert window.notice.text == ""
    assert window.statusBar().currentMessage() == "Opened good.csv."
    assert settings(window).zoom is None
