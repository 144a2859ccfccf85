"""Calibrating a person in the window: mounting, sweeps, a focus, and whether it holds."""

import json
import threading
from dataclasses import replace

import h5py
import pytest
from PySide6.QtWidgets import QFileDialog, QLabel, QMessageBox, QToolButton

import skinsource as ss
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.base.errors import Stopped
from skinsource.lab.calibrating import StandIn
from skinsource.limbs.locations import output_name
from skinsource_gui.panels.calibration.steps import FOCUS, MOUNTING, SWEEPS
from skinsource_gui.shell import calibrating

WAIT = {"timeout": 60_000}
INPUTS = (7, 12, 18)


@pytest.fixture
def window(open_window):
    window = open_window()
    window.playback.player.settings.choose_rig(None)
    return window


@pytest.fixture
def bench(window, qtbot):
    """The panel, in front of which a person with three actuators sits."""

    class Bench:
        panel, calibrating = window.panel("calibration"), window.calibrating

        @property
        def state(self):
            return self.calibrating.state

        def seat(self, **person):
            self.calibrating.make_stand_in = lambda output: StandIn(
                output=output, inputs=INPUTS, **person
            )

        def press(self, name, *, wait=True):
            assert self.panel.buttons[name].isEnabled(), self.state.said
            self.panel.buttons[name].click()
            if wait:
                self.wait()

        def wait(self):
            qtbot.waitUntil(lambda: not self.state.running, **WAIT)

        def results(self):
            return [self.panel.sweeps.item(row, 1).text() for row in range(len(INPUTS))]

    window.do("calibrate")
    bench, before = Bench(), window.calibrating.make_stand_in
    bench.seat()
    bench.calibrating._choose_station(True)
    bench.calibrating._put(step=MOUNTING, places=())
    yield bench
    window.calibrating.make_stand_in = before


def offers_lab(window):
    button = window.menuWidget().findChild(QToolButton, "arrange_lab_button")
    return not button.isHidden()


def test_the_lab_is_offered_once_a_rig_or_the_stand_in_person_is_chosen(make_window, tmp_path):
    window = make_window()
    assert not offers_lab(window)
    save_rig(tmp_path / "bench.skinrig", Rig(channels=(RigChannel(place=7, output=1),)))
    window.playback.player.settings.choose_rig(tmp_path / "bench.skinrig")
    assert offers_lab(window)
    window.playback.player.settings.choose_rig(None)
    assert not offers_lab(window)
    window.do("calibrate")
    assert window.actions_by_name["arrange_lab"].isChecked()
    window.do("arrange_design")
    assert offers_lab(window)


def test_the_stand_in_person_is_calibrated_focused_on_and_verified(
    bench, window, answers, tmp_path, monkeypatch
):
    panel = bench.panel
    panel.cells["output"].field.choose("52")
    bench.press("start")
    assert (bench.state.step, bench.results()) == (SWEEPS, ["accepted"] * 3)
    bench.press("focus")
    assert bench.state.step == FOCUS
    assert {track.location for track in window.document.design.inputs} == set(INPUTS)
    assert window.document.view.outputs == (52,)
    assert panel.verdict.text() == "Not verified."
    bench.press("verify")
    assert panel.verdict.text().startswith("Verified: ")
    assert panel.verified.item(0, 0).text().startswith("52 ")
    assert panel.verified.rowCount() == 9
    whom = f"stand-in, output 52: {output_name(52).name}"
    assert panel.findChild(QLabel, "calibration_whom").text() == whom
    answers["save"] = str(tmp_path / "p")
    bench.press("save")
    saved = ss.people.open_partial(tmp_path / "p.h5")
    assert (saved.person, saved.outputs, saved.inputs) == ("stand-in", (52,), INPUTS)
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    bench.press("report")
    (report,) = tmp_path.glob("stand-in-52-*/report.json")
    assert json.loads(report.read_text("utf-8"))["state"] == "verified"
    assert panel.message.text() == f"Wrote the report into {report.parent}."
    # What is mounted anew is not verified.
    bench.press("start")
    assert panel.verdict.text() == "Nothing is measured yet."
    assert not panel.buttons["verify"].isEnabled()


