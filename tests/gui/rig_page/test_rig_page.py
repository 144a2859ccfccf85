"""Play > Rig…: a rig is described, saved, opened, played for, and predicted through."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox, QPushButton
from shiboken6 import isValid

import skinsource as ss
from skinsource import View, edits
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel, open_rig, save_rig
from skinsource.lab.playing.devices import Output
from skinsource.lab.rig_measuring.measurement import MeasuringSetup
from skinsource.limbs.locations import input_name
from skinsource_gui.pages.rig.page import MeasurePage, RigPage, setup_of, setup_text, title_of
from tests.core.own_limbs.lab_bench import N_INPUTS, installed
from tests.core.rig_measuring import bench_top

WAIT = {"timeout": 30_000}


FLAT = MeasuredResponse(((20.0, 50.0, 0.0), (1000.0, 50.0, 0.0)))


@pytest.fixture
def window(open_window):
    return open_window(
        ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Gabor(200.0)),))
    )


@pytest.fixture
def page(window, qtbot):
    window.playback.player.settings.choose_rig(None)
    window.do("edit_rig")
    page = window.findChild(RigPage)
    qtbot.waitExposed(page)
    yield page
    if isValid(page):  # not closed by the test
        page._saved = page.rig
        page.reject()


@pytest.fixture
def answer(answers, tmp_path):
    """Have the next dialogs answer with a name."""

    def with_name(name):
        answers["save"] = answers["open"] = str(tmp_path / name)
        return tmp_path / name

    return with_name


def put(page, name, value):
    page.fields.cells[name].edited.emit(name, value, None)


def press(page, name):
    QTest.mouseClick(page.findChild(QPushButton, f"rig_{name}"), Qt.MouseButton.LeftButton)


def test_a_rig_made_by_hand_is_the_one_in_its_file(page, window, answer):
    QTest.keyClicks(page._title, "Bench 3")
    press(page, "add")
    put(page, "full_scale_v", 2.5)
    put(page, "polarity", "inverted")
    put(page, "delay_s", 0.004)
    put(page, "limit displacement_m", 1e-3)
    press(page, "add")
    put(page, "actuator", "example-voice-coil")
    path = answer("bench.skinrig")
    press(page, "save")
    first, second = open_rig(path).channels
    assert open_rig(path).title == "Bench 3"
    assert (first.place, first.output, first.full_scale_v) == (7, 1, 2.5)
    assert (first.polarity, first.delay_s, first.limits.displacement_m) == ("inverted", 0.004, 1e-3)
    # The place that the design drives comes first; the next one is like the one before, on the
    # next place and output.
    assert (second.place, second.output, second.full_scale_v) == (1, 2, 2.5)
    assert second.actuator == "example-voice-coil"
    assert "Saved bench.skinrig" in page.message.text()
    assert window.playback.player.settings.rig == page.rig


def test_a_response_comes_from_a_table_and_is_forgotten_again(page, qtbot, answer):
    press(page, "add")
    path = answer("coil.csv")
    rows = "\n".join(
        f"{hz},{10.0 + hz / 100:.3f},{-0.1 * hz / 100:.3f}" for hz in range(20, 800, 10)
    )
    path.write_text(f"frequency_hz,gain,phase_rad\n{rows}\n", encoding="utf-8")
    page.fields.from_file.click()
    qtbot.waitUntil(lambda: page.rig.channels[0].measured is not None, **WAIT)
    measured = page.rig.channels[0].measured
    assert np.abs(measured.response(200.0)) == pytest.approx(12.0, rel=1e-3)
    assert page.rig.channels[0].measured_on
    assert "78 points, 20 to 790 Hz" in page.fields.measured.text()
    page.fields.forget.click()
    assert page.rig.channels[0].measured is None
    assert page.rig.channels[0].measured_on == ""


def test_an_opened_rig_is_shown_and_what_is_none_is_refused(page, answer):
    path = answer("bench.skinrig")
    rig = Rig(title="Bench", channels=(RigChannel(place=12, output=4, full_scale_v=1.0),))
    save_rig(path, rig)
    press(page, "open")
    assert page.rig == rig
    assert page.channels.item(0).text() == "12 · Digit II, base, output 4"
    path.write_text("no rig", encoding="utf-8")
    press(page, "open")
    assert page.rig == rig
    assert "bench.skinrig" in page.message.text()


def test_changes_are_not_lost_unasked(page, answers, tmp_path):
    press(page, "add")
    press(page, "close")
    assert page.isVisible()
    assert "not saved" in answers["asked"][0]
    answers["question"] = QMessageBox.StandardButton.Save
    answers["save"] = str(tmp_path / "bench.skinrig")
    press(page, "close")
    assert not (isValid(page) and page.isVisible())
    assert (tmp_path / "bench.skinrig").exists()


def test_a_saved_rig_is_that_of_the_design_with_its_actuators(page, window, answer):
    press(page, "add")
    put(page, "actuator", "example-voice-coil")
    answer("bench.skinrig")
    press(page, "save")
    design = window.document.design
    assert design.rig == page.rig
    assert design.actuation.at(7).model == ss.actuators.load("example-voice-coil")
    window.document.undo_stack.undo()
    assert window.document.design.rig is None
    page._use.setChecked(False)
    press(page, "save")
    assert window.document.design.rig is None


def test_places_are_those_of_the_limb_of_the_design_the_driven_ones_first(page, window):
    installed()
    edit = edits.change_limb(
        ss.Design(limb="synthetic-1", inputs=(ss.track(5), ss.track(2))), View(), "lab-1"
    )
    window.document.apply(edit)
    for _ in range(N_INPUTS + 1):
        press(page, "add")
    assert [channel.place for channel in page.rig.channels] == [5, 2, 1, 3, 4, 6, 7]
    assert page.message.text() == "All places are wired already."
    own = input_name(5, "lab-1").name
    assert title_of(page.rig.channels[0], "lab-1") == f"5 · {own}, output 1"
    assert own != input_name(5).name


def test_what_was_measured_goes_before_what_is_listed():
    channels = (
        RigChannel(place=7, actuator="example-voice-coil", measured=FLAT),
        RigChannel(place=12, output=2, actuator="of the lab"),
        RigChannel(place=3, output=3, actuator="example-piezo"),
    )
    actuation = ss.actuation_of_rig(Rig(title="Bench", channels=channels))
    assert [actuator.place for actuator in actuation.actuators] == [7, 3]
    assert actuation.at(7).model == FLAT
    assert actuation.at(3).model == ss.actuators.load("example-piezo")
    assert actuation.rig == "Bench"


@pytest.fixture(scope="module")
def recording():
    return bench_top.ears(bench_top.sensed(bench_top.COIL))


@pytest.fixture
def card(monkeypatch, recording):
    return bench_top.use(monkeypatch, bench_top.Card(recording, output=1))


@pytest.fixture
def measuring(card, window, page, qtbot):
    window.playback.player.settings.choose(Output(sample_rate_hz=bench_top.RATE_HZ))
    press(page, "add")
    channel = replace(page.rig.channels[0], actuator="example-voice-coil", full_scale_v=3.0)
    page.take_channel(0, channel)
    page.fields.measure.click()
    measure_page = page.findChild(MeasurePage)
    qtbot.waitUntil(lambda: not measure_page._looking, **WAIT)
    assert not measure_page.start.isEnabled()
    measure_page.arm.click()
    qtbot.waitUntil(measure_page.start.isEnabled, **WAIT)
    values = {
        "sensitivity_v_per_m_per_s2": bench_top.SENSITIVITY,
        "input_full_scale_v": bench_top.INPUT_VOLTS,
        "level_db": -20.0,
        "sweep_s": 1.5,
        "repeats": 2,
    }
    for name, value in values.items():
        measure_page.cells[name].edited.emit(name, value, None)
    yield measure_page
    if isValid(measure_page) and measure_page.isVisible():
        measure_page.reject()


def test_what_is_measured_is_drawn_beside_the_model_and_kept(measuring, page, qtbot):
    assert not measuring.keep.isEnabled()
    measuring.start.click()
    assert measuring.stop.isEnabled()
    assert not measuring.start.isEnabled()
    qtbot.waitUntil(measuring.start.isEnabled, **WAIT)
    assert measuring.keep.isEnabled(), measuring.message.text()
    curves = measuring.plot.plot.curves
    assert [name.short for name in curves.names] == ["Measured", "Model"]
    assert np.abs(curves.y[0] - curves.y[1])[curves.x < 800.0].max() < 0.3
    assert "240 points from 20 to 1000 Hz" in measuring.message.text()
    assert "dB from the model, at" in measuring.message.text()
    assert page.rig.channels[0].measured is None
    measuring.keep.click()
    channel = page.rig.channels[0]
    assert np.abs(channel.measured.response(100.0) / bench_top.COIL.response(100.0) - 1.0) < 0.03
    assert channel.measured_on
    assert "240 points" in page.fields.measured.text()
    # The next channel is measured with the same sensor, on this machine on another day too.
    page.fields.measure.click()
    again = page.findChildren(MeasurePage)[-1]
    assert again.setup.sweep_s == 1.5
    again.reject()
    assert setup_of(setup_text(again.setup)) == again.setup
    for odd in ("", "[", "[1]", '{"sweep_s": -1}', '{"other": 1}'):
        assert setup_of(odd) == MeasuringSetup()


def test_what_cannot_be_measured_says_why(measuring, card, qtbot):
    measuring.cells["loopback_input"].edited.emit("loopback_input", 1, None)
    assert "expected two inputs" in measuring.message.text()
    assert measuring.setup.loopback_input == 0
    for highest_hz, can_start in ((3900.0, False), (1000.0, True)):
        measuring.cells["highest_hz"].edited.emit("highest_hz", highest_hz, None)
        assert measuring.start.isEnabled() is can_start
    measuring.cells["input_number"].edited.emit("input_number", 5, None)
    measuring.start.click()
    qtbot.waitUntil(measuring.start.isEnabled, **WAIT)
    assert "has 2 inputs, and input 5 is to be recorded" in measuring.message.text()
    assert not measuring.keep.isEnabled()
