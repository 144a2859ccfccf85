"""A response that is opened is the actuator of the design, and ends what was said before."""

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog

import skinsource as ss
from skinsource.design.view import View
from tests.gui.output.bench import TONE, brought_forward, choose, design_of, figures, number, settle


@pytest.fixture
def window(open_window):
    return open_window(design_of(TONE), View(selected_inputs=(1,)))


def test_a_good_file_ends_the_complaint_about_a_bad_one(window, qtbot, tmp_path, monkeypatch):
    panel = brought_forward(window, qtbot)
    bad, good = tmp_path / "bad.csv", tmp_path / "good.csv"
    bad.write_text("1,2\n3,4\n", encoding="utf-8")
    good.write_text("frequency_hz,gain\n20,1\n100,2\n500,1\n", encoding="utf-8")
    paths = iter((bad, good))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(next(paths)), ""))
    before = window.document.design
    panel.choices.open.click()
    qtbot.waitUntil(lambda: "bad.csv" in window.notice.text, timeout=30_000)
    assert window.document.design is before
    panel.choices.open.click()
    qtbot.waitUntil(lambda: window.document.design is not before, timeout=30_000)
    assert window.document.design.actuation.title == "good"
    assert window.notice.text == ""
    assert window.statusBar().currentMessage() == "Opened good.csv."


def test_a_response_that_was_measured_is_predicted_through(window, qtbot, tmp_path, monkeypatch):
    panel = brought_forward(window, qtbot)
    coil = ss.actuators.load("example-voice-coil")
    hz = np.geomspace(10.0, 2000.0, 150)
    response = coil.response(hz)
    rows = [f"{f:.6f},{abs(h):.9g},{np.angle(h):.9g}" for f, h in zip(hz, response, strict=True)]
    path = tmp_path / "lab coil.csv"
    path.write_text("\n".join(["frequency_hz,gain,phase_rad", *rows]) + "\n", encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    before = number(panel, "Peak voltage")
    panel.through.click()
    settle(window, qtbot)
    panel.choices.open.click()
    qtbot.waitUntil(lambda: window.document.design.actuation.title == "lab coil", timeout=30_000)
    settle(window, qtbot)
    # The same coil, by what was measured of it; the equaliser and the switch are as they were.
    assert number(panel, "Peak voltage") == pytest.approx(before, rel=0.05)
    assert "Peak current" not in figures(panel)
    assert "uncalibrated" not in panel.figures.heading.text()
    assert "150 points that were measured, from 10 to 2000 Hz" in panel.choices.about.text()
    assert window.document.design.actuated.actuators[0].actuator == "lab coil"
    assert panel.choices.cell("actuator").field.currentText() == "lab coil"
    choose(panel, "actuator", "example-voice-coil")
    settle(window, qtbot)
    assert window.document.design.actuated.actuators[0].model == coil