def test_a_saved_person_is_opened_and_focused_on_as_right_after_calibrating(
    bench, window, answers, tmp_path
):
    panel, path = bench.panel, tmp_path / "p07.h5"
    panel.cells["output"].field.choose("52")
    bench.press("start")
    bench.press("focus")
    measured = window.document.design
    found = bench.state.found
    ss.people.save_partial(path, replace(found.partial, person="p07\n" + 200 * "x"))
    bench.calibrating._choose_station(True)
    bench.calibrating._put(step=MOUNTING)
    assert not panel.buttons["focus"].isEnabled()
    answers["open"] = str(path)
    bench.press("open")
    assert panel.message.text().startswith("Opened p07.h5. Focus here")
    assert (bench.state.step, bench.results()) == (SWEEPS, ["from the file"] * 3)
    assert panel.findChild(QLabel, "calibration_whom").text().endswith(output_name(52).name)
    # Nothing else of it can be done.
    assert [name for name, button in panel.buttons.items() if button.isEnabled()] == [
        "open",
        "start",
        "focus",
    ]
    bench.press("focus")
    focused = window.document.design
    assert focused.inputs == measured.inputs
    assert focused.title.startswith("Focus of p07")
    assert panel.message.text().startswith("The tracks now play the focus.")
    assert "Verify" not in panel.message.text()
    assert panel.verdict.text().startswith("Not verified: opened from a file.")
    assert not panel.buttons["verify"].isEnabled()
    window.document.undo_stack.undo()
    assert panel.message.text() == ""
    bench.press("start")
    assert (bench.state.opened, bench.results()) == (None, ["accepted"] * 3)


def test_of_several_measured_places_one_is_chosen_on_the_skin(bench, window, answers, tmp_path):
    path = tmp_path / "two.h5"
    ss.people.save_partial(path, ss.people.partial("synthetic-2", [9, 21]))
    answers["open"] = str(path)
    bench.press("open")
    assert window.document.view.outputs == (9,)
    for clicked in (21, 30):
        window.document.look(replace(window.document.view, outputs=(clicked,)))
        assert bench.state.sitting.output == 21
    bench.press("focus")
    others = [f"synthetic-{k}" for k in (1, 3, 4)]
    expected = ss.people.focus(ss.people.open_partial(path), 21, others=others)
    design = expected.design(calibrating.WAVEFORM, level=calibrating.LEVEL)
    assert window.document.design.inputs == design.inputs


def test_a_damaged_person_is_one_error_and_nothing_changes(bench, answers, tmp_path):
    bench.press("start")
    before, path = bench.state, tmp_path / "p07.h5"
    ss.people.save_partial(path, before.found.partial)
    with h5py.File(path, "a") as file:
        file["responses"][0, 0, 2, 100] += 1.0
    answers["open"] = str(path)
    bench.press("open")
    assert "p07.h5: its checksum is another one" in bench.panel.message.text()
    assert (bench.state.found, bench.state.opened, bench.state.rows) == (
        before.found,
        None,
        before.rows,
    )


def test_what_a_rig_measured_is_not_lost_by_opening_somebody_without_a_question(
    bench, answers, tmp_path
):
    bench.press("start")
    answers["open"] = str(tmp_path / "p07.h5")
    bench.calibrating._put(stand_in=False, rig_title="Bench")
    bench.calibrating._unsaved = True
    bench.press("open")
    assert answers["asked"] == ["What was measured is in no file. Save it?"]
    assert bench.state.opened is None
    answers["question"] = QMessageBox.StandardButton.Discard
    # There is no such file, and what was measured is still there.
    bench.press("open")
    assert (bench.state.opened, bench.calibrating._unsaved) == (None, True)
    ss.people.save_partial(tmp_path / "p07.h5", bench.state.found.partial)
    bench.press("open")
    assert (bench.state.found, bench.calibrating._unsaved) == (None, False)


def test_the_place_of_the_sensor_is_the_output_that_is_clicked_on_the_skin(bench, window):
    sensor = bench.panel.cells["output"].field
    window.document.look(replace(window.document.view, outputs=(27,)))
    assert (sensor.value, bench.state.sitting.output) == ("27", 27)
    sensor.choose("36")
    assert window.document.view.outputs == (36,)
    bench.press("start")
    window.document.look(replace(window.document.view, outputs=(3,)))
    assert bench.state.sitting.output == 36


def test_with_a_rig_the_sensor_is_moved_by_hand_from_place_to_place(bench):
    bench.press("start")
    bench.press("focus")
    bench.calibrating._put(stand_in=False)
    for box in bench.panel.checks.values():
        box.click()
    bench.panel.arm.click()
    for count in (3, 6, 9):
        bench.calibrating._station.output = bench.state.verification.next_output
        bench.press("verify")
        assert bench.panel.verified.rowCount() == count
        moves = bench.panel.message.text().startswith("Move the sensor to output ")
        assert moves == ("Not verified" in bench.panel.verdict.text()) == (count < 9)


