"""The panel of the output: curves, figures and fields, live, and nothing while it is hidden."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import skinsource as ss
from skinsource import View, edits, track
from skinsource.base.measurement_conditions import BAND_HZ
from skinsource.base.work import counting
from skinsource.design.waveforms.pulses import CentredTap, Tap
from skinsource.engine.actuator_demand import LONGEST_S, listed_name, profile_of, strongest
from skinsource_gui.panels.output.figures import frequencies_of, frequency_axis, response_curves
from skinsource_gui.panels.output.panel import with_actuator, with_equaliser
from tests.gui.output.bench import (
    COIL,
    INVERSE,
    NO_EQUALISER,
    POLE_PAIR,
    TONE,
    brought_forward,
    choose,
    design_of,
    figures,
    number,
    settle,
)

TAP = track(3, Tap(), colour=1)


@pytest.fixture
def window(open_window):
    design = design_of(TONE, TAP)
    return open_window(design, View(selected_inputs=(design.ids[0],)))


@pytest.fixture
def panel(window, qtbot):
    panel = brought_forward(window, qtbot)
    panel.more.click()
    settle(window, qtbot)
    return panel


def test_the_figures_are_those_of_the_selected_input_through_the_equaliser(panel):
    assert panel.figures.heading.text().startswith("Place 7, Digit II, pad: peak ")
    assert "uncalibrated gain" in panel.figures.heading.text()
    # The band-limited tone of 10 m/s² moves the contactor by 10 m/s².
    assert number(panel, "Peak acceleration") == pytest.approx(10.0, rel=0.03)
    assert number(panel, "Peak velocity") == pytest.approx(1e3 * 10.0 / (2 * np.pi * 100), rel=0.1)
    assert figures(panel)["Duty cycle"].value == "100 %"
    coil = ss.actuators.load("example-voice-coil")
    volts = 10.0 / abs(coil.response(100.0))
    assert number(panel, "Peak voltage") == pytest.approx(volts, rel=0.1)
    assert "Temperature rise" not in figures(panel)


def test_figures_follow_edits_and_settings_and_are_red_beyond_a_limit(window, panel, qtbot):
    before = number(panel, "Peak voltage")
    assert not figures(panel)["Peak velocity"].exceeded
    design, view = window.document.design, window.document.view
    window.document.apply(edits.change_field(design, view, view.selected_inputs, "amplitude", 20.0))
    settle(window, qtbot)
    assert number(panel, "Peak voltage") == pytest.approx(2.0 * before, rel=0.02)
    window.document.apply(
        edits.change_field(design, view, view.selected_inputs, "amplitude", 100.0)
    )
    settle(window, qtbot)
    assert figures(panel)["Peak velocity"].exceeded
    assert "Beyond its limit: peak velocity" in panel.figures.limits.text()
    assert "beyond its limit" in panel.figures.table.accessibleDescription()


def test_curves_show_actuator_filter_and_both_and_the_published_one(window, panel, qtbot):
    curves = panel.plot.plot.curves
    assert [name.short for name in curves.names] == ["Actuator", "Filter", "Equalised"]
    place = int(np.abs(frequencies_of(BAND_HZ) - 100.0).argmin())
    assert curves.y[0, place] + curves.y[1, place] == pytest.approx(curves.y[2, place], abs=1e-6)
    assert curves.y[2, place] == pytest.approx(0.0, abs=0.2)
    assert curves.columns == ("actuator_db", "filter_db", "equalised_db")
    assert not panel.choices.reset.isVisibleTo(panel)
    choose(panel, "resistance_ohm", 8.0)
    settle(window, qtbot)
    assert window.document.design.actuation.actuators[0].model.resistance_ohm == 8.0
    assert "Resistance 4 Ω → 8 Ω" in panel.choices.about.text()
    assert [name.short for name in panel.plot.plot.curves.names][-1] == "As listed"
    panel.choices.reset.click()
    settle(window, qtbot)
    assert window.document.design.actuation.actuators == (COIL,)
    assert len(panel.plot.plot.curves.names) == 3


def test_without_an_equaliser_volts_are_known_where_amplitudes_are_volts(window, panel, qtbot):
    choose(panel, "equaliser", NO_EQUALISER)
    settle(window, qtbot)
    assert panel.figures.table.figures == ()
    assert "not known" in panel.figures.refusal.text()
    panel.through.click()
    settle(window, qtbot)
    assert number(panel, "Peak voltage") == pytest.approx(10.0, rel=0.02)
    assert len(panel.plot.plot.curves.names) == 1
    with pytest.raises(KeyError):
        panel.choices.cell("boost_db")


@pytest.mark.parametrize("name", ss.actuators.names())
def test_every_actuator_can_be_looked_at(name):
    for equaliser, band_hz in product((INVERSE, POLE_PAIR, NO_EQUALISER), (BAND_HZ, (5.0, 9000.0))):
        actuator = ss.ActuatorAt(actuator=name, model=ss.actuators.load(name))
        chosen = with_equaliser(with_actuator(None, actuator), equaliser)
        drawn = response_curves(actuator.model, actuator.model, chosen.equaliser, band_hz)
        assert np.isfinite(drawn.y).all()
        low, high = frequency_axis(band_hz).extent
        assert (drawn.x[0], drawn.x[-1]) == (low, high)
        assert low < band_hz[0] < band_hz[1] < high
    assert listed_name(actuator) == name
    assert profile_of(actuator) == ss.actuators.profile(name)


def test_without_an_actuator_there_are_no_figures_and_no_switch(window, panel, qtbot):
    choose(panel, "actuator", "none")
    settle(window, qtbot)
    assert window.document.design.actuation is None
    assert panel.figures.table.figures == ()
    assert panel.figures.refusal.text() == ""
    assert not panel.through.isEnabled()
    button = window.playback.button
    assert button.text().startswith("Output: none")
    window.docks["output"].hide()
    button.click()
    assert panel.isVisible()
    choose(panel, "actuator", "kastor-2023-air")
    settle(window, qtbot)
    assert panel.figures.table.figures
    assert "Fingertip voice coil, in air" in window.playback.button.text()


def test_a_tap_that_leaves_a_velocity_is_refused_and_another_is_offered(window, panel, qtbot):
    view = window.document.view
    window.document.look(replace(view, selected_inputs=(window.document.design.ids[1],)))
    settle(window, qtbot)
    assert panel.figures.heading.text().startswith("Place 3")
    assert "52 % of its energy" in panel.figures.refusal.text()
    assert panel.figures.mend.isVisibleTo(panel)
    # Without an equaliser nothing has to be followed, and nothing is offered.
    choose(panel, "equaliser", NO_EQUALISER)
    settle(window, qtbot)
    assert "energy" not in panel.figures.refusal.text()
    assert not panel.figures.mend.isVisibleTo(panel)
    choose(panel, "equaliser", INVERSE)
    settle(window, qtbot)
    panel.figures.mend.click()
    settle(window, qtbot)
    clip = window.document.design.inputs[1].clips[0]
    assert isinstance(clip.waveform, CentredTap)
    assert panel.figures.refusal.text() == ""
    assert panel.figures.table.figures
    assert not panel.figures.mend.isVisibleTo(panel)


def test_figures_are_computed_beside_the_window(window, panel, qtbot):
    design, moved = window.document.design, []
    window.engine.finished.connect(lambda outcome: moved.append(outcome.work.samples_moved))
    with counting() as in_the_way:
        window.document.edit("Softer", design.with_input(0, amplitude=3.0))
        settle(window, qtbot)
    assert sum(moved) > 0
    assert in_the_way.samples_moved == 0


def test_a_long_drive_is_looked_at_where_it_is_strongest():
    drive = np.zeros(130_000)
    drive[100_000] = 2.0
    part = strongest(drive, 1300.0)
    assert part.size == int(LONGEST_S * 1300)
    assert part.max() == 2.0
    assert strongest(drive[:100], 1300.0).size == 100
    assert strongest(np.zeros(0), 1300.0).size == 1


def test_without_anything_that_plays_it_says_what_to_do(open_window, qtbot):
    panel = brought_forward(open_window(design_of()), qtbot)
    assert "add one" in panel.figures.refusal.text()
    assert panel.figures.table.figures == ()
