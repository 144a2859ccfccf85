"""A response that is opened is shown whole, predicted through, and ends what was said before."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog

import skinsource as ss
from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource.engine.actuator_demand import ActuatorSettings
from tests.gui.actuator.bench import (
    TONE,
    brought_forward,
    choose,
    design_of,
    figures,
    number,
    settings,
    settle,
)


@pytest.fixture
def window(open_window):
    return open_window(design_of(TONE), View(selected_inputs=(1,)))


def zoom(window):
    zoomed = replace(settings(window), zoom=(10.0, 10.4))
    window.document.look(with_settings(window.document.view, "actuator", zoomed))
    window.catch_up()


def test_another_actuator_is_shown_whole_and_a_good_file_ends_the_complaint(
    window, qtbot, tmp_path, monkeypatch
):
    panel = brought_forward(window, qtbot)
    zoom(window)
    choose(panel, "actuator", "example-voice-coil")
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


def test_a_response_that_was_measured_is_looked_at_and_predicted_through(
    window, qtbot, tmp_path, monkeypatch
):
    panel = brought_forward(window, qtbot)
    coil = ss.actuators.load("example-voice-coil")
    hz = np.geomspace(10.0, 2000.0, 150)
    response = coil.response(hz)
    rows = [f"{f:.6f},{abs(h):.9g},{np.angle(h):.9g}" for f, h in zip(hz, response, strict=True)]
    path = tmp_path / "lab coil.csv"
    path.write_text("\n".join(["frequency_hz,gain,phase_rad", *rows]) + "\n", encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    before = number(panel, "Peak voltage")
    panel.through.box.click()
    settle(window, qtbot)
    panel.choices.open.click()
    qtbot.waitUntil(lambda: settings(window).actuator == "measured", timeout=30_000)
    settle(window, qtbot)
    # The same coil, by what was measured of it; what is predicted goes with what is shown.
    assert number(panel, "Peak voltage") == pytest.approx(before, rel=0.05)
    assert "Peak current" not in figures(panel)
    assert "uncalibrated" not in panel.figures.heading.text()
    assert "150 points that were measured, from 10 to 2000 Hz" in panel.choices.about.text()
    assert window.document.design.actuated.actuators[0].actuator == "lab coil"
    assert panel.choices.cell("actuator").field.currentText() == "lab coil (measured)"
    choose(panel, "actuator", "example-voice-coil")
    settle(window, qtbot)
    assert window.document.design.actuated.actuators[0].model == coil
    # It can be chosen again.
    choose(panel, "actuator", "measured")
    settle(window, qtbot)
    assert settings(window).profile.title == "lab coil"
    path.write_text("a,b\n1,2\n", encoding="utf-8")
    with qtbot.waitSignal(window.playback.rigs.failed, timeout=30_000) as failure:
        panel.choices.open.click()
    assert "lab coil.csv" in failure.args[0]
    assert ActuatorSettings(actuator="measured", measured=((1.0,), "x")).profile.title