def test_a_failed_input_is_named_with_its_reason_and_measured_again(bench):
    bench.seat(faults={12: "clips"})
    bench.press("start")
    first, failed, last = bench.results()
    assert (first, last) == ("accepted", "accepted")
    assert "clips" in failed
    assert bench.panel.message.text().startswith(f"1 input not accepted. Place 12: {failed}")
    measured = bench.state.rows
    bench.press("repeat")
    assert bench.results() == ["accepted"] * 3
    assert [row in measured for row in bench.state.rows] == [True, False, True]
    assert not bench.panel.buttons["repeat"].isEnabled()


class Endless(StandIn):
    """Plays until it is stopped."""

    def record(self, mix, stop, report):
        while not stop():
            threading.Event().wait(0.01)
        raise Stopped


def test_stop_answers_while_sweeps_are_played(bench, qtbot):
    bench.calibrating.make_stand_in = lambda output: Endless(output=output, inputs=INPUTS)
    bench.press("start", wait=False)
    assert not bench.panel.buttons["focus"].isEnabled()
    bench.press("stop")
    assert bench.panel.message.text().startswith("Stopped.")
    assert bench.panel.buttons["start"].isEnabled()


def test_stop_answers_during_focus_here_and_the_design_stays(bench, window):
    bench.press("start")
    before = window.document.design
    bench.press("focus", wait=False)
    bench.panel.buttons["stop"].click()
    assert bench.panel.message.text() == "Stopping…"
    bench.wait()
    assert bench.panel.message.text() == "Stopped. Nothing new was stored."
    assert (window.document.design, bench.state.verification) == (before, None)


def test_the_panel_says_that_tracks_play_the_focus_while_they_do(bench, window):
    document, message = window.document, bench.panel.message
    document.look(replace(document.view, axes="xyz", outputs=(52,)))
    bench.press("start")
    before = document.view
    bench.press("focus")
    assert message.text().startswith("The tracks now play the focus.")
    document.undo_stack.undo()
    assert message.text() == "Verify plays the focus."
    assert (document.view.axes, document.view.outputs) == (before.axes, before.outputs)


def test_start_and_focus_here_always_go_on_to_the_next_page(bench):
    twice = [("start", MOUNTING, SWEEPS)] * 2 + [("focus", SWEEPS, FOCUS)] * 2
    for button, from_page, to_page in twice:
        bench.panel.steps[from_page].click()
        bench.press(button)
        assert [step.isChecked() for step in bench.panel.steps.values()].index(True) == to_page


def test_what_was_measured_stays_until_the_new_measurement_is_complete(bench, qtbot):
    bench.press("start")
    bench.press("focus")
    before = bench.state
    bench.calibrating.make_stand_in = lambda output: Endless(output=output, inputs=INPUTS)
    bench.press("start", wait=False)
    assert bench.results() == [""] * 3
    bench.press("stop")
    assert (bench.state.found, bench.state.rows) == (before.found, before.rows)
    assert bench.panel.verdict.text() == "Not verified."
    # It is verified on the station where it was measured.
    bench.press("verify")
    assert bench.panel.verdict.text().startswith("Verified: ")


def test_what_a_rig_measured_is_not_lost_by_another_station_without_a_question(bench, answers):
    bench.press("start")
    bench.calibrating._put(stand_in=False, rig_title="Bench")
    bench.calibrating._unsaved, station = True, bench.panel.cells["station"].field
    station.choose("stand_in")
    assert answers["asked"] == ["What was measured is in no file. Save it?"]
    assert (station.value, bench.state.found is None) == ("rig", False)
    answers["question"] = QMessageBox.StandardButton.Discard
    station.choose("stand_in")
    assert (bench.state.found, bench.calibrating.may_lose()) == (None, True)
    assert len(answers["asked"]) == 2


def test_a_rig_plays_only_when_all_is_ticked_and_armed_and_its_channels_are_known(
    bench, window, tmp_path
):
    path, panel = tmp_path / "bench.skinrig", bench.panel
    save_rig(path, Rig(title="Bench", channels=(RigChannel(place=7, output=1, full_scale_v=1.0),)))
    window.playback.player.settings.choose_rig(path)
    panel.cells["station"].field.choose("rig")
    start = panel.buttons["start"]
    assert (start.isEnabled(), start.toolTip()) == (False, "Enter a code of the person first")
    assert (
        panel.findChild(QLabel, "calibration_lacks").text() == "Enter a code of the person first."
    )
    panel.cells["person"].field.setText("p07")
    assert (start.isEnabled(), start.toolTip()) == (False, "Tick all four points first")
    for box in panel.checks.values():
        box.click()
    assert (start.isEnabled(), start.toolTip()) == (False, "Arm the actuators first")
    panel.arm.click()
    bench.press("start")
    assert bench.state.sitting.person == "p07"
    assert "Place 7 has no measured response" in panel.message.text()
    window.playback.player.settings.choose_rig(None)
    assert (bench.state.stand_in, panel.arm.isChecked()) == (True, False)
