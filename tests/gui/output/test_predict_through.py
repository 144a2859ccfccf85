"""Predict through the actuator: the switch, what follows it, and what is said where it cannot."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog

import skinsource as ss
from skinsource import View, track
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.quantities import sources
from skinsource_gui.plots.pictures import caption_of
from skinsource_gui.plots.signal_view import DESCRIPTION_QUANTITIES, lazy_lines
from tests.gui.output.bench import (
    CHOSEN,
    INVERSE,
    POLE_PAIR,
    brought_forward,
    choose,
    design_of,
    figures,
    number,
    settle,
)

PIEZO = ss.actuators.profile("example-piezo").title


TONE = track(7, Tone(frequency_hz=40.0, duration_s=0.3), amplitude=2.0)


@pytest.fixture
def window(open_window):
    design = design_of(TONE)
    return open_window(design, View(selected_inputs=(design.ids[0],)))


@pytest.fixture
def panel(window, qtbot):
    return brought_forward(window, qtbot)


def test_the_switch_predicts_through_what_is_chosen_and_back(window, panel, qtbot):
    before = ss.evaluate(window.document.design, "output_levels_db")["output_levels_db"]
    panel.through.click()
    settle(window, qtbot)
    design = window.document.design
    assert design.actuated == replace(CHOSEN, on=True)
    assert panel.through.isChecked()
    assert "1 m/s²" in panel.through_text.text()
    after = ss.evaluate(design, "output_levels_db")["output_levels_db"]
    # A coil whose boost is limited moves less at 40 Hz than it is asked to.
    assert (after < before - 0.1).all()
    panel.through.click()
    settle(window, qtbot)
    assert window.document.design.actuation == CHOSEN
    assert not panel.through.isChecked()
    window.document.undo_stack.undo()
    settle(window, qtbot)
    assert panel.through.isChecked()


def test_the_fields_are_edits_and_a_drag_is_one_step(window, panel, qtbot):
    for resistance_ohm in (5.0, 6.0, 8.0):
        choose(panel, "resistance_ohm", resistance_ohm, gesture=1)
        settle(window, qtbot)
    assert window.document.design.actuation.actuators[0].model.resistance_ohm == 8.0
    assert window.document.design.actuated is None
    window.document.undo_stack.undo()
    settle(window, qtbot)
    assert window.document.design.actuation == CHOSEN
    panel.through.click()
    choose(panel, "actuator", "example-piezo")
    settle(window, qtbot)
    # It stays switched on, and the equaliser stays the same.
    actuated = window.document.design.actuated
    assert (actuated.title, actuated.equaliser) == (PIEZO, CHOSEN.equaliser)


def test_the_pole_pair_is_always_that_of_the_actuator(window, panel, qtbot):
    choose(panel, "equaliser", POLE_PAIR)
    choose(panel, "new_quality", 0.5)
    choose(panel, "stiffness_n_per_m", 2000.0)
    settle(window, qtbot)
    actuation = window.document.design.actuation
    assert actuation.equaliser == ss.equalising.PolePairReplacement(
        *ss.equalising.resonance_of(actuation.actuators[0].model), 0.5
    )


def test_an_actuator_that_is_not_listed_is_named_and_keeps_its_parameters(window, panel, qtbot):
    piezo = ss.ActuatorAt(actuator="Piezo of the lab", model=ss.actuators.load("example-piezo"))
    design, view = window.document.design, window.document.view
    through = ss.Actuation(actuators=(piezo, replace(piezo, place=3)))
    window.document.apply(ss.edits.choose_actuation(design, view, through))
    settle(window, qtbot)
    assert panel.choices.cell("actuator").field.currentText() == "Piezo of the lab"
    assert panel.choices.parameters._cells == ()
    choose(panel, "equaliser", INVERSE)
    settle(window, qtbot)
    assert window.document.design.actuation.actuators == through.actuators


def test_under_another_scaling_the_switch_stays_off_and_says_why(window, panel, qtbot):
    design, view = window.document.design, window.document.view
    window.document.apply(ss.edits.change_scaling(design, view, "upstream"))
    settle(window, qtbot)
    panel.through.click()
    settle(window, qtbot)
    assert not panel.through.isChecked()
    assert window.document.design.actuated is None
    assert "Probe acceleration" in window.notice.text


def test_pictures_and_tables_say_what_they_went_through(window, panel, qtbot):
    panel.through.click()
    settle(window, qtbot)
    design, view = window.document.design, window.document.view
    own = sources(design, view)
    results = {**own, **ss.evaluate(design, *(DESCRIPTION_QUANTITIES - own.keys()))}
    assert "; predicted through " in caption_of(design)
    assert any(line.startswith("predicted through: ") for line in lazy_lines(results)())


def test_a_good_file_ends_the_complaint_about_a_bad_one(
    window, panel, qtbot, tmp_path, monkeypatch
):
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


def test_a_response_that_was_measured_is_predicted_through(
    window, panel, qtbot, tmp_path, monkeypatch
):
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
