"""The panel of the output: curves, figures, fields and switch, live, and nothing while hidden."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog

import skinsource as ss
from skinsource import View, edits, track
from skinsource.base.conventions import BAND_HZ
from skinsource.base.work import counting
from skinsource.design.waveforms.pulses import CentredTap, Tap
from skinsource.design.waveforms.tones import Chirp, Tone
from skinsource.engine.actuator_demand import listed_name, profile_of, strongest
from skinsource.engine.quantities import sources
from skinsource.export.formats.audio import Wav
from skinsource.export.stimulus_export.preparing import prepare_stimulus
from skinsource_gui.panels.output.figures import frequencies_of, frequency_axis, response_curves
from skinsource_gui.panels.output.panel import with_actuator, with_equaliser
from skinsource_gui.plots.pictures import caption_of
from skinsource_gui.plots.signal_view import DESCRIPTION_QUANTITIES, lazy_lines
from tests.gui.output import bench

TAP = track(3, Tap(), colour=1)


@pytest.fixture
def window(open_window):
    design = bench.design_of(bench.TONE, TAP)
    return open_window(design, View(selected_inputs=(design.ids[0],)))


@pytest.fixture
def panel(window, qtbot):
    panel = bench.brought_forward(window, qtbot)
    panel.more.click()
    bench.settle(window)
    return panel


def test_the_figures_are_those_of_the_selected_input_through_the_equaliser(panel):
    assert panel.figures.heading.text().startswith("Place 7, Digit II, pad: peak ")
    assert "uncalibrated gain" in panel.figures.heading.text()
    # The band-limited tone of 10 m/s² moves the contactor by 10 m/s².
    assert bench.number(panel, "Peak acceleration") == pytest.approx(10.0, rel=0.03)
    assert bench.number(panel, "Peak velocity") == pytest.approx(
        1e3 * 10.0 / (2 * np.pi * 100), rel=0.1
    )
    assert bench.figures(panel)["Duty cycle"].value == "100 %"
    coil = ss.actuators.load("example-voice-coil")
    volts = 10.0 / abs(coil.response(100.0))
    assert bench.number(panel, "Peak voltage") == pytest.approx(volts, rel=0.1)
    assert "Temperature rise" not in bench.figures(panel)


def test_figures_follow_edits_and_settings_and_are_red_beyond_a_limit(window, panel, qtbot):
    before = bench.number(panel, "Peak voltage")
    assert not bench.figures(panel)["Peak velocity"].exceeded
    design, view = window.document.design, window.document.view
    window.document.apply(edits.change_field(design, view, view.selected_inputs, "amplitude", 20.0))
    bench.settle(window)
    assert bench.number(panel, "Peak voltage") == pytest.approx(2.0 * before, rel=0.02)
    window.document.apply(
        edits.change_field(design, view, view.selected_inputs, "amplitude", 100.0)
    )
    bench.settle(window)
    assert bench.figures(panel)["Peak velocity"].exceeded
    assert "Beyond its limit: peak velocity" in panel.figures.limits.text()
    assert "beyond its limit" in panel.figures.table.accessibleDescription()


def test_figures_and_response_are_of_one_place_with_its_limits_in_the_rig(window, panel, qtbot):
    tones = bench.TONE, replace(bench.TONE, location=3, id=0)
    channels = [
        ss.rigs.RigChannel(place=place, output=place, actuator=name, limits=limits)
        for place, name, limits in (
            (3, "example-piezo", ss.actuators.Limits(peak_voltage_v=3.0)),
            (7, "example-voice-coil", ss.actuators.Limits(peak_voltage_v=0.5)),
        )
    ]
    rig = ss.rigs.Rig(channels=channels)
    wired = edits.choose_rig(bench.design_of(*tones), View(), rig).design
    window.document.edit("Wired", wired)
    for id, channel, volts in zip(wired.ids, channels[::-1], ("0.5 V", "3 V"), strict=True):
        window.document.look(replace(window.document.view, selected_inputs=(id,)))
        bench.settle(window)
        assert bench.figures(panel)["Peak voltage"].limit == volts
        model = ss.actuators.load(channel.actuator)
        drawn = response_curves(model, model, wired.actuation.equaliser, BAND_HZ)
        np.testing.assert_array_equal(panel.plot.plot.curves.y, drawn.y)


def test_a_rig_with_a_longest_duration_has_a_row_for_what_is_sent(window, panel, qtbot, tmp_path):
    assert "Duration" not in bench.figures(panel)
    longer = track(3, Tone(frequency_hz=100.0, duration_s=2.5))
    limits = ss.actuators.Limits(duration_s=2.0)
    first = ss.rigs.RigChannel(
        place=3, actuator="example-voice-coil", limits=limits, full_scale_v=20.0
    )
    rig = ss.rigs.Rig(channels=(first, replace(first, place=7, output=2)))
    wired = edits.choose_rig(bench.design_of(bench.TONE, longer), View(), rig).design
    window.document.edit("Wired", wired)
    bench.settle(window)
    written = ss.export_stimulus(wired, tmp_path / "a.wav", confirmed=True)
    assert "Place 7: duration: 2.7 s, expected at most 2 s." in written.objections
    row = bench.figures(panel)["Duration"]
    assert (row.value, row.limit, row.exceeded) == ("2700 ms", "2000 ms", True)
    assert "Beyond its limit: duration" in panel.figures.limits.text()


def test_curves_show_actuator_filter_and_both_and_the_published_one(window, panel, qtbot):
    curves = panel.plot.plot.curves
    assert [name.short for name in curves.names] == ["Actuator", "Filter", "Equalised"]
    place = int(np.abs(frequencies_of(BAND_HZ) - 100.0).argmin())
    assert curves.y[0, place] + curves.y[1, place] == pytest.approx(curves.y[2, place], abs=1e-6)
    assert curves.y[2, place] == pytest.approx(0.0, abs=0.2)
    assert curves.columns == ("actuator_db", "filter_db", "equalised_db")
    assert not panel.choices.reset.isVisibleTo(panel)
    bench.choose(panel, "resistance_ohm", 8.0)
    assert window.document.design.actuation.actuators[0].model.resistance_ohm == 8.0
    assert "Resistance 4 Ω → 8 Ω" in panel.choices.about.text()
    assert [name.short for name in panel.plot.plot.curves.names][-1] == "As listed"
    panel.choices.reset.click()
    bench.settle(window)
    assert window.document.design.actuation.actuators == (bench.COIL,)
    assert len(panel.plot.plot.curves.names) == 3


def test_without_an_equaliser_volts_are_known_where_amplitudes_are_volts(window, panel, qtbot):
    bench.choose(panel, "equaliser", bench.NO_EQUALISER)
    assert panel.figures.table.figures == ()
    assert "not known" in panel.figures.refusal.text()
    panel.through.click()
    bench.settle(window)
    assert bench.number(panel, "Peak voltage") == pytest.approx(10.0, rel=0.02)
    assert len(panel.plot.plot.curves.names) == 1
    with pytest.raises(KeyError):
        panel.choices.cell("boost_db")


@pytest.mark.parametrize("name", ss.actuators.names())
def test_every_actuator_can_be_looked_at(name):
    for equaliser, band_hz in product(
        (bench.INVERSE, bench.POLE_PAIR, bench.NO_EQUALISER), (BAND_HZ, (5.0, 9000.0))
    ):
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
    bench.choose(panel, "actuator", "none")
    assert window.document.design.actuation is None
    assert panel.figures.table.figures == ()
    assert panel.figures.refusal.text() == ""
    assert not panel.through.isEnabled()
    place = panel.through.pos()
    button = window.playback.button
    assert button.text().startswith("Output: none")
    window.docks["output"].hide()
    button.click()
    assert panel.isVisible()
    bench.choose(panel, "actuator", "kastor-2023-air")
    assert panel.through.pos() == place
    assert panel.figures.table.figures
    assert "Fingertip voice coil, in air" in window.playback.button.text()


def test_a_tap_that_leaves_a_velocity_is_refused_and_another_is_offered(window, panel, qtbot):
    view = window.document.view
    window.document.look(replace(view, selected_inputs=(window.document.design.ids[1],)))
    bench.settle(window)
    assert panel.figures.heading.text().startswith("Place 3")
    assert "52 % of its energy" in panel.figures.refusal.text()
    assert panel.figures.mend.isVisibleTo(panel)
    # Without an equaliser nothing has to be followed, and nothing is offered.
    bench.choose(panel, "equaliser", bench.NO_EQUALISER)
    assert "energy" not in panel.figures.refusal.text()
    assert not panel.figures.mend.isVisibleTo(panel)
    bench.choose(panel, "equaliser", bench.INVERSE)
    panel.figures.mend.click()
    bench.settle(window)
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
        bench.settle(window)
    assert sum(moved) > 0
    assert in_the_way.samples_moved == 0


def test_a_long_voltage_is_looked_at_where_it_is_strongest():
    voltage = np.zeros(130_000)
    voltage[100_000] = 2.0
    part = strongest(voltage, 1300.0)
    assert part.size == 1560
    assert part.max() == 2.0
    assert strongest(voltage[:100], 1300.0).size == 100
    assert strongest(np.zeros(0), 1300.0).size == 1


CHIRP = Chirp(start_hz=600.0, end_hz=40.0, duration_s=4.0)


@pytest.mark.parametrize("waveform", [Tone(frequency_hz=100.0, duration_s=1.5), CHIRP])
@pytest.mark.parametrize("name", ["example-voice-coil", "kastor-2023-air", "example-piezo"])
def test_the_peak_of_a_long_drive_is_the_one_that_is_exported(name, waveform):
    actuator = ss.ActuatorAt(actuator=name, model=ss.actuators.load(name))
    actuation = replace(bench.CHOSEN, actuators=(actuator,))
    design = bench.design_of(track(7, waveform), actuation=actuation)
    demand = ss.evaluate(design, "actuator_demand")["actuator_demand"]
    exported = prepare_stimulus(design, Wav(), 48_000, ss.StimulusOptions())
    assert demand.part
    assert demand.figures.peak_voltage_v == pytest.approx(exported.peak, rel=1e-3)


def test_of_a_voltage_without_an_equaliser_no_edge_of_the_cut_is_counted():
    tone = track(7, Tone(frequency_hz=100.0, duration_s=3.0), amplitude=2.0)
    actuation = replace(bench.CHOSEN, equaliser=None, on=True)
    demand = ss.evaluate(bench.design_of(tone, actuation=actuation), "actuator_demand")
    figures = demand["actuator_demand"].figures
    # The fastest change is that of the tone, not the one at an edge.
    assert figures.slew_v_per_s == pytest.approx(2.0 * 2.0 * np.pi * 100.0, rel=0.02)
    assert figures.peak_voltage_v == pytest.approx(2.0, rel=1e-3)


def test_without_anything_that_plays_it_says_what_to_do(open_window, qtbot):
    panel = bench.brought_forward(open_window(bench.design_of()), qtbot)
    assert "add one" in panel.figures.refusal.text()
    assert panel.figures.table.figures == ()


PIEZO = ss.actuators.profile("example-piezo").title


def test_the_switch_predicts_through_what_is_chosen_and_back(window, panel, qtbot):
    low = Tone(frequency_hz=40.0, duration_s=0.3)
    window.document.edit("Low", bench.design_of(track(7, low, amplitude=2.0)))
    before = ss.evaluate(window.document.design, "output_levels_db")["output_levels_db"]
    panel.through.click()
    bench.settle(window)
    design = window.document.design
    assert design.actuated == replace(bench.CHOSEN, on=True)
    assert panel.through.isChecked()
    assert "1 m/s² at the contactor, as far" in panel.through_text.text()
    after = ss.evaluate(design, "output_levels_db")["output_levels_db"]
    # A coil whose boost is limited moves less at 40 Hz than it is asked to.
    assert (after < before - 0.1).all()
    panel.through.click()
    bench.settle(window)
    assert window.document.design.actuation == bench.CHOSEN
    assert not panel.through.isChecked()
    window.document.undo_stack.undo()
    bench.settle(window)
    assert panel.through.isChecked()


def test_the_fields_are_edits_and_a_drag_is_one_step(window, panel, qtbot):
    for resistance_ohm in (5.0, 6.0, 8.0):
        bench.choose(panel, "resistance_ohm", resistance_ohm, gesture=1)
    assert window.document.design.actuation.actuators[0].model.resistance_ohm == 8.0
    assert window.document.design.actuated is None
    window.document.undo_stack.undo()
    bench.settle(window)
    assert window.document.design.actuation == bench.CHOSEN
    panel.through.click()
    bench.choose(panel, "actuator", "example-piezo")
    # It stays switched on, and the equaliser stays the same.
    actuated = window.document.design.actuated
    assert (actuated.title, actuated.equaliser) == (PIEZO, bench.CHOSEN.equaliser)


def test_the_pole_pair_is_always_that_of_the_actuator(window, panel, qtbot):
    bench.choose(panel, "equaliser", bench.POLE_PAIR)
    bench.choose(panel, "new_quality", 0.5)
    bench.choose(panel, "stiffness_n_per_m", 2000.0)
    actuation = window.document.design.actuation
    assert actuation.equaliser == ss.equalising.PolePairReplacement(
        *ss.equalising.resonance_of(actuation.actuators[0].model), 0.5
    )


def test_an_actuator_that_is_not_listed_is_named_and_keeps_its_parameters(window, panel, qtbot):
    piezo = ss.ActuatorAt(actuator="Piezo of the lab", model=ss.actuators.load("example-piezo"))
    design, view = window.document.design, window.document.view
    through = ss.Actuation(actuators=(piezo, replace(piezo, place=3)))
    window.document.apply(ss.edits.choose_actuation(design, view, through))
    bench.settle(window)
    assert panel.choices.cell("actuator").field.currentText() == "Piezo of the lab"
    assert panel.choices.parameters._cells == ()
    bench.choose(panel, "equaliser", bench.INVERSE)
    assert window.document.design.actuation.actuators == through.actuators


def test_beside_a_rig_another_actuator_is_refused_and_the_field_stays(
    window, panel, qtbot, tmp_path, monkeypatch
):
    channel = ss.rigs.RigChannel(place=7, actuator="example-piezo")
    design, view = window.document.design, window.document.view
    window.document.apply(ss.edits.choose_rig(design, view, ss.rigs.Rig(channels=(channel,))))
    bench.settle(window)
    field = panel.choices.cell("actuator").field
    shown = field.currentText()
    field.choose("example-voice-coil")
    bench.settle(window)
    assert "Choose another rig, or none" in window.notice.text
    assert field.currentText() == shown
    path = tmp_path / "own.csv"
    path.write_text("frequency_hz,gain\n20,1\n100,2\n500,1\n", encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    refused = []
    window.document.refused.connect(refused.append)
    panel.choices.open.click()
    qtbot.waitUntil(lambda: refused != [], timeout=30_000)
    assert "Choose another rig, or none" in window.notice.text


def test_under_another_scaling_the_switch_stays_off_and_says_why(window, panel, qtbot):
    design, view = window.document.design, window.document.view
    window.document.apply(ss.edits.change_scaling(design, view, "upstream"))
    bench.settle(window)
    panel.through.click()
    bench.settle(window)
    assert not panel.through.isChecked()
    assert window.document.design.actuated is None
    assert "Probe acceleration" in window.notice.text


def test_pictures_and_tables_say_what_they_went_through(window, panel, qtbot):
    panel.through.click()
    bench.settle(window)
    design, view = window.document.design, window.document.view
    own = {**sources(design, view), "record_samples": 650}
    results = {**own, **ss.evaluate(design, *(DESCRIPTION_QUANTITIES - own.keys()))}
    assert "; predicted through " in caption_of(design)
    assert any(line.startswith("predicted through: ") for line in lazy_lines(results)())
    assert lazy_lines(results)()[-1].endswith("(record), 0.5 s, its length without the actuator")
    assert "length without" in window.panel("skin").measure.span.toolTip()


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
    before = bench.number(panel, "Peak voltage")
    panel.through.click()
    bench.settle(window)
    panel.choices.open.click()
    qtbot.waitUntil(lambda: window.document.design.actuation.title == "lab coil", timeout=30_000)
    bench.settle(window)
    # The same coil, by what was measured of it; the equaliser and the switch are as they were.
    assert bench.number(panel, "Peak voltage") == pytest.approx(before, rel=0.05)
    assert "Peak current" not in bench.figures(panel)
    assert "uncalibrated" not in panel.figures.heading.text()
    assert "150 points that were measured, from 10 to 2000 Hz" in panel.choices.about.text()
    assert window.document.design.actuated.actuators[0].actuator == "lab coil"
    assert panel.choices.cell("actuator").field.currentText() == "lab coil"
    bench.choose(panel, "actuator", "example-voice-coil")
    assert window.document.design.actuated.actuators[0].model == coil
