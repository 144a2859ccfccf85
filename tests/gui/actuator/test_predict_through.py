"""Predict through the actuator: the switch, what follows it, and what is said where it cannot."""

import pytest

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.actuator_demand import actuation_of
from skinsource.engine.quantities import sources
from skinsource_gui.plots.pictures import caption_of
from skinsource_gui.plots.signal_view import DESCRIPTION_QUANTITIES, lazy_lines
from tests.gui.actuator.bench import brought_forward, choose, settle

TONE = track(7, Tone(frequency_hz=40.0, duration_s=0.3), amplitude=2.0)


@pytest.fixture
def window(open_window):
    design = Design(limb="synthetic-1", inputs=(TONE,))
    return open_window(design, View(selected_inputs=(design.ids[0],)))


@pytest.fixture
def panel(window, qtbot):
    return brought_forward(window, qtbot)


def test_the_switch_predicts_through_what_the_panel_shows_and_back(window, panel, qtbot):
    before = ss.evaluate(window.document.design, "output_levels_db")["output_levels_db"]
    panel.through.box.click()
    settle(window, qtbot)
    design = window.document.design
    assert design.actuated == actuation_of(panel._settings)
    assert panel.through.box.isChecked()
    assert "1 m/s²" in panel.through.text.text()
    after = ss.evaluate(design, "output_levels_db")["output_levels_db"]
    # A coil whose boost is limited moves less at 40 Hz than it is asked to.
    assert (after < before - 0.1).all()
    panel.through.box.click()
    settle(window, qtbot)
    assert window.document.design.actuated is None
    assert not panel.through.box.isChecked()
    window.document.undo_stack.undo()
    settle(window, qtbot)
    assert panel.through.box.isChecked()


def test_while_it_is_on_predictions_follow_the_fields_as_edits(window, panel, qtbot):
    before = window.document.design
    choose(panel, "parameter resistance_ohm", 4.5)
    assert window.document.design is before
    choose(panel, "parameter resistance_ohm", 4.0)
    panel.through.box.click()
    settle(window, qtbot)
    for resistance_ohm in (5.0, 6.0, 8.0):
        choose(panel, "parameter resistance_ohm", resistance_ohm, gesture=1)
        settle(window, qtbot)
    assert window.document.design.actuated.actuators[0].model.resistance_ohm == 8.0
    window.document.undo_stack.undo()
    settle(window, qtbot)
    # One drag is one step, and fields and predictions go back together.
    assert window.document.design.actuated.actuators[0].model.resistance_ohm == 4.0
    assert panel._settings.model.resistance_ohm == 4.0


def test_without_an_equaliser_amplitudes_are_volts(window, panel, qtbot):
    choose(panel, "equaliser", "none")
    choose(panel, "volts", 3.0)
    panel.through.box.click()
    settle(window, qtbot)
    assert "1 V" in panel.through.text.text()
    with pytest.raises(StopIteration):
        panel.choices.cell("volts")
    figure_texts = {figure.label: figure.value for figure in panel.figures.table.figures}
    # Not three times as many: an amplitude has one unit now.
    assert float(figure_texts["Peak voltage"].split()[0]) == pytest.approx(2.0, rel=0.02)


def test_another_actuator_than_the_one_that_is_shown_is_named(window, panel, qtbot):
    piezo = ss.ActuatorAt(actuator="Piezo of the lab", model=ss.actuators.load("example-piezo"))
    through = ss.Actuation(actuators=(piezo,))
    window.document.apply(
        ss.edits.predict_through(window.document.design, window.document.view, through)
    )
    settle(window, qtbot)
    assert "Piezo of the lab, no equaliser" in panel.through.text.text()
    choose(panel, "parameter resistance_ohm", 8.0)
    settle(window, qtbot)
    assert window.document.design.actuated == through


def test_a_shape_that_ends_predicting_through_says_why(window, panel, qtbot):
    panel.through.box.click()
    settle(window, qtbot)
    choose(panel, "actuator", ss.actuators.shape_names()[0])
    settle(window, qtbot)
    assert window.document.design.actuated is None
    assert not panel.through.box.isChecked()
    assert panel.through.text.isVisible()
    title = ss.actuators.profile(ss.actuators.shape_names()[0]).title
    assert f"Of {title} only the shape" in panel.through.text.text()
    assert panel.through.box.toolTip() == panel.through.text.text()
    window.document.undo_stack.undo()
    settle(window, qtbot)
    assert "1 m/s²" in panel.through.text.text()


def test_under_another_scaling_the_switch_stays_off_and_says_why(window, panel, qtbot):
    design, view = window.document.design, window.document.view
    window.document.apply(ss.edits.change_scaling(design, view, "upstream"))
    settle(window, qtbot)
    panel.through.box.click()
    settle(window, qtbot)
    assert not panel.through.box.isChecked()
    assert window.document.design.actuated is None
    assert "Probe acceleration" in window.notice.text


def test_pictures_and_tables_say_what_they_went_through(window, panel, qtbot):
    panel.through.box.click()
    settle(window, qtbot)
    design, view = window.document.design, window.document.view
    own = sources(design, view)
    results = {**own, **ss.evaluate(design, *(DESCRIPTION_QUANTITIES - own.keys()))}
    assert "; predicted through " in caption_of(design)
    assert any(line.startswith("predicted through: ") for line in lazy_lines(results)())
